// What a cell holds of an exact solution: the counterpart of a cell's value in a scheme of finite
// volumes. A value at the centre, in its place, is off by half of a jump that the cell holds.
//
// From the means over the cell of density, momentum and energy, <rho>, <m>, <E>, with
// E = rho e + m^2/(2 rho):
//   rho_CC = <rho>, sp_vol_CC = 1/<rho>, vel_CC = <m>/<rho>, and with e = <E> - <m>^2/(2 <rho>)
//   press_CC = e / <1/(gamma - 1)>, temp_CC = e / (<rho> c_v).
// Solutions of several materials do not tell their laws: press_CC is the mean of the pressure
// there, temp_CC the mean by mass; vol_frac_CC is the share of the cell.
#pragma once
#include <array>
#include <string>

#include "exact/base/exact_solution.hpp"

namespace sluice::exact {

// One value per cell, in SI units.
struct CellVariable {
  std::string name = "rho_CC";
  int component = 0;         // of vel_CC
  int material = 0;          // of vol_frac_CC
  double specific_heat = 1;  // of temp_CC, J/(kg K)
};

class CellMean {
 public:
  // InputError for a variable without exact value. Keeps a reference to the solution.
  CellMean(const ExactSolution& solution, double time, const CellVariable& variable);

  // Over the box from `low` to `high`, along those `directions` in which the solution varies (at
  // its middle along the others); within about `tolerance`, in the unit of the variable.
  double over(Vec3 low, Vec3 high, std::array<bool, 3> directions, double tolerance) const;
  // At one point.
  double at(Vec3 x) const;

 private:
  enum class Kind { density, specific_volume, velocity, pressure, temperature, fraction };
  // Density, momentum, energy, 1/(gamma - 1), pressure, density times temperature, one of the
  // material.
  using Amounts = std::array<double, 9>;
  struct Cell;

  static Kind kind_of(const std::string& name);
  Amounts amounts(Vec3 x) const;
  double value(const Amounts& mean) const;
  Amounts slopes(const Amounts& mean) const;
  Amounts along(const Cell& cell, std::size_t number, Vec3 x, double tolerance) const;

  const ExactSolution& solution_;
  double time_;
  CellVariable variable_;
  Kind kind_;
  bool several_;  // materials
};

}  // namespace sluice::exact
