// The variables of one step of the conservative scheme.
//
// Axes are the active directions in order; component c < axes of momentum and velocity is along
// axis c, further components are carried passively.
#pragma once
#include <array>
#include <vector>

#include "framework/task/task.hpp"
#include "ice/step/scheme_options.hpp"

namespace sluice::ice {

// Where solids cut cells (cut_cells/scalars.cpp): 1 in those; weight of slopes there, of all axes
// and of each; the open share of faces.
struct ScalarWalls {
  bool has_cut_cells = false;
  VariableId cut, slopes;
  std::array<VariableId, 3> axis_slopes, open_share;
};

// Scalars that a graph carries; see scalars/variables.hpp.
struct ScalarVariables {
  struct Each {
    int index = 0;  // among the scalars of the scene
    VariableId old, now, mass, mass_new;
    VariableId volume;           // of the material; in a mixture
    VariableId density;          // beside solids: `mass` per volume of fluid
    VariableId after_reactions;  // of a species that reacts: the new state; `now` is before that
    int carrier = 0;             // component of `carrier`
  };
  std::vector<Each> each;
  std::vector<int> materials;         // of the components of `carrier`
  VariableId fraction;                // of a mixed gas: the new f
  VariableId released, released_new;  // what it had released before this step's end, and after it
  bool diffusive = false;
  VariableId diffusivity;  // of each species that spreads, in cells
  VariableId base, half;
  // By axis: mass that passes; value of each scalar on the face, and what of it spreads.
  std::array<VariableId, 3> carrier, face, spread;
  ScalarWalls walls;
};

// Of a semi-implicit step: pressure/variables.hpp.
struct PressureVariables {
  VariableId offset, offset_new;                             // state: X - p
  VariableId increment;                                      // d = X - X-, solved for
  VariableId work, smooth;                                   // X-; the pressure whose slopes count
  VariableId force;                                          // viscous, by axis
  std::array<VariableId, 3> prediction;                      // by axis: u*, j, k
  VariableId interface;                                      // X- in ghosts beside a coarser level
  VariableId error;                                          // R
  std::array<VariableId, 3> finer_velocity, finer_pressure;  // by axis: finer_faces.hpp
};

// The new state as outputs see it: of the fluid itself, where solids cut cells.
struct AfterVariables {
  VariableId rho, momentum, energy;
};

// Where solids stand in the fluid: cut_cells/variables.hpp.
struct WallVariables {
  VariableId fraction, fraction_new;  // state: theta
  // Given, of this step: theta' at its end, p_w, and by axis a, its mean A, the swept volume C (of
  // a cell), the velocity of the solid at the face.
  VariableId next, pressure;
  std::array<VariableId, 3> covered, mean_covered, swept, solid_velocity;
  // 1 where slopes along an axis count (by component); of faces that meet fluid alone u_f and p_f;
  // correction of what flows out of cells without fluid; velocity of the volume that passes.
  VariableId open, outflow;
  std::array<VariableId, 3> fluid_velocity, fluid_pressure, raw_flow, flow;
  std::array<VariableId, 3> whole_stress, whole_heat_flux;
  // Amounts of the cell: M, P; 1/M; of donors: velocity, weight of slopes along each axis.
  VariableId mass, momentum, inverse_mass, donor_velocity, base_mask;
  std::array<VariableId, 3> remap_mask;
  VariableId gives_old;  // 1 where donors give their old state: step/walled_donors.hpp
  AfterVariables after;  // of one material
};

// How the volume of cells moves: as the mixture does, unless each material has its own velocity
// (multi_velocity/tasks.hpp). Faces and their pressures follow from it.
struct VolumeMotionVariables {
  VariableId rho, inverse_rho, velocity, sound;
};

struct SchemeVariables {
  // State: mass, momentum and internal energy per volume.
  VariableId rho, momentum, energy, mask;        // old
  VariableId rho_new, momentum_new, energy_new;  // new
  // What the remap leaves: the new state, but where mixing then releases heat.
  VariableId rho_remap, momentum_remap, energy_remap;
  // Primitives of the old state.
  VariableId velocity, pressure, sound, inverse_rho;
  VolumeMotionVariables moving;
  AfterVariables after;
  // Slopes along each axis of the normal velocity and the pressure; predicted pressure; transverse
  // advection of the normal velocity.
  VariableId velocity_slope, pressure_slope, predicted_pressure, transverse_velocity;
  std::array<VariableId, 3> face_velocity, face_pressure;  // by axis
  std::array<VariableId, 3> stress;                        // viscous, by axis: force per area
  std::array<VariableId, 3> heat_flux;                     // by axis, W/m^2
  // Where strong shocks are, and what faces along them exchange: shock_shear.hpp.
  VariableId jumps, jump_marks, shear, shear_marks;
  VariableId temperature;                          // of the old state; conduction only
  VariableId viscosity, conductivity;              // of cells, where they vary
  VariableId molecular_viscosity, eddy_viscosity;  // their parts with turbulence
  VariableId front_viscosity;  // of a mixture: as if no material's varied, see face_mean.hpp
  VariableId heat_capacity;    // cv of the new state, likewise
  // Lagrangian phase: 1/J, density, energy per volume, velocity, E*, outflow Courant number and
  // the inverse of its bounded value, momentum source (what p and the forces took).
  VariableId inverse_J, rho_L, energy_L, velocity_L, energy_star, courant, inverse_courant;
  VariableId impulse;
  // Of a mixture: shock slope and minus the lowest pressure of each cell; work, friction.
  VariableId shock_slope, pi, lagrangian_mixture, new_pressure;
  VariableId pure;                 // see mixture/variables.hpp
  VariableId energy_scale;         // (p + pi)/G of the Lagrangian state; not for ideal gases
  VariableId closure;              // pressure, modulus, admissibility of the new state; likewise
  VariableId source_change;        // what sources add, see sources/sources.hpp
  VariableId pressure_change;      // of the classic form; elsewhere that of the whole step
  std::array<VariableId, 3> base;  // by axis: rho, energy, velocity (2-D and 3-D)
  // Of the third order, by axis: the states at the edges of cells; parabolas/tasks.hpp.
  std::array<VariableId, 3> traced;
  std::array<VariableId, 3> flux;  // by axis: mass F, energy G, velocity U
  // Of a mixture, by axis: what passes of each material, see mixture/variables.hpp.
  std::array<VariableId, 3> material_flux;
  std::array<VariableId, 3> material_velocity;  // with which it passes, if each has its own
  ScalarVariables scalars;
  PressureVariables solve;
  WallVariables walls;
};

// What the remap takes of the donor cells: all of it from the Lagrangian phase.
struct DonorVariables {
  VariableId inverse_J, rho_L, energy_L, velocity_L, courant, inverse_courant, energy_scale;

  static DonorVariables of(const SchemeVariables& v) {
    return {.inverse_J = v.inverse_J,
            .rho_L = v.rho_L,
            .energy_L = v.energy_L,
            .velocity_L = v.velocity_L,
            .courant = v.courant,
            .inverse_courant = v.inverse_courant,
            .energy_scale = v.energy_scale};
  }
};

// The state and what both schemes compute of it: primitives, faces, stress, fluxes, impulse, E*.
SchemeVariables declare_common_variables(TaskList&, const SchemeOptions&);
// Temporaries of either scheme, and of the conservative scheme alone: what does not depend on how
// many materials there are.
void declare_step_temporaries(TaskList&, const SchemeOptions&, SchemeVariables&);
void declare_conservative_temporaries(TaskList&, const SchemeOptions&, SchemeVariables&);
// All that one material needs in the conservative scheme.
SchemeVariables declare_conservative_variables(TaskList&, const SchemeOptions&);

// What the reductions of a step hold.
struct StepSlots {
  static constexpr int deck_rate = 0;       // max of sum or max of (|u| + knob c)/dx: 1/s
  static constexpr int flow_rate = 1;       // max of sum |u|/dx
  static constexpr int sound_rate = 2;      // max of (|u| + c)/dx and .8 of its sum
  static constexpr int diffusion_rate = 3;  // max of 2 D sum 1/dx^2, D = mu/rho or k/(rho cv)
  static constexpr int maxima = 4;
  static constexpr int volume_error = 4;  // semi-implicit steps: max |R|
  static constexpr int maxima_with_solve = 5;
  // Exact sums: what came in through the boundary in this step.
  static constexpr int mass = 0;
  static constexpr int momentum = 1;  // three
  static constexpr int energy = 4;
  static constexpr int pressure_impulse = 5;  // three: the part of momentum that is no advection
  static constexpr int sums = 8;
  // With several levels under gravity, and with a driving force, also their impulse (three) and
  // their work.
  static constexpr int gravity_impulse = 8;
  static constexpr int gravity_work = 11;
  static constexpr int sums_with_gravity = 12;
  // The masses of materials 1, 2, ... come after these; `base` is one of the two counts.
  static constexpr int mass_of(int material, int base) {
    return material == 0 ? mass : base + material - 1;
  }
};

enum FaultKind {
  fault_density = 0,
  fault_energy = 1,
  fault_volume = 2,
  fault_outflow = 3,
  fault_reactions = 4,
  fault_of_material = 16  // times the material + 1
};

// Calls f.operator()<D, C>() for D active axes and C momentum components.
template <class F>
auto dispatch(int axes, int components, F&& f) {
  switch (axes * 10 + components) {
    case 11:
      return f.template operator()<1, 1>();
    case 12:
      return f.template operator()<1, 2>();
    case 13:
      return f.template operator()<1, 3>();
    case 22:
      return f.template operator()<2, 2>();
    case 23:
      return f.template operator()<2, 3>();
    default:
      return f.template operator()<3, 3>();
  }
}

}  // namespace sluice::ice
