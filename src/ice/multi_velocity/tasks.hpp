// Materials with velocities of their own: what the step of a mixture does more, task by task.
//
// State: of each material its momentum relative to the mixture, S_m = M_m (u_m - u), beside the one
// momentum of all; zero where a material is alone or absent. The mixture moves as before, but for
// what follows:
//   1. volume moves with sum V_m u_m, not with u, and is as inert as the materials together can be:
//      1/rho_e = 1/rho + sum V_m r_m, r_m what a unit of pressure force gives to u_m - u while drag
//      acts. Faces know that velocity and that density: l u_f is the volume that passes. Between
//      free materials sound travels at a speed between theirs, under strong drag at Wood's
//   2. Lagrangian phase: half a step of drag, then what the pressure (and a driving force) gives,
//      dm_m = -V_m dp less the share by mass, under drag throughout
//   3. each face has a velocity for each material, u_fm = c + r_m: r_m the mean by mass of what
//      both cells have above the mean by volume, c such that what the materials carry with the
//      volumes of their own donors is what passes, sum H_m = l u_f
//   4. the remap takes each material from its own donor, with its own velocity
//   5. the rest of the drag after the remap; the kinetic energy that drag and remap take becomes
//      heat, by mass.
// Cells that solids touch have one velocity: across a wall all fluids have the wall's. Whatever
// enters them moves with it from then on, and the kinetic energy of its slip becomes heat.
// Drag: M_m du_m/dt = sum_n K_mn V_m V_n (u_n - u_m). Over a step: two materials by the exponential
// itself, more by an L-stable method of second order (pair_relaxation.hpp); both limits exact.
#pragma once
#include "ice/mixture/tasks.hpp"
#include "ice/step/material_runs.hpp"

namespace sluice::ice::mixture {

void declare_relative_velocities(TaskList& list, const SchemeOptions& o, Variables& v);

// What moves against the mixture.
struct RelativeStateInput {
  MaterialStates state;
  std::vector<VariableId> slip;
  VariableId presence, cut;

  static RelativeStateInput of(const Variables&);
};
// What binds the materials of a cell.
struct BondsInput {
  VariableId lock, surface;
};

// Velocities of each material, and how the volume moves (1).
struct SlipMotionInput {
  RelativeStateInput state;
  BondsInput bonds;  // lock: written
  VariableId pure, rho, inverse_rho, velocity, sound;
  VariableId own_velocity;       // written
  VolumeMotionVariables moving;  // written

  static SlipMotionInput of(const Variables&);
};
void add_slip_motion(TaskList&, const SlipMotionInput&, const SchemeOptions&, int effect);

// Friction of each material on itself joins that of the mixture; where gas touches a surface it
// slips.
struct SlipStressInput {
  MaterialStates state;
  VariableId pure, own_velocity, velocity, viscosity, own_viscosity, surface;
  std::array<VariableId, 3> stress;  // of the mixture

  static SlipStressInput of(const Variables&);
};
struct SlipStress {
  std::array<VariableId, 3> total, each;
};
// Viscous materials only.
SlipStress add_slip_stress(TaskList&, const SlipStressInput&, const SchemeOptions&, int effect);

// Drag and pressure over the Lagrangian phase (2).
struct SlipPhaseInput {
  RelativeStateInput state;
  BondsInput bonds;
  VariableId lagrangian_mixture, velocity, sound;
  std::array<VariableId, 3> face_pressure, stress;
  VariableId velocity_L, drift, kick, work, force_work;  // written

  static SlipPhaseInput of(const Variables&);
};
void add_slip_phase(TaskList&, const SlipPhaseInput&, const SchemeOptions&, int effect);

// Velocity of each material at the faces, and what flows out of cells (3).
struct SlipFacesInput {
  MaterialStates state;
  VolumeMotionVariables moving;
  VariableId pure, cut, drift, inverse_J, velocity, courant;
  std::array<VariableId, 3> face_velocity;
  std::array<VariableId, 3> own_face_velocity;  // written
  VariableId outflow;                           // written

  static SlipFacesInput of(const Variables&);
};
void add_slip_faces(TaskList&, const SlipFacesInput&, const SchemeOptions&, int effect);

// In place of the tasks of the same name without "slip" (4, 5).
struct SlipBasesInput {
  VariableId pure, own_velocity, velocity, velocity_L, kick, mask;
  std::array<VariableId, 3> mixture_base;
  std::array<VariableId, 3> base;  // written

  static SlipBasesInput of(const Variables&);
};
void add_slip_bases(TaskList&, const SlipBasesInput&, const SchemeOptions&, int effect);

struct SlipFluxInput {
  ice::RemapFluxInput mixture;
  DonorsInput materials;
  VariableId velocity, velocity_L, outflow;
  std::array<VariableId, 3> base, face_velocity;
  std::array<VariableId, 3> flux, material_velocity;  // written

  static SlipFluxInput of(const Variables&);
};
void add_slip_fluxes(TaskList&, const SlipFluxInput&, const SchemeOptions&, int effect);
void add_slip_flux(TaskList&, const SlipFluxInput&, const SchemeOptions&, int effect, int axis);

struct SlipUpdateInput {
  UpdateInput update;
  BondsInput bonds;
  VariableId velocity_L;
  std::array<VariableId, 3> stress, material_velocity, face_pressure;

  static SlipUpdateInput of(const Variables&);
};
void add_slip_update(TaskList&, const SlipUpdateInput&, const SchemeOptions&, int effect);

// Where a task finds what moves against the mixture.
struct RelativeVelocityReads {
  std::vector<In> mass, volume, slip;
  In presence, cut;
  bool has_cut_cells = false;
};
void read_slip(TaskBuilder&, const RelativeStateInput&, const SchemeOptions&,
               RelativeVelocityReads&);

// Parts of a row in which materials move apart: apart(part); where one is alone, or a solid touches
// the cells, all have one velocity: bound(part).
template <class Bound, class Apart>
void for_each_motion(const Row& row, const RelativeVelocityReads& r, Bound&& bound, Apart&& apart) {
  for_each_run(runs_of(row, r.presence), row.count(), [&](int first, int count, double presence) {
    if (is_single(presence)) return bound(row.part(first, count));
    if (!r.has_cut_cells) return apart(row.part(first, count));
    const double* cut = row(r.cut);
    for (int begin = first, end = first; begin < first + count; begin = end) {
      const bool beside = cut[begin] != 0;
      while (end < first + count && (cut[end] != 0) == beside) ++end;
      const Row part = row.part(begin, end - begin);
      beside ? bound(part) : apart(part);
    }
  });
}

struct DragCell;
// What interfaces and surfaces do to drag.
struct Bonds {
  In lock, surface;
  int axes = 1;
  bool slips = false;  // a gas along a surface
  void put(const Row& row, int i, DragCell& cell) const;
};
Bonds read_bonds(TaskBuilder&, const BondsInput&, const SchemeOptions&);

// What friction pushes apart: momentum by material per volume of the cell, kg/(m^2 s); sum 0.
struct FrictionOnSlip {
  bool on = false;
  Axes axes;
  int components = 1;
  std::array<In, 3> stress;
  void add(const Row& row, const DragCell& cell, int c, int i, double* push) const;
};
FrictionOnSlip read_friction(TaskBuilder&, const std::array<VariableId, 3>& stress,
                             const SchemeOptions&);

}  // namespace sluice::ice::mixture
