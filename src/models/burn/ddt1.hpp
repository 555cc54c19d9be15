// Model "DDT1": an explosive burns at its surface, in its cracks, or detonates, by the pressure.
//
//   p > p_J            detonates as JWL++ has it (jwlpp.hpp), until nothing is left
//   p_S <= p <= p_J    surfaces burn beside hot gas as by Steady_Burn (steady_burn.hpp); cracked
//                      explosive beside hot gas burns at the walls of its cracks, at the same
//                      mass flux, with an area of the explosive's volume over their spacing
// Explosive is cracked where its cracks, of radius a, let flames of that pressure in:
//   a^2 p^n > C,   C = 8e8 m^2 Pa^2.84, n = 2.84
// (Berghout, Son, Skidmore, Idar and Asay, Thermochim. Acta 384 (2002) 261.)
// Beside what detonates nothing burns. With an induction time flames need time to come along:
//   tau = d A/(F_b (p/p_0)^F_c),   A = I + (1 - I) sin^2 theta
// over the distance d to what burns or is hot, which lies at the angle theta to the surface's
// normal: head on the flame has the share I of d to go. It has come when the integral of dt/tau
// is 1.
#pragma once
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "framework/scene/output_switch.hpp"
#include "models/burn/burn_law.hpp"
#include "models/burn/jwlpp.hpp"
#include "models/burn/steady_burn.hpp"

namespace sluice::models {

// What a particle knows of the flame that comes.
struct Ignition {
  enum Kind { none = 0, surface = 2, cracks = 3 };  // as "burning" has it once it burns
  Kind kind = none;
  double come = 0;  // share of the way that the flame has come
  double time = 0;  // since it set out, s
  double way = 0;   // d A, m

  bool lit() const { return kind != none; }
  bool burns() const { return lit() && come >= 1; }
};

struct FlameSpread {
  double head_on = 1;    // I
  double speed = 0;      // F_b, m/s
  double reference = 1;  // p_0, Pa
  double power = 0;      // F_c

  // A, without unit; `cosine` of theta, of either sign.
  double share(double cosine) const {
    return head_on + (1 - head_on) * std::max(0.0, 1 - cosine * cosine);
  }
  double delay(double way, double pressure) const {
    return way / (speed * std::pow(pressure / reference, power));
  }
  // After dt (s) at this pressure (Pa).
  Ignition after(double dt, const Ignition& before, double pressure) const {
    Ignition now = before;
    const double tau = delay(before.way, pressure);
    now.come = tau > dt * 1e-12 ? std::min(1.0, before.come + dt / tau) : 1.0;
    now.time += dt;
    return now;
  }
};

struct Ddt1 {
  // Other intervals, once.
  struct Switch {
    double pressure = 0;  // of any cell with explosive, Pa; 0: where any detonates
    OutputSwitch to;
  };

  JwlPp detonation;
  SteadyBurn flame;
  int surface_product = 0;  // among the fluids: what surfaces become; else SolidBurn::product
  bool cracks = false;
  double crack_constant = 8e8, crack_power = 2.84;  // C, m^2 Pa^n; n
  double crack_spacing = 0.002;                     // m
  double seen_in_cracks = 1e-14;      // fluid that fills no more of a cell is no hot gas to cracks
  std::optional<FlameSpread> spread;  // none: flames are there at once
  std::vector<Switch> switches;

  // Pressures in Pa, radii in m.
  bool detonates(double pressure) const { return pressure > detonation.threshold_pressure; }
  bool deflagrates(double pressure) const {
    return pressure >= flame.threshold_pressure && !detonates(pressure);
  }
  bool cracked(double radius, double pressure) const {
    return cracks && pressure > 0 &&
           radius * radius * std::pow(pressure, crack_power) > crack_constant;
  }
  // Share of explosive of this density (kg/m^3) that its cracks burn in dt (s) at a mass flux
  // (kg/(m^2 s)); `filled`: share of it that is left.
  // The walls' area stays until nothing is left between them.
  double burned_in_cracks(double dt, double flux, double density, double filled) const {
    return flux * dt / (crack_spacing * density * filled);
  }
};

void check_ddt1(const DeckNode& parameters, const MaterialNames& names, std::vector<Fault>& faults);
TagSpec ddt1_tag();
std::shared_ptr<const BurnLaw> read_ddt1(const DeckNode& parameters, const MaterialNames& names);

}  // namespace sluice::models
