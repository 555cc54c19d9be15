// Histories of two archives, at the same times.
#include <fmt/format.h>

#include <set>

#include "framework/archive/compare/compare.hpp"
#include "framework/archive/compare/history_table.hpp"

namespace sluice {
namespace {

std::set<std::string> files_of(const Archive& archive) {
  std::set<std::string> files;
  for (const HistoryEntry& h : archive.index().histories) files.insert(h.file);
  return files;
}

void compare_files(const std::string& file, const Archive& a, const Archive& b,
                   const CompareOptions& options, HistoryComparison& result) {
  const HistoryDifferences found =
      compare_history(read_history(a.folder() / file), read_history(b.folder() / file),
                      options.absolute, options.relative);
  if (!found.not_comparable.empty())
    result.not_comparable.push_back(file + ": " + found.not_comparable);
  result.values += found.values;
  for (const HistoryDifference& d : found.columns) {
    result.differing += d.differing;
    const std::string column =
        found.columns.size() > 1 || d.column > 0 ? fmt::format(", value {}", d.column + 1) : "";
    result.differences.push_back(fmt::format(
        "{}{}: {} lines differ{}, most in line {} at {:.17g}: {:.17g} and {:.17g}", file, column,
        d.differing, found.interpolated ? ", at the times of the first" : "", d.line, d.time, d.a,
        d.b));
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
