// What friction and conduction allow a step, from a state of several materials.
//
// max of 2 D sum 1/dx^2, D = mu/rho with mu = sum V_m mu_m, and k_m/(rho_m cv_m), with velocities
// of their own mu_m/rho_m, of each material that fills more than a hundredth of the cell and weighs
// more than a billionth: those with less take the heat (contacts.hpp) and the push
// (multi_velocity/stress.cpp) that they can bear. A function of the state of a cell alone, with
// coefficients that vary beside it.
#pragma once
#include <vector>

#include "ice/step/material_runs.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice::mixture {

// State of a row of cells, by material, per volume of the cell: kg/m^3, fraction, J/m^3.
struct MaterialRows {
  const double *mass[max_materials], *volume[max_materials], *energy[max_materials];
  // Where they vary: of the mixture (Pa s), and of each material that it holds (W/(m K)).
  const double *viscosity = nullptr, *conductivity[max_materials] = {};
};

class DiffusionRates {
 public:
  explicit DiffusionRates(const SchemeOptions& o);

  bool on() const { return viscous_ || conducting_; }
  bool viscosity_varies() const { return viscosity_varies_; }
  bool conductivity_varies() const { return conductivity_varies_; }
  // Of n cells, 1/s; spacing in m.
  double largest(const MaterialRows& state, int n, const Vec3& spacing) const;

 private:
  std::vector<Fluid> fluids_;
  std::vector<double> viscosities_, conductivities_;
  Axes axes_;
  bool multi_velocity_;
  bool viscous_, conducting_, viscosity_varies_, conductivity_varies_;
};

}  // namespace sluice::ice::mixture
