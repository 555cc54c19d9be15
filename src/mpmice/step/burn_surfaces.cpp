// Surfaces that burn: what particles lose over their outer faces, by the fluid that these look
// into, and what their surfaces remember.
#include <algorithm>
#include <cmath>

#include "framework/base/reduction.hpp"
#include "mpmice/burn/burn_law.hpp"
#include "mpmice/geometry/pieces.hpp"
#include "mpmice/step/level_coupling.hpp"

namespace sluice::mpmice {
namespace {

constexpr double seen_volume = 0.2;  // fluids that fill less of a cell do not count as hot

}  // namespace

// Hottest fluid in a cell, or around it where asked or where the cell has little; 0: none.
template <int D>
double LevelCoupling<D>::hottest_fluid(const Cell<D>& c, bool around) const {
  const std::size_t here = frame_.box.index(c);
  if (!around && amounts_.volume[here] > seen_volume) return heat_of(here).temperature;
  double most = 0;
  for_each_around(c, 1, [&](std::size_t i) {
    if (amounts_.near[i] != 0 && amounts_.volume[i] > seen_volume)
      most = std::max(most, heat_of(i).temperature);
  });
  return most;
}

// What of the particles' surfaces burns; `pieces`: which, where somebody asks.
template <int D>
std::vector<ExposedArea<D>> LevelCoupling<D>::exposed_areas(
    const models::SolidBurn& burn, std::size_t n, std::vector<BurningPiece>* pieces) const {
  const SolidSet<D>& s = sets_[n];
  std::vector<ExposedArea<D>> exposed(s.set->size());
  const double* mass = s.set->column(static_cast<std::size_t>(s.columns->mass));
  const double* volume = s.set->column(static_cast<std::size_t>(s.columns->volume));
  const double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
  for_each_piece<D>(s.faces, When::start, 0, s.faces.size(),
                    [&](std::size_t i, int, const FacetNodes<D>&, const Piece<D>& piece) {
                      const std::size_t p = s.faces.particle[i];
                      if ((s.outer[p] >> s.faces.face[i] & 1) == 0 || !(s.filled[p] > 0)) return;
                      Cell<D> c = piece.cell;
                      for (std::size_t d = 0; d < D; ++d)
                        if (!frame_.periodic[d] &&
                            (c[d] < frame_.domain.lower[d] || c[d] >= frame_.domain.upper[d]))
                          return;  // on a side of the domain
                      c = frame_.inside(c);
                      const std::size_t k = frame_.box.index(c);
                      if (!wet(k)) return;
                      AtSurface at;
                      at.pressure = fields_.pressure[k];
                      at.solid_temperature = T[p];
                      at.hottest = std::max(T[p], hottest_fluid(c, looks_around(burn)));
                      at.density = mass[p] / volume[p];
                      std::array<double, D> area = piece.area;
                      for (int d = 0; d < D; ++d)
                        area[static_cast<std::size_t>(d)] *= frame_.face_area(d);
                      const auto surface = steady_surface(burn, at);
                      if (surface.flux > 0 && pieces != nullptr) pieces->push_back({n, p, k});
                      exposed[p].add(s.faces.face[i], area, surface);
                    });
  return exposed;
}

// Surfaces that remember burn at rates of their own.
template <int D>
void LevelCoupling<D>::delay_burning(const models::UnsteadyBurn& law, SolidSet<D>& s,
                                     const std::vector<ExposedArea<D>>& exposed, double dt,
                                     Column& shares) const {
  const double* mass = s.set->column(static_cast<std::size_t>(s.columns->mass));
  const double* volume = s.set->column(static_cast<std::size_t>(s.columns->volume));
  const double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
  for (std::size_t p = 0; p < shares.size(); ++p) {
    const models::SteadyBurn::Surface steady = exposed[p].burning();
    if (!(steady.flux > 0) || !(s.stays[p] > 0)) continue;
    const double density = mass[p] / volume[p];
    s.surface[p] = law.after(dt, s.surface[p], steady, T[p], density);
    shares[p] *= law.flux(s.surface[p], steady.flux, density) / steady.flux;
  }
}

// Shares of the particles' masses that their surfaces lose.
template <int D>
void LevelCoupling<D>::burn_surfaces(const StageScope& scope, const models::SolidBurn& burn,
                                     std::vector<Column>& shares) {
  const Warehouse& state = scope.levels.front()->state();
  std::vector<BurningField> fields = burning_fields(burn);
  std::erase_if(fields, [&](const BurningField& f) { return state.find(f.kept, burn.solid) < 0; });
  std::vector<BurningPiece> pieces;
  for (std::size_t n = 0; n < sets_.size(); ++n) {
    SolidSet<D>& s = sets_[n];
    if (s.kind != burn.solid) continue;
    const std::vector<ExposedArea<D>> exposed =
        exposed_areas(burn, n, fields.empty() ? nullptr : &pieces);
    const double* mass = s.set->column(static_cast<std::size_t>(s.columns->mass));
    shares[n].assign(s.set->size(), 0.0);
    for (std::size_t p = 0; p < shares[n].size(); ++p)
      if (s.stays[p] > 0) shares[n][p] = scope.step.dt * exposed[p].flow() / (mass[p] * s.stays[p]);
    if (const auto* unsteady = std::get_if<models::UnsteadyBurn>(&burn.law))
      delay_burning(*unsteady, s, exposed, scope.step.dt, shares[n]);
  }
  if (!fields.empty()) store_burning(scope, burn, fields, pieces);
}

// Of what surfaces remember, in cells; `most` pieces are in one.
template <int D>
void LevelCoupling<D>::mean_of_pieces(const StageScope& scope,
                                      const std::vector<BurningPiece>& pieces, bool gradient,
                                      const CellSums<D>& counts, double most, Column& mean) const {
  const auto value = [&](const BurningPiece& piece) {
    const models::SurfaceHistory& surface = sets_[piece.set].surface[piece.particle];
    return gradient ? surface.gradient : surface.temperature;
  };
  double largest = 1e-300;
  for (const BurningPiece& piece : pieces) largest = std::max(largest, std::fabs(value(piece)));
  Reduction all;
  const auto slot = all.add_maximum(largest);
  scope.ranks->reduce(all);
  largest = all.maximum(slot);
  CellSums<D> sums;
  sums.begin(frame_.box, 1);
  sums.reach(frame_.box);
  for (const BurningPiece& piece : pieces)
    sums.lane(0)[piece.cell] += to_sum(value(piece) / largest / most);
  sums.sum_over_ranks(*scope.ranks);
  for (std::size_t i = 0; i < mean.size(); ++i)
    if (counts.lane(0)[i] > 0)
      mean[i] = from_sum(sums.lane(0)[i]) * largest * most / static_cast<double>(counts.lane(0)[i]);
}

// For the archive, by all ranks' pieces of surface: means over the pieces in a cell.
template <int D>
void LevelCoupling<D>::store_burning(const StageScope& scope, const models::SolidBurn& burn,
                                     const std::vector<BurningField>& fields,
                                     const std::vector<BurningPiece>& pieces) const {
  CellSums<D> counts;
  counts.begin(frame_.box, 1);
  counts.reach(frame_.box);
  for (const BurningPiece& piece : pieces) ++counts.lane(0)[piece.cell];
  counts.sum_over_ranks(*scope.ranks);
  const double most =
      static_cast<double>(*std::max_element(counts.lane(0), counts.lane(0) + frame_.box.cells()));
  Warehouse& next = scope.levels.front()->attempted();
  for (const BurningField& field : fields) {
    Column mean(frame_.box.cells(), 1.0);
    if (field.value != SurfaceValue::burns)
      mean_of_pieces(scope, pieces, field.value == SurfaceValue::gradient, counts, most, mean);
    const int slot = next.find(field.kept, burn.solid);
    for (int b = 0; b < static_cast<int>(next.local_boxes().size()); ++b) {
      const RealView to = next.view(slot, 0, b);
      for_each_cell(frame_.held(next.local_boxes()[static_cast<std::size_t>(b)].cells),
                    [&](IntVec3 c) {
                      const std::size_t i = frame_.box.index(frame_.cell(c));
                      if (counts.lane(0)[i] > 0) to(c) = mean[i];
                    });
    }
  }
}

template void LevelCoupling<1>::burn_surfaces(const StageScope&, const models::SolidBurn&,
                                              std::vector<Column>&);
template void LevelCoupling<2>::burn_surfaces(const StageScope&, const models::SolidBurn&,
                                              std::vector<Column>&);
template void LevelCoupling<3>::burn_surfaces(const StageScope&, const models::SolidBurn&,
                                              std::vector<Column>&);

}  // namespace sluice::mpmice
