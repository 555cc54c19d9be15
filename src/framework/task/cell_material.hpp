// What a cell-centred method sees of any material: cell fields, how it moves, its closure.
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

// One row of cells for a closure. Pointers are to `count` values; none overlap.
struct ClosureRow {
  int count = 0;
  const double* pressure = nullptr;     // Pa
  const double* temperature = nullptr;  // K
  double* density = nullptr;            // true density, kg/m^3
  double* compressibility = nullptr;    // d density / d pressure at constant temperature, s^2/m^2
  double* sound_speed = nullptr;        // m/s
};

class CellMaterial {
 public:
  virtual ~CellMaterial() = default;
  virtual std::string name() const = 0;
  virtual int index() const = 0;
  virtual Movement movement() const = 0;
  virtual CellFields fields() const = 0;
  virtual CellChange change() const { return {}; }  // particle-moved materials have one
  // Density, its derivative and the sound speed at (p, T). Called once a row, from any thread:
  // the model is chosen here, outside the loop over cells.
  virtual void closure(const ClosureRow& row) const = 0;
};

}  // namespace sluice
