// Solids in the cells of the fluid: what the sweep is told of them, and what it makes of that.
//
// A solid takes the part theta of a cell, V = 1 - theta is left to the fluid. The state stays that
// of the fluid itself, per volume of fluid: boundaries, laws and outputs see it as elsewhere. A
// cell without fluid ("dry", V = 0) holds the state of its neighbours, with no weight. Of a face,
// 1 - a is open. All of it is given, at the start and the end of the step and in its mean; see
// docs/theory/mpmice_coupling.md for the step in full.
//
// The step of a cell that a solid meets ends with amounts per volume of the cell (M' = rho V, ...),
// which may be negative where V' is small: who couples the two mends that, and divides by V'.
#pragma once
#include <string>

#include "ice/one_material/tasks.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice::cut_cells {

void declare_variables(TaskList&, const SchemeOptions&, SchemeVariables&);
// What the tasks of scalars (scalars/) take of solids; once scalars are declared.
void declare_scalar_walls(TaskList&, const SchemeOptions&, SchemeVariables&);

// Tasks of the step, in order, in place of those of the same name; each in the file of its name.
struct AperturesInput {
  VariableId mask, fraction;
  std::array<VariableId, 3> covered;
  VariableId open;  // written

  static AperturesInput of(const SchemeVariables&);
};
void add_apertures(TaskList&, const AperturesInput&, const SchemeOptions&, int effect);

struct OpenFacesInput {
  VariableId fraction, next, wall_pressure;
  std::array<VariableId, 3> mean_covered, swept, solid_velocity;
  std::array<VariableId, 3> fluid_velocity, fluid_pressure;  // of faces between fluid alone
  std::array<VariableId, 3> face_velocity, face_pressure;    // written
  std::array<VariableId, 3> raw_flow, flow;                  // written
  VariableId outflow;                                        // written

  static OpenFacesInput of(const SchemeVariables&);
};
void add_open_faces(TaskList&, const OpenFacesInput&, const SchemeOptions&, int effect);

// What passes faces between cells of fluid, from whole faces to their open share.
struct OpenShareInput {
  VariableId fraction;
  std::array<VariableId, 3> covered, whole;
  std::array<VariableId, 3> open;  // written
};
void add_open_share(TaskList&, const OpenShareInput&, const SchemeOptions&, int axis,
                    int components, const std::string& task, int effect);
// Of the mixture.
struct SharesInput {
  OpenShareInput stress, heat_flux;
};
void add_shares(TaskList&, const SharesInput&, const SchemeOptions&, int effect);

// Amounts of a cell, and what it gives to the remap.
struct CellVariables {
  VariableId mass, momentum, inverse_mass, donor_velocity, base_mask, gives_old;
  std::array<VariableId, 3> remap_mask;
};
struct LagrangianInput {
  VariableId momentum;
  ice::LagrangianInput fluid;
  VariableId fraction, next, wall_pressure, open;
  std::array<VariableId, 3> flow, covered;
  CellVariables cell;  // written

  static LagrangianInput of(const SchemeVariables&);
};
void add_lagrangian(TaskList&, const LagrangianInput&, const SchemeOptions&, int effect);

struct UpdateInput {
  ice::UpdateInput amounts;  // of the cell
  VariableId velocity_L, fraction, next, rho, momentum, energy;
  VariableId fraction_new, rho_new, momentum_new, energy_new;  // written

  static UpdateInput of(const SchemeVariables&);
};
void add_update(TaskList&, const UpdateInput&, const SchemeOptions&, int effect);

struct ScalarWallsInput {
  ScalarVariables scalars;
  VariableId fraction, next, open;
  std::array<VariableId, 3> covered;

  static ScalarWallsInput of(const SchemeVariables&);
};
void add_scalar_walls(TaskList&, const ScalarWallsInput&, const SchemeOptions&, int effect);

// threshold: share of a cell up to which a volume of fluid is none: the round-off of overlaps;
//   unit: 1; test: none
inline constexpr double min_fluid_volume = 1e-10;

}  // namespace sluice::ice::cut_cells
