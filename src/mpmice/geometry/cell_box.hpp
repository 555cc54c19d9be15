// A box of cells in D directions, [lower, upper), and where its cells lie in a dense array.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>

#include "framework/base/kept_array.hpp"
#include "framework/grid/index_box.hpp"

namespace sluice::mpmice {

template <int D>
using Cell = std::array<int, D>;

template <int D>
struct CellBox {
  Cell<D> lower{}, upper{};

  int size(int d) const {
    const auto a = static_cast<std::size_t>(d);
    return upper[a] - lower[a];
  }
  bool empty() const {
    for (int d = 0; d < D; ++d)
      if (size(d) <= 0) return true;
    return false;
  }
  std::size_t cells() const {
    if (empty()) return 0;
    std::size_t n = 1;
    for (int d = 0; d < D; ++d) n *= static_cast<std::size_t>(size(d));
    return n;
  }
  // Distance in an array of neighbours along d; x is fastest.
  std::ptrdiff_t stride(int d) const {
    std::ptrdiff_t n = 1;
    for (int a = 0; a < d; ++a) n *= size(a);
    return n;
  }
  std::size_t index(const Cell<D>& cell) const {
    std::ptrdiff_t at = 0;
    for (std::size_t d = D; d-- > 0;) at = at * size(static_cast<int>(d)) + (cell[d] - lower[d]);
    return static_cast<std::size_t>(at);
  }
  bool contains(const CellBox& b) const {
    if (b.empty()) return true;
    for (std::size_t d = 0; d < D; ++d)
      if (b.lower[d] < lower[d] || b.upper[d] > upper[d]) return false;
    return true;
  }
  // The smallest box around both.
  void include(const CellBox& b) {
    if (b.empty()) return;
    if (empty()) {
      *this = b;
      return;
    }
    for (std::size_t d = 0; d < D; ++d) {
      lower[d] = std::min(lower[d], b.lower[d]);
      upper[d] = std::max(upper[d], b.upper[d]);
    }
  }

  friend bool operator==(const CellBox&, const CellBox&) = default;
};

// What lies in both; it may be empty.
template <int D>
CellBox<D> common(const CellBox<D>& a, const CellBox<D>& b) {
  CellBox<D> to;
  for (std::size_t d = 0; d < D; ++d) {
    to.lower[d] = std::max(a.lower[d], b.lower[d]);
    to.upper[d] = std::min(a.upper[d], b.upper[d]);
  }
  return to;
}

// The cells of a box in its active directions, of which the first D of `active` are taken.
template <int D>
CellBox<D> cell_box(const IndexBox& box, const std::array<int, 3>& active) {
  CellBox<D> to;
  for (std::size_t d = 0; d < D; ++d) {
    to.lower[d] = box.lower[active[d]];
    to.upper[d] = box.upper[active[d]];
  }
  return to;
}

// Is act(cell) true for any of the cells of a box, x fastest; the first ends the search.
template <int D, class Act>
bool any_cell_of(const CellBox<D>& box, Act&& act) {
  if (box.empty()) return false;
  Cell<D> c = box.lower;
  for (;;) {
    if (act(static_cast<const Cell<D>&>(c))) return true;
    std::size_t d = 0;
    for (; d < D; ++d) {
      if (++c[d] < box.upper[d]) break;
      c[d] = box.lower[d];
    }
    if (d == D) return false;
  }
}

// act(cell) for all of them.
template <int D, class Act>
void for_each_cell_of(const CellBox<D>& box, Act&& act) {
  any_cell_of<D>(box, [&](const Cell<D>& c) {
    act(c);
    return false;
  });
}

}  // namespace sluice::mpmice
