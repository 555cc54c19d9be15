// Appending to the files of analyses, and cutting them back for a restart.
#include "framework/analysis/sample_file.hpp"

#include <cstdlib>

#include "framework/archive/posix_file.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

// The number in a line's n-th word.
double word_as_number(const std::string& line, int n) {
  const char* blank = " \t";
  std::size_t start = line.find_first_not_of(blank);
  for (; n > 0 && start != line.npos; --n)
    start = line.find_first_not_of(blank, line.find_first_of(blank, start));
  return start == line.npos ? 0.0 : std::strtod(line.c_str() + start, nullptr);
}

// Has a text any line besides its header.
bool holds_sample(const std::string& text) {
  for (std::size_t line = 0; line < text.size(); line = text.find('\n', line) + 1)
    if (text[line] != '#') return true;
  return false;
}

}  // namespace

void make_folders(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail_system("create folder", folder, error.value());
}

std::string lines_up_to(const std::string& text, int time_column, double time) {
  std::size_t kept = 0;
  for (;;) {
    const std::size_t end = text.find('\n', kept);
    if (end == text.npos) break;
    const std::string line = text.substr(kept, end - kept);
    const bool header = !line.empty() && line.front() == '#';
    if (!header && word_as_number(line, time_column) > time) break;
    kept = end + 1;
  }
  return text.substr(0, kept);
}

AnalysisFile::AnalysisFile(fs::path name, std::string header, int time_column)
    : name_(std::move(name)), header_(std::move(header)), time_column_(time_column) {}

void AnalysisFile::append(const std::string& line) {
  pending_ += line;
  pending_ += '\n';
}

void AnalysisFile::flush(const fs::path& folder) {
  if (pending_.empty()) return;
  make_folders((folder / name_).parent_path());
  PosixFile file = PosixFile::open_or_create(folder / name_);
  const std::int64_t end = file.size();
  try {
    const std::string text = end == 0 ? header_ + pending_ : pending_;
    file.write_at(end, text.data(), text.size());
  } catch (...) {
    file.truncate(end);
    throw;
  }
  file.close();
  pending_.clear();
}

void AnalysisFile::adopt(const fs::path& earlier, const fs::path& folder, double time) const {
  if (!fs::exists(earlier / name_)) return;
  const std::string kept = lines_up_to(read_text(earlier / name_), time_column_, time);
  if (!holds_sample(kept)) return;
  make_folders((folder / name_).parent_path());
  write_text(folder / name_, kept);
}

}  // namespace sluice
