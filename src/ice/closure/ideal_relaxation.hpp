// One pressure for ideal gases, over rows of cells: the closed form of equilibrate.hpp.
//
//   q = sum g_m E_m/(1 - sum g_m V_m),   V_m' = g_m (E_m/q + V_m),   g = (gamma - 1)/gamma
// Cells that are at one pressure already are left alone, and the largest gas takes the rest of
// volume and energy, as there.
#pragma once
#include <vector>

#include "ice/fluid/fluid.hpp"
#include "ice/fluid/material_set.hpp"

namespace sluice::ice::mixture {

// Rows of one material, per volume of the cell (kg/m^3, fraction, J/m^3); absent means that all
// three are zero.
struct GasRows {
  const double* M;
  double *V, *E;
};

class IdealRelaxation {
 public:
  static constexpr int max_cells = 64;

  explicit IdealRelaxation(const std::vector<Fluid>& fluids);
  // All materials are ideal gases.
  bool applies() const { return applies_; }
  // Pressure and modulus (rho c^2) of `n` cells, Pa. False, and nothing changed, where a gas of one
  // of them has no state.
  bool relax(int n, const GasRows* gases, double* pressure, double* modulus) const;

 private:
  struct Sums;
  struct Gas {
    double G, share;  // gamma - 1, (gamma - 1)/gamma
  };

  // The steps, in order; `First`: of the first gas.
  template <bool First>
  bool add(int k, int n, const GasRows& gas, Sums& s) const;
  static bool find_pressures(int n, Sums& s, double* pressure, double* modulus);
  template <bool First>
  void compare(int k, int n, const GasRows& gas, Sums& s, const double* pressure) const;
  static void choose(int n, const Sums& s, double* pressure, double* modulus);
  template <bool First>
  void expand(int k, int n, const GasRows& gas, Sums& s, const double* pressure,
              const double* inverse) const;
  template <bool First>
  void give_rest(int k, int n, const GasRows& gas, Sums& s) const;

  bool applies_ = false;
  std::vector<Gas> gases_;
};

}  // namespace sluice::ice::mixture
