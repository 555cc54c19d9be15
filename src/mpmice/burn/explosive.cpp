#include "mpmice/burn/explosive.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/reduction.hpp"
#include "mpmice/burn/burning_outputs.hpp"
#include "mpmice/burn/exposed_area.hpp"
#include "mpmice/burn/flames.hpp"
#include "mpmice/burn/surface_burning.hpp"
#include "mpmice/surfaces/surface_pieces.hpp"

namespace sluice::mpmice {

template <int D>
void Explosive<D>::look_at_cells() {
  const std::size_t count = step_.frame().cells.size();
  mean_in_cells(step_, burn_.solid, cells_.reactant, cells_.pressure);
  cells_.product = step_.amounts.mass[static_cast<std::size_t>(burn_.product)];
  for (auto* values : {&cells_.detonates, &cells_.gain}) values->assign(count, 0.0);
  for (auto* marks : {&cells_.beside_detonation, &cells_.hot, &cells_.beside_hot, &cells_.hot_fluid,
                      &cells_.surface_burns, &cells_.burning})
    marks->assign(count, 0);
  step_.near.for_each([&](const Cell<D>& c, std::size_t i) {
    if (step_.amounts.near[i] == 0) return;
    const double theta = cells_.reactant[i] > 0 ? step_.solid.theta_next[i] : 0.0,
                 V = step_.wet(i) ? step_.amounts.volume[i] : 0.0;
    double& p = cells_.pressure[i];
    p = V + theta > 0 ? ((V > 0 ? V * step_.pressure[i] : 0.0) + theta * p) / (V + theta) : 0.0;
    if (law_.detonates(p))
      step_.near.for_each_around(c, 1, [&](std::size_t j) { cells_.beside_detonation[j] = 1; });
  });
  if (law_.cracks || law_.spread) find_hot_cells();
}

// What is hot, and what flames burn by now.
template <int D>
void Explosive<D>::find_hot_cells() {
  enum Lane { hot, surfaces, cracks, lanes };
  const double ignition = law_.flame.ignition_temperature;
  CellSums<D> counts;
  counts.begin(step_.frame().cells, lanes);
  for (const SolidSet<D>& s : step_.sets.all()) {
    if (s.kind != burn_.solid) continue;
    const double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
    for (std::size_t p = 0; p < s.set->size(); ++p) {
      if (!(s.stays[p] > 0)) continue;
      const std::size_t i = step_.frame().cells.index(cell_of_middle(step_.frame(), *s.next, p));
      if (T[p] > ignition) ++counts.lane(hot)[i];
      if (law_.spread && s.flame[p].burns())
        ++counts.lane(s.flame[p].kind == models::Ignition::surface ? surfaces : cracks)[i];
    }
  }
  counts.sum_over_ranks(*step_.scope.ranks);
  step_.near.for_each([&](const Cell<D>& c, std::size_t i) {
    const double V = step_.amounts.near[i] != 0 && step_.wet(i) ? step_.amounts.volume[i] : 0.0;
    const bool fluid = V > law_.seen_in_cracks && heat_of(step_, i).temperature > ignition;
    cells_.hot_fluid[i] = fluid && V > seen_volume ? 1 : 0;
    cells_.hot[i] = fluid || counts.lane(hot)[i] > 0 ? 1 : 0;
    if (cells_.hot[i] != 0)
      step_.near.for_each_around(c, 1, [&](std::size_t j) { cells_.beside_hot[j] = 1; });
    const auto bit = [&](Lane lane, models::Ignition::Kind kind) {
      return counts.lane(lane)[i] > 0 ? 1u << kind : 0u;
    };
    cells_.burning[i] = static_cast<std::uint8_t>(bit(surfaces, models::Ignition::surface) |
                                                  bit(cracks, models::Ignition::cracks));
  });
}

template <int D>
void Explosive<D>::detonate() {
  models::JwlPp jwl = law_.detonation;
  jwl.rho0 = step_.sets.kinds()[static_cast<std::size_t>(burn_.solid)].density;
  step_.near.for_each([&](const Cell<D>&, std::size_t i) {
    const double reactant = cells_.reactant[i], p = cells_.pressure[i];
    if (!(reactant > 0) || step_.amounts.near[i] == 0 || !jwl.burns(p, step_.solid.theta_next[i]))
      return;
    cells_.detonates[i] =
        jwl.burned(step_.scope.step.dt, p, reactant, cells_.product[i]) / reactant;
  });
}

template <int D>
void Explosive<D>::burn_open_faces(std::size_t n, Column& shares) const {
  const SolidSet<D>& s = step_.sets.all()[n];
  std::vector<ExposedArea<D>> exposed(s.set->size());
  const double* mass = s.set->column(static_cast<std::size_t>(s.columns->mass));
  const double* volume = s.set->column(static_cast<std::size_t>(s.columns->volume));
  const double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
  for_each_open_piece(
      step_.frame(), step_.solid, s,
      [&](std::size_t p, int face, const std::array<double, D>& area, const Cell<D>& c,
          std::size_t k) {
        const double pressure = step_.pressure[k];
        bool burns = law_.deflagrates(pressure) && cells_.beside_detonation[k] == 0;
        if (burns && law_.spread)
          burns = s.flame[p].burns() && s.flame[p].kind == models::Ignition::surface;
        else if (burns)
          burns =
              std::max(T[p], hottest_fluid<D>(step_, c, true)) > law_.flame.ignition_temperature;
        exposed[p].add(face, area,
                       burns ? law_.flame.surface(pressure, T[p], mass[p] / volume[p])
                             : models::BurningSurface{});
      });
  for (std::size_t p = 0; p < shares.size(); ++p)
    if (s.stays[p] > 0)
      shares[p] = step_.scope.step.dt * exposed[p].flow() / (mass[p] * s.stays[p]);
}

// A cell whose surface burns does not burn in its cracks, where flames need no time.
template <int D>
void Explosive<D>::mark_burning_surfaces(const std::vector<Column>& shares) {
  CellSums<D> counts;
  counts.begin(step_.frame().cells, 1);
  for (std::size_t n = 0; n < step_.sets.all().size(); ++n)
    for (std::size_t p = 0; p < shares[n].size(); ++p)
      if (shares[n][p] > 0)
        ++counts.lane(0)[step_.frame().cells.index(
            cell_of_middle(step_.frame(), *step_.sets.all()[n].next, p))];
  counts.sum_over_ranks(*step_.scope.ranks);
  for (std::size_t i = 0; i < cells_.surface_burns.size(); ++i)
    cells_.surface_burns[i] = counts.lane(0)[i] > 0 ? 1 : 0;
}

template <int D>
void Explosive<D>::burn_cracks(std::size_t n, Column& shares) const {
  const SolidSet<D>& s = step_.sets.all()[n];
  const double* radius = crack_radii(s);
  if (radius == nullptr) return;
  const double* mass = s.set->column(static_cast<std::size_t>(s.columns->mass));
  const double* volume = s.set->column(static_cast<std::size_t>(s.columns->volume));
  const double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
  for (std::size_t p = 0; p < shares.size(); ++p) {
    if (!(s.stays[p] > 0)) continue;
    const std::size_t i = step_.frame().cells.index(cell_of_middle(step_.frame(), *s.next, p));
    const double pressure = cells_.pressure[i], density = mass[p] / volume[p];
    if (!law_.deflagrates(pressure) || cells_.beside_detonation[i] != 0) continue;
    const bool burns = law_.spread
                           ? s.flame[p].burns() && s.flame[p].kind == models::Ignition::cracks
                           : cells_.surface_burns[i] == 0 && cells_.beside_hot[i] != 0 &&
                                 law_.cracked(radius[p], pressure);
    if (burns)
      shares[p] = law_.burned_in_cracks(step_.scope.step.dt,
                                        law_.flame.surface(pressure, T[p], density).flux, density,
                                        s.filled[p]);
  }
}

// Pressures are those at which the step was taken.
template <int D>
void Explosive<D>::pass_switches(std::span<double> passed) const {
  if (law_.switches.empty()) return;
  double most = 0;
  bool detonates = false;
  step_.near.for_each_own([&](const Cell<D>&, std::size_t i) {
    if (!(cells_.reactant[i] > 0)) return;
    most = std::max(most, cells_.pressure[i]);
    detonates |= cells_.detonates[i] > 0;
  });
  Reduction all;
  const auto highest = all.add_maximum(most);
  const auto any = all.add_any(detonates);
  step_.scope.ranks->reduce(all);
  std::size_t n = 0;
  for (const models::Ddt1::Switch& s : law_.switches) {
    const bool is_passed = s.pressure > 0 ? all.maximum(highest) > s.pressure : all.any(any);
    passed[n++] += is_passed ? 1 : 0;
  }
}

template <int D>
ExplosiveShares Explosive<D>::burn() {
  look_at_cells();
  detonate();
  const std::size_t count = step_.sets.all().size();
  ExplosiveShares shares{std::vector<Column>(count), std::vector<Column>(count),
                         std::vector<Column>(count)};
  share_by_cells(step_, burn_, cells_.detonates, shares.detonated);
  for (std::size_t n = 0; n < count; ++n) {
    const SolidSet<D>& s = step_.sets.all()[n];
    if (s.kind != burn_.solid) continue;
    if (law_.spread) spread_flames(step_, law_, cells_, n);
    shares.of_surfaces[n].assign(s.set->size(), 0.0);
    burn_open_faces(n, shares.of_surfaces[n]);
  }
  if (law_.spread) note_flames(*step_.scope.journal, step_.sets);
  if (law_.cracks && !law_.spread) mark_burning_surfaces(shares.of_surfaces);
  for (std::size_t n = 0; n < count; ++n) {
    shares.of_cracks[n].assign(shares.of_surfaces[n].size(), 0.0);
    if (law_.cracks && step_.sets.all()[n].kind == burn_.solid) burn_cracks(n, shares.of_cracks[n]);
  }
  return shares;
}

// What burns where, for the means in cells.
template <int D>
struct Explosive<D>::Pieces {
  std::vector<BurningPiece> surfaces, cracks, coming, lit;
  Column delays, waited;  // of what comes, of what is lit
};

template <int D>
typename Explosive<D>::Pieces Explosive<D>::pieces_of(const ExplosiveShares& shares) const {
  Pieces pieces;
  for (std::size_t n = 0; n < step_.sets.all().size(); ++n) {
    const SolidSet<D>& s = step_.sets.all()[n];
    for (std::size_t p = 0; p < shares.of_surfaces[n].size(); ++p) {
      const std::size_t i = step_.frame().cells.index(cell_of_middle(step_.frame(), *s.next, p));
      if (shares.of_surfaces[n][p] > 0) pieces.surfaces.push_back({n, p, i});
      if (shares.of_cracks[n][p] > 0) pieces.cracks.push_back({n, p, i});
      if (!law_.spread || !s.flame[p].lit()) continue;
      pieces.lit.push_back({n, p, i});
      pieces.waited.push_back(s.flame[p].time);
      if (s.flame[p].burns() || !(cells_.pressure[i] > 0)) continue;
      pieces.coming.push_back({n, p, i});
      pieces.delays.push_back(law_.spread->delay(s.flame[p].way, cells_.pressure[i]));
    }
  }
  return pieces;
}

template <int D>
Column Explosive<D>::kinds_of_flames(const Pieces& pieces, const CellSums<D>& on_the_way) const {
  Column kind(step_.near.size(), 0.0);
  CellSums<D> counts;
  for (std::size_t i = 0; i < kind.size(); ++i) kind[i] = on_the_way.lane(0)[i] > 0 ? 1 : 0;
  for (const auto& [of, number] : {std::pair{&pieces.surfaces, models::Ignition::surface},
                                   std::pair{&pieces.cracks, models::Ignition::cracks}}) {
    count_pieces(step_, *of, counts);
    for (std::size_t i = 0; i < kind.size(); ++i)
      if (counts.lane(0)[i] > 0) kind[i] = number;
  }
  return kind;
}

template <int D>
void Explosive<D>::store(const ExplosiveShares& shares) {
  const Column& product = step_.amounts.mass[static_cast<std::size_t>(burn_.product)];
  for (std::size_t i = 0; i < product.size(); ++i) cells_.gain[i] = product[i] - cells_.product[i];
  const std::vector<BurningField> fields = saved_fields(step_, burn_);
  if (fields.empty()) return;
  const Pieces pieces = pieces_of(shares);
  CellSums<D> on_the_way, set_out;
  const double most_coming = count_pieces(step_, pieces.coming, on_the_way),
               most_lit = count_pieces(step_, pieces.lit, set_out);
  const Column kind = kinds_of_flames(pieces, on_the_way);
  for (const BurningField& field : fields) {
    Column values(step_.near.size(), 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double all = cells_.reactant[i] + cells_.product[i];
      if (field.value == BurningValue::detonates) values[i] = cells_.detonates[i] > 0 ? 1 : 0;
      if (field.value == BurningValue::gain && cells_.reactant[i] > 0)
        values[i] = cells_.gain[i] / all;
      if (field.value == BurningValue::share && cells_.reactant[i] > 0)
        values[i] = (cells_.product[i] + cells_.gain[i]) / all;
    }
    if (field.value == BurningValue::kind) values = kind;
    if (field.value == BurningValue::delay)
      mean_of_pieces(step_, pieces.coming, pieces.delays, on_the_way, most_coming, values);
    if (field.value == BurningValue::waited)
      mean_of_pieces(step_, pieces.lit, pieces.waited, set_out, most_lit, values);
    keep_in_cells(step_, field.kept, burn_.solid, values);
  }
}

template class Explosive<1>;
template class Explosive<2>;
template class Explosive<3>;

}  // namespace sluice::mpmice
