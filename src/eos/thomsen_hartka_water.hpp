// Thomsen-Hartka water: a liquid with a density maximum.
//
//   v = v0 (1 - k0 p + L x^2),   x = a p + T - T0;   cp(0, T) = c0 - b (T - T0)
//   cp = cp(0, T) - 2 T v0 L p,   cv = cp - T (dv/dT)^2 / |dv/dp|,   dv/dp = -v0 (k0 - 2 a L x)
//   h = c0 t - b t^2/2 + integral of (v - T dv/dT) dp,  t = T - T0;   e = h - p v (0 at p = 0, T0)
//   dp/drho|T = v^2/|dv/dp|,  dp/dT|v = 2 L x/(k0 - 2 a L x),
//   c^2 = dp/drho|T + T (dp/dT)^2 v^2 / cv.
// Units: a K/Pa, b J/(kg K^2), c0 J/(kg K), k0 1/Pa, L 1/K^2, T0 K, v0 m^3/kg; of the functions as
// in gruneisen_form.hpp. Reference: Thomsen and Hartka, Am. J.
// Phys. 30 (1962) 26 and 388. Limits: about 0 to 40 C and p up to some 1e8 Pa; the law ends where
// dv/dp = 0 (x = k0/(2 a L)). Water colder than where it is densest (x < 0) has the density and the
// pressure of a warmer one: functions of these two take the warm side (x >= 0), unless they are
// told a temperature, and lose half their digits near x = 0. Of a state that has an energy the
// modulus
// is modulus_of_state (eos.hpp).
// Admissible: rho > 0, T > 0, dv/dp < 0, cv > 0, p > -1/k0. Shock slope 2: water (Us = c + 2 up).
#pragma once
#include <array>

#include "eos/density_search.hpp"
#include "eos/heat_ratio.hpp"
#include "eos/parameter.hpp"

namespace sluice::eos {

struct ThomsenHartkaWater {
  double a = 2.0e-7, b = 2.6;
  double co = 4205.7, ko = 5.0e-10;
  double To = 277.0, L = 8.0e-6;
  double vo = 1.00008e-3;

  static constexpr std::string_view name = "Thomsen_Hartka_water";
  static constexpr auto parameters() {
    using P = Parameter<ThomsenHartkaWater>;
    return std::array{
        P{"a", "K/Pa", "shift of the density maximum with pressure", &ThomsenHartkaWater::a,
          above(0)},
        P{"b", "J/(kg K^2)", "fall of the specific heat with temperature", &ThomsenHartkaWater::b,
          at_least(0)},
        P{"co", "J/(kg K)", "specific heat at constant pressure at To", &ThomsenHartkaWater::co,
          above(0)},
        P{"ko", "1/Pa", "compressibility", &ThomsenHartkaWater::ko, above(0)},
        P{"To", "K", "temperature of largest density", &ThomsenHartkaWater::To, above(0)},
        P{"L", "1/K^2", "growth of volume with temperature squared", &ThomsenHartkaWater::L,
          above(0)},
        P{"vo", "m^3/kg", "volume at To and zero pressure", &ThomsenHartkaWater::vo, above(0)}};
  }
  double heat_capacity_ratio(double rho, double rho_e, double T, double cv) const {
    return ratio_of_heats(*this, rho, rho_e, T, cv);
  }
  static constexpr bool depends_on_energy = true;
  static constexpr bool takes_any_heat = false;
  double pressure(double rho, double rho_e) const { return isochore(rho, temperature(rho, rho_e)); }
  double dp_drho(double rho, double rho_e) const {
    const Slopes s = slopes(rho, temperature(rho, rho_e));
    return s.p_rho - s.p_T * (s.p - s.T * s.p_T) / (rho * rho * s.cv);
  }
  double dp_de(double rho, double rho_e) const {
    const Slopes s = slopes(rho, temperature(rho, rho_e));
    return s.p_T / s.cv;
  }
  double sound_speed_squared(double rho, double rho_e) const {
    return sound_squared(rho, temperature(rho, rho_e));
  }
  double bulk_modulus(double rho, double p) const {
    return rho * sound_squared(rho, warm_temperature(rho, p));
  }
  double sound_speed(double rho, double p) const { return std::sqrt(bulk_modulus(rho, p) / rho); }

  // Newton at constant density, to a step whose square is round-off; not a number where no state
  // with cv > 0 has this energy.
  double temperature(double rho, double rho_e) const {
    const double e = rho_e / rho;
    double T = std::min(To, 0.9 * hottest(rho));
    for (int step = 0; step < 30; ++step) {
      const Slopes s = slopes(rho, T);
      const double next = T - (energy(s.p, T) - e) / s.cv;
      if (std::abs(next - T) <= 1e-9 * T) return s.cv > 0.0 ? next : no_density;
      T = std::min(std::max(next, 0.5 * T), 0.5 * (T + hottest(rho)));
    }
    return no_density;
  }
  double energy_from_temperature(double rho, double T) const {
    return rho * energy(isochore(rho, T), T);
  }
  // cv T, J/kg: what water may lose. (Its pressure rises with energy on the warm side only.)
  double thermal_energy(double rho, double rho_e) const {
    const double T = temperature(rho, rho_e);
    return slopes(rho, T).cv * T;
  }
  double energy_from_pressure(double rho, double p) const {
    return rho * energy(p, warm_temperature(rho, p));
  }
  // On the side of x = 0 on which T is.
  double energy_from_pressure(double rho, double p, double T) const {
    const double densest = To - a * p, warmer = warm_temperature(rho, p) - densest;
    return rho * energy(p, densest + (T < densest ? -warmer : warmer));
  }
  double density(double p, double T) const {
    const double x = a * p + T - To;
    return x < 0.5 * ko / (a * L) ? 1.0 / (vo * (1.0 - ko * p + L * x * x)) : no_density;
  }

  bool admissible(double rho, double rho_e) const {
    if (!(rho > 0.0)) return false;
    const double T = temperature(rho, rho_e);
    const Slopes s = slopes(rho, T);
    return T > 0.0 && s.cv > 0.0 && s.p_rho > 0.0 && s.p > lowest_pressure();
  }
  double shock_slope() const { return 2.0; }
  double lowest_pressure() const { return -1.0 / ko; }
  double highest_density() const { return std::numeric_limits<double>::infinity(); }

 private:
  struct Slopes {
    double p, T, p_rho, p_T, cv;
  };
  double isochore(double rho, double T) const {  // smaller root of the quadratic in p
    const double t = T - To, c = 1.0 + L * t * t - 1.0 / (rho * vo), B = ko - 2.0 * a * L * t;
    return 2.0 * c / (B + std::sqrt(B * B - 4.0 * L * a * a * c));
  }
  // Where the two roots meet.
  double hottest(double rho) const {
    return To + 0.25 * ko / (a * L) - a / ko * (1.0 - 1.0 / (rho * vo));
  }
  double warm_temperature(double rho, double p) const {
    return To - a * p + std::sqrt(std::max((1.0 / (rho * vo) - 1.0 + ko * p) / L, 0.0));
  }
  double energy(double p, double T) const {
    const double t = T - To, x = a * p + t, ap = a * p;
    const double cubes = t * t + t * ap + ap * ap / 3.0, squares = t + 0.5 * ap;
    const double push = p * vo * (1.0 - 0.5 * ko * p + L * (cubes - 2.0 * T * squares));
    return t * (co - 0.5 * b * t) + push - p * vo * (1.0 - ko * p + L * x * x);
  }
  Slopes slopes(double rho, double T) const {
    const double p = isochore(rho, T), x = a * p + T - To, d = ko - 2.0 * a * L * x;
    const double cp = co - b * (T - To) - 2.0 * T * vo * L * p;
    return {p, T, 1.0 / (rho * rho * vo * d), 2.0 * L * x / d,
            cp - 4.0 * T * vo * L * L * x * x / d};
  }
  double sound_squared(double rho, double T) const {
    const Slopes s = slopes(rho, T);
    return s.p_rho + T * s.p_T * s.p_T / (rho * rho * s.cv);
  }
};

}  // namespace sluice::eos
