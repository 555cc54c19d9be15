// Conditions of a deck's boundary that hold for all faces of a kind: <LODI>, <SINE_BC>,
// <inletVelocity> and <microSlip> in <BoundaryConditions>. Plain data.
#pragma once
#include <optional>
#include <vector>

#include "framework/base/vec3.hpp"
#include "framework/deck/deck.hpp"

namespace sluice::ice {

// Waves that leave and do not come back (waves.hpp).
struct LodiSettings {
  double press_infinity = 0;  // Pa
  double sigma = 0.27;        // how fast the pressure goes back to it
  double scale = 1;           // of all that comes in
  std::optional<Vec3> velocity_infinity;
  std::optional<double> rho_infinity;
  Location where;
};

// q = reference + A sin(omega t); components of velocity whose reference is zero stay zero.
struct SineSettings {
  double omega = 0, amplitude = 0;
  double reference_pressure = 0;
  Vec3 reference_velocity{};
};

// h: height above the low side of the domain along `vertical`.
//   power law: the velocity given times min(h/H, 1)^exponent
//   log law: the velocity given (friction velocity) times ln(h/z0)/kappa, 0 below z0
struct InletProfile {
  int vertical = 1;
  double exponent = 0;
  std::optional<double> height;  // H; the domain's without it
  double roughness = 0;          // z0
  double von_karman = 0.4;
};

// Rarefied gas at walls (wall_slip.hpp).
struct SlipSettings {
  enum class Model { first_order, deissler, karniadakis_beskok };
  Model model = Model::first_order;
  double momentum_accommodation = 1, thermal_accommodation = 1;
  bool creep = false;  // at all its walls
  Vec3 force{};        // that drives the gas beside gravity, N/m^3

  bool second_order() const { return model != Model::first_order; }
};

// Travelling vortices of <manufacturedSolution type="mms_1">, an exact flow without compression:
//   u = 1 - A cos(x - t) sin(y - t) d,  v = 1 + A sin(x - t) cos(y - t) d,  d = exp(-2 nu t)
//   p = p_ref - rho A^2/4 d^2 (cos 2(x - t) + cos 2(y - t)),  nu = mu/rho
struct TravellingVortices {
  double amplitude = 1, reference_pressure = 0;

  struct Flow {
    double u = 0, v = 0, p = 0;
  };
  Flow at(Vec3 x, double time, double rho, double viscosity) const;
};

struct FlowConditions {
  std::optional<LodiSettings> lodi;
  std::optional<SineSettings> sine;
  std::optional<InletProfile> profile;
  std::optional<SlipSettings> slip;
  std::optional<TravellingVortices> vortices;  // of the start
};

FlowConditions read_flow_conditions(const DeckNode& root);

}  // namespace sluice::ice
