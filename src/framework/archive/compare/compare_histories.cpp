// Histories of two archives, line by line and number by number.
#include <fmt/format.h>

#include <set>
#include <sstream>

#include "framework/archive/compare/compare.hpp"
#include "framework/archive/posix_file.hpp"

namespace sluice {
namespace {

std::set<std::string> files_of(const Archive& archive) {
  std::set<std::string> files;
  for (const HistoryEntry& h : archive.index().histories) files.insert(h.file);
  return files;
}

std::vector<std::vector<double>> numbers_of(const std::filesystem::path& path) {
  std::vector<std::vector<double>> lines;
  std::istringstream text(read_text(path));
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    auto& numbers = lines.emplace_back();
    for (std::string word; words >> word;) numbers.push_back(parse_real(word, path.string()));
  }
  return lines;
}

void compare_files(const std::string& file, const Archive& a, const Archive& b,
                   const CompareOptions& options, HistoryComparison& result) {
  const auto x = numbers_of(a.folder() / file), y = numbers_of(b.folder() / file);
  if (x.size() != y.size())
    result.not_comparable.push_back(fmt::format("{}: {} and {} lines", file, x.size(), y.size()));
  for (std::size_t n = 0; n < std::min(x.size(), y.size()); ++n) {
    if (x[n].size() != y[n].size()) {
      result.not_comparable.push_back(
          fmt::format("{}: line {} has {} and {} numbers", file, n + 1, x[n].size(), y[n].size()));
      return;
    }
    for (std::size_t i = 0; i < x[n].size(); ++i) {
      ++result.values;
      if (!numbers_differ(x[n][i], y[n][i], options.absolute, options.relative)) continue;
      ++result.differing;
      result.differences.push_back(fmt::format("{}: line {}, column {}: {:.17g} and {:.17g}", file,
                                               n + 1, i + 1, x[n][i], y[n][i]));
    }
  }
}

}  // namespace

HistoryComparison compare_histories(const Archive& a, const Archive& b,
                                    const CompareOptions& options) {
  HistoryComparison result;
  const std::set<std::string> in_a = files_of(a), in_b = files_of(b);
  for (const std::string& file : in_b)
    if (!in_a.contains(file)) result.not_comparable.push_back("only the second has " + file);
  for (const std::string& file : in_a) {
    if (in_b.contains(file))
      compare_files(file, a, b, options, result);
    else
      result.not_comparable.push_back("only the first has " + file);
  }
  return result;
}

}  // namespace sluice
