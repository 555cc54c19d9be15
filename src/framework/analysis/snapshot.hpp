// Files of single samples: <root>/tNNNNN/L-<level>/<name>, NNNNN the number of steps taken.
//
// Texts begin with snapshot_head() and are kept in memory until flush(). A restarted run takes over
// those up to its time.
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace sluice {

// The first line of every file: when it was, s.
std::string snapshot_head(double time);

class SnapshotFiles {
 public:
  // `root`: path below the archive's folder.
  SnapshotFiles(std::filesystem::path root, int level);

  void add(int step, const std::string& name, std::string text);
  // A file that cannot be written whole is removed; SystemError, and nothing is forgotten.
  void flush(const std::filesystem::path& folder);
  void adopt(const std::filesystem::path& earlier, const std::filesystem::path& folder,
             double time) const;

 private:
  std::filesystem::path root_;
  std::string level_;
  std::vector<std::pair<std::filesystem::path, std::string>> pending_;
};

}  // namespace sluice
