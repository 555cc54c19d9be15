#include "mpmice/burn/burning_step.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/reduction.hpp"
#include "mpmice/burn/burning_cells.hpp"

namespace sluice::mpmice {

template <int D>
FluidHeat heat_of(const BurningStep<D>& step, std::size_t i) {
  const CellAmounts<D>& a = step.amounts;
  const std::vector<ice::Fluid>& fluids = step.fluid.options().materials.fluids;
  const double all = a.mass_of_all(i), rest = a.kinetic[i] - a.moving(i);
  FluidHeat heat;
  for (std::size_t m = 0; m < fluids.size(); ++m) {
    const double M = a.mass[m][i], V = a.filled[m][i];
    if (!(M > 0) || !(V > 0)) continue;
    const double rho = M / V, rho_e = (a.energy[m][i] + rest * (M / all)) / V;
    if (!fluids[m].admissible(rho, rho_e)) continue;
    const double capacity = M * fluids[m].heat_capacity(rho, rho_e);
    heat.capacity += capacity;
    heat.temperature += capacity * fluids[m].temperature(rho, rho_e);
  }
  if (heat.capacity > 0) heat.temperature /= heat.capacity;
  return heat;
}

template <int D>
double hottest_fluid(const BurningStep<D>& step, const Cell<D>& c, bool around) {
  const CellAmounts<D>& a = step.amounts;
  const std::size_t here = step.frame().cells.index(c);
  if (!around && a.volume[here] > seen_volume) return heat_of(step, here).temperature;
  double most = 0;
  step.near.for_each_around(c, 1, [&](std::size_t i) {
    if (a.near[i] != 0 && a.volume[i] > seen_volume)
      most = std::max(most, heat_of(step, i).temperature);
  });
  return most;
}

template <int D>
void mean_in_cells(const BurningStep<D>& step, int kind, Column& mass, Column& pressure) {
  double most_mass = 1e-300, most_pressure = 1e-300;
  const auto pressure_of = [](const std::array<const double*, 6>& stress, std::size_t p) {
    return -(stress[0][p] + stress[1][p] + stress[2][p]) / 3;
  };
  const auto for_particles = [&](auto&& act) {
    for (const SolidSet<D>& s : step.sets.all()) {
      if (s.kind != kind) continue;
      const double* m = s.set->column(static_cast<std::size_t>(s.columns->mass));
      const auto stress = columns_from<6>(*s.next, s.columns->stress);
      for (std::size_t p = 0; p < s.set->size(); ++p)
        act(s, p, m[p] * s.stays[p], pressure_of(stress, p));
    }
  };
  for_particles([&](const SolidSet<D>&, std::size_t, double m, double p) {
    most_mass = std::max(most_mass, m);
    most_pressure = std::max(most_pressure, std::fabs(p));
  });
  Reduction all;
  const auto a = all.add_maximum(most_mass), b = all.add_maximum(most_pressure);
  step.scope.ranks->reduce(all);
  most_mass = all.maximum(a);
  most_pressure = all.maximum(b);
  const Frame<D>& frame = step.frame();
  CellSums<D> sums;
  sums.begin(frame.cells, 2);
  for_particles([&](const SolidSet<D>& s, std::size_t p, double m, double pressure_of_p) {
    const double share = m / most_mass / most_parts<D>;
    for_each_part<D>(frame, corner_columns<D>(frame, *s.columns, *s.next), *s.next, p,
                     [&](std::size_t cell) {
                       sums.lane(0)[cell] += to_sum(share);
                       sums.lane(1)[cell] += to_sum(share * (pressure_of_p / most_pressure));
                     });
  });
  sums.sum_over_ranks(*step.scope.ranks);
  sums.values(0, mass);
  sums.values(1, pressure);
  const double reference = step.sets.reference_pressure();
  for (std::size_t i = 0; i < mass.size(); ++i) {
    pressure[i] = mass[i] > 0 ? pressure[i] / mass[i] * most_pressure + reference : 0.0;
    mass[i] *= most_mass * (most_parts<D> / (1 << D)) / frame.cell_volume;
  }
}

template <int D>
double most_of(const CellSums<D>& counts, Communicator& ranks) {
  Reduction all;
  const auto most = all.add_maximum(static_cast<double>(
      *std::max_element(counts.lane(0), counts.lane(0) + counts.cells().size())));
  ranks.reduce(all);
  return all.maximum(most);
}

template FluidHeat heat_of(const BurningStep<1>&, std::size_t);
template FluidHeat heat_of(const BurningStep<2>&, std::size_t);
template FluidHeat heat_of(const BurningStep<3>&, std::size_t);
template double hottest_fluid<1>(const BurningStep<1>&, const Cell<1>&, bool);
template double hottest_fluid<2>(const BurningStep<2>&, const Cell<2>&, bool);
template double hottest_fluid<3>(const BurningStep<3>&, const Cell<3>&, bool);
template void mean_in_cells(const BurningStep<1>&, int, Column&, Column&);
template void mean_in_cells(const BurningStep<2>&, int, Column&, Column&);
template void mean_in_cells(const BurningStep<3>&, int, Column&, Column&);
template double most_of(const CellSums<1>&, Communicator&);
template double most_of(const CellSums<2>&, Communicator&);
template double most_of(const CellSums<3>&, Communicator&);

}  // namespace sluice::mpmice
