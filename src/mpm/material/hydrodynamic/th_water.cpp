// TH_water: water with a density maximum, by Thomsen and Hartka (Am. J. Phys. 30, 1962; formulas
// in eos/thomsen_hartka_water.hpp).
//
//   sigma = -(p(rho, T) - Pref) I,   v = vo (1 - ko p + L (a p + T - To)^2)
// A step is adiabatic: e_1 = e_0 - (p_0 + p_1)(v_1 - v_0)/2 from e_0 = e(rho_0, T) gives p_1 and
// the temperature at the end. Without viscosity.
#include <algorithm>
#include <cmath>

#include "eos/thomsen_hartka_water.hpp"
#include "mpm/material/base/batch_math.hpp"
#include "mpm/material/base/material_model.hpp"

namespace sluice::mpm {
namespace {

class ThermalWater final : public Material {
 public:
  ThermalWater(const eos::ThomsenHartkaWater& law, double p_ref, double density)
      : law_(law), p_ref_(p_ref), density_(density), at_rest_(law.bulk_modulus(density, p_ref)) {}

  void start(const Batch& b) const override {
    for (int i = 0; i < b.count; ++i) {
      const double rho = density_ / determinant(at(b.F, i));
      set_stress(b, i, rho, law_.energy_from_temperature(rho, b.temperature[i]));
      b.energy[i] = 0;
    }
  }

  std::optional<BatchFault> update(const Batch& b) const override {
    if (const auto fault = fault_of_volume(b)) return fault;
    for (int i = 0; i < b.count; ++i) {
      const double J_0 = determinant(at(b.old_F, i)), J = determinant(at(b.F, i));
      const double rho_0 = density_ / J_0, rho = density_ / J, T = b.temperature[i];
      const double e_0 = law_.energy_from_temperature(rho_0, T) / rho_0;
      const double p_0 = p_ref_ - b.old_stress[0][i], dv = 1 / rho - 1 / rho_0;
      // The guess is off by little, and dp/de |dv| is 1e-2 at most: few rounds.
      double p = p_0 - at_rest_ * std::log(J / J_0), e = e_0;
      for (int round = 0; round < 20; ++round) {
        e = e_0 - 0.5 * (p_0 + p) * dv;
        const double next = law_.pressure(rho, rho * e);
        const bool done = !(std::abs(next - p) > 1e-13 * at_rest_);
        p = next;
        if (done) break;
      }
      if (!law_.admissible(rho, rho * e))
        return BatchFault{i, "water beyond the law of Thomsen and Hartka, density", rho};
      set_stress(b, i, rho, rho * e);
      b.heating[i] += (law_.temperature(rho, rho * e) - T) / b.dt;
      b.energy[i] =
          b.old_energy[i] + 0.5 * b.volume_0[i] * (b.old_stress[0][i] + b.stress[0][i]) * (J - J_0);
    }
    return std::nullopt;
  }
  double bulk_modulus() const override { return at_rest_; }

 private:
  void set_stress(const Batch& b, int i, double rho, double rho_e) const {
    const double p = law_.pressure(rho, rho_e) - p_ref_;
    for (int k = 0; k < 6; ++k) b.stress[k][i] = k < 3 ? -p : 0;
    b.wave_speed[i] = std::sqrt(law_.sound_speed_squared(rho, rho_e));
  }

  eos::ThomsenHartkaWater law_;
  double p_ref_, density_;
  double at_rest_;  // bulk modulus without stress, on the warm side, Pa
};

}  // namespace

MaterialModel TH_water_model() {
  const eos::ThomsenHartkaWater water;
  return {
      "TH_water",
      {},
      "water with a density maximum (Thomsen and Hartka)",
      {positive_or("a", "decrease of the temperature of largest density with pressure, K/Pa",
                   water.a),
       number("b", "decrease of the specific heat with temperature, J/kg/K^2", water.b).at_least(0),
       positive_or("co", "specific heat at To, J/kg/K", water.co),
       positive_or("ko", "compressibility, 1/Pa", water.ko),
       positive_or("To", "temperature of largest density, K", water.To),
       positive_or("L", "thermal expansion, 1/K^2", water.L),
       positive_or("vo", "specific volume at To, m^3/kg", water.vo),
       number("Pref", "pressure without stress, Pa", 101325)},
      [](const Parameters& p) -> std::shared_ptr<const Material> {
        eos::ThomsenHartkaWater law;
        law.a = p.real("a");
        law.b = p.real("b");
        law.co = p.real("co");
        law.ko = p.real("ko");
        law.To = p.real("To");
        law.L = p.real("L");
        law.vo = p.real("vo");
        return std::make_shared<ThermalWater>(law, p.real("Pref"), p.constants().density);
      }};
}

}  // namespace sluice::mpm
