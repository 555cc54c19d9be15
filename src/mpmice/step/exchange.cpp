// Momentum and heat that fluid and solids of a cell give each other, with the geometry at the end
// of the step. With M, u, T of the fluid and M_s, u_s, T_s of the solid, K and K_h coefficients:
//
//   k = dt K V theta,  I = (u - u_s)/(1/k + 1/M + 1/M_s),   Q alike with M c_v, T and K_h
//   fluid: P -= I, total energy -= I.(u_s + I/(2 M_s)) + Q
//   particle: dv = sum_c w_c I/M_s (w_c: share of it in cell c), heat: what is left of that energy
// Exact for any K: the relative velocity of the pair never changes its sign. What friction costs
// the pair goes to the fluid. (mpmice_scheme, section 3.)
#include <cmath>

#include "framework/base/reduction.hpp"
#include "mpmice/step/cell_masks.hpp"
#include "mpmice/step/level_coupling.hpp"

namespace sluice::mpmice {
namespace {

// What one kind of solid has in cells, per cell volume.
template <int D>
struct KindInCells {
  Column mass, heat;               // M_s; M_s T_s
  std::array<Column, D> velocity;  // u_s
};

}  // namespace

template <int D>
void LevelCoupling<D>::exchange(const StageScope& scope) {
  const ice::IceScene& ice = fluid_->scene();
  for (int k = 0; k < static_cast<int>(solids_->scene().materials.size()); ++k)
    if (exchanges(k))
      exchange_with(scope, k, ice.momentum_of_all(k, ice.solids), ice.heat_of_all(k, ice.solids));
}

template <int D>
bool LevelCoupling<D>::exchanges(int kind) const {
  const ice::IceScene& ice = fluid_->scene();
  return ice.momentum_of_all(kind, ice.solids) > 0 || ice.heat_of_all(kind, ice.solids) > 0;
}

// Temperature and M c_v of the fluids of a cell: what they have together.
template <int D>
typename LevelCoupling<D>::FluidHeat LevelCoupling<D>::heat_of(std::size_t i) const {
  const std::vector<ice::Fluid>& fluids = fluid_->options().materials.fluids;
  const double all = amounts_.mass_of_all(i), rest = amounts_.kinetic[i] - amounts_.moving(i);
  FluidHeat heat;
  for (std::size_t m = 0; m < fluids.size(); ++m) {
    const double M = amounts_.mass[m][i], V = amounts_.filled[m][i];
    if (!(M > 0) || !(V > 0)) continue;
    const double rho = M / V, rho_e = (amounts_.energy[m][i] + rest * (M / all)) / V;
    if (!fluids[m].admissible(rho, rho_e)) continue;
    const double capacity = M * fluids[m].heat_capacity(rho, rho_e);
    heat.capacity += capacity;
    heat.temperature += capacity * fluids[m].temperature(rho, rho_e);
  }
  if (heat.capacity > 0) heat.temperature /= heat.capacity;
  return heat;
}

// Cells in which the middles of particles lie that may meet fluid in a cell with both: no part of a
// particle is farther from its middle than a cell.
template <int D>
CellMask LevelCoupling<D>::cells_that_exchange() const {
  CellMask mask(frame_.cells.size(), 0);
  for_each_cell_near([&](const Cell<D>&, std::size_t i) {
    const double V = amounts_.volume[i];
    mask[i] = V > 0 && V < 1 ? 1 : 0;
  });
  dilate(frame_, 1, mask);
  return mask;
}

template <int D>
void LevelCoupling<D>::exchange_with(const StageScope& scope, int kind, double K, double K_h) {
  const mpm::SolidMaterial& material = solids_->scene().materials[static_cast<std::size_t>(kind)];
  const bool rigid = material.rigid;
  const double dt = scope.step.dt, c_s = material.constants.specific_heat;
  // Sums over the particles.
  const ExchangeScales& scales = exchange_scales_[static_cast<std::size_t>(kind)];
  const double most_mass = mass_of_heaviest(), most_speed = scales.velocity,
               most_T = scales.temperature;
  const auto column = [](const SolidSet<D>& s, int c) {
    return s.next->column(static_cast<std::size_t>(c));
  };
  CellSums<D> sums;
  sums.begin(frame_.cells, 2 + D);
  const CellMask meets = cells_that_exchange();
  const auto is_apart = [&](const SolidSet<D>& s, std::size_t p) {
    return meets[frame_.cells.index(middle_of(*s.next, p))] == 0;
  };
  for (const SolidSet<D>& s : sets_) {
    if (s.kind != kind) continue;
    const CornerColumns<D> x = corner_columns<D>(frame_, *s.columns, *s.next);
    const double* m = s.set->column(static_cast<std::size_t>(s.columns->mass));
    for (std::size_t p = 0; p < s.set->size(); ++p) {
      if (is_apart(s, p)) continue;
      const double share = m[p] / most_mass / most_parts<D>;
      for_each_part<D>(frame_, x, *s.next, p, [&](std::size_t cell) {
        sums.lane(0)[cell] += to_sum(share);
        sums.lane(1)[cell] += to_sum(share * (column(s, s.columns->temperature)[p] / most_T));
        for (int d = 0; d < D; ++d)
          sums.lane(2 + d)[cell] += to_sum(
              share *
              (column(s, s.columns->velocity + frame_.direction[static_cast<std::size_t>(d)])[p] /
               most_speed));
      });
    }
  }
  sums.sum_over_ranks(*scope.ranks);
  KindInCells<D> solid;
  sums.values(0, solid.mass);
  sums.values(1, solid.heat);
  for (int d = 0; d < D; ++d) sums.values(2 + d, solid.velocity[static_cast<std::size_t>(d)]);
  const double to_density = most_mass * (most_parts<D> / (1 << D)) / frame_.cell_volume;
  // Exchange in cells: dv and the energy that the particles get, by cell.
  std::array<Column, D> dv;
  for (Column& of : dv) of.assign(frame_.cells.size(), 0.0);
  Column gain(frame_.cells.size(), 0.0), warm(frame_.cells.size(), 0.0);
  // On the fluid; of rigid solids it comes from outside.
  const auto impulse = [&](std::size_t d) -> ExactSum& {
    return books_.of_exchange(mpm::StepSums::impulse_x + frame_.direction[d]);
  };
  ExactSum& work = books_.of_exchange(mpm::StepSums::work);  // likewise, and heat
  std::array<int, 3> component{-1, -1, -1};
  for (std::size_t k = 0; k < amounts_.momentum.size(); ++k)
    component[static_cast<std::size_t>(fluid_->options().grid.direction[k])] = static_cast<int>(k);
  for_each_cell_near([&](const Cell<D>&, std::size_t i) {
    const double V = amounts_.volume[i], theta = fields_.theta_next[i];
    if (!(V > 0 && V < 1) || !(solid.mass[i] > 0) || amounts_.near[i] == 0) return;
    const double M = amounts_.mass_of_all(i), Ms = solid.mass[i] * to_density;
    if (!(M > 0)) return;
    amounts_.touched[i] = 1;
    const double inverse_s = rigid ? 0.0 : 1 / Ms;
    const FluidHeat fluid = heat_of(i);
    if (K > 0)
      for (std::size_t d = 0; d < D; ++d) {
        const int c = component[static_cast<std::size_t>(frame_.direction[d])];
        if (c < 0) continue;
        double& P = amounts_.momentum[static_cast<std::size_t>(c)][i];
        const double us = solid.velocity[d][i] / solid.mass[i] * most_speed;
        const double I = (P / M - us) / (1 / (dt * K * V * theta) + 1 / M + inverse_s);
        P -= I;
        if (rigid && own_[i] != 0) impulse(d).add(-I * frame_.cell_volume);
        const double given = I * (us + 0.5 * I * inverse_s);
        amounts_.kinetic[i] -= given;
        if (rigid && own_[i] != 0) work.add(-given * frame_.cell_volume);
        dv[d][i] = I * inverse_s;
        gain[i] += given;
      }
    if (K_h > 0 && c_s > 0 && fluid.capacity > 0) {
      const double Ts = solid.heat[i] / solid.mass[i] * most_T;
      const double Q = (fluid.temperature - Ts) / (1 / (dt * K_h * V * theta) + 1 / fluid.capacity +
                                                   (rigid ? 0.0 : 1 / (Ms * c_s)));
      amounts_.kinetic[i] -= Q;
      if (rigid && own_[i] != 0) work.add(-Q * frame_.cell_volume);
      warm[i] = rigid ? 0.0 : Q / (Ms * c_s);
    }
  });
  if (rigid) return;
  ExactSum &heated = books_.of_exchange(mpm::StepSums::heat_from_fluid),
           &moved = books_.of_exchange(mpm::StepSums::exchange_gain);
  for (SolidSet<D>& s : sets_) {
    if (s.kind != kind) continue;
    const CornerColumns<D> x = corner_columns<D>(frame_, *s.columns, *s.next);
    const double* mass = s.set->column(static_cast<std::size_t>(s.columns->mass));
    double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
    std::array<double*, D> v;
    for (std::size_t d = 0; d < D; ++d)
      v[d] = s.next->column(static_cast<std::size_t>(s.columns->velocity + frame_.direction[d]));
    for (std::size_t p = 0; p < s.set->size(); ++p) {
      if (is_apart(s, p)) continue;
      std::array<double, D> kick{};
      double heat = 0, energy = 0;  // per mass
      for_each_part<D>(frame_, x, *s.next, p, [&](std::size_t cell) {
        for (std::size_t d = 0; d < D; ++d) kick[d] += dv[d][cell] / (1 << D);
        heat += warm[cell] / (1 << D);
        if (gain[cell] != 0) energy += gain[cell] / (solid.mass[cell] * to_density) / (1 << D);
      });
      for (std::size_t d = 0; d < D; ++d) {
        const double gained = kick[d] * (v[d][p] + 0.5 * kick[d]);
        moved.add(mass[p] * gained);
        energy -= gained;
        v[d][p] += kick[d];
      }
      T[p] += heat;
      if (c_s > 0) T[p] += energy / c_s;
      heated.add(mass[p] * (c_s * heat + energy));
    }
  }
}

// Velocities have changed: sums of the next step must have room for them.
template <int D>
std::array<Vec3, 2> LevelCoupling<D>::bounds_of_velocities(int kind) const {
  Vec3 up{-1e300, -1e300, -1e300}, down = up;
  for (const SolidSet<D>& s : sets_) {
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

template std::array<Vec3, 2> LevelCoupling<1>::bounds_of_velocities(int) const;
template bool LevelCoupling<1>::exchanges(int) const;
template std::array<Vec3, 2> LevelCoupling<2>::bounds_of_velocities(int) const;
template bool LevelCoupling<2>::exchanges(int) const;
template std::array<Vec3, 2> LevelCoupling<3>::bounds_of_velocities(int) const;
template bool LevelCoupling<3>::exchanges(int) const;
template void LevelCoupling<1>::exchange(const StageScope&);
template void LevelCoupling<2>::exchange(const StageScope&);
template void LevelCoupling<3>::exchange(const StageScope&);

}  // namespace sluice::mpmice
