// Rows whose bodies are cut off by the high end of the box: a body that leaves the domain loses the
// faces that are out.
//
// Covered parts summed from the high end, where none is covered, end below zero at the low end by
// what is covered at the high one: there the body goes on. The row is raised by that, from the
// lowest cell that faces reach on: sums have not gone farther down.
//
// Boxes end `layers_beyond` cells beyond the domain, or farther from bodies inside of it: no row is
// open then, and what is below zero there is a body that is folded.
#pragma once
#include <vector>

#include "mpmice/geometry/cell_sums.hpp"

namespace sluice::mpmice {

// `covered`: covered parts of the low faces along d, as summed over the cells `reached`; `raised`
// (or null): volume fractions that follow from them; `high`: where what faces themselves reach
// ends.
template <int D>
void raise_open_rows(const CellBox<D>& box, const CellBox<D>& reached, int d, int high,
                     std::vector<double>& covered, std::vector<double>* raised) {
  constexpr double round_off = 1e-9;
  const std::ptrdiff_t step = box.stride(d);
  const auto along = static_cast<std::size_t>(d);
  CellBox<D> first = reached;  // the first cell of every row
  if (first.empty() || high + layers_beyond < box.upper[along]) return;
  first.upper[along] = first.lower[along] + 1;
  const int length = box.upper[along] - first.lower[along];
  for_each_row_down<D>(box, first, 0, [&](std::size_t begin, std::size_t n) {
    for (std::size_t i = begin; i < begin + n; ++i) {
      double least = 0;
      for (int k = 0; k < length; ++k) least = std::min(least, covered[i + k * step]);
      if (least > -round_off) continue;
      for (int k = 0; k < length; ++k) {
        covered[i + k * step] -= least;
        if (raised != nullptr) (*raised)[i + k * step] -= least;
      }
    }
  });
}

}  // namespace sluice::mpmice
