// What particles have lost becomes fluid in their cells, where their volume opens.
//
// Redistribution joins what little cells hold with their neighbours at once: products alone in a
// crack would tear the body.
#include <algorithm>
#include <cmath>

#include "framework/base/reduction.hpp"
#include "mpmice/step/level_coupling.hpp"

namespace sluice::mpmice {

// The largest number of parts of the giving particles in a cell: sums need room for no more.
template <int D>
double LevelCoupling<D>::most_parts_given(const StageScope& scope,
                                          const std::vector<Given>& given) const {
  CellSums<D> parts;
  parts.begin(frame_.cells, 1);
  for (const Given& g : given) {
    const SolidSet<D>& s = sets_[g.set];
    for_each_part<D>(frame_, corner_columns<D>(frame_, *s.columns, *s.next), *s.next, g.particle,
                     [&](std::size_t i) { ++parts.lane(0)[i]; });
  }
  parts.sum_over_ranks(*scope.ranks);
  return most_of(scope, parts);
}

// Cells get what particles have given: each cell of a particle as many parts as lie in it, by
// `in_cells` where that is not empty. False: no rank has anything.
template <int D>
bool LevelCoupling<D>::give_to_cells(const StageScope& scope, int product,
                                     const std::vector<Given>& given, const Column& in_cells) {
  constexpr int mass = 0, energy = 1, kinetic = 2, momentum = 3;
  const int components = static_cast<int>(amounts_.momentum.size());
  double most_mass = 1e-300, most_energy = 1e-300, most_kinetic = 1e-300, most_speed = 1e-300;
  for (const Given& g : given) {
    most_mass = std::max(most_mass, g.mass);
    most_energy = std::max(most_energy, std::fabs(g.energy));
    most_kinetic = std::max(most_kinetic, g.kinetic);
    for (int d = 0; d < 3; ++d) most_speed = std::max(most_speed, std::fabs(g.velocity[d]));
  }
  Reduction all;
  const std::array<Reduction::Maximum, 4> maxima{
      all.add_maximum(most_mass), all.add_maximum(most_energy), all.add_maximum(most_kinetic),
      all.add_maximum(most_speed)};
  const auto any = all.add_any(!given.empty());
  scope.ranks->reduce(all);
  if (!all.any(any)) return false;
  most_mass = all.maximum(maxima[0]);
  most_energy = all.maximum(maxima[1]);
  most_kinetic = all.maximum(maxima[2]);
  most_speed = all.maximum(maxima[3]);
  const double room = most_parts_given(scope, given);
  CellSums<D> sums;
  sums.begin(frame_.cells, momentum + components);
  const auto weight = [&](std::size_t i) { return in_cells.empty() ? 1.0 : in_cells[i]; };
  for (const Given& g : given) {
    const SolidSet<D>& s = sets_[g.set];
    const CornerColumns<D> x = corner_columns<D>(frame_, *s.columns, *s.next);
    double whole = 0;  // of the weights of its parts
    for_each_part<D>(frame_, x, *s.next, g.particle, [&](std::size_t i) { whole += weight(i); });
    for_each_part<D>(frame_, x, *s.next, g.particle, [&](std::size_t i) {
      const double share = g.mass / most_mass / room * (weight(i) / whole);
      sums.lane(mass)[i] += to_sum(share);
      sums.lane(energy)[i] += to_sum(share * (g.energy / most_energy));
      sums.lane(kinetic)[i] += to_sum(share * (g.kinetic / most_kinetic));
      for (int k = 0; k < components; ++k) {
        const int d = fluid_->options().grid.direction[static_cast<std::size_t>(k)];
        sums.lane(momentum + k)[i] += to_sum(share * (g.velocity[d] / most_speed));
      }
    });
  }
  sums.sum_over_ranks(*scope.ranks);
  const double to_density = most_mass * room / frame_.cell_volume;
  for_each_cell_near([&](const Cell<D>&, std::size_t i) {
    if (sums.lane(mass)[i] == 0) return;
    const auto value = [&](int lane) { return from_sum(sums.lane(lane)[i]) * to_density; };
    std::array<double, 3> P{};
    for (int k = 0; k < components; ++k)
      P[static_cast<std::size_t>(k)] = value(momentum + k) * most_speed;
    add_product(i, product, value(mass), value(energy) * most_energy, value(kinetic) * most_kinetic,
                P);
  });
  return true;
}

template <int D>
void LevelCoupling<D>::add_product(std::size_t i, int product, double mass, double energy,
                                   double kinetic, const std::array<double, 3>& momentum) {
  const auto m = static_cast<std::size_t>(product);
  amounts_.mass[m][i] += mass;
  products_[m][i] += mass;
  amounts_.energy[m][i] += energy;
  amounts_.kinetic[i] += kinetic;
  for (std::size_t k = 0; k < amounts_.momentum.size(); ++k) amounts_.momentum[k][i] += momentum[k];
  amounts_.touched[i] = 1;
}

// theta and a once more, with what is left of the particles. The products fill what opens.
template <int D>
void LevelCoupling<D>::open_burned_volume(const StageScope& scope) {
  find_all_faces(scope, true);
  SolidInCells<D> found;
  geometry_.find_at_end(frame_, sets_, *scope.ranks, found);
  take_geometry(found, fields_.theta_next, fields_.covered_next);
  for_each_cell_near([&](const Cell<D>&, std::size_t i) {
    const double volume = 1 - fields_.theta_next[i], opened = volume - amounts_.volume[i];
    if (opened == 0) return;
    amounts_.volume[i] = volume;
    amounts_.touched[i] = 1;
    double all = 0;
    for (const Column& mass : products_) all += mass[i];
    if (amounts_.mass.size() == 1) {
      amounts_.filled[0][i] = volume;
    } else if (all > 0) {
      for (std::size_t m = 0; m < products_.size(); ++m)
        amounts_.filled[m][i] += opened * (products_[m][i] / all);
    }
  });
  refresh_amounts(scope);
  share_small_cells();
}

template bool LevelCoupling<1>::give_to_cells(const StageScope&, int, const std::vector<Given>&,
                                              const Column&);
template void LevelCoupling<1>::open_burned_volume(const StageScope&);
template bool LevelCoupling<2>::give_to_cells(const StageScope&, int, const std::vector<Given>&,
                                              const Column&);
template void LevelCoupling<2>::open_burned_volume(const StageScope&);
template bool LevelCoupling<3>::give_to_cells(const StageScope&, int, const std::vector<Given>&,
                                              const Column&);
template void LevelCoupling<3>::open_burned_volume(const StageScope&);

}  // namespace sluice::mpmice
