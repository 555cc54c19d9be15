// A file written piece by piece beside its target, which it replaces once it is complete.
#pragma once
#include "framework/archive/posix_file.hpp"

namespace sluice {

class ReplacingFile {
 public:
  explicit ReplacingFile(std::filesystem::path target);
  ~ReplacingFile();  // removes what was not finished
  ReplacingFile(const ReplacingFile&) = delete;
  ReplacingFile& operator=(const ReplacingFile&) = delete;

  PosixFile& file() { return file_; }
  void append(const void* data, std::size_t bytes);
  void append(std::string_view text) { append(text.data(), text.size()); }
  std::int64_t appended() const { return appended_; }  // bytes
  void finish();                                       // not flushed

 private:
  std::filesystem::path target_;
  PosixFile file_;
  std::int64_t appended_ = 0;
  bool finished_ = false;
};

}  // namespace sluice
