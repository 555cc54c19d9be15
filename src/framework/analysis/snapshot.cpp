// Writing samples that have a file each, and taking over those of an earlier archive.
#include "framework/analysis/snapshot.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <limits>
#include <string_view>

#include "framework/analysis/sample_file.hpp"
#include "framework/archive/posix_file.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view head = "# Simulation time: ";

// What snapshot_head() has written; larger than any time where it is not there.
double time_of(const std::string& text) {
  if (text.compare(0, head.size(), head) != 0) return std::numeric_limits<double>::infinity();
  return std::strtod(text.c_str() + head.size(), nullptr);
}

void write_whole(const fs::path& path, const std::string& text) {
  PosixFile file = PosixFile::create(path);
  try {
    file.write_at(0, text.data(), text.size());
  } catch (...) {
    std::error_code ignored;
    fs::remove(path, ignored);
    throw;
  }
  file.close();
}

}  // namespace

std::string snapshot_head(double time) {
  return fmt::format("{}{:.17g}\n", head, time);
}

SnapshotFiles::SnapshotFiles(fs::path root, int level)
    : root_(std::move(root)), level_(fmt::format("L-{}", level)) {}

void SnapshotFiles::add(int step, const std::string& name, std::string text) {
  pending_.emplace_back(root_ / fmt::format("t{:05}", step) / level_ / name, std::move(text));
}

void SnapshotFiles::flush(const fs::path& folder) {
  for (const auto& [name, text] : pending_) {
    make_folders((folder / name).parent_path());
    write_whole(folder / name, text);
  }
  pending_.clear();
}

void SnapshotFiles::adopt(const fs::path& earlier, const fs::path& folder, double time) const {
  std::error_code error;
  for (const auto& of_step : fs::directory_iterator(earlier / root_, error))
    for (const auto& file : fs::directory_iterator(of_step.path() / level_, error)) {
      if (!file.is_regular_file(error)) continue;
      const std::string text = read_text(file.path());
      if (time_of(text) > time) continue;
      const fs::path name = root_ / of_step.path().filename() / level_ / file.path().filename();
      make_folders((folder / name).parent_path());
      write_whole(folder / name, text);
    }
}

}  // namespace sluice
