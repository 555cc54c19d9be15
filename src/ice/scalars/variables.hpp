// The variables with which a step carries scalars, and its tasks.
//
// A scalar goes with the mass of its material: through a face passes F q_f, F the mass that the
// remap has found. In the graph of one material only its own scalars are carried; in that of
// several, F of each material that has any is put together first.
#pragma once
#include <span>

#include "ice/step/variables.hpp"
#include "models/scalars/transported_scalar.hpp"

namespace sluice::ice::mixture {
struct Variables;
}

namespace sluice::ice::scalars {

// Components of `base` of each scalar: lowest and highest value around, then what the cell offers
// along each axis.
enum Base { lowest = 0, highest = 1, offered = 2 };

// Declares the variables of the scalars of material `o.materials.index`, or of all in a mixture:
// state, mass and its fluxes are those of `v` (one material) or these of all materials.
struct Masses {
  std::span<const VariableId> old, now, volume;  // no volumes of one material
};
void declare_variables(TaskList& list, const SchemeOptions& o, SchemeVariables& v,
                       const Masses& masses);

// What the tasks of scalars read of the flow, and their own variables.
struct FlowOfScalars {
  VariableId velocity, velocity_slope, rho_L, inverse_J, courant, mask, pure;
  std::array<VariableId, 3> face_velocity, flux, material_flux;
  ScalarVariables scalars;

  static FlowOfScalars of(const SchemeVariables& v) {
    return {.velocity = v.velocity,
            .velocity_slope = v.velocity_slope,
            .rho_L = v.rho_L,
            .inverse_J = v.inverse_J,
            .courant = v.courant,
            .mask = v.mask,
            .pure = v.pure,
            .face_velocity = v.face_velocity,
            .flux = v.flux,
            .material_flux = v.material_flux,
            .scalars = v.scalars};
  }
};

// How the materials that carry scalars move, where each has a velocity of its own: face velocity
// and outflow by carrier, velocity of cells of all materials, in the places of the mixture's.
struct OwnMotionInput {
  VariableId velocity, outflow;  // of each material
  std::array<VariableId, 3> face_velocity;
};
FlowOfScalars add_own_motion(TaskList&, const FlowOfScalars& of_mixture, const OwnMotionInput&,
                             const SchemeOptions&, int effect);

// Tasks of the step, in order; each in the file of its name. None without scalars.
void add_carriers(TaskList&, const FlowOfScalars&, const SchemeOptions&, int effect);
void add_bases(TaskList&, const FlowOfScalars&, const SchemeOptions&, int effect);
void add_fluxes(TaskList&, const FlowOfScalars&, const SchemeOptions&, int effect);
void add_update(TaskList&, const FlowOfScalars&, const SchemeOptions&, int effect);

// All of them.
inline void add_tasks(TaskList& list, const FlowOfScalars& v, const SchemeOptions& o, int effect) {
  if (v.scalars.each.empty()) return;
  add_carriers(list, v, o, effect);
  add_bases(list, v, o, effect);
  add_fluxes(list, v, o, effect);
  scalars::add_update(list, v, o, effect);
}

// 2 D sum 1/dx^2, 1/s, of the most diffusive scalar of the scene, with a margin: a cell between two
// heavier ones, through whose faces twice as much spreads, bears the step too.
double diffusion_rate(const SchemeOptions& o, Vec3 spacing);
double diffusion_rate_of(double D, const SchemeOptions& o, Vec3 spacing);  // D: m^2/s

}  // namespace sluice::ice::scalars
