// What the fluid has in the cells near solids, behind the sweep.
#pragma once
#include <vector>

#include "mpmice/fields/cell_masks.hpp"

namespace sluice::mpmice {

// What the fluid has in cells near solids, per volume of the cell; and the volume left to it.
template <int D>
struct CellAmounts {
  Column volume;  // left to the fluids
  // By fluid: mass, volume, internal energy; all of it but `kinetic`, which holds the kinetic
  // energy and what remapping momentum left to heat, and for one fluid alone its whole energy.
  std::vector<Column> mass, filled, energy;
  Column kinetic;
  std::vector<Column> momentum;     // by component
  std::vector<Column> scalar;       // of each scalar: its value times its carrier's mass
  KeptArray<std::uint8_t> near;     // 1: a cell near solids, whose amounts are here
  KeptArray<std::uint8_t> touched;  // 1: they become its state anew
  // 1: what is left there is no state; it is shared through covered faces too.
  KeptArray<std::uint8_t> inadmissible;

  double mass_of_all(std::size_t i) const {
    double sum = 0;
    for (const Column& m : mass) sum += m[i];
    return sum;
  }
  // P^2/2M; 0 without mass.
  double moving(std::size_t i) const {
    double sum = 0;
    for (const Column& m : momentum) sum += m[i] * m[i];
    const double M = mass_of_all(i);
    return M != 0 ? 0.5 * sum / M : 0.0;
  }
  // Act on every column of amounts.
  template <class F>
  void for_each_amount(F&& act) {
    for (auto* columns : {&mass, &filled, &energy, &momentum, &scalar})
      for (Column& column : *columns) act(column);
    act(kinetic);
  }
};

}  // namespace sluice::mpmice
