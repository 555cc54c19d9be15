// What the sources of a step change, as components of one variable.
#pragma once
#include "ice/step/variables.hpp"

namespace sluice::ice {

// Components of what a step's sources change, per volume of the cell: for each material of a graph
// mass, energy, volume and momentum; then what is of the whole cell.
struct SourceChange {
  int components = 1;  // of momentum
  int materials = 1;

  enum OfMaterial { mass = 0, energy, volume, momentum };
  // burned_share and burned_in_step are no amounts: F and its gain.
  enum OfCell {
    total_energy = 0,
    heat,
    exchanged_mass,
    exchanged_energy,
    burned_mass,
    released_heat,
    burned_share,
    burned_in_step,
    of_cell_count
  };
  int of(int material, OfMaterial what) const { return material * (momentum + components) + what; }
  int of(OfCell what) const { return materials * (momentum + components) + what; }
  int count() const { return of(of_cell_count); }
};

// Of a graph.
inline SourceChange source_change(const SchemeOptions& o) {
  SourceChange layout;
  layout.components = o.grid.components;
  layout.materials = o.materials.mixture ? static_cast<int>(o.materials.fluids.size()) : 1;
  return layout;
}

}  // namespace sluice::ice
