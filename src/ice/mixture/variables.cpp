// Declaring the variables of a step of several materials.
#include "ice/mixture/variables.hpp"

#include <algorithm>
#include <string>

#include "ice/fluid/labels.hpp"
#include "ice/mixture/surface.hpp"

namespace sluice::ice::mixture {
namespace {

// What the one-material tasks know under the same names; mass and energy are sums here.
SchemeVariables declare_common(TaskList& list, const SchemeOptions& o) {
  const int C = o.grid.components;
  SchemeVariables v;
  v.rho = list.temporary("density of the mixture");
  v.energy = list.temporary("energy of the mixture");
  v.momentum = list.old_state(labels().momentum, 0, C);
  if (o.scheme.masked) v.mask = list.old_state(labels().mask, 0, 1);
  v.momentum_new = list.new_state(labels().momentum, 0, C);
  v.after.momentum = v.momentum_new;
  v.shock_slope = list.temporary("shock slope");
  v.pi = list.temporary("lowest pressure");
  v.new_pressure = list.temporary("new pressure");
  v.lagrangian_mixture = list.temporary("work, friction", o.transport.viscous ? 2 : 1);
  declare_step_temporaries(list, o, v);
  declare_conservative_temporaries(list, o, v);
  if (o.transport.viscous)
    v.front_viscosity = o.own_viscosity_varies()        ? list.temporary("viscosity of fronts")
                        : o.transport.models.turbulence ? v.molecular_viscosity
                                                        : v.viscosity;
  v.energy_scale = list.temporary("energy scale");
  v.closure = list.temporary("closure of the new state", 3);
  return v;
}

void declare_remap(TaskList& list, const SchemeOptions& o, Variables& v) {
  v.common.momentum_remap = v.common.momentum_new;
  v.mass_remap = v.mass_new;
  v.volume_remap = v.volume_new;
  v.energy_remap = v.energy_new;
  if (o.materials.mixed == nullptr) return;
  v.alike = list.temporary("the same fraction around");
  v.common.momentum_remap = list.temporary("momentum after the remap", o.grid.components);
  for (std::size_t m = 0; m < v.mass.size(); ++m) {
    const std::string of = " after the remap, material " + std::to_string(m);
    v.mass_remap[m] = list.temporary("mass" + of);
    v.volume_remap[m] = list.temporary("volume" + of);
    v.energy_remap[m] = list.temporary("energy" + of);
  }
}

}  // namespace

bool relaxes_before_remap(const SchemeOptions& o) {
  return o.scheme.implicit && !o.grid.solids && !o.grid.has_cut_cells &&
         !o.materials.multi_velocity && o.materials.mixed == nullptr;
}

bool all_ideal_gases(const std::vector<Fluid>& fluids) {
  return std::all_of(fluids.begin(), fluids.end(),
                     [](const Fluid& fluid) { return fluid.gamma_law() != nullptr; });
}

Variables declare_variables(TaskList& list, const SchemeOptions& o) {
  const Labels& l = labels();
  const int M = static_cast<int>(o.materials.fluids.size());
  Variables v;
  v.common = declare_common(list, o);
  for (int m = 0; m < M; ++m) {
    v.mass.push_back(list.old_state(l.mass, m, 1));
    v.volume.push_back(list.old_state(l.volume, m, 1));
    v.energy.push_back(list.old_state(l.energy, m, 1));
    v.mass_new.push_back(list.new_state(l.mass, m, 1));
    v.volume_new.push_back(list.new_state(l.volume, m, 1));
    v.energy_new.push_back(list.new_state(l.energy, m, 1));
  }
  v.presence = list.temporary("presence", 2);
  v.pure = list.temporary("pure neighbourhood", 2);
  v.near = list.temporary("near several materials", 2);
  v.blend = list.temporary("blend of materials", 2);
  v.blend_density = list.temporary("density of each material of a blend", M);
  v.blend_energy = list.temporary("energy per volume of each material of a blend", M);
  v.density = list.temporary("density of each material", M);
  v.specific_energy = list.temporary("energy per volume of each material", M);
  v.stretch = list.temporary("J, main outlet", 2);
  if (relaxes_before_remap(o)) v.strain = list.temporary("strain of each material", 2 * M);
  v.energy_L = list.temporary("Lagrangian energy of each material", M);
  v.specific_energy_L = list.temporary("Lagrangian energy per volume of each material", M);
  v.energy_scale = all_ideal_gases(o.materials.fluids)
                       ? v.specific_energy_L
                       : list.temporary("energy scale of each material", M);
  for (int a = 0; a < o.grid.axes.count; ++a) {
    const std::string axis = " of axis " + std::to_string(a);
    v.base[a] = list.temporary("remap base of each material" + axis, 3 * M);
    v.flux[a] = list.temporary("flux of each material" + axis, 3 * M, o.grid.axes.direction[a]);
  }
  if (o.transport.conducting) {
    v.temperature = list.temporary("temperature of each material", M);
    v.heat_capacity = list.temporary("heat capacity of each material", M);
    for (int a = 0; a < o.grid.axes.count; ++a)
      v.heat_flux[a] = list.temporary("heat through contacts of axis " + std::to_string(a), 2 * M,
                                      o.grid.axes.direction[a]);
  }
  if (o.materials.multi_velocity_exchange)
    v.surface = list.temporary("surface", SurfaceParts::count(o.grid.axes.count));
  if (o.transport.viscous && o.own_viscosity_varies())
    v.own_viscosity = list.temporary("viscosity of each material", M);
  if (o.transport.viscous || o.transport.conducting)
    v.heat = list.temporary("heat of each material", M);
  v.common.pure = v.pure;
  declare_remap(list, o, v);
  v.common.material_flux = v.flux;
  v.end = list.temporary("density and modulus of the new mixture", 2);
  v.end_remap = o.materials.mixed == nullptr ? v.end : list.temporary("density after the remap", 2);
  return v;
}

StateReads read_state(TaskBuilder& task, const MaterialStates& v) {
  StateReads r;
  for (std::size_t m = 0; m < v.mass.size(); ++m) {
    r.mass.push_back(task.read(v.mass[m]));
    r.volume.push_back(task.read(v.volume[m]));
    r.energy.push_back(task.read(v.energy[m]));
  }
  return r;
}

void StateReads::divide(const Row& row, int m, double* density, double* energy_density) const {
  const double* __restrict M = row(mass[m]);
  const double* __restrict V = row(volume[m]);
  const double* __restrict E = row(energy[m]);
  double* __restrict r = density;
  double* __restrict e = energy_density;
  for (int i = 0; i < row.count(); ++i) {
    const double inverse = 1.0 / V[i];
    r[i] = M[i] * inverse;
    e[i] = E[i] * inverse;
  }
}

}  // namespace sluice::ice::mixture
