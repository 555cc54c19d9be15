// cnh_mms: the neo-Hookean solid of the manufactured solutions.
//
//   sigma = [lambda ln J I + G (F F^T - I)]/J,   lambda = K - 2 G/3
//   W     = lambda/2 (ln J)^2 - G ln J + G/2 (tr F F^T - 3)
#include <cmath>

#include "mpm/material/base/batch_math.hpp"
#include "mpm/material/base/material_model.hpp"

namespace sluice::mpm {
namespace {

class LogNeoHook final : public Material {
 public:
  LogNeoHook(double bulk, double shear, double density)
      : lambda_(bulk - 2.0 / 3 * shear), shear_(shear), bulk_(bulk), density_(density) {}

  void start(const Batch& batch) const override { evaluate(batch); }
  std::optional<BatchFault> update(const Batch& batch) const override {
    evaluate(batch);
    return fault_of_volume(batch);
  }
  double bulk_modulus() const override { return bulk_; }
  double shear_modulus() const override { return shear_; }
  bool stress_of_state() const override { return true; }
  double wave_stiffening() const override { return shear_ / density_; }

 private:
  void evaluate(const Batch& batch) const {
    const Nine<const double> F_columns = batch.F;
    const Six<double> stress = batch.stress;
    const double* volume_0 = batch.volume_0;
    double *energy = batch.energy, *wave_speed = batch.wave_speed;
    const double lambda = lambda_, G = shear_, per_density = 1 / density_;
#pragma GCC ivdep
    for (int i = 0; i < batch.count; ++i) {
      const std::array<double, 9> F = at(F_columns, i);
      const double J = determinant(F), per_J = 1 / J;
      const VolumeLogs logs = volume_logs(J);
      const std::array<double, 6> b = left_cauchy_green(F);
      const double diagonal = lambda * logs.ln - G;
      stress[0][i] = per_J * (diagonal + G * b[0]);
      stress[1][i] = per_J * (diagonal + G * b[1]);
      stress[2][i] = per_J * (diagonal + G * b[2]);
      stress[3][i] = per_J * G * b[3];
      stress[4][i] = per_J * G * b[4];
      stress[5][i] = per_J * G * b[5];
      const double trace = b[0] + b[1] + b[2], mean = trace * (1.0 / 3);
      energy[i] =
          volume_0[i] * (0.5 * lambda * logs.ln * logs.ln + G * (0.5 * (trace - 3) - logs.ln));
      // rho_0 c^2 = lambda + G - lambda ln J + G b_max
      const double modulus = lambda + G - lambda * logs.ln + G * (mean + eigenvalue_reach(b, mean));
      wave_speed[i] = std::sqrt(std::max(modulus, 0.0) * per_density);
    }
  }

  double lambda_, shear_, bulk_, density_;
};

}  // namespace

MaterialModel cnh_mms_model() {
  return {"cnh_mms",
          {},
          "neo-Hookean solid with the logarithm of the volume, for manufactured solutions",
          {positive("bulk_modulus", "K, Pa"), positive("shear_modulus", "G, Pa")},
          [](const Parameters& p) -> std::shared_ptr<const Material> {
            return std::make_shared<LogNeoHook>(p.real("bulk_modulus"), p.real("shear_modulus"),
                                                p.constants().density);
          }};
}

}  // namespace sluice::mpm
