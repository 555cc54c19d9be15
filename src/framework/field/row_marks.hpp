// What is remembered of parts of the rows of a box: a small number for `cells` cells each, 0 where
// nothing is known.
//
// Parts lie on a lattice of the box. Only who computes a part as a whole marks it: no part that two
// blocks share has a mark, and threads never write the same one.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "framework/grid/level.hpp"

namespace sluice {

class RowMarks {
 public:
  static constexpr int cells = 32;

  RowMarks(const IndexBox& box, const Level& level) : box_(box) {
    while (along_ < 2 && !level.active[along_]) ++along_;
    of_row_ = (box.size()[along_] + cells - 1) / cells;
    IntVec3 rows = box.size();
    rows[along_] = of_row_;
    marks_.assign(static_cast<std::size_t>(rows.x) * (rows.y * rows.z), 0);
  }

  // Calls f(first, count, mark) for parts of the `n` cells of a row from `cell` on; they cover it.
  template <class F>
  void for_each(IntVec3 cell, int n, F&& f) const {
    const int x = cell[along_] - box_.lower[along_], size = box_.size()[along_];
    const int inside = std::clamp(-x, 0, n), end = std::clamp(size - x, inside, n);
    cell[along_] = box_.lower[along_];
    if (inside == end || !box_.contains(cell)) return f(0, n, 0);
    const std::uint8_t* marks = marks_.data() + row(cell);
    int first = 0, mark = 0;
    for (int i = inside; i < end;) {
      const int part = (x + i) / cells, here = marks[part];
      if (here != mark && i > first) f(first, i - first, mark);
      if (here != mark) first = i;
      mark = here;
      i = std::min(end, (part + 1) * cells - x);
    }
    if (mark != 0) f(first, end - first, mark);
    if (mark != 0) first = end;
    if (first < n) f(first, n - first, 0);
  }

  // What is known now of `n` cells of a row from `cell` on. Parts that are cut keep it if they have
  // it.
  void set(IntVec3 cell, int n, int mark) {
    const int x = cell[along_] - box_.lower[along_], size = box_.size()[along_];
    cell[along_] = box_.lower[along_];
    std::uint8_t* marks = marks_.data() + row(cell);
    const auto now = static_cast<std::uint8_t>(mark);
    for (int part = x / cells; part * cells < x + n; ++part) {
      const bool whole = part * cells >= x && std::min((part + 1) * cells, size) <= x + n;
      if (whole)
        marks[part] = now;
      else if (marks[part] != now && marks[part] != 0)
        marks[part] = 0;
    }
  }

  void clear() { std::fill(marks_.begin(), marks_.end(), std::uint8_t{0}); }
  void clear(const IndexBox& region) {
    IndexBox rows = region;
    rows.upper[along_] = rows.lower[along_] + 1;
    for (int k = rows.lower.z; k < rows.upper.z; ++k)
      for (int j = rows.lower.y; j < rows.upper.y; ++j)
        for (int i = rows.lower.x; i < rows.upper.x; ++i) set({i, j, k}, region.size()[along_], 0);
  }

 private:
  std::ptrdiff_t row(IntVec3 cell) const {
    std::ptrdiff_t number = 0;
    for (int d = 2; d >= 0; --d)
      if (d != along_) number = number * box_.size()[d] + (cell[d] - box_.lower[d]);
    return number * of_row_;
  }

  IndexBox box_;
  int along_ = 0;   // direction of rows
  int of_row_ = 0;  // marks
  std::vector<std::uint8_t> marks_;
};

}  // namespace sluice
