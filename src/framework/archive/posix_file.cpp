// Checked POSIX file calls, atomic text files, folder locks.
#include "framework/archive/posix_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "framework/base/console.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace {

std::atomic<std::int64_t> flushes = 0;

// What to try next, for the causes that users meet.
std::string advice(const std::filesystem::path& path, int error_number) {
  switch (error_number) {
    case ENOSPC:
    case EDQUOT: {
      struct statvfs space {};
      const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
      std::string left;
      if (statvfs(folder.c_str(), &space) == 0)
        left = fmt::format(" ({} left)", human_bytes(static_cast<double>(space.f_bavail) *
                                                     static_cast<double>(space.f_frsize)));
      return left + "; free some space or choose another folder with -o DIR";
    }
    case EFBIG:
      return "; raise the limit of file sizes (ulimit -f)";
    case EACCES:
    case EPERM:
    case EROFS:
      return "; choose a folder that you may write to with -o DIR";
    case ENOENT:
    case ENOTDIR:
      return "; check the path";
    case EMFILE:
    case ENFILE:
      return "; raise the limit of open files (ulimit -n)";
    default:
      return "";
  }
}

}  // namespace

void fail_system(const std::string& action, const std::filesystem::path& path, int error_number) {
  throw SystemError(fmt::format("cannot {} {}: {}{}", action, path.string(),
                                std::strerror(error_number), advice(path, error_number)));
}

PosixFile PosixFile::open(const std::filesystem::path& path, int flags, const char* action) {
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  if (descriptor < 0) fail_system(action, path, errno);
  return {descriptor, path};
}
PosixFile PosixFile::create(const std::filesystem::path& path) {
  return open(path, O_RDWR | O_CREAT | O_TRUNC, "create");
}
PosixFile PosixFile::open_existing(const std::filesystem::path& path) {
  return open(path, O_RDWR, "open");
}
PosixFile PosixFile::open_or_create(const std::filesystem::path& path) {
  return open(path, O_RDWR | O_CREAT, "open");
}
PosixFile PosixFile::open_read(const std::filesystem::path& path) {
  return open(path, O_RDONLY, "open");
}

PosixFile::PosixFile(PosixFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), path_(std::move(other.path_)) {}

PosixFile& PosixFile::operator=(PosixFile&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(path_, other.path_);
  return *this;
}

PosixFile::~PosixFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void PosixFile::write_at(std::int64_t offset, const void* data, std::size_t bytes) {
  const char* from = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t done = ::pwrite(descriptor_, from, bytes, offset);
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) fail_system("write", path_, errno);
    if (done == 0) fail_system("write", path_, ENOSPC);
    from += done;
    offset += done;
    bytes -= done;
  }
}

void PosixFile::read_at(std::int64_t offset, void* data, std::size_t bytes) const {
  char* to = static_cast<char*>(data);
  while (bytes > 0) {
    const ssize_t done = ::pread(descriptor_, to, bytes, offset);
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) fail_system("read", path_, errno);
    if (done == 0)
      throw SystemError(
          fmt::format("cannot read {}: the file ends at byte {}, {} more were expected",
                      path_.string(), offset, bytes));
    to += done;
    offset += done;
    bytes -= done;
  }
}

std::int64_t PosixFile::size() const {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) fail_system("inspect", path_, errno);
  return status.st_size;
}

void PosixFile::truncate(std::int64_t bytes) {
  if (::ftruncate(descriptor_, bytes) != 0) fail_system("cut", path_, errno);
}

void PosixFile::flush() {
  ++flushes;
  // EINVAL: a special file or file system that has nothing to flush.
  if (::fsync(descriptor_) != 0 && errno != EINVAL) fail_system("flush", path_, errno);
}

void PosixFile::close() {
  const int descriptor = std::exchange(descriptor_, -1);
  if (descriptor >= 0 && ::close(descriptor) != 0) fail_system("close", path_, errno);
}

std::string read_text(const std::filesystem::path& path) {
  const PosixFile file = PosixFile::open_read(path);
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode))
    fail_system("read", path, EISDIR);
  std::string text(file.size(), '\0');
  file.read_at(0, text.data(), text.size());
  return text;
}

void write_text(const std::filesystem::path& path, std::string_view text) {
  PosixFile file = PosixFile::create(path);
  file.write_at(0, text.data(), text.size());
  file.close();
}

void write_text_atomically(const std::filesystem::path& path, std::string_view text) {
  // The process number keeps two writers from sharing the file beside the target.
  const std::filesystem::path beside = path.string() + fmt::format(".{}.partial", ::getpid());
  try {
    write_text(beside, text);
    flush_file_system(path.has_parent_path() ? path.parent_path() : std::filesystem::path("."));
    rename_path(beside, path);
  } catch (...) {
    ::unlink(beside.c_str());
    throw;
  }
}

bool make_folder(const std::filesystem::path& path) {
  if (::mkdir(path.c_str(), 0777) == 0) return true;
  if (errno == EEXIST) return false;
  fail_system("create folder", path, errno);
}

void rename_path(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (std::rename(from.c_str(), to.c_str()) != 0)
    fail_system("rename " + from.string() + " to", to, errno);
}

void flush_file_system(const std::filesystem::path& folder) {
  ++flushes;
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) fail_system("open folder", folder, errno);
  const int status = ::syncfs(descriptor);
  const int error_number = errno;
  ::close(descriptor);
  if (status == 0) return;
  if (error_number != ENOSYS) fail_system("flush", folder, error_number);
  ::sync();  // a system that cannot flush one file system flushes all
}

std::int64_t flush_count() {
  return flushes;
}

void remove_tree(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::remove_all(path, error);
  if (error) fail_system("remove", path, error.value());
}

FolderLock::FolderLock(const std::filesystem::path& folder) {
  descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0) fail_system("open folder", folder, errno);
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  const int error_number = errno;
  ::close(std::exchange(descriptor_, -1));
  if (error_number == EWOULDBLOCK)
    throw SystemError(fmt::format(
        "another run is writing into {}; wait for it or give this one its own folder with -o DIR",
        folder.string()));
  // Some network file systems know no locks; the run goes on without one.
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool FolderLock::is_at(const std::filesystem::path& folder) const {
  struct stat held {
  }, found{};
  return ::fstat(descriptor_, &held) == 0 && ::stat(folder.c_str(), &found) == 0 &&
         held.st_dev == found.st_dev && held.st_ino == found.st_ino;
}

}  // namespace sluice
