// Which materials the cells of a row hold: runs of one material, and what rows remember of them.
// Keys are numbers of materials, -1 for several, kept as numbers of cells.
#pragma once
#include <algorithm>
#include <cstddef>

#include "framework/field/row_marks.hpp"
#include "framework/task/row.hpp"
#include "ice/fluid/material_set.hpp"
#include "ice/step/runs.hpp"

namespace sluice::ice {

// Rows of one material over runs that hold one (key >= 0), but in one piece across those that do
// not, where these are short and the materials on both sides run the same rows, kind(key): what a
// piece leaves in cells or faces of several materials is computed again. Looking rows up takes
// longer than a few dozen of them. Calls one(first, count, kind). True: some hold several.
template <class Runs, class Kind, class One>
bool for_each_pure_piece(Runs runs, Kind kind, One&& one) {
  constexpr int max_between = 32;
  int begin = 0, end = 0, of = 0;
  bool mixed = false;
  runs([&](int first, int count, double key) {
    mixed = mixed || key < 0.0;
    if (key < 0.0) return;
    const int here = kind(static_cast<std::size_t>(key));
    if (end > begin && here == of && first - end <= max_between) {
      end = first + count;
      return;
    }
    if (end > begin) one(begin, end - begin, of);
    begin = first;
    end = first + count;
    of = here;
  });
  if (end > begin) one(begin, end - begin, of);
  return mixed;
}

// Parts of a row that cover it, each with the rows of the materials that are alone in it; what is
// mixed goes with those before.
template <class Runs, class Kind, class One>
void for_each_piece(Runs runs, int n, Kind kind, One&& one) {
  int begin = 0, of = -1;
  runs([&](int first, int, double key) {
    if (key < 0.0) return;
    const int here = kind(static_cast<std::size_t>(key));
    if (of >= 0 && here != of) {
      one(begin, first - begin, of);
      begin = first;
    }
    of = here;
  });
  one(begin, n - begin, of < 0 ? 0 : of);
}

// Rows remember where a material is alone: its mass, volume 1 and the lack of the others are in the
// state already. The mark is its number, and one.
// Calls f(first, count, material) for parts that cover the row, -1 where nothing is known.
template <class F>
void for_each_marked(const Row& row, const RowMarks* marks, F&& f) {
  if (marks == nullptr) return f(0, row.count(), -1);
  marks->for_each(row.cell(), row.count(),
                  [&](int first, int count, int mark) { f(first, count, mark - 1); });
}
// From now on `material` is alone in these cells of the new state, or (-1) nothing is known.
inline void mark_alone(const Row& row, int material) {
  if (RowMarks* marks = row.new_marks()) marks->set(row.cell(), row.count(), material + 1);
}

// Runs of cells that no solid touches: calls f(first, count).
template <class F>
void for_each_full(const double* cut, int first, int count, F&& f) {
  for (int i = first; i < first + count;) {
    if (cut[i] != 0) {
      ++i;
      continue;
    }
    const int begin = i;
    while (i < first + count && cut[i] == 0) ++i;
    f(begin, i - begin);
  }
}

// The values of a material: its own where the neighbourhood (`pure`) is mixed, those of the mixture
// where it is alone, nothing where another is; of any quantity. No row overlaps `to`.
inline void pick_row(int n, const double* __restrict pure, int material,
                     const double* __restrict own, const double* __restrict mixture,
                     double* __restrict to) {
  const double m = material;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double alone = pure[i] == m ? mixture[i] : 0.0;
    to[i] = pure[i] < 0.0 ? own[i] : alone;
  }
}

// Materials of cells that hold the same one alone in all of them and in both cells aside; -1
// elsewhere. `around`: the rows of presence around a row, from the cell before it on.
// `room`: of RunWriter.
inline void write_pure(const RunRow* around, int rows, int n, double* pure, double* left,
                       int room = 0) {
  RunWriter runs(pure, left, room);
  for (int i = 0; i < n;) {
    const double set = around[0].key[i], material = single_of(set);
    const int here = around[0].end(i, n);
    int end = n + 2;  // of the cells from i - 1 on that hold the same in all rows
    int mixed = material < 0 ? here : 0;  // of those that hold others somewhere
    for (int r = 1; r < rows; ++r) {
      const bool same = around[r].key[i] == set;
      if (!same) mixed = std::max(mixed, around[r].end(i, here));
    }
    if (mixed == 0)
      for (int r = 0; r < rows; ++r) end = around[r].reach(i, end);
    const bool pure_here = mixed == 0 && end - i > 2;
    // All cells that have a change between them and the next but one.
    const int next = pure_here ? end - 2 : mixed > 0 ? mixed : std::min(end, n);
    runs.add(next - i, pure_here ? material : -1.0);
    i = next;
  }
  runs.close();
}

// 1 in cells of which any row has a key below zero, else 0.
inline void write_near(const RunRow* around, int rows, int n, double* near, double* left,
                       int room = 0) {
  RunWriter runs(near, left, room);
  for (int i = 0; i < n;) {
    int near_to = 0, end = n;
    for (int r = 0; r < rows; ++r) {
      const int here = around[r].end(i, n);
      if (around[r].key[i] < 0.0)
        near_to = std::max(near_to, here);
      else
        end = std::min(end, here);
    }
    const int next = near_to > 0 ? near_to : end;
    runs.add(next - i, near_to > 0 ? 1.0 : 0.0);
    i = next;
  }
  runs.close();
}

}  // namespace sluice::ice
