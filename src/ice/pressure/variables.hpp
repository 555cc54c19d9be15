// The semi-implicit step: one pressure X in the middle of the step, solved for, in place of that of
// the Riemann problems at the faces. docs/theory/ice_pressure.md.
//
//   X   work pressure: pressure at t + dt/2 at the cell's centre. X- is that of the step before;
//       the state keeps Y = X - p, so that X- = p + Y, and ghost cells follow from those of p
//   d   = X - X-, what is solved for: a work slot, kept unrounded within the step
//   u_f = u* - dt/(rho_f dx) [ (X-_b - X-_a)/2 + A (d_b - d_a) ]
//   p_f = (rho_b X_a + rho_a X_b)/(rho_a + rho_b) + j + k
//   R   = { (1 - g1)(p - X-) + al [dp - 2 sum_d h_d u_d sp_d] - d } / (al rho c^2)
// R is the relative error of the volume of a cell. dp is the rise of its pressure in the step: in
// the first pass -rho c^2 sum_d l_d (u_f+ - u_f-), afterwards that of the Lagrangian phase. One
// pass solves
//   e/(al rho c^2) - sum over faces of  A dt^2/(rho_f dx^2) (e_neighbour - e) = R,   d <- d + e.
// What the solve leaves changes no balance: the faces' velocities and pressures are single-valued,
// and all after them is the explicit scheme.
#pragma once
#include "ice/step/variables.hpp"

namespace sluice::ice::pressure {

// r = dt_before/dt; the first step has none. g1 damps what X- and p disagree about, s1 the waves
// that no step resolves; both cost phase error of second order (measured: .177 (w dt)^2).
// Factors without unit.
struct SolveConstants {
  double old_share;  // 1 - g1 (of this step)
  double al, A;      // (1 + g1 r)/2, 1/2 + s
};
inline SolveConstants solve_constants(const StepConstants& step) {
  // coefficient: damping of the difference between X- and p; unit: 1
  constexpr double g1 = 0.15;
  // coefficient: damping of waves that no step resolves; unit: 1
  constexpr double s1 = 0.1;
  // threshold: growth dt_before/dt beyond which X- says little about this step; unit: 1; test:
  //   ImplicitPulse.NeverGrowsWhenStepsChange
  constexpr double max_growth = 4.0;
  const double r = step.dt_before / step.dt;
  const double g = r > max_growth ? 0.0 : g1;
  return {1.0 - g, 0.5 * (1.0 + g * r), 0.5 + s1 * (r < 1.0 ? r : 1.0)};
}

// Components of the prediction of a face.
enum Prediction { star_velocity = 0, jump_pressure, slope_pressure, prediction_count };

// Declares what the tasks of this folder share, and the state.
void declare_variables(TaskList&, const SchemeOptions&, SchemeVariables&);

// What the error of a cell's volume follows from, and what is solved for.
struct ErrorInput {
  VolumeMotionVariables moving;
  VariableId pressure, pressure_slope;
  PressureVariables solve;

  static ErrorInput of(const SchemeVariables& v) {
    return {.moving = v.moving,
            .pressure = v.pressure,
            .pressure_slope = v.pressure_slope,
            .solve = v.solve};
  }
};

// Tasks of the step, in order, in place of slopes and faces; each in the file of its name.
struct SolvedFacesInput {
  ErrorInput cells;            // pressure_slope: written
  VariableId mask, open;       // where slopes count: of a redo, beside solids
  VariableId shock_slope, pi;  // of a mixture
  std::array<VariableId, 3> stress;
  VariableId velocity_slope, transverse_velocity;          // written
  std::array<VariableId, 3> face_velocity, face_pressure;  // written

  static SolvedFacesInput of(const SchemeVariables& v) {
    return {.cells = ErrorInput::of(v),
            .mask = v.mask,
            .open = v.walls.open,
            .shock_slope = v.shock_slope,
            .pi = v.pi,
            .stress = v.stress,
            .velocity_slope = v.velocity_slope,
            .transverse_velocity = v.transverse_velocity,
            .face_velocity = v.face_velocity,
            .face_pressure = v.face_pressure};
  }
};
void add_work_pressure(TaskList&, const ErrorInput&, const SchemeOptions&, int effect);
void add_smooth_slopes(TaskList&, const SolvedFacesInput&, const SchemeOptions&, int effect);
void add_viscous_force(TaskList&, const SolvedFacesInput&, const SchemeOptions&, int effect);
void add_predictions(TaskList&, const SolvedFacesInput&, const SchemeOptions&, int effect);
void add_solved_face_states(TaskList&, const SolvedFacesInput&, const SchemeOptions&, int effect);
// What multiplies differences of d across the faces of an axis in the volume that a cell loses.
void add_face_coefficient(TaskList&, const ErrorInput&, const SchemeOptions&, int axis,
                          VariableId to_write, int effect);
// All of these, but for coefficients beside solids.
void add_solved_faces(TaskList&, const SolvedFacesInput&, const SchemeOptions&, int effect);

// After the Lagrangian phase: R by the law, its maximum; X - p of the new state. `p_L`: pressure of
// the state after it; `p_new`: of the new state.
void add_volume_error(TaskList&, const ErrorInput&, const SchemeOptions&, VariableId p_L,
                      int effect);
void add_offset(TaskList&, const PressureVariables&, VariableId p_new, int effect);

// Both, of one material, whose pressures they find.
struct EndOfOneInput {
  ErrorInput error;
  VariableId rho_L, energy_L;
  AfterVariables after;

  static EndOfOneInput of(const SchemeVariables& v) {
    return {.error = ErrorInput::of(v), .rho_L = v.rho_L, .energy_L = v.energy_L, .after = v.after};
  }
};
void add_end_of_one(TaskList&, const EndOfOneInput&, const SchemeOptions&, int effect);

// Beside solids: the system, of faces as far as they are open and cells as far as fluid fills them;
// the volume error; the end of the step of one material.
struct CutCellErrorInput {
  ErrorInput error;
  VariableId fraction, next, gives_old;
  std::array<VariableId, 3> mean_covered, flow;
  VariableId inverse_J;

  static CutCellErrorInput of(const SchemeVariables& v) {
    return {.error = ErrorInput::of(v),
            .fraction = v.walls.fraction,
            .next = v.walls.next,
            .gives_old = v.walls.gives_old,
            .mean_covered = v.walls.mean_covered,
            .flow = v.walls.flow,
            .inverse_J = v.inverse_J};
  }
};
void add_cut_cell_system(TaskList&, const CutCellErrorInput&, const SchemeOptions&, int effect);
void add_cut_cell_error(TaskList&, const CutCellErrorInput&, const SchemeOptions&, VariableId p_L,
                        int effect);
void add_cut_cell_end_of_step(TaskList&, const CutCellErrorInput&, const EndOfOneInput&,
                              const SchemeOptions&, int effect);

}  // namespace sluice::ice::pressure
