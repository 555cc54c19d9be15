// Several fluids in cells that solids cut. What is done to the mixture is done in the files of
// cut_cells/ as for one fluid; the fluids share it so (V fluid's volume in the cell, V_m shares of
// it, sum 1; W the pressures' work on the mixture, V_L its volume after the Lagrangian
// phase):
//
//   E_mL = V E_m - V_m p (V_L - V) - (W - p (V_L - V)) M_m/rho
//   a touched donor gives volume by its shares, each fluid at its mean density and energy:
//   FV_m = H V_m,  FM_m = FV_m M_m V/(V_m V_L),  FE_m = FV_m E_mL/(V_m V_L),  U = its velocity
//   M_m' = V M_m + sum FM,  V_m' = V_m V_L + sum FV,  E_m' = E_mL + sum FE     per cell volume
//
// A cell without fluid gives the mixture that it takes in: of any other it would give what it does
// not have. One that gives its old state (step/walled_donors.hpp) keeps V_m V in place of V_m V_L,
// which may be anything then. What the kinetic energy leaves is told apart, until the cell is
// settled. All other cells take the rules of mixture/, to the bit.
//
// Fluids with one velocity each share one in cut cells (multi_velocity/tasks.hpp). What was their
// slip before a solid touched the cell is heat of E_mL, by mass. Donors that none touches give each
// fluid with its own velocity U_m; their neighbour takes what they pass with U = sum FM U_m/sum FM,
// and FM |U_m - U|^2/2 of each as heat.
#pragma once
#include "ice/cut_cells/variables.hpp"
#include "ice/mixture/variables.hpp"

namespace sluice::ice::cut_cells {

struct MaterialVariables {
  VariableId energy_L;   // E_mL of touched cells, by material
  VariableId volume_L;   // V_L
  VariableId passed_on;  // of cells without fluid, by material: what they give per volume
  std::array<VariableId, 3> whole_flux;  // of the mixture and of each material, as the rules of
  std::array<VariableId, 3> full_face_material_flux;  // whole cells have them
  // Of what conducts: heat through contacts of whole faces.
  std::array<VariableId, 3> full_face_material_heat;
  // Of what moves apart: the velocity of each that passes whole faces.
  std::array<VariableId, 3> full_face_velocity;
};

MaterialVariables declare_materials(TaskList&, const SchemeOptions&, mixture::Variables&);
// Which cells solids touch.
struct WhichCutInput {
  VariableId fraction, next;
  VariableId cut;  // written

  static WhichCutInput of(const mixture::Variables& v) {
    return {.fraction = v.common.walls.fraction, .next = v.common.walls.next, .cut = v.cut};
  }
};
void add_cut_cells(TaskList&, const WhichCutInput&, const SchemeOptions&, int effect);
// Of what moves apart: friction of each, on the open share of faces.
void add_open_stresses(TaskList&, const OpenShareInput&, const SchemeOptions&, int effect);
// Of what conducts: heat through contacts, on the open share of faces.
void add_open_heats(TaskList&, const OpenShareInput&, const SchemeOptions&, int effect);
// E_mL, V_L of touched cells.
struct MaterialSharesInput {
  mixture::MaterialStates state;
  std::vector<VariableId> slip;
  VariableId fraction, next, pressure, inverse_rho, energy_star, energy;
  std::array<VariableId, 3> flow;
  VariableId volume_L, energy_L;  // written

  static MaterialSharesInput of(const mixture::Variables&, const MaterialVariables&);
};
void add_material_shares(TaskList&, const MaterialSharesInput&, const SchemeOptions&, int effect);
// Fluxes of faces at touched cells.
struct WholeFluxes {  // as the rules of whole cells have them: of the mixture, and of each material
  std::array<VariableId, 3> flux, of_each, velocity;
};
struct CutFluxInput {
  mixture::MaterialStates state;
  VariableId cut, fraction, inverse_J, pure, donor_velocity, energy_L, gives_old;
  std::array<VariableId, 3> flow;
  WholeFluxes whole;

  VariableId passed_on;                                             // written
  std::array<VariableId, 3> flux, flux_of_each, material_velocity;  // written

  static CutFluxInput of(const mixture::Variables&, const MaterialVariables&);
};
void add_fluxes_of_cut_cells(TaskList&, const CutFluxInput&, const SchemeOptions&, int effect);
// Of several materials.
struct OfEachInput {
  MaterialSharesInput shares;
  CutFluxInput fluxes;

  static OfEachInput of(const mixture::Variables& v, const MaterialVariables& x) {
    return {.shares = MaterialSharesInput::of(v, x), .fluxes = CutFluxInput::of(v, x)};
  }
};

// As mixture/ has it, of the remap along an axis: what a whole cell gives.
RemapFluxInput full_cell_remap(const SchemeVariables&, int axis);

}  // namespace sluice::ice::cut_cells
