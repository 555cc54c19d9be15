// Parts of a row in which a key is the same: the materials of a cell change seldom along a row.
// Keys are whole numbers kept as doubles, and so are the counts of cells beside them.
#pragma once
#include <bit>
#include <cstdint>

#include "framework/task/row.hpp"

namespace sluice::ice {

// Where the run that starts at `begin` ends: the first i with key[i] != key[begin], or n. Many at a
// time, for most runs are long.
inline int end_of_run(const double* key, int begin, int n) {
  constexpr int stride = 32, vector = 8;
  const double k = key[begin];
  int end = begin + 1;
  for (; end + stride <= n; end += stride) {
    std::int64_t others = 0;
    for (int i = end; i < end + stride; ++i) others += key[i] != k ? 1 : 0;
    if (others != 0) break;
  }
  for (; end + vector <= n; end += vector) {
    std::uint64_t others = 0;
    for (int i = 0; i < vector; ++i) others |= std::uint64_t{key[end + i] != k} << i;
    if (others != 0) return end + std::countr_zero(others);
  }
  while (end < n && key[end] == k) ++end;
  return end;
}

// A row of keys, and of each cell how many of its run are left, itself included: found once, where
// the keys are written, for all tasks that go by them.
struct RunRow {
  const double *key, *left;

  int end(int i, int n) const {
    const int end = i + static_cast<int>(left[i]);
    return end < n ? end : n;
  }
  // The same across runs that follow each other with one key, as they may where rows were written
  // in parts.
  int reach(int i, int n) const {
    int reached = end(i, n);
    while (reached < n && key[reached] == key[i]) reached = end(reached, n);
    return reached;
  }
};

// Has the whole row one key.
inline bool is_one_run(RunRow row, int n) {
  return row.reach(0, n) == n;
}

// The key of these elements in all rows; 0 if they have several.
inline double key_of_all(const RunRow* rows, int count_of_rows, int first, int count) {
  const double key = rows[0].key[first];
  const int end = first + count;
  bool same = true;
  for (int r = 0; r < count_of_rows; ++r)
    same = same && rows[r].key[first] == key && rows[r].reach(first, end) == end;
  return same ? key : 0.0;
}

// A variable of two components: keys and what is left of their runs.
inline RunRow runs_of(const Row& row, In keys, int axis = 0, int shift = 0) {
  return {row(keys, 0, axis, shift), row(keys, 1, axis, shift)};
}

// So many of at most `most` elements that loops end with whole vectors: what remains of a short run
// would take longer than the run.
inline int whole_vectors(int count, int most) {
  constexpr int lanes = 8;
  const int rounded = (count + lanes - 1) / lanes * lanes;
  return rounded < most ? rounded : most;
}

// So many elements will be read soon, and are not in the cache: a few of a row are no stream that
// the machine would foresee. They need not be there.
inline void ask_for(const double* row, int n) {
  constexpr int line = 8;
  for (int i = 0; i < n; i += line) __builtin_prefetch(row + i);
}

// Writes keys run by run; one that goes on with the key of the last joins it.
class RunWriter {
 public:
  // `room`: so many cells are there, and what a run leaves beyond itself is written after it.
  RunWriter(double* key, double* left, int room = 0) : key_(key), left_(left), room_(room) {}
  void add(int count, double key) {
    if (key != run_key_) close();
    run_key_ = key;
    end_ += count;
  }
  // So many cells whose keys are there already.
  void find(int count) {
    const double* keys = key_;
    for (const int end = end_ + count; end_ < end;)
      add(end_of_run(keys, end_, end) - end_, keys[end_]);
  }
  void close() {
    const double key = run_key_;
    const int count = end_ - begin_;
    const int n = room_ > end_ ? whole_vectors(count, room_ - begin_) : count;
    double* __restrict keys = key_ + begin_;
    double* __restrict left = left_ + begin_;
    for (int i = 0; i < n; ++i) {
      keys[i] = key;
      left[i] = count - i;
    }
    begin_ = end_;
  }

 private:
  double *key_, *left_;
  double run_key_ = 0.0;
  int room_;
  int begin_ = 0, end_ = 0;
};

// Calls f(first, count, key) for every run of equal keys.
template <class F>
void for_each_run(RunRow row, int n, F&& f) {
  for (int begin = 0; begin < n;) {
    const int end = row.end(begin, n);
    f(begin, end - begin, row.key[begin]);
    begin = end;
  }
}

// The same for faces between cells with keys a (low side) and b: -1 where they differ.
template <class F>
void for_each_face_run(RunRow a, RunRow b, int n, F&& f) {
  const auto key = [&](int i) { return a.key[i] == b.key[i] ? a.key[i] : -1.0; };
  for (int begin = 0; begin < n;) {
    const double here = key(begin);
    int end = begin;
    do {
      const int end_a = a.end(end, n), end_b = b.end(end, n);
      end = end_a < end_b ? end_a : end_b;
    } while (end < n && key(end) == here);
    f(begin, end - begin, here);
    begin = end;
  }
}

}  // namespace sluice::ice
