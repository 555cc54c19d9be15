// Lines for changes only: a level that stays as it is costs nothing.
#include "framework/run/simulation/level_history.hpp"

#include <fmt/format.h>

#include <sstream>

#include "framework/archive/posix_file.hpp"

namespace sluice {
namespace {

constexpr int time_column = 1;

std::string header(int levels) {
  std::string text = "# step\ttime";
  for (int l = 0; l < levels; ++l) text += fmt::format("\tlevel {}", l);
  return text + "\n";
}

}  // namespace

LevelHistory::LevelHistory(int levels, bool is_root)
    : file_("levels.txt", header(levels), time_column), writes_(is_root && levels > 1) {}

void LevelHistory::open(std::filesystem::path folder) {
  folder_ = std::move(folder);
}

void LevelHistory::adopt(const std::filesystem::path& earlier, double time) {
  if (!writes_ || folder_.empty()) return;
  file_.adopt(earlier, folder_, time);
  if (!std::filesystem::exists(folder_ / file_.name())) return;
  // The last line still holds.
  const std::string text = read_text(folder_ / file_.name());
  std::istringstream line(text.substr(text.rfind('\n', text.size() - 2) + 1));
  line >> written_step_ >> time_;
  for (std::int64_t n; line >> n;) cells_.push_back(n);
}

void LevelHistory::append() {
  std::string line = fmt::format("{}\t{:.17g}", step_, time_);
  for (std::int64_t n : cells_) line += fmt::format("\t{}", n);
  file_.append(line);
  written_step_ = step_;
}

void LevelHistory::sample(int step, double time, const std::vector<std::int64_t>& cells) {
  if (!writes_ || folder_.empty()) return;
  step_ = step;
  time_ = time;
  if (cells == cells_) return;
  cells_ = cells;
  append();
}

void LevelHistory::flush() {
  if (writes_ && !folder_.empty()) file_.flush(folder_);
}

void LevelHistory::finish() {
  if (!writes_ || folder_.empty()) return;
  if (!cells_.empty() && written_step_ != step_) append();
  flush();
}

}  // namespace sluice
