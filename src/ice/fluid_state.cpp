#include "ice/fluid_state.hpp"

#include <algorithm>

#include "framework/solve/linear_solver.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/internal_energy_form/variables.hpp"
#include "ice/start/initialise.hpp"

namespace sluice::ice {

// One material: mass, momentum, energy. Several: mass of each, one momentum, energy and volume of
// each.
std::vector<SlotInfo> FluidState::slots() const {
  // LODI and slip each look one cell aside from the ghosts that they fill: slip into cells, LODI
  // into ghosts of slip and of LODI in other directions, and again where those meet. The dynamic
  // model filters twice. Materials with velocities of their own: what flows out of a donor follows
  // from faces of its neighbours, and interfaces are looked for around cells.
  const int waves = part_->boundary(0).wave_directions();
  const int aside = waves + std::max(waves - 1, 0) + (part_->scene().conditions.slip ? 1 : 0);
  // Their friction follows what the dynamic model has filtered.
  const bool filtered = part_->scene().turbulence && part_->scene().turbulence->dynamic;
  const int around = part_->options().materials.multi_velocity ? (filtered ? 3 : 2)
                     : filtered                                ? 2
                                                               : 0;
  // Slopes of the semi-implicit step reach one cell further, and so do parabolas where scalars ask
  // for the Lagrangian phase of cells beside the box.
  const MethodOptions& scheme = part_->options().scheme;
  const bool far =
      scheme.implicit || (scheme.third_order && !part_->scene().models.scalars.empty());
  const int own = scheme.internal_energy_form ? internal_energy_form::ghost_layers(part_->options())
                  : far                       ? 4
                                              : 3;
  // What cells without fluid close to is known of their neighbours' neighbours, and of several
  // fluids what they pass on is what the neighbours give.
  const int closing = part_->scene().solids == 0 ? 0 : part_->material_count() == 1 ? 1 : 2;
  const int ghosts = own + aside + around + closing;
  std::vector<SlotInfo> slots;
  const auto of_each = [&](Label label) {
    for (int m = 0; m < part_->material_count(); ++m)
      slots.push_back({label, part_->options().place(m), 1, ghosts});
  };
  of_each(labels().mass);
  slots.push_back(
      {labels().momentum, part_->options().place(0), part_->options().grid.components, ghosts});
  of_each(labels().energy);
  if (part_->material_count() > 1) of_each(labels().volume);
  if (part_->options().materials.multi_velocity)
    for (int m = 0; m < part_->material_count(); ++m)
      slots.push_back(
          {labels().slip, part_->options().place(m), part_->options().grid.components, ghosts});
  for (const models::TransportedScalar& s : part_->scene().models.scalars)
    slots.push_back({s.state(), part_->options().place(s.material), 1, ghosts});
  if (part_->options().scheme.implicit)
    slots.push_back({labels().pressure_offset, part_->options().place(0), 1, ghosts});
  if (part_->scene().solids > 0)
    slots.push_back({labels().solid_fraction, part_->options().place(0), 1, ghosts});
  return slots;
}

std::vector<std::vector<Label>> FluidState::checkpoint_labels() const {
  std::vector<Label> momentum, slip;
  for (int c = 0; c < part_->options().grid.components; ++c) {
    const int d = part_->options().grid.direction[c];
    momentum.push_back(labels().momentum_component[d]);
    slip.push_back(labels().slip_component[d]);
  }
  std::vector<std::vector<Label>> names;
  for (const SlotInfo& slot : slots())
    names.push_back(slot.label == labels().momentum ? momentum
                    : slot.label == labels().slip   ? slip
                                                    : std::vector{slot.label});
  return names;
}

void FluidState::initialise(Warehouse& state) const {
  ice::initialise(state, part_->run_scene(), part_->scene(), part_->options());
  if (part_->scene().solids > 0) {
    const int fraction = state.find(labels().solid_fraction, part_->options().place(0));
    for (int box = 0; box < static_cast<int>(state.local_boxes().size()); ++box)
      fill(state.view(fraction, 0, box), state.view(fraction, 0, box).box, 0.0);
  }
  if (!part_->options().scheme.implicit) return;
  solve::start_library(part_->scene().implicit->linear);  // here, and not in the first step
  // The work pressure begins as that of the state.
  const int offset = state.find(labels().pressure_offset, part_->options().place(0));
  for (int box = 0; box < static_cast<int>(state.local_boxes().size()); ++box) {
    const RealView v = state.view(offset, 0, box);
    fill(v, v.box, 0.0);
  }
}

void FluidState::fill_boundary(Warehouse& state, double time, std::span<const double> sums,
                               const ThreadTeam& team) const {
  part_->boundary(state.level().index).fill(state, team, time, sums);
}

int FluidState::boundary_sums() const {
  return part_->boundary(0).sum_count();
}

void FluidState::add_boundary_sums(const Warehouse& state, std::span<ExactSum> sums) const {
  part_->boundary(0).add_sums(state, sums);
}

std::vector<SlotInfo> FluidState::work_slots() const {
  std::vector<SlotInfo> slots = part_->wall_slots();
  if (!part_->options().scheme.implicit) return slots;
  slots.insert(slots.end(), {{labels().pressure_increment, part_->options().place(0), 1, 0},
                             {labels().pressure_correction, part_->options().place(0), 1, 0}});
  if (part_->run_scene().grid.levels.size() == 1) return slots;
  slots.push_back({labels().interface_pressure, part_->options().place(0), 1, 0});
  for (int a = 0; a < part_->options().grid.axes.count; ++a) {
    const int d = part_->options().grid.axes.direction[a];
    for (const Label label : {labels().finer_face_velocity[d], labels().finer_face_pressure[d]})
      slots.push_back({label, part_->options().place(0), 1, 0});
  }
  return slots;
}

void FluidState::fill_work_boundary(Warehouse& state, Label label, const ThreadTeam& team) const {
  // Faces that a finer level gives lie inside the domain.
  if (label == labels().pressure_increment)
    part_->boundary(state.level().index)
        .fill_increment(state, state.find(label, part_->options().place(0)), team);
}

}  // namespace sluice::ice
