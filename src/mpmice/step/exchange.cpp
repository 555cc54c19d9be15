// Momentum and heat that fluid and solids give each other through the surfaces of these, with the
// geometry at the end of the step (surface_exchange.hpp has the equations).
#include <cmath>

#include "mpmice/step/level_coupling.hpp"
#include "mpmice/step/surface_exchange.hpp"

namespace sluice::mpmice {
namespace {

// A solid with each fluid. Convective exchange counts all that is in front and behind, not half of
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

}  // namespace

template <int D>
void LevelCoupling<D>::exchange(const StageScope& scope) {
  const mpm::MpmScene& solids = solids_->scene();
  for (int k = 0; k < static_cast<int>(solids.materials.size()); ++k) {
    if (!exchanges(k)) continue;
    const FilmCoefficients films = films_of(fluid_->scene(), k);
    const mpm::SolidMaterial& material = solids.materials[static_cast<std::size_t>(k)];
    const SolidConstants constants{material.rigid, material.constants.specific_heat,
                                   solids.heat_conduction ? material.constants.conductivity : 0.0};
    SurfaceExchange<D>(frame_, fields_, amounts_, sets_, *fluid_, k, constants, films)
        .run(scope, books_);
  }
}

template <int D>
bool LevelCoupling<D>::exchanges(int kind) const {
  const FilmCoefficients films = films_of(fluid_->scene(), kind);
  return films.any_drag() || films.any_heat();
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

template bool LevelCoupling<1>::exchanges(int) const;
template std::array<Vec3, 2> LevelCoupling<1>::bounds_of_velocities(int) const;
template bool LevelCoupling<2>::exchanges(int) const;
template std::array<Vec3, 2> LevelCoupling<2>::bounds_of_velocities(int) const;
template bool LevelCoupling<3>::exchanges(int) const;
template std::array<Vec3, 2> LevelCoupling<3>::bounds_of_velocities(int) const;
template LevelCoupling<1>::FluidHeat LevelCoupling<1>::heat_of(std::size_t) const;
template LevelCoupling<2>::FluidHeat LevelCoupling<2>::heat_of(std::size_t) const;
template LevelCoupling<3>::FluidHeat LevelCoupling<3>::heat_of(std::size_t) const;
template void LevelCoupling<1>::exchange(const StageScope&);
template void LevelCoupling<2>::exchange(const StageScope&);
template void LevelCoupling<3>::exchange(const StageScope&);

}  // namespace sluice::mpmice
