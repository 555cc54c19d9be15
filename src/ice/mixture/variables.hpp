// The variables of a step where several materials may meet in a cell, with one common velocity.
//
// Per cell and material m: mass M_m, volume fraction V_m and internal energy E_m, all per volume of
// the cell; one momentum. Absent means all three are zero; a cell with one material has V = 1 to
// the bit. Rules are rules for one cell: a cell whose neighbourhood (one cell all around) holds one
// material alone runs the rows of one_material/, whatever the block or the scene holds elsewhere.
// Scheme: one exchange, Lagrange, sharp remap, pressure relaxation; docs/theory/ice_materials.md.
#pragma once
#include <vector>

#include "ice/step/variables.hpp"

namespace sluice::ice::mixture {

// With one velocity per material (multi_velocity/tasks.hpp). Components of a material m, by
// component c of momentum: m * components + c; by axis: m * axes + axis.
struct RelativeVelocityVariables {
  std::vector<VariableId> slip, slip_new;  // state: S_m = M_m (u_m - u), zero where alone
  VariableId velocity;                     // u_m by component; that of the mixture where absent
  VariableId lock;        // how strongly an interface binds the materials of a cell
  VariableId velocity_L;  // u_m - v by component, after the Lagrangian phase
  VariableId drift;       // by axis: u_m less the mean by volume, in the middle of the step
  VariableId kick;        // by axis: what pressure gave to u_m - u
  VariableId work;        // work defect of the mixture and its change of kinetic energy of slip
  VariableId force_work;  // what a driving force works on the slip
  std::array<VariableId, 3> stress;         // by axis: friction of each material
  std::array<VariableId, 3> face_velocity;  // by axis, of each material
  VariableId outflow;                       // of each material: Courant number, main outlet
  std::array<VariableId, 3> base;           // by axis: velocity of each for the remap
};

struct Variables {
  SchemeVariables common;  // of the mixture: rho, energy, p, faces, Lagrangian phase, total fluxes
  // State, by material.
  std::vector<VariableId> mass, volume, energy, mass_new, volume_new, energy_new;
  // What the remap leaves: the new state, but where the fraction of a mixed gas must be known
  // before one pressure can be found (one_pressure.cpp).
  std::vector<VariableId> mass_remap, volume_remap, energy_remap;
  // Of a mixed gas: 1 where its fraction is the same in all cells around, else 0.
  VariableId alike;
  // Keys of cells; their second component is what is left of the run (runs.hpp).
  VariableId presence;  // bit set of the materials in a cell, as a number
  VariableId pure;      // the material that is alone in a cell and all around it; -1: none
  VariableId near;      // 1 where that is none, and in cells that share a face with such; else 0
  // The set of materials of cells in each of which several fill a fair part (fair_part), and none
  // the whole; 0 elsewhere. There, by material, density and energy per its own volume.
  VariableId blend, blend_density, blend_energy;
  // By material, for outputs: density and energy per its own volume (old; 0 where absent).
  VariableId density, specific_energy;
  // By material, but only in cells that are near: after the Lagrangian phase energy per cell and
  // per own volume (0 where absent), and the energy
  // scale (p + pi)/G, which of an ideal gas is that energy: where all materials are such, the same
  // variable. In cells of pure neighbourhood these are the mixture's, or zero.
  VariableId energy_L, specific_energy_L, energy_scale;
  // In cells that are near: J, and the largest outflow H of a cell through one face: as it is if
  // that is the only outlet, negative if there are several, minus infinity if several are largest.
  VariableId stretch;
  // Of steps with a pressure solve (relaxes_before_remap), in the same cells by material:
  // r_m = V_mL/(V_m J), then 1/(J r_m). Elsewhere all materials are strained alike.
  VariableId strain;
  // By axis, 3 components a material: what volume, density and energy offer to the remap, in the
  // same cells.
  std::array<VariableId, 3> base;
  // By axis, 3 components a material: volume, mass and energy that pass a face, unless both its
  // cells have the same pure neighbourhood.
  std::array<VariableId, 3> flux;
  VariableId own_viscosity;  // molecular, of each material; where it varies, 0 where absent
  // Of the material with a surface (surface.hpp): how much of it a volume holds, 1/m, and its
  // normal, out of the material, by axis.
  VariableId surface;
  // Where materials conduct: temperature and rho_m cv_m of each; by axis and material what the low
  // cell gives and what the high cell takes. What friction and conduction bring each.
  VariableId temperature, heat_capacity, heat;
  std::array<VariableId, 3> heat_flux;
  VariableId end;        // density, modulus of the new mixture
  VariableId end_remap;  // density after the remap
  RelativeVelocityVariables slip;
  // Where solids cut cells (cut_cells/materials.hpp): which cells the rules of full cells leave
  // out, and how.
  VariableId cut, cut_volume, cut_energy, old_momentum;
};

bool all_ideal_gases(const std::vector<Fluid>& fluids);

// Do the materials of a cell find one pressure before the remap, too. In the long steps of a
// pressure solve a cell that holds little gas changes what it holds in one; without, pressures grow
// from step to step.
bool relaxes_before_remap(const SchemeOptions& o);

Variables declare_variables(TaskList& list, const SchemeOptions& o);

// The state of each material.
struct MaterialStates {
  std::vector<VariableId> mass, volume, energy;

  static MaterialStates of(const Variables& v) { return {v.mass, v.volume, v.energy}; }
};

// The old state of each material, at a point.
struct StateReads {
  std::vector<In> mass, volume, energy;

  // True density (kg/m^3) and energy per volume (J/m^3) of material m, which is in all cells of the
  // row.
  void divide(const Row& row, int m, double* density, double* energy_density) const;
};
StateReads read_state(TaskBuilder& task, const MaterialStates& v);

// Component of `lagrangian_mixture`.
constexpr int friction_of_mixture = 1;

// Runs of faces or cells whose neighbours are a blend (VariableId blend) of the same materials are
// spared the rules of fronts and traces; so this is far above all that these call little.
// threshold: volume fraction from which on a material is one of a blend; unit: 1; test:
//   MarksOfRows.SayWhereAMaterialIsAlone
constexpr double fair_part = 1e-8;

// What makes a value per volume of the cell one per volume of the material; 0 where it is absent.
inline double per_own_volume(double V) {
  return V > 0.0 ? 1.0 / V : 0.0;
}

// Component of a quantity of a material in `base` and `flux`.
enum Carried { of_volume = 0, of_mass = 1, of_energy = 2 };
inline int component(int material, Carried q) {
  return 3 * material + q;
}

}  // namespace sluice::ice::mixture
