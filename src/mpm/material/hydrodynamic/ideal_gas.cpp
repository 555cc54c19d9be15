// ideal_gas: particles of a gas.
//
//   p = (gamma - 1) rho c_v T,   sigma = -(p - p_ref + q) I,   dT/dt by the work of p
//   q = (2.5 dx)^2 rho (tr D)^2 where the gas is compressed
// T at the end of the step is that at its start after the isentrope J^(1 - gamma).
#include <algorithm>
#include <cmath>

#include "mpm/material/base/batch_math.hpp"
#include "mpm/material/base/material_model.hpp"

namespace sluice::mpm {
namespace {

class GasParticles final : public Material {
 public:
  GasParticles(double gamma, double c_v, double p_ref, double density, bool viscous)
      : gamma_(gamma), c_v_(c_v), p_ref_(p_ref), density_(density), viscous_(viscous) {}

  void start(const Batch& b) const override {
    for (int i = 0; i < b.count; ++i) {
      set_stress(b, i, determinant(at(b.F, i)), b.temperature[i], 0);
      b.energy[i] = 0;
    }
  }

  std::optional<BatchFault> update(const Batch& b) const override {
    if (const auto fault = fault_of_volume(b)) return fault;
    for (int i = 0; i < b.count; ++i) {
      const double J_0 = determinant(at(b.old_F, i)), J = determinant(at(b.F, i));
      const double rate = (J - J_0) / (0.5 * (J + J_0) * b.dt);  // tr D
      // q = rho (2.5 h tr D)^2 = rho Q h |tr D|
      const double squeeze = viscous_ && rate < 0 ? -rate * b.spacing : 0;
      const double Q = 2.5 * 2.5 * squeeze;
      const double q = density_ / J * Q * squeeze;
      // Along the isentrope, and by the work of q, which is all heat: a shock is no isentrope.
      const double q_0 =
          viscous_ ? p_ref_ - b.old_stress[0][i] - pressure(J_0, b.temperature[i]) : 0;
      const double T = b.temperature[i] * std::pow(J / J_0, 1 - gamma_) +
                       0.5 * (q_0 + q) * (J_0 - J) / (density_ * c_v_);
      if (!(T > 0)) return BatchFault{i, "temperature of a gas <= 0", T};
      set_stress(b, i, J, T, q);
      // What acts a step later is stable to h/(Q + sqrt(Q^2 + c^2)), as artificial viscosity.
      const double c = b.wave_speed[i];
      if (squeeze > 0) b.wave_speed[i] = Q + std::sqrt(Q * Q + c * c);
      b.heating[i] += (T - b.temperature[i]) / b.dt;
      b.energy[i] =
          b.old_energy[i] + 0.5 * b.volume_0[i] * (b.old_stress[0][i] + b.stress[0][i]) * (J - J_0);
    }
    return std::nullopt;
  }
  double bulk_modulus() const override { return gamma_ * p_ref_; }

 private:
  double pressure(double J, double T) const { return (gamma_ - 1) * density_ / J * c_v_ * T; }
  void set_stress(const Batch& b, int i, double J, double T, double q) const {
    const double p = pressure(J, T);
    for (int k = 0; k < 6; ++k) b.stress[k][i] = k < 3 ? p_ref_ - p - q : 0;
    b.wave_speed[i] = std::sqrt(gamma_ * p * J / density_);
  }

  double gamma_, c_v_, p_ref_, density_;
  bool viscous_;
};

}  // namespace

MaterialModel ideal_gas_model() {
  return {"ideal_gas",
          {},
          "particles of an ideal gas",
          {positive_or("gamma", "ratio of specific heats, above 1", 1.4),
           tag("specific_heat", "c_v, J/kg/K; absent: that of the material").real().above(0),
           number("Pref", "pressure without stress, Pa; absent: 101325", 101325),
           choice("UseArtificialViscosity",
                  "whether an artificial viscosity spreads shocks over cells", true)},
          [](const Parameters& p) -> std::shared_ptr<const Material> {
            if (!(p.real("gamma") > 1)) {
              p.error("gamma", "<gamma> must be greater than 1");
              return nullptr;
            }
            const double c_v =
                p.has("specific_heat") ? p.real("specific_heat") : p.constants().specific_heat;
            return std::make_shared<GasParticles>(p.real("gamma"), c_v, p.real("Pref"),
                                                  p.constants().density,
                                                  p.flag("UseArtificialViscosity"));
          }};
}

}  // namespace sluice::mpm
