// What the ICE part of a deck means: numerics, materials, initial state. Plain data.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/scene/scene.hpp"
#include "ice/conditions/flow_conditions.hpp"
#include "ice/deck/body_sources.hpp"
#include "ice/deck/custom_start.hpp"
#include "ice/deck/exchange_settings.hpp"
#include "ice/deck/implicit_settings.hpp"
#include "ice/deck/transport_settings.hpp"
#include "ice/fluid/fluid.hpp"
#include "models/models.hpp"

namespace sluice::ice {

struct IceMaterial {
  std::string name;
  int index = 0;          // among the fluids
  int solids_before = 0;  // materials of the scene that come before the fluids
  Fluid fluid;
  double viscosity = 0;     // dynamic, Pa s
  double conductivity = 0;  // W/(m K)
  ViscosityModels viscosity_models;
  bool subgrid = false;      // turbulence or a law of the wall acts on it
  bool surrounding = false;  // its weight makes the hydrostatic pressure
  std::vector<GeomObject> objects;
  Location where, viscosity_where, conductivity_where;

  int number() const { return solids_before + index; }  // as decks count them
  bool viscous() const { return viscosity > 0 || viscosity_models.any() || subgrid; }
};

// Formulas of x, y, z that replace values of the geometry objects.
struct FormulaFill {
  std::optional<std::string> density, pressure, temperature;
  std::array<std::optional<std::string>, 3> velocity;
  bool over_cells = false;  // means over cells, not values at their centres
  Location where;
};

struct RefinementCriterion {
  std::string label;  // a cell variable that is a function of the state
  double value = 0;   // threshold of the gradient's magnitude: unit of the variable, per m
  int material = 0;
};

struct IceScene {
  int solids = 0;  // materials of solids, which come first among those of the scene
  bool internal_energy_form = false;  // <scheme>classic</scheme>
  bool second_order = true;           // <advection type=>, or a higher order
  bool third_order = false;           // the same: parabolas
  bool compatible_fluxes = true;
  bool shears_shocks = true;  // shearAlongShocks
  std::optional<ImplicitSettings> implicit;
  std::optional<double> cfl;            // Courant number; none: courant_number() chooses
  double sound_speed_factor = 1;        // weight of c in the deck's time-step rule
  double diffusion_factor = 1;          // weight of diffusion in it
  bool conservative_time_step = false;  // Scheme_for_delT_calc
  bool hydrostatic_start = true;
  std::vector<IceMaterial> materials;
  std::optional<Turbulence> turbulence;
  std::vector<WallShear> wall_shear;
  FlowConditions conditions;        // LODI, Sine and inlet profiles of the boundary
  std::vector<CustomStart> custom;  // in the order in which they act
  std::optional<FormulaFill> formula;
  std::vector<RefinementCriterion> criteria;
  ExchangeSettings exchange;                      // among the fluids
  PairCoefficients momentum_of_all, heat_of_all;  // with the solids, as decks count
  models::ModelList models;
  std::vector<models::AddedHeat> added_heat;
  DrivingForce driving_force;
  Location advection_where, cfl_where, scheme_where, gravity_where;

  // Drag so strong in every pair that all materials move together (one_velocity_coefficient).
  bool one_velocity() const;
  // Courant number that the deck says, or the default: 0.8 for explicit steps of one inviscid fluid
  // along one direction of one level, where the error is the same at half the steps
  // (docs/accuracy.md), 0.4 otherwise.
  double courant_number(const Scene& scene) const;
  // The material whose weight makes the hydrostatic pressure: the one marked, or the only one.
  const IceMaterial& surrounding() const;
};

// Adds errors and warnings to `faults`.
IceScene read_ice_scene(const Deck& deck, const Scene& scene, std::vector<Fault>& faults);

}  // namespace sluice::ice
