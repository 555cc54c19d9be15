// Appending to histories, and cutting them back for a restart.
#include "framework/archive/history_file.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <string_view>

#include "framework/archive/posix_file.hpp"
#include "framework/archive/xml_text.hpp"

namespace sluice {
namespace {

// Whether a line (without its end) belongs to the run up to this step and time.
bool belongs(const std::string& line, const HistoryControl& control, int step, double time) {
  if (control.step_column) return std::atoi(line.c_str()) <= step;
  return std::strtod(line.c_str(), nullptr) <= time;
}

// How many lines the steps 1 to `step` have written when lines say neither step nor time.
int line_count(const HistoryControl& control, int step) {
  int count = 0;
  for (int s = 1; s <= step; ++s) count += control.selects(s);
  return count;
}

}  // namespace

HistoryFile::HistoryFile(std::filesystem::path path, HistoryControl control)
    : path_(std::move(path)), control_(control) {}

void HistoryFile::append(int step, double time, double value) {
  append_line(step, time, real_text(value));
}
void HistoryFile::append(int step, double time, Vec3 value) {
  append_line(step, time, fmt::format("{:.17g} {:.17g} {:.17g}", value.x, value.y, value.z));
}

void HistoryFile::append_line(int step, double time, const std::string& value) {
  if (!control_.selects(step)) return;
  if (control_.step_column) pending_ += fmt::format("{:>10}\t", step);
  if (control_.time_column) pending_ += real_text(time) + '\t';
  pending_ += value + '\n';
}

void HistoryFile::write() {
  if (pending_.empty()) return;
  PosixFile file = PosixFile::open_or_create(path_);
  const std::int64_t end = file.size();
  try {
    file.write_at(end, pending_.data(), pending_.size());
  } catch (...) {
    file.truncate(end);
    throw;
  }
  file.close();
  pending_.clear();
}

std::string history_file_name(const std::string& label, int material) {
  return material < 0 ? label + ".dat" : fmt::format("{}_{}.dat", label, material);
}

void cut_history(const std::filesystem::path& path, const HistoryControl& control, int step,
                 double time) {
  const std::string text = read_text(path);
  const bool by_count = !control.step_column && !control.time_column;
  const int wanted = by_count ? line_count(control, step) : 0;
  std::size_t kept = 0;
  for (int lines = 0;; ++lines) {
    const std::size_t end = text.find('\n', kept);
    if (end == text.npos) break;
    const bool keep =
        by_count ? lines < wanted : belongs(text.substr(kept, end - kept), control, step, time);
    if (!keep) break;
    kept = end + 1;
  }
  if (kept == text.size()) return;
  PosixFile file = PosixFile::open_existing(path);
  file.truncate(static_cast<std::int64_t>(kept));
  file.close();
}

}  // namespace sluice
