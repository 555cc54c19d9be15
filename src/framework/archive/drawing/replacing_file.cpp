// Under a name of this process, until it is finished.
#include "framework/archive/drawing/replacing_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <utility>

namespace sluice {

ReplacingFile::ReplacingFile(std::filesystem::path target)
    : target_(std::move(target)),
      file_(PosixFile::create(target_.string() + fmt::format(".{}.partial", ::getpid()))) {}

ReplacingFile::~ReplacingFile() {
  if (!finished_) ::unlink(file_.path().c_str());
}

void ReplacingFile::append(const void* data, std::size_t bytes) {
  file_.write_at(appended_, data, bytes);
  appended_ += static_cast<std::int64_t>(bytes);
}

void ReplacingFile::finish() {
  file_.close();
  rename_path(file_.path(), target_);
  finished_ = true;
}

}  // namespace sluice
