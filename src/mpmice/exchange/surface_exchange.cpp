#include "mpmice/exchange/surface_exchange.hpp"

namespace sluice::mpmice {
namespace {

// Cells in which the middles of particles lie that may count at a node behind a surface: one cell
// to the particle that has the face, one to its nodes, one to others there.
template <int D>
CellMask cells_that_exchange(const NearCells<D>& near, const CellAmounts<D>& amounts) {
  CellMask mask(near.size(), 0);
  near.for_each([&](const Cell<D>&, std::size_t i) { mask[i] = amounts.volume[i] > 0 ? 1 : 0; });
  dilate(near.frame(), 3, mask);
  return mask;
}

}  // namespace

// Convective exchange counts all that is in front and behind, not half of
// each: K l per area instead of K l/4.
FilmCoefficients films_of(const ice::IceScene& ice, int solid) {
  const auto& convective = ice.exchange.convective;
  FilmCoefficients films;
  for (int m = ice.solids; m < ice.solids + static_cast<int>(ice.materials.size()); ++m) {
    const bool whole = convective && convective->between(solid, m);
    films.drag.push_back(ice.momentum_of_all(solid, m));
    films.heat.push_back((whole ? 4 : 1) * ice.heat_of_all(solid, m));
  }
  return films;
}

template <int D>
SurfaceExchange<D>::SurfaceExchange(const ice::FluidPart& fluid,
                                    const std::vector<solids::SolidKind>& kinds)
    : fluid_(&fluid), kinds_(&kinds) {
  for (std::size_t k = 0; k < kinds.size(); ++k)
    films_.push_back(films_of(fluid.scene(), static_cast<int>(k)));
}

template <int D>
void SurfaceExchange<D>::run(const StageScope& scope, int kind, const NearCells<D>& near,
                             const SolidGeometry<D>& solid, std::vector<SolidSet<D>>& sets,
                             CellAmounts<D>& amounts, CouplingBooks& books) const {
  const Frame<D>& frame = near.frame();
  Communicator& ranks = *scope.ranks;
  const FilmCoefficients& films = films_[static_cast<std::size_t>(kind)];
  const double dt = scope.step.dt, end = scope.step.time + dt;
  const KeptArray<SurfaceContact<D>> contacts =
      surface_contacts<D>(near, solid, amounts, sets, kind);
  FluidInFront<D> front(frame, *fluid_);
  SolidBehind<D> behind((*kinds_)[static_cast<std::size_t>(kind)]);
  ExchangeScales most;
  front.look(contacts, amounts, most);
  behind.include(frame, sets, kind, most);
  most.join(ranks);
  behind.find(near, cells_that_exchange(near, amounts), sets, kind, most, ranks);
  Conductances<D> joined;
  joined.find(near, sets, contacts, amounts, front, behind, films, end, ranks);
  PassedAmounts<D> passed(front, behind, most);
  passed.pass(near, contacts, joined, films, dt, ranks);
  passed.give_to_fluid(near, amounts);
  if (behind.solid().rigid) return passed.book_rigid(frame, books);
  std::size_t n = 0;
  for (SolidSet<D>& s : sets)
    if (s.kind == kind) passed.give_to_set(near, s, n++, books);
}

template class SurfaceExchange<1>;
template class SurfaceExchange<2>;
template class SurfaceExchange<3>;

}  // namespace sluice::mpmice
