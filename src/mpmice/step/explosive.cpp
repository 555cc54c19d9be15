// Explosive that burns and detonates (models/burn/ddt1.hpp), by the cells in which it lies.
//
// Cells detonate by their own pressure and share; surfaces burn by the cell that they look into,
// cracks by the cell of the particle's middle. All is decided before anything is given.
#include <algorithm>
#include <cmath>

#include "framework/base/reduction.hpp"
#include "models/burn/ddt1.hpp"
#include "mpmice/step/level_coupling.hpp"

namespace sluice::mpmice {

// The cell of a particle's middle.
template <int D>
Cell<D> LevelCoupling<D>::middle_of(const ParticleSet& set, std::size_t p) const {
  Cell<D> c;
  for (std::size_t a = 0; a < D; ++a)
    c[a] = frame_.cell_at(set.coordinate(frame_.direction[a])[p], a);
  return frame_.inside(c);
}

// Null: its law has no cracks.
template <int D>
const double* LevelCoupling<D>::crack_radii(const SolidSet<D>& s) const {
  const int column =
      mpm::column_of(solids_->carried()[static_cast<std::size_t>(s.kind)], "p.crackRad");
  return column < 0 ? nullptr : s.next->column(static_cast<std::size_t>(column));
}

template <int D>
ExplosiveCells LevelCoupling<D>::look_at_explosive(const StageScope& scope,
                                                   const models::SolidBurn& burn,
                                                   const models::Ddt1& law) {
  ExplosiveCells cells;
  const std::size_t count = frame_.cells.size();
  mean_in_cells(scope, burn.solid, cells.reactant, cells.pressure);
  cells.product = amounts_.mass[static_cast<std::size_t>(burn.product)];
  for (auto* values : {&cells.detonates, &cells.gain}) values->assign(count, 0.0);
  for (auto* marks : {&cells.beside_detonation, &cells.hot, &cells.beside_hot, &cells.hot_fluid,
                      &cells.surface_burns, &cells.burning})
    marks->assign(count, 0);
  for_each_cell_near([&](const Cell<D>& c, std::size_t i) {
    if (amounts_.near[i] == 0) return;
    const double theta = cells.reactant[i] > 0 ? fields_.theta_next[i] : 0.0,
                 V = wet(i) ? amounts_.volume[i] : 0.0;
    double& p = cells.pressure[i];
    p = V + theta > 0 ? ((V > 0 ? V * fields_.pressure[i] : 0.0) + theta * p) / (V + theta) : 0.0;
    if (law.detonates(p))
      for_each_around(c, 1, [&](std::size_t j) { cells.beside_detonation[j] = 1; });
  });
  if (law.cracks || law.spread) find_hot_cells(scope, burn, law, cells);
  return cells;
}

// What is hot, and what flames burn by now.
template <int D>
void LevelCoupling<D>::find_hot_cells(const StageScope& scope, const models::SolidBurn& burn,
                                      const models::Ddt1& law, ExplosiveCells& cells) const {
  enum Lane { hot, surfaces, cracks, lanes };
  const double ignition = law.flame.ignition_temperature;
  CellSums<D> counts;
  counts.begin(frame_.cells, lanes);
  for (const SolidSet<D>& s : sets_) {
    if (s.kind != burn.solid) continue;
    const double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
    for (std::size_t p = 0; p < s.set->size(); ++p) {
      if (!(s.stays[p] > 0)) continue;
      const std::size_t i = frame_.cells.index(middle_of(*s.next, p));
      if (T[p] > ignition) ++counts.lane(hot)[i];
      if (law.spread && s.flame[p].burns())
        ++counts.lane(s.flame[p].kind == models::Ignition::surface ? surfaces : cracks)[i];
    }
  }
  counts.sum_over_ranks(*scope.ranks);
  for_each_cell_near([&](const Cell<D>& c, std::size_t i) {
    const double V = amounts_.near[i] != 0 && wet(i) ? amounts_.volume[i] : 0.0;
    const bool fluid = V > law.seen_in_cracks && heat_of(i).temperature > ignition;
    cells.hot_fluid[i] = fluid && V > seen_volume ? 1 : 0;
    cells.hot[i] = fluid || counts.lane(hot)[i] > 0 ? 1 : 0;
    if (cells.hot[i] != 0) for_each_around(c, 1, [&](std::size_t j) { cells.beside_hot[j] = 1; });
    const auto bit = [&](Lane lane, models::Ignition::Kind kind) {
      return counts.lane(lane)[i] > 0 ? 1u << kind : 0u;
    };
    cells.burning[i] = static_cast<std::uint8_t>(bit(surfaces, models::Ignition::surface) |
                                                 bit(cracks, models::Ignition::cracks));
  });
}

template <int D>
void LevelCoupling<D>::detonate(double dt, const models::SolidBurn& burn, const models::Ddt1& law,
                                ExplosiveCells& cells) const {
  models::JwlPp jwl = law.detonation;
  jwl.rho0 = solids_->scene().materials[static_cast<std::size_t>(burn.solid)].constants.density;
  for_each_cell_near([&](const Cell<D>&, std::size_t i) {
    const double reactant = cells.reactant[i], p = cells.pressure[i];
    if (!(reactant > 0) || amounts_.near[i] == 0 || !jwl.burns(p, fields_.theta_next[i])) return;
    cells.detonates[i] = jwl.burned(dt, p, reactant, cells.product[i]) / reactant;
  });
}

template <int D>
void LevelCoupling<D>::burn_open_faces(const models::Ddt1& law, const ExplosiveCells& cells,
                                       std::size_t n, double dt, Column& shares) const {
  const SolidSet<D>& s = sets_[n];
  std::vector<ExposedArea<D>> exposed(s.set->size());
  const double* mass = s.set->column(static_cast<std::size_t>(s.columns->mass));
  const double* volume = s.set->column(static_cast<std::size_t>(s.columns->volume));
  const double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
  for_each_open_piece(s, [&](std::size_t p, int face, const std::array<double, D>& area,
                             const Cell<D>& c, std::size_t k) {
    const double pressure = fields_.pressure[k];
    bool burns = law.deflagrates(pressure) && cells.beside_detonation[k] == 0;
    if (burns && law.spread)
      burns = s.flame[p].burns() && s.flame[p].kind == models::Ignition::surface;
    else if (burns)
      burns = std::max(T[p], hottest_fluid(c, true)) > law.flame.ignition_temperature;
    exposed[p].add(
        face, area,
        burns ? law.flame.surface(pressure, T[p], mass[p] / volume[p]) : models::BurningSurface{});
  });
  for (std::size_t p = 0; p < shares.size(); ++p)
    if (s.stays[p] > 0) shares[p] = dt * exposed[p].flow() / (mass[p] * s.stays[p]);
}

// A cell whose surface burns does not burn in its cracks, where flames need no time.
template <int D>
void LevelCoupling<D>::mark_burning_surfaces(const StageScope& scope,
                                             const std::vector<Column>& shares,
                                             ExplosiveCells& cells) const {
  CellSums<D> counts;
  counts.begin(frame_.cells, 1);
  for (std::size_t n = 0; n < sets_.size(); ++n)
    for (std::size_t p = 0; p < shares[n].size(); ++p)
      if (shares[n][p] > 0) ++counts.lane(0)[frame_.cells.index(middle_of(*sets_[n].next, p))];
  counts.sum_over_ranks(*scope.ranks);
  for (std::size_t i = 0; i < cells.surface_burns.size(); ++i)
    cells.surface_burns[i] = counts.lane(0)[i] > 0 ? 1 : 0;
}

template <int D>
void LevelCoupling<D>::burn_cracks(const models::Ddt1& law, const ExplosiveCells& cells,
                                   std::size_t n, double dt, Column& shares) const {
  const SolidSet<D>& s = sets_[n];
  const double* radius = crack_radii(s);
  if (radius == nullptr) return;
  const double* mass = s.set->column(static_cast<std::size_t>(s.columns->mass));
  const double* volume = s.set->column(static_cast<std::size_t>(s.columns->volume));
  const double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
  for (std::size_t p = 0; p < shares.size(); ++p) {
    if (!(s.stays[p] > 0)) continue;
    const std::size_t i = frame_.cells.index(middle_of(*s.next, p));
    const double pressure = cells.pressure[i], density = mass[p] / volume[p];
    if (!law.deflagrates(pressure) || cells.beside_detonation[i] != 0) continue;
    const bool burns = law.spread
                           ? s.flame[p].burns() && s.flame[p].kind == models::Ignition::cracks
                           : cells.surface_burns[i] == 0 && cells.beside_hot[i] != 0 &&
                                 law.cracked(radius[p], pressure);
    if (burns)
      shares[p] = law.burned_in_cracks(dt, law.flame.surface(pressure, T[p], density).flux, density,
                                       s.filled[p]);
  }
}

// Pressures are those at which the step was taken.
template <int D>
void LevelCoupling<D>::pass_switches(const StageScope& scope, const models::Ddt1& law,
                                     const ExplosiveCells& cells) {
  if (law.switches.empty()) return;
  double most = 0;
  bool detonates = false;
  for_each_own_cell([&](const Cell<D>&, std::size_t i) {
    if (!(cells.reactant[i] > 0)) return;
    most = std::max(most, cells.pressure[i]);
    detonates |= cells.detonates[i] > 0;
  });
  Reduction all;
  const auto highest = all.add_maximum(most);
  const auto any = all.add_any(detonates);
  scope.ranks->reduce(all);
  for (const models::Ddt1::Switch& s : law.switches) {
    const bool passed = s.pressure > 0 ? all.maximum(highest) > s.pressure : all.any(any);
    places_.switches.of(*scope.sums)[next_switch_++] += passed ? 1 : 0;
  }
}

template <int D>
bool LevelCoupling<D>::burn_ddt(const StageScope& scope, const models::SolidBurn& burn,
                                const models::Ddt1& law) {
  const double dt = scope.step.dt;
  ExplosiveCells cells = look_at_explosive(scope, burn, law);
  detonate(dt, burn, law, cells);
  pass_switches(scope, law, cells);
  std::vector<Column> detonated(sets_.size()), of_surfaces = detonated, of_cracks = detonated;
  burn_particles(burn, cells.detonates, detonated);
  for (std::size_t n = 0; n < sets_.size(); ++n) {
    if (sets_[n].kind != burn.solid) continue;
    if (law.spread) spread_flames(law, cells, n, dt);
    of_surfaces[n].assign(sets_[n].set->size(), 0.0);
    burn_open_faces(law, cells, n, dt, of_surfaces[n]);
  }
  if (law.spread) note_flames(scope);
  if (law.cracks && !law.spread) mark_burning_surfaces(scope, of_surfaces, cells);
  for (std::size_t n = 0; n < sets_.size(); ++n) {
    of_cracks[n].assign(of_surfaces[n].size(), 0.0);
    if (law.cracks && sets_[n].kind == burn.solid) burn_cracks(law, cells, n, dt, of_cracks[n]);
  }
  const auto give = [&](int product, double heat, const std::vector<Column>& shares,
                        const Column& in_cells) {
    return give_to_cells(scope, product, take_from_particles(burn.solid, product, heat, shares),
                         in_cells);
  };
  const double flame_heat = law.flame.heat();
  bool any = give(burn.product, law.detonation.heat, detonated, cells.detonates);
  any |= give(law.surface_product, flame_heat, of_surfaces, {});
  any |= give(burn.product, flame_heat, of_cracks, {});
  const Column& product = amounts_.mass[static_cast<std::size_t>(burn.product)];
  for (std::size_t i = 0; i < product.size(); ++i) cells.gain[i] = product[i] - cells.product[i];
  store_explosive(scope, burn, law, cells, of_surfaces, of_cracks);
  return any;
}

template <int D>
void LevelCoupling<D>::store_explosive(const StageScope& scope, const models::SolidBurn& burn,
                                       const models::Ddt1& law, const ExplosiveCells& cells,
                                       const std::vector<Column>& of_surfaces,
                                       const std::vector<Column>& of_cracks) const {
  const std::vector<BurningField> fields = saved_fields(scope, burn);
  if (fields.empty()) return;
  std::vector<BurningPiece> surfaces, cracks, coming, lit;
  Column delays, waited;
  for (std::size_t n = 0; n < sets_.size(); ++n) {
    const SolidSet<D>& s = sets_[n];
    for (std::size_t p = 0; p < of_surfaces[n].size(); ++p) {
      const std::size_t i = frame_.cells.index(middle_of(*s.next, p));
      if (of_surfaces[n][p] > 0) surfaces.push_back({n, p, i});
      if (of_cracks[n][p] > 0) cracks.push_back({n, p, i});
      if (!law.spread || !s.flame[p].lit()) continue;
      lit.push_back({n, p, i});
      waited.push_back(s.flame[p].time);
      if (s.flame[p].burns() || !(cells.pressure[i] > 0)) continue;
      coming.push_back({n, p, i});
      delays.push_back(law.spread->delay(s.flame[p].way, cells.pressure[i]));
    }
  }
  CellSums<D> on_the_way, set_out;
  const double most_coming = count_pieces(scope, coming, on_the_way),
               most_lit = count_pieces(scope, lit, set_out);
  Column kind(frame_.cells.size(), 0.0);
  CellSums<D> counts;
  for (std::size_t i = 0; i < kind.size(); ++i) kind[i] = on_the_way.lane(0)[i] > 0 ? 1 : 0;
  for (const auto& [pieces, number] : {std::pair{&surfaces, models::Ignition::surface},
                                       std::pair{&cracks, models::Ignition::cracks}}) {
    count_pieces(scope, *pieces, counts);
    for (std::size_t i = 0; i < kind.size(); ++i)
      if (counts.lane(0)[i] > 0) kind[i] = number;
  }
  for (const BurningField& field : fields) {
    Column values(frame_.cells.size(), 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double all = cells.reactant[i] + cells.product[i];
      if (field.value == BurningValue::detonates) values[i] = cells.detonates[i] > 0 ? 1 : 0;
      if (field.value == BurningValue::gain && cells.reactant[i] > 0)
        values[i] = cells.gain[i] / all;
      if (field.value == BurningValue::share && cells.reactant[i] > 0)
        values[i] = (cells.product[i] + cells.gain[i]) / all;
    }
    if (field.value == BurningValue::kind) values = kind;
    if (field.value == BurningValue::delay)
      mean_of_pieces(scope, coming, delays, on_the_way, most_coming, values);
    if (field.value == BurningValue::waited)
      mean_of_pieces(scope, lit, waited, set_out, most_lit, values);
    keep_in_cells(scope, field.kept, burn.solid, values);
  }
}

template const double* LevelCoupling<1>::crack_radii(const SolidSet<1>&) const;
template const double* LevelCoupling<2>::crack_radii(const SolidSet<2>&) const;
template const double* LevelCoupling<3>::crack_radii(const SolidSet<3>&) const;
template Cell<1> LevelCoupling<1>::middle_of(const ParticleSet&, std::size_t) const;
template Cell<2> LevelCoupling<2>::middle_of(const ParticleSet&, std::size_t) const;
template Cell<3> LevelCoupling<3>::middle_of(const ParticleSet&, std::size_t) const;
template bool LevelCoupling<1>::burn_ddt(const StageScope&, const models::SolidBurn&,
                                         const models::Ddt1&);
template bool LevelCoupling<2>::burn_ddt(const StageScope&, const models::SolidBurn&,
                                         const models::Ddt1&);
template bool LevelCoupling<3>::burn_ddt(const StageScope&, const models::SolidBurn&,
                                         const models::Ddt1&);

}  // namespace sluice::mpmice
