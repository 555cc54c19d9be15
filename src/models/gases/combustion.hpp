// Models "gasCombustion" and "hydrogenBurke": a gas of species that react and spread.
//
//   d(rho Y_k)/dt + div(rho u Y_k) = div(rho D_k grad Y_k) + M_k omega_k
// omega_k: kinetics/rates.hpp, integrated in each cell at constant volume (kinetics/reactor.hpp);
// D_k, mu and lambda of the mixture: kinetics/transport.hpp. The last species, the closure, fills
// up to 1. The gas has the caloric law of its species; gamma and specific_heat of the deck's
// material are not used.
#pragma once
#include <cstddef>
#include <memory>
#include <optional>

#include "framework/field/label.hpp"
#include "kinetics/species_gas.hpp"
#include "models/deck/start_line.hpp"

namespace sluice::models {

inline constexpr std::size_t max_species = 64;

// What a flame starts from, in place of the deck's regions; the fractions have theirs with the
// scalars.
struct FlameStart {
  StartLine temperature, velocity, density, pressure;  // K, m/s along the axis, kg/m^3, Pa
};

struct Combustion {
  std::shared_ptr<const kinetics::SpeciesGas> gas;
  bool reacts = true, diffuses = false;
  // As kinetics::Tolerances: a share, K, a mass fraction.
  double relative_tolerance = 1e-8, temperature_tolerance = 1e-6, fraction_tolerance = 1e-14;
  std::optional<FlameStart> start;
};

// What can be saved of reactions.
struct ReactionLabels {
  Label heat_release;  // HeatReleaseRate, W/m^3
  Label last_step;     // dt_chemistry, s
  Label limiter;       // dt_chemistry_limiter
};
ReactionLabels reaction_labels();

}  // namespace sluice::models
