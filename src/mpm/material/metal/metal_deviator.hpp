// <deviatoric_stress_model> of a metal: how its deviator follows the strain before it yields.
//
//   hypoElastic       S' = 2 mu (D' - D_p)
//   hypoViscoElastic  S = sum S_i,  S_i' = 2 mu_i (D' - D_p) - S_i/tau_i,  sum mu_i = mu
// Maxwell elements side by side, exact for a constant rate in the step (maxwell_step.hpp), so that
// they are stable where dt is far longer than tau_i. All of them flow with the same D_p.
#pragma once
#include <span>
#include <vector>

#include "mpm/material/base/parameters.hpp"
#include "mpm/material/base/tensor.hpp"

namespace sluice::mpm {

class MaxwellElements {
 public:
  MaxwellElements() = default;
  // mu_i/mu, and tau_i in s.
  MaxwellElements(std::vector<double> shares, std::vector<double> times)
      : shares_(std::move(shares)), times_(std::move(times)) {}

  bool none() const { return shares_.empty(); }
  // Of the history: six for each element, in the axes of the body.
  int columns() const { return 6 * static_cast<int>(shares_.size()); }

  // Without plastic flow: the deviator at the end, and mu of a return, S = S_tr - 2 mu strain_p.
  struct Trial {
    Symmetric S{};  // Pa
    double mu = 0;  // Pa
  };
  // `old`: the columns of the elements, Pa; mu: of the metal as it is, Pa; dt: s.
  Trial trial(std::span<const double* const> old, int i, double mu, double dt,
              const Symmetric& strain) const;
  // Writes the elements, `strain` less the plastic one; what they turned into heat, J/m^3.
  double take(std::span<const double* const> old, std::span<double* const> now, int i, double mu,
              double dt, const Symmetric& strain) const;

 private:
  std::vector<double> shares_;  // mu_i/mu
  std::vector<double> times_;   // tau_i, s
};

TagSpec deviator_tag();
// None for hypoElastic. mu: <shear_modulus> of the model, Pa.
MaxwellElements read_deviator(const Parameters& model, double mu);

}  // namespace sluice::mpm
