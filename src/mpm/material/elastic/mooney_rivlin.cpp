// comp_mooney_rivlin: rubber.
//
//   W     = C1 (I1 - 3) + C2 (I2 - 3) + C3 (1/I3^2 - 1) + C4 (I3 - 1)^2
//   C3    = C1/2 + C2,   C4 = [C1 (5 nu - 2) + C2 (11 nu - 5)]/(2 (1 - 2 nu))
//   sigma = (2/J) [(C1 + C2 I1) B - C2 B^2 + (-2 C3/I3^2 + 2 C4 I3 (I3 - 1)) I],   B = F F^T
// At rest G = 2 (C1 + C2) and K = 2 G (1 + nu)/(3 (1 - 2 nu)).
#include <algorithm>
#include <cmath>

#include "mpm/material/base/batch_math.hpp"
#include "mpm/material/base/material_model.hpp"

namespace sluice::mpm {
namespace {

class MooneyRivlin final : public Material {
 public:
  MooneyRivlin(double C1, double C2, double nu, double density)
      : C1_(C1), C2_(C2), C3_(0.5 * C1 + C2), density_(density) {
    C4_ = 0.5 * (C1 * (5 * nu - 2) + C2 * (11 * nu - 5)) / (1 - 2 * nu);
    bulk_ = 4 * (C1 + C2) * (1 + nu) / (3 * (1 - 2 * nu));
  }

  void start(const Batch& batch) const override { evaluate(batch); }
  std::optional<BatchFault> update(const Batch& batch) const override {
    evaluate(batch);
    return fault_of_volume(batch);
  }
  double bulk_modulus() const override { return bulk_; }
  double shear_modulus() const override { return 2 * (C1_ + C2_); }
  bool stress_of_state() const override { return true; }

 private:
  void evaluate(const Batch& batch) const {
    const Nine<const double> F_columns = batch.F;
    const Six<double> stress = batch.stress;
    const double* volume_0 = batch.volume_0;
    double *energy = batch.energy, *wave_speed = batch.wave_speed;
    const double C1 = C1_, C2 = C2_, C3 = C3_, C4 = C4_, per_density = 1 / density_;
#pragma GCC ivdep
    for (int i = 0; i < batch.count; ++i) {
      const std::array<double, 9> F = at(F_columns, i);
      const std::array<double, 6> b = left_cauchy_green(F);
      const std::array<double, 6> b2 = {
          b[0] * b[0] + b[5] * b[5] + b[4] * b[4], b[5] * b[5] + b[1] * b[1] + b[3] * b[3],
          b[4] * b[4] + b[3] * b[3] + b[2] * b[2], b[5] * b[4] + b[1] * b[3] + b[3] * b[2],
          b[0] * b[4] + b[5] * b[3] + b[4] * b[2], b[0] * b[5] + b[5] * b[1] + b[4] * b[3]};
      const double J = determinant(F), I3 = J * J, per_I3_2 = 1 / (I3 * I3);
      const double I1 = b[0] + b[1] + b[2], mean = I1 * (1.0 / 3);
      const double I2 = 0.5 * (I1 * I1 - (b2[0] + b2[1] + b2[2]));
      const double of_b = C1 + C2 * I1;
      const double of_I = -2 * C3 * per_I3_2 + 2 * C4 * I3 * (I3 - 1);
      const double scale = 2 / J;
      stress[0][i] = scale * (of_b * b[0] - C2 * b2[0] + of_I);
      stress[1][i] = scale * (of_b * b[1] - C2 * b2[1] + of_I);
      stress[2][i] = scale * (of_b * b[2] - C2 * b2[2] + of_I);
      stress[3][i] = scale * (of_b * b[3] - C2 * b2[3]);
      stress[4][i] = scale * (of_b * b[4] - C2 * b2[4]);
      stress[5][i] = scale * (of_b * b[5] - C2 * b2[5]);
      const double d = I3 - 1;
      energy[i] = volume_0[i] * (C1 * (I1 - 3) + C2 * (I2 - 3) + C3 * (per_I3_2 - 1) + C4 * d * d);
      // Along a principal direction rho_0 c^2 = b^(1/2) d^2 W/d lambda^2 b^(1/2)
      //   = 2 b [C1 + C2 (I1 - b)] + 20 C3/I3^2 + 4 C4 I3 (3 I3 - 1);   b(I1 - b) grows to I1/2.
      const double b_max = mean + eigenvalue_reach(b, mean), b_half = std::min(b_max, 0.5 * I1);
      const double modulus = 2 * (C1 * b_max + C2 * b_half * (I1 - b_half)) + 20 * C3 * per_I3_2 +
                             4 * C4 * I3 * (3 * I3 - 1);
      wave_speed[i] = std::sqrt(std::max(modulus, 0.0) * per_density);
    }
  }

  double C1_, C2_, C3_, C4_ = 0, bulk_ = 0, density_;
};

}  // namespace

MaterialModel comp_mooney_rivlin_model() {
  return {"comp_mooney_rivlin",
          {},
          "rubber of Mooney and Rivlin, compressible",
          {positive("he_constant_1", "C1, Pa"),
           tag("he_constant_2", "C2, Pa").once().real().at_least(0),
           tag("he_PR", "Poisson's ratio at rest, below 1/2").once().real().above(-1)},
          [](const Parameters& p) -> std::shared_ptr<const Material> {
            if (!(p.real("he_PR") < 0.5)) {
              p.error("he_PR", "<he_PR> must be below 1/2: the bulk modulus would be infinite",
                      "take 0.49 for rubber");
              return nullptr;
            }
            return std::make_shared<MooneyRivlin>(p.real("he_constant_1"), p.real("he_constant_2"),
                                                  p.real("he_PR"), p.constants().density);
          }};
}

}  // namespace sluice::mpm
