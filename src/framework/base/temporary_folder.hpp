// A folder of its own that goes away with the object, for tests and for commands that need one.
#pragma once
#include <filesystem>
#include <string>

namespace sluice {

class TemporaryFolder {
 public:
  // memory: for what is small, where the machine has such a place, else on disk; flushing thousands
  // of files to a disk takes long. disk: in the folder that TMPDIR names, /tmp without.
  enum class Place { memory, disk };

  // SystemError when it cannot be made.
  explicit TemporaryFolder(Place place = Place::memory);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string string() const { return path_.string(); }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace sluice
