// What tasks of full cells take where solids cut some: other variables under the same names.
#pragma once
#include "ice/budgets/tasks.hpp"
#include "ice/cut_cells/materials.hpp"
#include "ice/multi_velocity/tasks.hpp"
#include "ice/scalars/variables.hpp"

namespace sluice::ice {

// Of whole faces, before their open share is taken.
struct WholeFaceInputs {
  ViscousStressInput stress;
  HeatFluxInput heat;
  mixture::FrictionInput friction;
  mixture::HeatFluxInput heat_of_each;
};

struct CutCellInputs {
  WholeFaceInputs whole;
  // The open share of each: of the mixture, and of several materials.
  cut_cells::SharesInput open;
  cut_cells::OpenShareInput open_stresses, open_heats;
  // Of the volume that passes the open share of faces.
  mixture::MaterialLagrangianInput lagrangian;
  mixture::SlipFacesInput slip_faces;
  scalars::FlowOfScalars scalars;
  BudgetInput budgets;
  // Donors of the remap.
  RemapBasesInput bases;
  mixture::RemapBasesInput bases_of_each;
  mixture::SlipBasesInput slip_bases;
  // Amounts of the cell.
  mixture::UpdateInput update;
  mixture::SlipUpdateInput slip_update;

  static CutCellInputs of(const mixture::Variables& m, const cut_cells::MaterialVariables& x);
};

// Friction of each material on whole faces; the open share of that of the mixture is taken then.
void add_whole_stresses(TaskList& list, const mixture::Variables& m, const SchemeOptions& o,
                        CutCellInputs& s);
// What passes the faces, as between full cells.
void add_whole_fluxes(TaskList& list, const mixture::Variables& m,
                      const cut_cells::MaterialVariables& x, const SchemeOptions& masked);

}  // namespace sluice::ice
