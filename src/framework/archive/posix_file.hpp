// Files by their POSIX calls: every call checked, failures named with path, cause and what to do.
//
// An archive must survive a kill or a power cut at any moment. So what is written is flushed before
// anything names it, and text files that name things are replaced as a whole (write beside, flush,
// rename). A flush takes milliseconds, however little there is to flush: a step's many small files
// and folders are flushed all at once, with the file system that they lie in.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace sluice {

// Throws SystemError: "cannot ACTION PATH: errno text", with the free space when the disk is full.
[[noreturn]] void fail_system(const std::string& action, const std::filesystem::path& path,
                              int error_number);

class PosixFile {
 public:
  static PosixFile create(const std::filesystem::path& path);  // must not exist, or is emptied
  static PosixFile open_existing(const std::filesystem::path& path);  // read and write
  static PosixFile open_or_create(const std::filesystem::path& path);
  static PosixFile open_read(const std::filesystem::path& path);
  PosixFile(PosixFile&& other) noexcept;
  PosixFile& operator=(PosixFile&& other) noexcept;
  PosixFile(const PosixFile&) = delete;
  PosixFile& operator=(const PosixFile&) = delete;
  ~PosixFile();

  void write_at(std::int64_t offset, const void* data, std::size_t bytes);
  // Throws when the file ends before `bytes` are read.
  void read_at(std::int64_t offset, void* data, std::size_t bytes) const;
  std::int64_t size() const;
  void truncate(std::int64_t bytes);
  void flush();  // to the disk
  void close();  // checks what the destructor cannot report

  const std::filesystem::path& path() const { return path_; }

 private:
  PosixFile(int descriptor, std::filesystem::path path)
      : descriptor_(descriptor), path_(std::move(path)) {}
  static PosixFile open(const std::filesystem::path& path, int flags, const char* action);
  int descriptor_ = -1;
  std::filesystem::path path_;
};

std::string read_text(const std::filesystem::path& path);
// In a folder that nothing names yet. Not flushed.
void write_text(const std::filesystem::path& path, std::string_view text);
// Writes beside the target, flushes, renames: a reader sees the old text or the new, never a part.
// Before the rename the file system is flushed, so that all that this process has written, made or
// renamed in it earlier is on disk when the new text can be seen.
void write_text_atomically(const std::filesystem::path& path, std::string_view text);
// False when the folder exists already.
bool make_folder(const std::filesystem::path& path);
void rename_path(const std::filesystem::path& from, const std::filesystem::path& to);
// Everything in the file system of this folder, to the disk.
void flush_file_system(const std::filesystem::path& folder);
// Flushes of this process so far, of files and file systems.
std::int64_t flush_count();
void remove_tree(const std::filesystem::path& path);

// Keeps other runs from writing into the same archive while this one lives (the lock goes with the
// process). Throws SystemError when another run holds it.
class FolderLock {
 public:
  FolderLock() = default;
  explicit FolderLock(const std::filesystem::path& folder);
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;
  ~FolderLock();
  // Whether this path still leads to the folder: it may have been removed, renamed or replaced.
  bool is_at(const std::filesystem::path& folder) const;

 private:
  int descriptor_ = -1;
};

}  // namespace sluice
