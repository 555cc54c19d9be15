// How the cells of a window lie in memory: rows along direction 0, one ghost layer around.
//
// The directions are the solver's own: 1 is the one of strongest coupling (lines run along it),
// 2 the one that is swept slice by slice. A window of one slice has no ghosts in direction 2.
#pragma once
#include <array>
#include <cstddef>

namespace sluice::solve {

struct DenseShape {
  std::array<int, 3> count{1, 1, 1};
  std::array<bool, 3> periodic{};

  bool deep() const { return count[2] > 1; }
  std::ptrdiff_t row() const { return count[0] + 2; }
  std::ptrdiff_t slice() const { return row() * (count[1] + 2); }
  std::ptrdiff_t stride(int d) const { return d == 0 ? 1 : d == 1 ? row() : deep() ? slice() : 0; }
  std::size_t size() const { return slice() * (deep() ? count[2] + 2 : 1); }
  std::size_t cells() const { return static_cast<std::size_t>(count[0]) * count[1] * count[2]; }
  std::ptrdiff_t at(int i, int j, int k) const {
    return i + 1 + row() * (j + 1) + (deep() ? slice() * (k + 1) : 0);
  }
};

// Ghosts of one slice in directions 0 and 1, copies of the cells on the other side.
template <class T>
void wrap_slice(const DenseShape& s, T* x, int k) {
  if (s.periodic[0]) {
    for (int j = 0; j < s.count[1]; ++j) {
      x[s.at(-1, j, k)] = x[s.at(s.count[0] - 1, j, k)];
      x[s.at(s.count[0], j, k)] = x[s.at(0, j, k)];
    }
  }
  if (s.periodic[1]) {
    for (int i = 0; i < s.count[0]; ++i) {
      x[s.at(i, -1, k)] = x[s.at(i, s.count[1] - 1, k)];
      x[s.at(i, s.count[1], k)] = x[s.at(i, 0, k)];
    }
  }
}

// Ghosts in direction 2.
template <class T>
void wrap_ends(const DenseShape& s, T* x) {
  if (!s.deep() || !s.periodic[2]) return;
  const std::ptrdiff_t below = s.at(-1, -1, -1);
  const std::ptrdiff_t above = s.at(-1, -1, s.count[2]);
  const std::ptrdiff_t round = s.slice() * s.count[2];
  for (std::ptrdiff_t n = 0; n < s.slice(); ++n) {
    x[below + n] = x[below + n + round];
    x[above + n] = x[above + n - round];
  }
}

template <class T>
void wrap(const DenseShape& s, T* x) {
  for (int k = 0; k < s.count[2]; ++k) wrap_slice(s, x, k);
  wrap_ends(s, x);
}

}  // namespace sluice::solve
