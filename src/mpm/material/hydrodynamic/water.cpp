// water and murnaghanMPM: a viscous liquid under Murnaghan's pressure.
//
//   sigma = -p I + 2 mu dev D,   p = K (J^-gamma - 1)
//   W     = K [J^(1 - gamma)/(gamma - 1) + J - gamma/(gamma - 1)]; viscous work is added to it
#include <algorithm>
#include <cmath>

#include "mpm/material/base/material_model.hpp"
#include "mpm/material/base/objective_step.hpp"

namespace sluice::mpm {
namespace {

class Liquid final : public Material {
 public:
  Liquid(double K, double viscosity, double gamma, double density)
      : K_(K), viscosity_(viscosity), gamma_(gamma), density_(density) {}

  void start(const Batch& b) const override {
    for (int i = 0; i < b.count; ++i) {
      const double J = determinant(at(b.F, i)), p = pressure(J);
      for (int k = 0; k < 6; ++k) b.stress[k][i] = k < 3 ? -p : 0;
      b.energy[i] = b.volume_0[i] * stored(J);
      b.wave_speed[i] = wave_speed(J);
    }
  }

  std::optional<BatchFault> update(const Batch& b) const override {
    constexpr double greatest_volume = 1e5;
    if (const auto fault = fault_of_volume(b)) return fault;
    for (int i = 0; i < b.count; ++i) {
      const double J_0 = determinant(at(b.old_F, i)), J = determinant(at(b.F, i));
      if (J > greatest_volume)
        return BatchFault{i, "a liquid stretched to 1e5 times its volume", J};
      const Symmetric strain = deviator(objective_step(at(b.L, i), b.dt).strain);
      const double of_strain = 2 * viscosity_ / b.dt, p = pressure(J);
      for (std::size_t k = 0; k < 6; ++k) b.stress[k][i] = of_strain * strain[k] - (k < 3 ? p : 0);
      b.energy[i] = b.old_energy[i] + b.volume_0[i] * (stored(J) - stored(J_0) +
                                                       J * of_strain * double_dot(strain, strain));
      b.wave_speed[i] = wave_speed(J);
    }
    return std::nullopt;
  }
  double bulk_modulus() const override { return K_ * gamma_; }

 private:
  double pressure(double J) const { return K_ * (std::pow(J, -gamma_) - 1); }
  double stored(double J) const {
    const double ln = std::log(J);
    const double power = gamma_ == 1 ? -ln : std::expm1((1 - gamma_) * ln) / (gamma_ - 1);
    return K_ * (power + J - 1);
  }
  // c^2 = K gamma J^(1 - gamma)/rho_0
  double wave_speed(double J) const {
    return std::sqrt(K_ * gamma_ * std::pow(J, 1 - gamma_) / density_);
  }

  double K_, viscosity_, gamma_, density_;
};

}  // namespace

MaterialModel water_model() {
  return {"water",
          {},
          "viscous liquid with Murnaghan's pressure",
          {positive("bulk_modulus", "K, Pa: the bulk modulus is K gamma"),
           tag("viscosity", "mu, Pa s").once().real().at_least(0),
           positive("gamma", "exponent of the density")},
          [](const Parameters& p) -> std::shared_ptr<const Material> {
            return std::make_shared<Liquid>(p.real("bulk_modulus"), p.real("viscosity"),
                                            p.real("gamma"), p.constants().density);
          }};
}

MaterialModel murnaghanMPM_model() {
  return {
      "murnaghanMPM",
      {},
      "the same liquid with other tags",
      {positive("K", "K, Pa: the bulk modulus is K gamma"),
       number("viscosity", "mu, Pa s", 0).at_least(0), positive("gamma", "exponent of the density"),
       number("pressure", "reference pressure with a fluid, Pa", 0),
       number("rho0", "reference density with a fluid, kg/m^3", 0)},
      [](const Parameters& p) -> std::shared_ptr<const Material> {
        return std::make_shared<Liquid>(p.real("K"), p.real("viscosity"), p.real("gamma"),
                                        p.constants().density);
      }};
}

}  // namespace sluice::mpm
