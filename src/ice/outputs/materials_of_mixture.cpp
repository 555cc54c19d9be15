#include "ice/outputs/materials_of_mixture.hpp"

#include "ice/closure/drag.hpp"
#include "ice/step/effect_ids.hpp"
#include "ice/step/laws_of_cells.hpp"
#include "ice/step/material_runs.hpp"

namespace sluice::ice::mixture {
namespace {

std::string material_label(const char* what, int m) {
  return std::string(what) + " of material " + std::to_string(m);
}

// Energy after the Lagrangian phase; where the material is alone the mixture's.
VariableId declare_energy(TaskList& list, const MaterialsInput& v, int m) {
  const std::string name = material_label("energy after the Lagrangian phase", m);
  const VariableId energy = list.temporary(name);
  TaskBuilder task = list.task(name, effect_saved_intermediates);
  const In pure = task.read(v.pure), own = task.read(v.energy_L), alone = task.read(v.energy_star);
  const Out out = task.write(energy);
  task.kernel([=](const Row& row) {
    pick_row(row.count(), row(pure), m, row(own, m), row(alone), row(out));
  });
  return energy;
}

// Of the volume that passes a face, l u_f (its own u_f where it has one), the share of the
// material. Nothing passes: mean of the two cells.
VariableId declare_passing(TaskList& list, const MaterialsInput& v, const SchemeOptions& o, int m,
                           int axis) {
  const int d = o.grid.axes.direction[axis];
  const std::string name =
      material_label("share of what passes", m) + ", axis " + std::to_string(axis);
  const VariableId share = list.temporary(name, 1, d);
  TaskBuilder task = list.task(name, effect_saved_intermediates);
  const In pure = task.read(v.pure, Stencil::along(d, 1, 0));
  const In volume = task.read(v.state.volume[m], Stencil::along(d, 1, 0));
  const In flux = task.read(v.flux[axis]);
  const In velocity =
      task.read(o.materials.multi_velocity ? v.own_face_velocity[axis] : v.face_velocity[axis]);
  const int own = o.materials.multi_velocity ? m : 0;
  const Out out = task.write(share);
  task.kernel([=](const Row& row) {
    const double l = row.step().dt / row.step().spacing[d];
    const auto run = [&](int first, int count, double alone) {
      for (int i = first; i < first + count; ++i) {
        if (alone >= 0.0) {
          row(out)[i] = alone == m ? 1.0 : 0.0;
          continue;
        }
        const double all = l * row(velocity, own)[i];
        row(out)[i] = all != 0.0 ? row(flux, component(m, of_volume))[i] / all
                                 : 0.5 * (row(volume, 0, axis, -1)[i] + row(volume)[i]);
      }
    };
    for_each_face_run(runs_of(row, pure, axis, -1), runs_of(row, pure), row.count(), run);
  });
  return share;
}

// Momentum by which friction pushes the material apart from the others.
VariableId declare_friction(TaskList& list, const MaterialsInput& v, const SchemeOptions& o,
                            int m) {
  const std::string name = material_label("friction against the others", m);
  const VariableId friction = list.temporary(name, o.grid.components);
  TaskBuilder task = list.task(name, effect_saved_intermediates);
  const FrictionOnSlip pull = read_friction(task, v.stress, o);
  RelativeVelocityReads state;
  read_slip(task, v.relative, o, state);
  const Out out = task.write(friction);
  task.kernel([=, components = o.grid.components](const Row& row) {
    const double *mass[max_materials], *volume[max_materials];
    const int materials = static_cast<int>(state.mass.size());
    for (std::size_t k = 0; k < state.mass.size(); ++k) {
      mass[k] = row(state.mass[k]);
      volume[k] = row(state.volume[k]);
    }
    for (int i = 0; i < row.count(); ++i) {
      for (int c = 0; c < components; ++c) row(out, c)[i] = 0.0;
      if (is_single(row(state.presence)[i])) continue;
      DragCell cell;
      find_present(materials, mass, volume, i, cell);
      for (int c = 0; c < components; ++c) {
        double push[max_materials] = {};
        pull.add(row, cell, c, i, push);
        for (int k = 0; k < cell.count; ++k)
          if (cell.index[k] == m) row(out, c)[i] = push[k];
      }
    }
  });
  return friction;
}

}  // namespace

MaterialsInput MaterialsInput::of(const Variables& v) {
  return {.state = MaterialStates::of(v),
          .next = {v.mass_new, v.volume_new, v.energy_new},
          .density_new = v.end,
          .energy_L = v.energy_L,
          .energy_star = v.common.energy_star,
          .pure = v.pure,
          .flux = v.flux,
          .face_velocity = v.common.face_velocity,
          .relative = RelativeStateInput::of(v),
          .slip_new = v.slip.slip_new,
          .velocity_L = v.slip.velocity_L,
          .own_face_velocity = v.slip.face_velocity,
          .stress = v.slip.stress};
}

MaterialsOfStep materials_of_step(TaskList& list, const MaterialsInput& v, const SchemeOptions& o) {
  MaterialsOfStep materials;
  materials.density_new = v.density_new;
  for (int m = 0; m < static_cast<int>(o.materials.fluids.size()); ++m) {
    MaterialOfStep one{m,
                       o.materials.fluids[m],
                       v.state.mass[m],
                       v.state.volume[m],
                       v.state.energy[m],
                       v.next.mass[m],
                       v.next.volume[m],
                       v.next.energy[m],
                       declare_energy(list, v, m),
                       {},
                       {}};
    for (int axis = 0; axis < o.grid.axes.count; ++axis)
      one.passing[axis] = declare_passing(list, v, o, m, axis);
    if (o.materials.multi_velocity) {
      one.motion =
          OwnMotion{v.relative.slip[m], v.slip_new[m], v.velocity_L, m * o.grid.components, {}};
      if (o.transport.viscous) one.motion->friction = declare_friction(list, v, o, m);
    }
    materials.each.push_back(std::move(one));
  }
  if (o.materials.mixed != nullptr) {
    materials.f = old_fraction(list, o);
    materials.f_new = new_fraction(list, o);
  }
  return materials;
}

}  // namespace sluice::ice::mixture
