// Gas of a cavity that closes within a step.
//
// Relaxation with the final pressure lets the liquid do the work q dV on the gas: right for a gas
// that fills its part of a cell, but where a trace of gas is a cavity, the whole energy of the
// closing would go into that trace (1e9 K of 1e-6 of a cell, measured). Such a bubble is small, and
// as warm as the liquid around it: it takes the temperature of the heaviest material, its volume at
// the pressure found, and the rest of its energy and volume goes to the heaviest. Sums are kept.
#pragma once
#include <vector>

#include "ice/closure/equilibrate.hpp"

namespace sluice::ice::mixture {

class Collapse {
 public:
  explicit Collapse(const std::vector<Fluid>& fluids);
  void set_law(int m, const Fluid& fluid);

  // Are there gases and liquids.
  bool possible() const { return possible_; }
  // Before the relaxation of a cell of this density (kg/m^3): the gases with so little mass.
  std::uint64_t traces_of_gas(const Equilibration::Cell& cell, double density) const;
  // The pressures of the traces, in their places: by material, Pa.
  void remember(const Equilibration::Cell& cell, std::uint64_t traces, double* before) const;
  // After it: `before` is the pressure of each gas as it was, q the pressure found (Pa). True:
  // something passed, and one pressure is to be found again.
  bool settle(const Equilibration::Cell& cell, std::uint64_t traces, const double* before,
              double q) const;

 private:
  std::vector<Fluid> fluids_;
  std::vector<double> G_;  // gamma - 1 of the gases, else 0
  bool possible_ = false;
};

}  // namespace sluice::ice::mixture
