// What the laws of burning say of a surface and of a cell, whichever law a model has.
#pragma once
#include "models/models.hpp"

namespace sluice::mpmice {

// Of the fluid at a piece of surface, and of the particle behind it.
struct AtSurface {
  double pressure = 0;
  double hottest = 0;            // of the fluid there and the particle, K
  double solid_temperature = 0;  // of the particle
  double density = 0;            // of the particle
};

// Does a law burn surfaces; else whole particles.
inline bool burns_surfaces(const models::SolidBurn& burn) {
  return std::holds_alternative<models::SimpleBurn>(burn.law) ||
         std::holds_alternative<models::SteadyBurn>(burn.law);
}

// Is the temperature of the fluid around the cell asked too, or only where the cell has little.
inline bool looks_around(const models::SolidBurn& burn) {
  return std::holds_alternative<models::SteadyBurn>(burn.law);
}

// Heat per mass that the product gets beside what the mass brings with it.
inline double heat_of_reaction(const models::SolidBurn& burn) {
  if (const auto* simple = std::get_if<models::SimpleBurn>(&burn.law)) return simple->heat;
  if (const auto* steady = std::get_if<models::SteadyBurn>(&burn.law)) return steady->heat();
  if (const auto* exchange = std::get_if<models::MassExchange>(&burn.law))
    return exchange->by_pressure ? exchange->by_pressure->heat : 0.0;
  return 0;
}

// Mass per area and time.
inline double surface_flux(const models::SolidBurn& burn, const AtSurface& at) {
  if (const auto* simple = std::get_if<models::SimpleBurn>(&burn.law))
    return simple->burns(at.pressure, at.hottest) ? simple->flux(at.pressure) : 0.0;
  if (const auto* steady = std::get_if<models::SteadyBurn>(&burn.law))
    return steady->burns(at.pressure, at.hottest)
               ? steady->surface(at.pressure, at.solid_temperature, at.density).flux
               : 0.0;
  return 0;
}

}  // namespace sluice::mpmice
