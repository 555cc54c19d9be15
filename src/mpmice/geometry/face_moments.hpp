// M_du of one cut of a mixed facet: first moments of what it covers of faces along d.
//
// Where u is not split a cut stands for the old and new places along u, each with its own part of
// N_d: N_d = N_d[old] + N_d[new].
#pragma once
#include "mpmice/geometry/mixed_facet.hpp"

namespace sluice::mpmice {

template <int D>
class FaceMoments {
 public:
  FaceMoments(const MixedFacet<D>& f, const std::array<Slots, D>& slots,
              const std::array<double, D>& N)
      : facet_(f), slots_(slots) {
    for (std::size_t u = 0; u < D; ++u) {
      const Slots both = slots[u];
      areas_[u][static_cast<std::size_t>(both.last)] = N;
      if (both.count() == 1) continue;
      std::array<Slots, D> old = slots;
      old[u] = {0, 0};
      areas_[u][0] = f.mean_area(old);
      for (std::size_t d = 0; d < D; ++d) areas_[u][1][d] -= areas_[u][0][d];
    }
  }

  // n_d (m.P - s X_mid)_u of a piece with weights w/2, for all d.
  std::array<double, D> of(std::size_t u, int cell, const std::array<double, D>& m) const {
    std::array<double, D> moment{};
    for (int slot = slots_[u].first; slot <= slots_[u].last; ++slot) {
      const auto b = static_cast<std::size_t>(slot);
      double arm = 0;
      for (std::size_t k = 0; k < D; ++k) arm += m[k] * (facet_.x[b][k][u] - (cell + 0.5));
      for (std::size_t d = 0; d < D; ++d) moment[d] += areas_[u][b][d] * arm;
    }
    return moment;
  }

 private:
  const MixedFacet<D>& facet_;
  std::array<Slots, D> slots_;
  std::array<std::array<std::array<double, D>, 2>, D> areas_;  // [u][slot][d]
};

}  // namespace sluice::mpmice
