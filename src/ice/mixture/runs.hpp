// Parts of a row in which a key is the same: the materials of a cell change seldom along a row.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace sluice::ice::mixture {

// Where the run that starts at `begin` ends: the first i with key(i) != key(begin), or n. Many at a
// time, for most runs are long.
template <class Key>
int end_of_run(Key key, int begin, int n) {
  constexpr int stride = 32;
  const double k = key(begin);
  int end = begin + 1;
  for (; end + stride <= n; end += stride) {
    std::int64_t others = 0;
    for (int i = end; i < end + stride; ++i) others += key(i) != k ? 1 : 0;
    if (others != 0) break;
  }
  while (end < n && key(end) == k) ++end;
  return end;
}

// Calls f(first, count, key) for every run of equal keys.
template <class Key, class F>
void for_each_run_of(Key key, int n, F&& f) {
  for (int begin = 0; begin < n;) {
    const int end = end_of_run(key, begin, n);
    f(begin, end - begin, key(begin));
    begin = end;
  }
}

template <class F>
void for_each_run(const double* key, int n, F&& f) {
  for_each_run_of([key](int i) { return key[i]; }, n, std::forward<F>(f));
}

// The same for faces between cells with keys a (low side) and b: -1 where they differ.
template <class F>
void for_each_face_run(const double* a, const double* b, int n, F&& f) {
  const auto key = [a, b](int i) {
    const double low = a[i], high = b[i];
    return low == high ? low : -1.0;
  };
  for_each_run_of(key, n, std::forward<F>(f));
}

// Rows of one material over runs that hold one (key >= 0), but in one piece across those that do
// not, where these are short and the materials on both sides run the same rows, kind(key): what a
// piece leaves in cells or faces of several materials is computed again. Looking rows up takes
// longer than a few dozen of them. Calls one(first, count, kind).
template <class Runs, class Kind, class One>
void for_each_pure_piece(Runs runs, Kind kind, One&& one) {
  constexpr int most_between = 32;
  int begin = 0, end = 0, of = 0;
  runs([&](int first, int count, double key) {
    if (key < 0.0) return;
    const int here = kind(static_cast<std::size_t>(key));
    if (end > begin && here == of && first - end <= most_between) {
      end = first + count;
      return;
    }
    if (end > begin) one(begin, end - begin, of);
    begin = first;
    end = first + count;
    of = here;
  });
  if (end > begin) one(begin, end - begin, of);
}

// More than `count` elements that whole_vectors may add.
constexpr int most_beyond = 7;

// So many of at most `most` elements that loops end with whole vectors: what remains of a short run
// would take longer than the run.
inline int whole_vectors(int count, int most) {
  constexpr int lanes = 8;
  const int rounded = (count + lanes - 1) / lanes * lanes;
  return rounded < most ? rounded : most;
}

// The values of a material: its own where the neighbourhood (`pure`) is mixed, those of the mixture
// where it is alone, nothing where another is. No row overlaps `to`.
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

// Of less of a cell than this the numbers would lose their digits; no sum over cells knows of it.
constexpr double least_volume = 1e-100;

// Sets of materials as numbers: exact in a double up to 2^53.
constexpr int most_materials = 32;
inline double only(int material) {
  return static_cast<double>(std::uint64_t{1} << material);
}
inline std::uint64_t as_set(double presence) {
  return static_cast<std::uint64_t>(presence);
}
inline bool is_single(double presence) {
  return std::has_single_bit(as_set(presence));
}
inline int first_of(double presence) {
  return std::countr_zero(as_set(presence));
}
// The material of a set of one, -1 of any other: without a branch, for rows. Such a set is a power
// of two, and its exponent the material.
inline double single_of(double presence) {
  constexpr int digits = 52, bias = 1023;
  const auto bits = std::bit_cast<std::int64_t>(presence);
  const std::int64_t beyond = bits & ((std::int64_t{1} << digits) - 1);
  const std::int64_t material = (bits >> digits) - bias;
  return static_cast<double>(beyond == 0 && bits != 0 ? material : -1);
}
template <class F>
void for_each_of(std::uint64_t set, F&& f) {
  for (; set != 0; set &= set - 1) f(std::countr_zero(set));
}

}  // namespace sluice::ice::mixture
