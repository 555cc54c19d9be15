// Mie-Grueneisen solid about the Hugoniot of a linear shock speed Us = C0 + S up.
//
//   p = rho0 C0^2 chi (1 - Gamma0 chi/2)/(1 - S chi)^2 + Gamma0 rho0 e,   chi = 1 - rho0/rho >= 0
//   p = rho0 C0^2 chi + Gamma0 rho0 e                                      in tension (chi < 0)
//   T = T0 exp(Gamma0 chi) + (e - e_s)/cv,   e_s(chi) the isentrope through (rho0, T0), e_s(0) = 0:
//   e_s = exp(Gamma0 chi) C0^2 * integral over xi of exp(-Gamma0 s) s (1 - Gamma0 s/2),
//   s = xi/(1 + S xi), xi from 0 to chi/(1 - S chi), a choice that removes the Hugoniot's pole.
// Units: functions as in gruneisen_form.hpp; C0 m/s, rho0 kg/m^3, T0 K; S and Gamma0 are numbers; e
// = 0 at (rho0, T0). References: Menikoff and Plohr, Rev. Mod. Phys. 61 (1989) 75; McQueen et al.,
// in High Velocity Impact Phenomena (1970), chapter VII. Limits: pole at chi = 1/S; no spall.
// Admissible: T > 0, c^2 > 0, rho below the pole, p > -rho0 C0^2 / max(Gamma0, 1). Shock slope S.
#pragma once
#include <array>

#include "eos/gruneisen_form.hpp"
#include "eos/parameter.hpp"

namespace sluice::eos {

struct MieGruneisenCurves {
  double C0 = 1.0;
  double S = 0.0;
  double Gamma0 = 0.0;
  double rho0 = 1.0;
  double T0 = 300.0;
  double specific_heat = 1.0;

  static constexpr std::string_view name = "MieGruneisen";
  static constexpr auto parameters() {
    using P = Parameter<MieGruneisenCurves>;
    return std::array{
        P{"C0", "m/s", "sound speed of weak shocks", &MieGruneisenCurves::C0, above(0)},
        P{"S", "", "slope of shock speed against particle speed", &MieGruneisenCurves::S,
          at_least(0)},
        P{"Gamma0", "", "Grueneisen coefficient", &MieGruneisenCurves::Gamma0, above(0)},
        P{"rho0", "kg/m^3", "density of reference", &MieGruneisenCurves::rho0, above(0)},
        P{"T0", "K", "temperature of reference", &MieGruneisenCurves::T0, above(0)},
        heat_of_material<MieGruneisenCurves>()};
  }
  static constexpr bool depends_on_energy = true;
  static constexpr bool takes_any_heat = false;
  double offset(double rho) const {
    const double chi = 1.0 - rho0 / rho, stiff = rho0 * C0 * C0 * chi, d = 1.0 - S * chi;
    return chi < 0.0 ? stiff : stiff * (1.0 - 0.5 * Gamma0 * chi) / (d * d);
  }
  double offset_slope(double rho) const {
    const double chi = 1.0 - rho0 / rho, d = 1.0 - S * chi, squeeze = C0 * rho0 / rho;
    const double slope = squeeze * squeeze;
    return chi < 0.0 ? slope : slope * (1.0 + (S - Gamma0) * chi) / (d * d * d);
  }
  double gruneisen(double rho) const { return Gamma0 * rho0 / rho; }
  double exponent(double /*rho*/) const { return 0.0; }
  double cold_energy(double rho) const {
    const double chi = 1.0 - rho0 / rho;
    return isentrope(chi) - specific_heat * T0 * std::exp(Gamma0 * chi);
  }

  double start_density() const { return rho0; }
  double shock_slope() const { return S; }
  double lowest_pressure() const { return -rho0 * C0 * C0 / std::max(Gamma0, 1.0); }
  double highest_density() const {
    return S > 1.0 ? rho0 / (1.0 - 1.0 / S) : std::numeric_limits<double>::infinity();
  }

 private:
  double isentrope(double chi) const {
    if (chi >= 0.0) return C0 * C0 * squeezed(chi);
    const double z = Gamma0 * chi;  // (exp(z) - 1 - z)/z^2, by its series near zero
    const double part = std::abs(z) < 1e-2
                            ? 0.5 + z * (1.0 / 6 + z * (1.0 / 24 + z * (1.0 / 120 + z / 720)))
                            : (std::expm1(z) - z) / (z * z);
    return C0 * C0 * chi * chi * part;
  }
  // Gauss-Legendre quadrature with 16 points: 1e-13 at S chi = 0.5, 1e-8 at 0.9.
  double squeezed(double chi) const {
    static constexpr double node[8] = {0.0950125098376374, 0.2816035507792589, 0.4580167776572274,
                                       0.6178762444026438, 0.7554044083550030, 0.8656312023878318,
                                       0.9445750230732326, 0.9894009349916499};
    static constexpr double weight[8] = {0.1894506104550685, 0.1826034150449236, 0.1691565193950025,
                                         0.1495959888165767, 0.1246289712555339, 0.0951585116824928,
                                         0.0622535239386479, 0.0271524594117541};
    const double half = 0.5 * chi / (1.0 - S * chi);
    const auto part = [&](double xi) {
      const double s = xi / (1.0 + S * xi);
      return std::exp(Gamma0 * (chi - s)) * s * (1.0 - 0.5 * Gamma0 * s);
    };
    double sum = 0.0;
    for (int k = 0; k < 8; ++k)
      sum += weight[k] * (part(half * (1.0 - node[k])) + part(half * (1.0 + node[k])));
    return half * sum;
  }
};
using MieGruneisen = GruneisenForm<MieGruneisenCurves>;

}  // namespace sluice::eos
