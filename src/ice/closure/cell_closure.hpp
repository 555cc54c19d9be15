// How a cell of several materials ends its step: one pressure (equilibrate.hpp), bubbles that
// closed as warm as the liquid (collapse.hpp), heat between the materials (heat_exchange.hpp), and
// one pressure again.
#pragma once
#include "ice/closure/collapse.hpp"
#include "ice/closure/equilibrate.hpp"
#include "ice/closure/heat_exchange.hpp"

namespace sluice::ice::mixture {

class CellClosure {
 public:
  CellClosure(const std::vector<Fluid>& fluids, const PairCoefficients& heat,
              const std::optional<MultiVelocityExchange>& slip)
      : equilibration_(fluids), collapse_(fluids), heat_(fluids, heat, slip) {}

  // The law of a gas in the next cell, where it is another in every cell.
  void set_law(int m, const Fluid& fluid) {
    equilibration_.set_law(m, fluid);
    collapse_.set_law(m, fluid);
    heat_.set_law(m, fluid);
  }

  bool exchanges_heat() const { return heat_.on(); }
  // Of mass `density` per volume (kg/m^3), after a step of dt (s).
  Equilibration::Result close(const Equilibration::Cell& cell, double density, double dt,
                              const HeatExchange::Surface& surface) const;

 private:
  Equilibration equilibration_;
  Collapse collapse_;
  HeatExchange heat_;
};

}  // namespace sluice::ice::mixture
