// Tillotson: metals and rocks from the shocked solid to the vapour, of density and energy.
//
//   eta = rho/rho0, mu = eta - 1, w = e/(E0 eta^2) + 1, y = 1/eta - 1
//   condensed (rho >= rho0 or e <= Es):  p1 = (a + b/w) rho e + A mu + B mu^2
//   vapour (rho < rho0 and e >= Esp):
//     p2 = a rho e + [b rho e/w + A mu exp(-beta y)] exp(-alpha y^2)
//   between Es and Esp: p1 + (e - Es)/(Esp - Es) (p2 - p1);  c^2 = dp/drho|e + (p/rho^2) dp/de|rho.
// Units: A, B Pa; E0, Es, Esp J/kg (Es: incipient, Esp: complete vaporisation); a, b, alpha and
// beta are numbers; of the functions as in gruneisen_form.hpp. References:
// Tillotson, General Atomic report GA-3216 (1962); Melosh, Impact Cratering (1989), appendix II.
// Limits: temperature is no part of the law: T = (e - e_c)/cv with e_c the integral of
// (A mu + B mu^2)/rho^2 above rho0 and 0 below, good for estimates. Admissible: rho > 0, T > 0,
// c^2 > 0, p above the lowest of A mu + B mu^2. Shock slope (1 + B/A + (a + b)/2)/2 (Melosh).
#pragma once
#include <array>

#include "eos/density_search.hpp"
#include "eos/heat_ratio.hpp"
#include "eos/parameter.hpp"

namespace sluice::eos {

struct Tillotson {
  double a = 0.5, b = 1.0;
  double A = 1.0, B = 1.0;
  double E0 = 1.0, Es = 1.0, Esp = 2.0;
  double alpha = 5.0, beta = 5.0;
  double rho0 = 1.0;
  double specific_heat = 1.0;

  static constexpr std::string_view name = "Tillotson";
  static constexpr auto parameters() {
    using P = Parameter<Tillotson>;
    return std::array{
        P{"a", "", "Grueneisen coefficient of the vapour", &Tillotson::a, above(0)},
        P{"b", "", "what the condensed body adds to the Grueneisen coefficient", &Tillotson::b,
          at_least(0)},
        P{"A", "Pa", "bulk modulus", &Tillotson::A, above(0)},
        P{"B", "Pa", "growth of the bulk modulus with compression", &Tillotson::B, any_number()},
        P{"E0", "J/kg", "energy at which b has halved", &Tillotson::E0, above(0)},
        P{"Es", "J/kg", "energy of incipient vaporisation", &Tillotson::Es, above(0)},
        P{"Esp", "J/kg", "energy of complete vaporisation", &Tillotson::Esp, above(0)},
        P{"alpha", "", "decay of the pressure in expansion", &Tillotson::alpha, above(0)},
        P{"beta", "", "decay of the tension in expansion", &Tillotson::beta, above(0)},
        P{"rho0", "kg/m^3", "density of reference", &Tillotson::rho0, above(0)},
        heat_of_material<Tillotson>()};
  }
  std::string_view contradiction() const {
    return Esp > Es ? "" : "<Esp> must be greater than <Es>";
  }
  double heat_capacity_ratio(double rho, double rho_e, double T, double cv) const {
    return ratio_of_heats(*this, rho, rho_e, T, cv);
  }
  static constexpr bool depends_on_energy = true;
  static constexpr bool takes_any_heat = true;
  double pressure(double rho, double rho_e) const { return at(rho, rho_e / rho).p; }
  double dp_drho(double rho, double rho_e) const { return at(rho, rho_e / rho).drho; }
  double dp_de(double rho, double rho_e) const { return at(rho, rho_e / rho).de; }
  double sound_speed_squared(double rho, double rho_e) const {
    const State s = at(rho, rho_e / rho);
    return s.drho + s.de * s.p / (rho * rho);
  }
  double bulk_modulus(double rho, double p) const {
    return rho * sound_speed_squared(rho, energy_from_pressure(rho, p));
  }
  double sound_speed(double rho, double p) const { return std::sqrt(bulk_modulus(rho, p) / rho); }

  double cold_energy(double rho) const {
    const double eta = std::max(rho / rho0, 1.0), l = std::log(eta);
    return (A * (l + 1.0 / eta - 1.0) + B * (eta - 2.0 * l - 1.0 / eta)) / rho0;
  }
  double thermal_energy(double rho, double rho_e) const { return rho_e / rho - cold_energy(rho); }
  double temperature(double rho, double rho_e) const {
    return thermal_energy(rho, rho_e) / specific_heat;
  }
  double energy_from_temperature(double rho, double T) const {
    return rho * (cold_energy(rho) + specific_heat * T);
  }
  // Not a number below the pressure of zero energy.
  double energy_from_pressure(double rho, double p) const {
    if (!(at(rho, 0.0).p <= p)) return no_density;
    double high = E0;
    while (at(rho, high).p < p) high *= 4.0;
    const auto excess = [&](double e) {
      const State s = at(rho, e);
      return ValueAndSlope{s.p - p, s.de};
    };
    return rho * bracketed_root(excess, 0.0, high, 0.5 * high);
  }
  double density(double p, double T) const {
    return density_at_thermal_energy(p, specific_heat * T);
  }
  double density_at_thermal_energy(double p, double thermal) const {
    const auto isotherm = [&](double rho) {
      const State s = at(rho, thermal + cold_energy(rho));
      const double mu = std::max(rho / rho0 - 1.0, 0.0);
      return ValueAndSlope{s.p, s.drho + s.de * mu * (A + B * mu) / (rho * rho)};
    };
    return search_density(p, rho0, highest_density(), isotherm);
  }

  bool admissible(double rho, double rho_e) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double e = rho_e / rho, thermal = e - cold_energy(rho);
    const State s = at(rho, e);
    const double c2 = s.drho + s.de * s.p / (rho * rho);
    return rho > 0.0 && thermal > 0.0 && thermal < infinity && s.p > lowest_pressure() &&
           c2 > 0.0 && c2 < infinity;
  }
  double shock_slope() const { return 0.5 * (1.0 + B / A + 0.5 * (a + b)); }
  double lowest_pressure() const { return A < 2.0 * B ? -0.25 * A * A / B : std::min(B - A, 0.0); }
  double highest_density() const { return std::numeric_limits<double>::infinity(); }

 private:
  struct State {
    double p, drho, de;
  };
  State at(double rho, double e) const {
    const double eta = rho / rho0, mu = eta - 1.0, part = e / (E0 * eta * eta), w = part + 1.0;
    const double hot = b * rho * e / w, hot_drho = b * e / w * (1.0 + 2.0 * part / w);
    const double hot_de = b * rho / (w * w);
    const State solid{a * rho * e + hot + mu * (A + B * mu),
                      a * e + hot_drho + (A + 2.0 * B * mu) / rho0, a * rho + hot_de};
    if (!(eta < 1.0) || !(e > Es)) return solid;
    const double y = 1.0 / eta - 1.0, dy = -1.0 / (eta * rho);
    const double decay = std::exp(-alpha * y * y), tension = A * std::exp(-beta * y);
    const double bracket = hot + tension * mu;
    const double bracket_drho = hot_drho + tension * (1.0 / rho0 - beta * mu * dy);
    const State gas{a * rho * e + bracket * decay,
                    a * e + (bracket_drho - 2.0 * alpha * y * dy * bracket) * decay,
                    a * rho + hot_de * decay};
    if (e >= Esp) return gas;
    const double f = (e - Es) / (Esp - Es);
    return {solid.p + f * (gas.p - solid.p), solid.drho + f * (gas.drho - solid.drho),
            solid.de + f * (gas.de - solid.de) + (gas.p - solid.p) / (Esp - Es)};
  }
};

}  // namespace sluice::eos
