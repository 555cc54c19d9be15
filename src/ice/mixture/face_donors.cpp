// Looking up the rows of each material.
#include "ice/mixture/face_donors.hpp"
#include "ice/step/material_runs.hpp"

#include <algorithm>

#include "ice/step/laws_of_cells.hpp"

namespace sluice::ice::mixture {

MaterialHandles read_materials(TaskBuilder& task, const DonorsInput& v, const SchemeOptions& o,
                               int axis) {
  const int direction = o.grid.axes.direction[axis];
  const Stencil both = Stencil::along(direction, 1, 0), four = Stencil::along(direction, 2, 1);
  const Stencil six = Stencil::along(direction, 3, 2);
  MaterialHandles h;
  for (const VariableId id : v.state.mass) h.mass.push_back(task.read(id, four));
  for (const VariableId id : v.state.energy) h.energy.push_back(task.read(id, four));
  for (const VariableId id : v.state.volume) h.volume.push_back(task.read(id, six));
  h.presence = task.read(v.presence, six);
  h.pure = task.read(v.pure, both);
  h.energy_L = task.read(v.energy_L, both);
  h.specific_energy_L = task.read(v.specific_energy_L, both);
  h.scale = task.read(v.energy_scale, both);
  h.stretch = task.read(v.stretch, both);
  if (relaxes_before_remap(o)) h.strain = task.read(v.strain, both);
  if (o.scheme.second_order && o.grid.axes.count > 1) h.base = task.read(v.base[axis], both);
  if (o.materials.mixed != nullptr && o.scheme.second_order) h.alike = task.read(v.alike, both);
  return h;
}

void read_blends(TaskBuilder& task, const BlendInput& v, int axis, const SchemeOptions& o,
                 MaterialHandles& h) {
  if (!o.scheme.second_order) return;
  const int direction = o.grid.axes.direction[axis];
  h.blend = task.read(v.blend, Stencil::along(direction, 3, 2));
  h.blend_density = task.read(v.blend_density, Stencil::along(direction, 2, 1));
  h.blend_energy = task.read(v.blend_energy, Stencil::along(direction, 2, 1));
}

MaterialFaces::MaterialFaces(const Row& row, const RemapFluxHandles& common,
                             const MaterialHandles& materials, Out flux,
                             const SchemeOptions& options, int axis, double l)
    : row_(row),
      h_(materials),
      options_(options),
      flux_(flux),
      axis_(axis),
      materials_(static_cast<int>(materials.volume.size())),
      based_(options.scheme.second_order && options.grid.axes.count > 1),
      l_(l),
      uf_(row(common.face_velocity)) {
  const auto cells = [&](In in, int c = 0) { return pair_of(row, in, c, axis); };
  iJ_ = cells(common.inverse_J);
  N_ = cells(common.courant);
  iN_ = cells(common.inverse_courant);
  J_ = cells(materials.stretch, 0);
  outlet_ = cells(materials.stretch, 1);
  if (options.scheme.masked) mask_ = cells(common.mask);
  for (int s = 0; s < 6; ++s) {
    presence_[s] = row(materials.presence, 0, axis, s - 3);
    if (options.scheme.second_order) blend_[s] = runs_of(row, materials.blend, axis, s - 3);
  }
}

void MaterialFaces::bind(int m) {
  if ((bound_ >> m & 1) != 0) return;
  bound_ |= std::uint64_t{1} << m;
  MaterialFaceRows& k = rows_[m];
  for (int s = 0; s < 6; ++s) k.V[s] = row_(h_.volume[m], 0, axis_, s - 3);
  for (int s = 0; s < 4; ++s) {
    k.M[s] = row_(h_.mass[m], 0, axis_, s - 2);
    k.E[s] = row_(h_.energy[m], 0, axis_, s - 2);
  }
  const auto look_up = [&](const double** to, In in, int c) {
    for (int s = 0; s < 2; ++s) to[s] = row_(in, c, axis_, s - 1);
  };
  if (options_.scheme.second_order) {
    k.r = around(row_, h_.blend_density, m, axis_);
    k.e = around(row_, h_.blend_energy, m, axis_);
  }
  look_up(k.energy_L, h_.energy_L, m);
  look_up(k.eps_L, h_.specific_energy_L, m);
  look_up(k.scale, h_.scale, m);
  k.strain[0] = k.strain[1] = k.iJ[0] = k.iJ[1] = nullptr;
  if (relaxes_before_remap(options_)) {
    look_up(k.strain, h_.strain, m);
    look_up(k.iJ, h_.strain, materials_ + m);
  }
  k.alike[0] = k.alike[1] = nullptr;
  if (is_mixed(options_, m) && options_.scheme.second_order) look_up(k.alike, h_.alike, 0);
  if (based_) {
    look_up(k.base_V, h_.base, component(m, of_volume));
    look_up(k.base_r, h_.base, component(m, of_mass));
    look_up(k.base_e, h_.base, component(m, of_energy));
  }
  k.FV = row_(flux_, component(m, of_volume));
  k.FM = row_(flux_, component(m, of_mass));
  k.FE = row_(flux_, component(m, of_energy));
}

// In the six cells around any of the faces.
std::uint64_t MaterialFaces::materials_around(int first, int count) const {
  std::uint64_t set = 0;
  for (const double* presence : presence_) {
    const double* here = presence + first;
    for (int i = 0; i < count; ++i) set |= as_set(here[i]);
  }
  return set;
}

// The materials of the six cells around all of the faces, if they are blends of the same; else 0.
std::uint64_t MaterialFaces::blend_around(int first, int count) const {
  return options_.scheme.second_order ? as_set(key_of_all(blend_, 6, first, count)) : 0;
}

void MaterialFaces::nothing_passes(int m, int first, int count) const {
  const MaterialFaceRows& k = rows_[m];
  for (double* flux : {k.FV, k.FM, k.FE}) std::fill_n(flux + first, count, 0.0);
}

}  // namespace sluice::ice::mixture
