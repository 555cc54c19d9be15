// A .dat history as numbers, and two of them at the same times.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sluice {

// Columns before the values tell step and time, or one of both, or neither: then lines are counted.
struct HistoryTable {
  std::vector<double> times;                // s, one per line; ascending
  std::vector<std::vector<double>> values;  // by column and line, in the unit of the label
  bool timed = true;                        // false: `times` are the numbers of the lines

  double end() const { return times.empty() ? 0 : times.back(); }
  double last_interval() const {
    return times.size() < 2 ? 0 : times.back() - times[times.size() - 2];
  }
};

// A value is one number or a vector of three. DamageError where the file is no such table;
// SystemError where it cannot be read.
HistoryTable read_history(const std::filesystem::path& file);

// The largest difference of a column.
struct HistoryDifference {
  int column = 0;       // of the values, from 0
  int line = 0;         // of the first table, from 1
  double time = 0;      // s
  double a = 0, b = 0;  // there, in the unit of the label
  double scale = 0;     // the largest magnitude of the column of the first
  std::int64_t differing = 0;
};

struct HistoryDifferences {
  bool interpolated = false;  // the lines are of other times
  std::string not_comparable;
  std::int64_t values = 0;
  std::vector<HistoryDifference> columns;  // in which something differs
};

// At the times of the first, as far as the second reaches: line by line where the times are the
// same, else linear between the lines of the second. Numbers differ as in compare.hpp. Not
// comparable: other numbers of columns, no time in common, or ends further apart than a step.
HistoryDifferences compare_history(const HistoryTable& a, const HistoryTable& b, double absolute,
                                   double relative);

}  // namespace sluice
