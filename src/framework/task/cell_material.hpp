// What a cell-centred method sees of any material: cell fields and how it moves.
//
// A fluid owns its cell fields: the method reads the old ones and writes the new ones. A material
// that is moved by particles fills the same fields by projection at the start of a step; the method
// treats them alike up to the end of the Lagrangian phase and then, in place of the remap, leaves
// in `change` what it did to momentum and energy, for the particles to take over. The method knows
// neither particles nor their constitutive models; the models know nothing of cells' neighbours.
#pragma once
#include <string>

#include "framework/field/label.hpp"

namespace sluice {

enum class Movement {
  advection,  // the cell fields are the state: remapped with the flow
  particles   // the cell fields are a projection of particles: new in every step
};

// Conserved quantities of one material per volume of the cell.
struct CellFields {
  Label mass;      // kg/m^3
  Label momentum;  // kg/(m^2 s)
  Label energy;    // internal, J/m^3
  Label volume;    // share of the cell
};

// What the method did to a particle-moved material in a step, per volume of the cell.
struct CellChange {
  Label impulse;  // kg/(m^2 s)
  Label heat;     // J/m^3
};

// What one part of a component tells the others of a material: plain data, filled in by whoever
// owns the material. Its law stays with whoever closes the cells.
struct CellMaterial {
  std::string name;
  int number = 0;  // of the scene's materials: under it its fields are stored
  Movement movement = Movement::advection;
  CellFields fields;
  CellChange change{};  // of materials that particles move
};

}  // namespace sluice
