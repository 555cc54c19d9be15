// Surfaces that burn: what particles lose over their outer faces, by the fluid that these look
// into, and what their surfaces remember.
#include <algorithm>
#include <cmath>

#include "framework/base/reduction.hpp"
#include "mpmice/geometry/pieces.hpp"
#include "mpmice/step/level_coupling.hpp"

namespace sluice::mpmice {
// Hottest fluid in a cell, or around it where asked or where the cell has little; 0: none.
template <int D>
double LevelCoupling<D>::hottest_fluid(const Cell<D>& c, bool around) const {
  const std::size_t here = frame_.cells.index(c);
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
    const models::SurfaceLaw& law, std::size_t n, std::vector<BurningPiece>* pieces) const {
  const SolidSet<D>& s = sets_[n];
  std::vector<ExposedArea<D>> exposed(s.set->size());
  const double* mass = s.set->column(static_cast<std::size_t>(s.columns->mass));
  const double* volume = s.set->column(static_cast<std::size_t>(s.columns->volume));
  const double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
  for_each_open_piece(s, [&](std::size_t p, int face, const std::array<double, D>& area,
                             const Cell<D>& c, std::size_t k) {
    models::AtSurface at;
    at.pressure = fields_.pressure[k];
    at.solid_temperature = T[p];
    at.hottest = std::max(T[p], hottest_fluid(c, law.looks_around()));
    at.density = mass[p] / volume[p];
    const models::BurningSurface surface = law.steady_surface(at);
    if (surface.flux > 0 && pieces != nullptr) pieces->push_back({n, p, k});
    exposed[p].add(face, area, surface);
  });
  return exposed;
}

// Surfaces that remember burn at rates of their own.
template <int D>
void LevelCoupling<D>::delay_burning(const models::SurfaceDelay& law, SolidSet<D>& s,
                                     const std::vector<ExposedArea<D>>& exposed, double dt,
                                     Column& shares) const {
  const double* mass = s.set->column(static_cast<std::size_t>(s.columns->mass));
  const double* volume = s.set->column(static_cast<std::size_t>(s.columns->volume));
  const double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
  for (std::size_t p = 0; p < shares.size(); ++p) {
    const models::BurningSurface steady = exposed[p].burning();
    if (!(steady.flux > 0) || !(s.stays[p] > 0)) continue;
    const double density = mass[p] / volume[p];
    s.surface[p] = law.after(dt, s.surface[p], steady, T[p], density);
    shares[p] *= law.flux(s.surface[p], steady.flux, density) / steady.flux;
  }
}

// Shares of the particles' masses that their surfaces lose.
template <int D>
void LevelCoupling<D>::burn_surfaces(const StageScope& scope, const models::SolidBurn& burn,
                                     const models::SurfaceLaw& law, std::vector<Column>& shares) {
  const std::vector<BurningField> fields = saved_fields(scope, burn);
  std::vector<BurningPiece> pieces;
  for (std::size_t n = 0; n < sets_.size(); ++n) {
    SolidSet<D>& s = sets_[n];
    if (s.kind != burn.solid) continue;
    const std::vector<ExposedArea<D>> exposed =
        exposed_areas(law, n, fields.empty() ? nullptr : &pieces);
    const double* mass = s.set->column(static_cast<std::size_t>(s.columns->mass));
    shares[n].assign(s.set->size(), 0.0);
    for (std::size_t p = 0; p < shares[n].size(); ++p)
      if (s.stays[p] > 0) shares[n][p] = scope.step.dt * exposed[p].flow() / (mass[p] * s.stays[p]);
    if (const models::SurfaceDelay* delay = law.delay())
      delay_burning(*delay, s, exposed, scope.step.dt, shares[n]);
  }
  if (!fields.empty()) store_burning(scope, burn, fields, pieces);
}

// Means in cells of the values of pieces; `most` of these are in one.
template <int D>
void LevelCoupling<D>::mean_of_pieces(const StageScope& scope,
                                      const std::vector<BurningPiece>& pieces, const Column& values,
                                      const CellSums<D>& counts, double most, Column& mean) const {
  double largest = 1e-300;
  for (const double value : values) largest = std::max(largest, std::fabs(value));
  Reduction all;
  const auto slot = all.add_maximum(largest);
  scope.ranks->reduce(all);
  largest = all.maximum(slot);
  CellSums<D> sums;
  sums.begin(frame_.cells, 1);
  for (std::size_t n = 0; n < pieces.size(); ++n)
    sums.lane(0)[pieces[n].cell] += to_sum(values[n] / largest / most);
  sums.sum_over_ranks(*scope.ranks);
  for (std::size_t i = 0; i < mean.size(); ++i)
    if (counts.lane(0)[i] > 0)
      mean[i] = from_sum(sums.lane(0)[i]) * largest * most / static_cast<double>(counts.lane(0)[i]);
}

// The largest number of the first lane on any rank. Collective.
template <int D>
double LevelCoupling<D>::most_of(const StageScope& scope, const CellSums<D>& counts) {
  Reduction all;
  const auto most = all.add_maximum(static_cast<double>(
      *std::max_element(counts.lane(0), counts.lane(0) + counts.cells().size())));
  scope.ranks->reduce(all);
  return all.maximum(most);
}

// How many pieces, of all ranks, are in each cell, and the most of them.
template <int D>
double LevelCoupling<D>::count_pieces(const StageScope& scope,
                                      const std::vector<BurningPiece>& pieces,
                                      CellSums<D>& counts) const {
  counts.begin(frame_.cells, 1);
  for (const BurningPiece& piece : pieces) ++counts.lane(0)[piece.cell];
  counts.sum_over_ranks(*scope.ranks);
  return most_of(scope, counts);
}

// What is not 0, for the archive.
template <int D>
void LevelCoupling<D>::keep_in_cells(const StageScope& scope, Label kept, int solid,
                                     const Column& values) const {
  Warehouse& next = scope.levels.front()->attempted();
  const int slot = next.find(kept, solid);
  for (int b = 0; b < static_cast<int>(next.local_boxes().size()); ++b) {
    const RealView to = next.view(slot, 0, b);
    frame_.for_each_held(next.local_boxes()[static_cast<std::size_t>(b)].cells,
                         [&](IntVec3 c, std::size_t i) {
                           if (values[i] != 0) to(c) = values[i];
                         });
  }
}

// Means over the pieces of surface that burn in a cell.
template <int D>
void LevelCoupling<D>::store_burning(const StageScope& scope, const models::SolidBurn& burn,
                                     const std::vector<BurningField>& fields,
                                     const std::vector<BurningPiece>& pieces) const {
  CellSums<D> counts;
  const double most = count_pieces(scope, pieces, counts);
  for (const BurningField& field : fields) {
    Column mean(frame_.cells.size(), 0.0), values;
    if (field.value == BurningValue::burns) {
      for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = counts.lane(0)[i] > 0 ? 1 : 0;
    } else {
      for (const BurningPiece& piece : pieces) {
        const models::SurfaceHistory& surface = sets_[piece.set].surface[piece.particle];
        values.push_back(field.value == BurningValue::gradient ? surface.gradient
                                                               : surface.temperature);
      }
      mean_of_pieces(scope, pieces, values, counts, most, mean);
    }
    keep_in_cells(scope, field.kept, burn.solid, mean);
  }
}

// Those of its fields that the deck saves.
template <int D>
std::vector<BurningField> LevelCoupling<D>::saved_fields(const StageScope& scope,
                                                         const models::SolidBurn& burn) const {
  const Warehouse& state = scope.levels.front()->state();
  std::vector<BurningField> fields = burning_fields(burn);
  std::erase_if(fields, [&](const BurningField& f) { return state.find(f.kept, burn.solid) < 0; });
  return fields;
}

template void LevelCoupling<1>::burn_surfaces(const StageScope&, const models::SolidBurn&,
                                              const models::SurfaceLaw&, std::vector<Column>&);
template double LevelCoupling<1>::most_of(const StageScope&, const CellSums<1>&);
template double LevelCoupling<1>::hottest_fluid(const Cell<1>&, bool) const;
template double LevelCoupling<1>::count_pieces(const StageScope&, const std::vector<BurningPiece>&,
                                               CellSums<1>&) const;
template void LevelCoupling<1>::mean_of_pieces(const StageScope&, const std::vector<BurningPiece>&,
                                               const Column&, const CellSums<1>&, double,
                                               Column&) const;
template void LevelCoupling<1>::keep_in_cells(const StageScope&, Label, int, const Column&) const;
template std::vector<BurningField> LevelCoupling<1>::saved_fields(const StageScope&,
                                                                  const models::SolidBurn&) const;
template void LevelCoupling<2>::burn_surfaces(const StageScope&, const models::SolidBurn&,
                                              const models::SurfaceLaw&, std::vector<Column>&);
template double LevelCoupling<2>::most_of(const StageScope&, const CellSums<2>&);
template double LevelCoupling<2>::hottest_fluid(const Cell<2>&, bool) const;
template double LevelCoupling<2>::count_pieces(const StageScope&, const std::vector<BurningPiece>&,
                                               CellSums<2>&) const;
template void LevelCoupling<2>::mean_of_pieces(const StageScope&, const std::vector<BurningPiece>&,
                                               const Column&, const CellSums<2>&, double,
                                               Column&) const;
template void LevelCoupling<2>::keep_in_cells(const StageScope&, Label, int, const Column&) const;
template std::vector<BurningField> LevelCoupling<2>::saved_fields(const StageScope&,
                                                                  const models::SolidBurn&) const;
template void LevelCoupling<3>::burn_surfaces(const StageScope&, const models::SolidBurn&,
                                              const models::SurfaceLaw&, std::vector<Column>&);
template double LevelCoupling<3>::most_of(const StageScope&, const CellSums<3>&);
template double LevelCoupling<3>::hottest_fluid(const Cell<3>&, bool) const;
template double LevelCoupling<3>::count_pieces(const StageScope&, const std::vector<BurningPiece>&,
                                               CellSums<3>&) const;
template void LevelCoupling<3>::mean_of_pieces(const StageScope&, const std::vector<BurningPiece>&,
                                               const Column&, const CellSums<3>&, double,
                                               Column&) const;
template void LevelCoupling<3>::keep_in_cells(const StageScope&, Label, int, const Column&) const;
template std::vector<BurningField> LevelCoupling<3>::saved_fields(const StageScope&,
                                                                  const models::SolidBurn&) const;

}  // namespace sluice::mpmice
