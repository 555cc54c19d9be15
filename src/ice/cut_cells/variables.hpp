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
#include "ice/step/variables.hpp"

namespace sluice::ice::cut_cells {

// Tasks of the step, in order, in place of those of the same name; each in the file of its name.
void declare_variables(TaskList&, const SchemeOptions&, SchemeVariables&);
void add_apertures(TaskList&, const SchemeVariables&, const SchemeOptions&, int effect);
void add_open_faces(TaskList&, const SchemeVariables& fluid, const SchemeVariables& v,
                    const SchemeOptions&, int effect);
// What passes faces between cells of fluid, from whole faces to their open share.
struct FaceShare {
  VariableId whole, open;
  int components = 1;
};
void add_open_share(TaskList&, const SchemeVariables&, const SchemeOptions&, int axis,
                    const FaceShare& of, const std::string& task, int effect);
void add_shares(TaskList&, const SchemeVariables& whole, const SchemeVariables& v,
                const SchemeOptions&, int effect);
void add_lagrangian(TaskList&, const SchemeVariables&, const SchemeOptions&, int effect);
void add_update(TaskList&, const SchemeVariables&, const SchemeOptions&, int effect);
// What the tasks of scalars (scalars/) take of solids; once scalars are declared.
void declare_scalar_walls(TaskList&, const SchemeOptions&, SchemeVariables&);
void add_scalar_walls(TaskList&, const SchemeVariables&, const SchemeOptions&, int effect);

// Variables as the tasks of the whole cell take them: of the faces of the fluid alone; of the remap
// along an axis.
SchemeVariables fluid_face_variables(const SchemeVariables&);
SchemeVariables remap_variables(const SchemeVariables&, int axis);
SchemeVariables base_variables(const SchemeVariables&);

// threshold: share of a cell up to which a volume of fluid is none: the round-off of overlaps;
//   unit: 1; test: none
inline constexpr double min_fluid_volume = 1e-10;

}  // namespace sluice::ice::cut_cells
