// Parts of a row in which a key is the same: the materials of a cell change seldom along a row.
#pragma once
#include <bit>
#include <cstdint>

namespace sluice::ice::mixture {

// Calls f(first, count, key) for every run of equal keys.
template <class F>
void for_each_run(const double* key, int n, F&& f) {
  for (int begin = 0; begin < n;) {
    int end = begin + 1;
    while (end < n && key[end] == key[begin]) ++end;
    f(begin, end - begin, key[begin]);
    begin = end;
  }
}

// The same for faces between cells with keys a (low side) and b: -1 where they differ.
template <class F>
void for_each_face_run(const double* a, const double* b, int n, F&& f) {
  const auto key = [&](int i) { return a[i] == b[i] ? a[i] : -1.0; };
  for (int begin = 0; begin < n;) {
    const double k = key(begin);
    int end = begin + 1;
    while (end < n && key(end) == k) ++end;
    f(begin, end - begin, k);
    begin = end;
  }
}

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
  for (int i = 0; i < n; ++i) {
    const double alone = pure[i] == m ? mixture[i] : 0.0;
    to[i] = pure[i] < 0.0 ? own[i] : alone;
  }
}

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
template <class F>
void for_each_of(std::uint64_t set, F&& f) {
  for (; set != 0; set &= set - 1) f(std::countr_zero(set));
}

}  // namespace sluice::ice::mixture
