#include "mpmice/step/cells_agreement.hpp"

#include <algorithm>

namespace sluice::mpmice {
namespace {

// The largest velocities of a kind on this rank, and the largest of their negatives.
template <int D>
std::array<Vec3, 2> bounds_of_velocities(const SolidSets<D>& sets, int kind) {
  Vec3 up{-1e300, -1e300, -1e300}, down = up;
  for (const SolidSet<D>& s : sets.all()) {
    if (s.kind != kind) continue;
    for (int d = 0; d < 3; ++d) {
      const double* v = s.next->column(static_cast<std::size_t>(s.columns->velocity + d));
      for (std::size_t p = 0; p < s.set->size(); ++p) {
        up[d] = std::max(up[d], v[p]);
        down[d] = std::max(down[d], -v[p]);
      }
    }
  }
  return {up, down};
}

struct VelocityBounds {
  int kind;
  std::array<Reduction::Maximum, 6> slots;
};

}  // namespace

template <int D>
typename CellsAgreement<D>::Faults CellsAgreement<D>::find(const SolidSets<D>& sets,
                                                           const Faults& here, const CellRates& own,
                                                           CouplingBooks& books,
                                                           std::span<double> sums,
                                                           Communicator& ranks) {
  Reduction all;
  const auto trapped = all.add_any(here.trapped), inadmissible = all.add_any(here.inadmissible),
             strayed = all.add_any(here.strayed);
  const auto deck = all.add_maximum(own.deck), flow = all.add_maximum(own.flow),
             sound = all.add_maximum(own.sound);
  books.add_to(all);
  std::vector<VelocityBounds> bounds;
  for (int k = 0; k < static_cast<int>(sets.kinds().size()); ++k) {
    if (!exchange_->exchanges(k)) continue;
    const std::array<Vec3, 2> of_rank = bounds_of_velocities(sets, k);
    VelocityBounds& of_kind = bounds.emplace_back(VelocityBounds{k, {}});
    for (int n = 0; n < 6; ++n)
      of_kind.slots[static_cast<std::size_t>(n)] =
          all.add_maximum(of_rank[static_cast<std::size_t>(n / 3)][n % 3]);
  }
  ranks.reduce(all);
  const Faults faults{all.any(trapped), all.any(inadmissible), all.any(strayed)};
  if (faults.any()) return faults;
  books.take(all, solids_->sums(), sums);
  rates_ = {all.maximum(deck), all.maximum(flow), all.maximum(sound)};
  for (const VelocityBounds& of_kind : bounds) {
    std::array<Vec3, 2> most;
    for (int n = 0; n < 6; ++n)
      most[static_cast<std::size_t>(n / 3)][n % 3] =
          all.maximum(of_kind.slots[static_cast<std::size_t>(n)]);
    solids_->include_velocities(of_kind.kind, most[0], most[1]);
  }
  return faults;
}

template class CellsAgreement<1>;
template class CellsAgreement<2>;
template class CellsAgreement<3>;

}  // namespace sluice::mpmice
