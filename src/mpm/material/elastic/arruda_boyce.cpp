// ArrudaBoyce8: rubber of chains that lock (Arruda and Boyce 1993), by five terms of the inverse
// Langevin function.
//
//   W = K/2 [(J^2 - 1)/2 - ln J] + mu sum C_i/beta^(2 i - 2) (I^i - 3^i),   I = tr b_bar
//   C = 1/2, 1/20, 11/1050, 19/7000, 519/673750;   b_bar = J^(-2/3) F F^T
//   sigma = K/2 (J - 1/J) I + (2 W'/J) dev b_bar,   W' = dW/dI
// beta is the stretch where a chain locks. <shear_modulus> is that of the body at rest,
//   G = 2 W'(3)
//     = mu (1 + 3/(5 beta^2) + 99/(175 beta^4) + 513/(875 beta^6) + 42039/(67375 beta^8)),
// so that Young's modulus and Poisson's ratio give it as for any other solid; mu is the n k T of
// the chains.
#include <cmath>

#include "mpm/material/base/batch_math.hpp"
#include "mpm/material/base/material_model.hpp"

namespace sluice::mpm {
namespace {

class EightChains final : public Material {
 public:
  EightChains(double bulk, double shear, double locking, double density)
      : bulk_(bulk), shear_(shear), density_(density) {
    constexpr double series[terms] = {1.0 / 2, 1.0 / 20, 11.0 / 1050, 19.0 / 7000, 519.0 / 673750};
    double at_rest = 0, power = 1, of_3 = 1;
    for (int k = 0; k < terms; ++k) {
      a_[k] = series[k] * power;
      at_rest += 2 * (k + 1) * a_[k] * of_3;
      power /= locking * locking;
      of_3 *= 3;
    }
    for (double& a : a_) a *= shear / at_rest;
  }

  void start(const Batch& batch) const override { evaluate(batch); }
  std::optional<BatchFault> update(const Batch& batch) const override {
    evaluate(batch);
    return fault_of_volume(batch);
  }
  double bulk_modulus() const override { return bulk_; }
  double shear_modulus() const override { return shear_; }
  bool stress_of_state() const override { return true; }

 private:
  static constexpr int terms = 5;

  void evaluate(const Batch& batch) const {
    const Nine<const double> F_columns = batch.F;
    const Six<double> stress = batch.stress;
    const double* volume_0 = batch.volume_0;
    double *energy = batch.energy, *wave_speed = batch.wave_speed;
    const double K = bulk_, per_density = 1 / density_;
    const double a1 = a_[0], a2 = a_[1], a3 = a_[2], a4 = a_[3], a5 = a_[4];
#pragma GCC ivdep
    for (int i = 0; i < batch.count; ++i) {
      const std::array<double, 9> F = at(F_columns, i);
      const double J = determinant(F), root = inverse_cube_root(J), root_2 = root * root;
      const std::array<double, 6> b = left_cauchy_green(F);
      const double mean = (b[0] + b[1] + b[2]) * (1.0 / 3), I = 3 * root_2 * mean;
      const double W1 = a1 + I * (2 * a2 + I * (3 * a3 + I * (4 * a4 + I * (5 * a5))));
      const double W11 = 2 * a2 + I * (6 * a3 + I * (12 * a4 + I * (20 * a5)));
      // (I^k - 3^k)/(I - 3), term by term
      const double q2 = I + 3, q3 = I * q2 + 9, q4 = I * q3 + 27, q5 = I * q4 + 81;
      const double shape = (I - 3) * (a1 + a2 * q2 + a3 * q3 + a4 * q4 + a5 * q5);
      const double pressure = 0.5 * K * (J - 1 / J), per_J = 2 * W1 * root_2 / J;
      stress[0][i] = pressure + per_J * (b[0] - mean);
      stress[1][i] = pressure + per_J * (b[1] - mean);
      stress[2][i] = pressure + per_J * (b[2] - mean);
      stress[3][i] = per_J * b[3];
      stress[4][i] = per_J * b[4];
      stress[5][i] = per_J * b[5];
      energy[i] = volume_0[i] * (0.5 * K * volume_logs(J).energy + shape);
      // As comp_neo_hook with G = 2 W', and 4 W'' (n dev b_bar n)^2 of chains that lock.
      const double reach = root_2 * eigenvalue_reach(b, mean);
      const double modulus = 0.5 * K * (J * J + 1) + 2 * W1 * (4.0 / 3 * root_2 * mean + reach) +
                             4 * W11 * reach * reach;
      wave_speed[i] = std::sqrt(modulus * per_density);
    }
  }

  double bulk_, shear_, density_;
  double a_[terms];  // mu C_i/beta^(2 i - 2), Pa
};

}  // namespace

MaterialModel ArrudaBoyce8_model() {
  return {"ArrudaBoyce8",
          {},
          "rubber of chains that lock (eight chains of Arruda and Boyce)",
          {positive("bulk_modulus", "K, Pa"),
           positive("shear_modulus", "G of the undeformed body, Pa; mu of the chains is less"),
           tag("beta", "stretch where the chains lock").once().real().above(1)},
          [](const Parameters& p) -> std::shared_ptr<const Material> {
            return std::make_shared<EightChains>(p.real("bulk_modulus"), p.real("shear_modulus"),
                                                 p.real("beta"), p.constants().density);
          }};
}

}  // namespace sluice::mpm
