// A gas whose properties follow from a scalar, in the graph of a step: where its fraction stands.
#pragma once
#include <vector>

#include "ice/fluid/mixed_gas.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

// Whether material m of a graph is such a gas.
inline bool is_mixed(const SchemeOptions& o, std::size_t m) {
  return is_mixed(o.mixed, m);
}

// The law of each material in a cell, that of a mixed gas by its fraction.
struct LawsOfCells {
  std::vector<Fluid> fluids;
  const models::MixedGas* gas = nullptr;
  In fraction;  // with a mixed gas only

  // `room` holds a law that is made for the cell.
  const Fluid& at(const Row& row, std::size_t m, int i, Fluid& room) const {
    if (!is_mixed(gas, m)) return fluids[m];
    return room = fluid_of(*gas, row(fraction)[i]);
  }
};

// The scalar f among those of the scene, and its old state.
const models::TransportedScalar& fraction_of(const SchemeOptions& o);
VariableId old_fraction(TaskList& list, const SchemeOptions& o);

}  // namespace sluice::ice
