#include "framework/archive/compare/history_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "framework/archive/compare/compare.hpp"
#include "framework/archive/posix_file.hpp"
#include "framework/archive/xml_text.hpp"

namespace sluice {
namespace {

using Rows = std::vector<std::vector<double>>;

Rows rows_of(const std::filesystem::path& file) {
  Rows rows;
  std::istringstream text(read_text(file));
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    std::vector<double> numbers;
    for (std::string word; words >> word;) numbers.push_back(parse_real(word, file.string()));
    if (numbers.empty()) continue;
    if (!rows.empty() && rows.front().size() != numbers.size())
      throw DamageError(fmt::format("{}: a line has {} numbers, the first {}", file.string(),
                                    numbers.size(), rows.front().size()));
    rows.push_back(std::move(numbers));
  }
  return rows;
}

bool ascends(const Rows& rows, std::size_t column) {
  return std::is_sorted(rows.begin(), rows.end(),
                        [&](const auto& a, const auto& b) { return a[column] < b[column]; });
}

bool counts_steps(const Rows& rows) {
  return ascends(rows, 0) && std::all_of(rows.begin(), rows.end(), [](const auto& row) {
           return row[0] == std::floor(row[0]) && row[0] >= 0;
         });
}

// How many columns stand before the values: time (2 or 4 numbers), step and time (3 or 5), or none
// (1, or 3 that begin with no steps).
std::size_t columns_before(const Rows& rows) {
  switch (rows.front().size()) {
    case 2:
    case 4:
      return 1;
    case 5:
      return 2;
    case 3:
      return counts_steps(rows) && ascends(rows, 1) ? 2 : 0;
    default:
      return 0;
  }
}

// Linear between lines; the table reaches over t.
double value_at(const HistoryTable& table, const std::vector<double>& column, double t) {
  const auto after = std::lower_bound(table.times.begin(), table.times.end(), t);
  const auto n = static_cast<std::size_t>(after - table.times.begin());
  if (n == table.times.size()) return column.back();
  if (*after == t || n == 0) return column[n];
  const double before = table.times[n - 1], share = (t - before) / (*after - before);
  return column[n - 1] + share * (column[n] - column[n - 1]);
}

bool same_times(const HistoryTable& a, const HistoryTable& b) {
  constexpr double round_off = 1e-12;
  return a.times.size() == b.times.size() &&
         std::equal(a.times.begin(), a.times.end(), b.times.begin(), [](double x, double y) {
           return std::fabs(x - y) <= round_off * std::max(std::fabs(x), std::fabs(y));
         });
}

std::string why_not_comparable(const HistoryTable& a, const HistoryTable& b) {
  if (a.values.size() != b.values.size() || a.timed != b.timed)
    return fmt::format("{} and {} columns of values", a.values.size(), b.values.size());
  if (a.times.empty() || b.times.empty())
    return fmt::format("{} and {} lines", a.times.size(), b.times.size());
  if (!a.timed && a.times.size() != b.times.size())
    return fmt::format("{} and {} lines, without times", a.times.size(), b.times.size());
  // A run ends at its first time beyond maxTime: by less than a step.
  const double most = 0.999 * std::max(a.last_interval(), b.last_interval());
  const double round_off = 1e-12 * std::max(std::fabs(a.end()), std::fabs(b.end()));
  if (std::fabs(a.end() - b.end()) > most + round_off)
    return fmt::format("one ends at {:g}, the other at {:g}", a.end(), b.end());
  if (a.times.front() > b.end() || b.times.front() > a.end()) return "no time in common";
  return {};
}

}  // namespace

HistoryTable read_history(const std::filesystem::path& file) {
  const Rows rows = rows_of(file);
  HistoryTable table;
  if (rows.empty()) return table;
  const std::size_t before = columns_before(rows), width = rows.front().size();
  if (width - before != 1 && width - before != 3)
    throw DamageError(fmt::format("{}: {} numbers in a line are no history", file.string(), width));
  table.timed = before > 0;
  table.values.resize(width - before);
  for (std::size_t n = 0; n < rows.size(); ++n) {
    table.times.push_back(table.timed ? rows[n][before - 1] : static_cast<double>(n + 1));
    for (std::size_t c = before; c < width; ++c) table.values[c - before].push_back(rows[n][c]);
  }
  return table;
}

HistoryDifferences compare_history(const HistoryTable& a, const HistoryTable& b, double absolute,
                                   double relative) {
  HistoryDifferences result;
  result.not_comparable = why_not_comparable(a, b);
  if (!result.not_comparable.empty()) return result;
  result.interpolated = !same_times(a, b);
  for (std::size_t c = 0; c < a.values.size(); ++c) {
    HistoryDifference largest;
    largest.column = static_cast<int>(c);
    for (const double x : a.values[c]) largest.scale = std::max(largest.scale, std::fabs(x));
    for (std::size_t n = 0; n < a.times.size(); ++n) {
      const double t = a.times[n];
      if (result.interpolated && (t < b.times.front() || t > b.end())) continue;
      const double x = a.values[c][n],
                   y = result.interpolated ? value_at(b, b.values[c], t) : b.values[c][n];
      ++result.values;
      if (!numbers_differ(x, y, absolute, relative)) continue;
      const bool first = largest.differing++ == 0;
      if (!first && !(std::fabs(x - y) > std::fabs(largest.a - largest.b))) continue;
      largest.line = static_cast<int>(n + 1);
      largest.time = t;
      largest.a = x;
      largest.b = y;
    }
    if (largest.differing > 0) result.columns.push_back(largest);
  }
  return result;
}

}  // namespace sluice
