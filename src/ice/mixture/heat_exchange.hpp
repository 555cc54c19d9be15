// Heat between the materials of a cell: dE_m/dt = sum_n H_mn V_m V_n (T_n - T_m).
#pragma once
#include <vector>

#include "ice/exchange_settings.hpp"
#include "ice/mixture/equilibrate.hpp"

namespace sluice::ice::mixture {

class HeatExchange {
 public:
  // H in W/(m^3 K); without any coefficient above zero it does nothing.
  HeatExchange(const std::vector<Fluid>& fluids, const PairCoefficients& H);

  bool on() const { return on_; }
  // Over a step of dt at fixed volumes; energies sum to what they were. True: something passed.
  bool exchange(const Equilibration::Cell& cell, double dt) const;

 private:
  std::vector<Fluid> fluids_;
  std::vector<bool> constant_heat_;
  PairCoefficients H_;
  bool on_ = false;
};

}  // namespace sluice::ice::mixture
