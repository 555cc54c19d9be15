// What the ICE part of a deck means: numerics, materials, initial state. Plain data.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/scene/scene.hpp"
#include "ice/fluid.hpp"

namespace sluice::ice {

struct IceMaterial {
  std::string name;
  int index = 0;
  Fluid fluid;
  double viscosity = 0;  // dynamic, Pa s
  std::vector<GeomObject> objects;
  Location where, viscosity_where;
};

// Formulas of x, y, z that replace values of the geometry objects.
struct FormulaFill {
  std::optional<std::string> density, pressure, temperature;
  std::array<std::optional<std::string>, 3> velocity;
  Location where;
};

struct RefinementCriterion {
  std::string label;  // a cell variable that is a function of the state
  double value = 0;   // threshold of the gradient's magnitude
  int material = 0;
};

struct IceScene {
  bool classic = false;      // <scheme>classic</scheme>
  bool second_order = true;  // <advection type=>
  bool compatible_fluxes = true;
  double cfl = 0.4;
  double sound_speed_knob = 1;
  double diffusion_knob = 1;
  bool conservative_time_step = false;  // Scheme_for_delT_calc
  bool hydrostatic_start = true;
  std::vector<IceMaterial> materials;
  std::optional<FormulaFill> formula;
  std::vector<RefinementCriterion> criteria;
  bool exchange_written = false;  // the deck has coefficients (one material: nothing to exchange)
  Location advection_where, cfl_where, scheme_where, exchange_where, gravity_where;
};

// Adds errors and warnings to `faults`.
IceScene read_ice_scene(const Deck& deck, const Scene& scene, std::vector<Fault>& faults);

}  // namespace sluice::ice
