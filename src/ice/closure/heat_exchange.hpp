// Heat between the materials of a cell: dE_m/dt = sum_n H_mn V_m V_n (T_n - T_m).
//
// By the exponential (two materials) or at second order (more). Where that leaves the range of the
// temperatures, or little of one of them (next to nothing beside a liquid), by backward Euler.
#pragma once
#include <vector>

#include "ice/closure/equilibrate.hpp"
#include "ice/deck/exchange_settings.hpp"

namespace sluice::ice::mixture {

class HeatExchange {
 public:
  // H in W/(m^3 K); without any coefficient above zero it does nothing.
  // With slip of a gas along a surface, of which a cell holds what surface.hpp says.
  HeatExchange(const std::vector<Fluid>& fluids, const PairCoefficients& H,
               std::optional<MultiVelocityExchange> slip = {});

  // Of a gas with a constant specific heat.
  void set_law(int m, const Fluid& fluid) { fluids_[m] = fluid; }

  bool on() const { return on_; }
  // Over a step of dt (s) at fixed volumes; energies sum to what they were. True: something passed.
  struct Surface {
    double share = 0, heat = 0;  // of the cell, 0 to 1; what passes, W/(m^3 K)
  };
  bool exchange(const Equilibration::Cell& cell, double dt, const Surface& surface) const;
  bool exchange(const Equilibration::Cell& cell, double dt) const {
    return exchange(cell, dt, Surface{});
  }

 private:
  struct Present {
    int index[max_materials];
    int count = 0;
    double T[max_materials], C[max_materials];  // K, J/(m^3 K)
    double E[max_materials];                    // after it, of take_means
  };
  // What a pair exchanges for a unit of difference, in n x n.
  void couple(const Equilibration::Cell& cell, const Present& in, double dt, const Surface& surface,
              double* k) const;
  void take_means(const Equilibration::Cell& cell, Present& in, double* k, double* gain) const;

  std::vector<Fluid> fluids_;
  std::vector<bool> constant_heat_;
  PairCoefficients H_;
  std::optional<MultiVelocityExchange> slip_;
  bool on_ = false;
};

}  // namespace sluice::ice::mixture
