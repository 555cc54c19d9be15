#include "framework/base/temporary_folder.hpp"

#include <fmt/format.h>
#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "framework/base/error.hpp"

namespace sluice {

namespace fs = std::filesystem;

namespace {

constexpr const char* memory_folder = "/dev/shm";

fs::path disk_folder() {
  std::error_code fault;
  const fs::path folder = fs::temp_directory_path(fault);
  if (!fault) return folder;
  const char* named = ::getenv("TMPDIR");
  throw SystemError(
      fmt::format("the folder for temporary files, {}, does not exist ({}); set TMPDIR to a folder "
                  "that can be written",
                  named != nullptr ? named : "/tmp", fault.message()));
}

}  // namespace

TemporaryFolder::TemporaryFolder(Place place) {
  const bool in_memory = place == Place::memory && ::access(memory_folder, W_OK) == 0;
  const std::string unique(6, 'X');  // mkdtemp puts letters of its own there
  std::string name = ((in_memory ? memory_folder : disk_folder()) / ("sluice_" + unique)).string();
  if (::mkdtemp(name.data()) == nullptr)
    throw SystemError(
        fmt::format("cannot make the temporary folder {}: {}; set TMPDIR to a folder that can be "
                    "written",
                    name, std::strerror(errno)));
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace sluice
