// What the laws of burning say of a surface and of a cell, whichever law a model has.
#pragma once
#include "models/models.hpp"

namespace sluice::mpmice {

inline constexpr double seen_volume = 0.2;  // fluids that fill less of a cell do not count as hot

// Of the fluid at a piece of surface, and of the particle behind it.
struct AtSurface {
  double pressure = 0;
  double hottest = 0;            // of the fluid there and the particle, K
  double solid_temperature = 0;  // of the particle
  double density = 0;            // of the particle
};

// The law of surface and flame, where a model has one.
inline const models::SteadyBurn* surface_and_flame(const models::SolidBurn& burn) {
  if (const auto* unsteady = std::get_if<models::UnsteadyBurn>(&burn.law)) return unsteady;
  return std::get_if<models::SteadyBurn>(&burn.law);
}

// Does a law burn surfaces; else whole particles.
inline bool burns_surfaces(const models::SolidBurn& burn) {
  return std::holds_alternative<models::SimpleBurn>(burn.law) || surface_and_flame(burn) != nullptr;
}

// Is the temperature of the fluid around the cell asked too, or only where the cell has little.
inline bool looks_around(const models::SolidBurn& burn) {
  return surface_and_flame(burn) != nullptr;
}

// Heat per mass that the product gets beside what the mass brings with it.
inline double heat_of_reaction(const models::SolidBurn& burn) {
  if (const auto* simple = std::get_if<models::SimpleBurn>(&burn.law)) return simple->heat;
  if (const auto* steady = surface_and_flame(burn)) return steady->heat();
  if (const auto* exchange = std::get_if<models::MassExchange>(&burn.law))
    return exchange->by_pressure ? exchange->by_pressure->heat : 0.0;
  return 0;
}

// A surface that remembers nothing; no flux: it does not burn.
inline models::SteadyBurn::Surface steady_surface(const models::SolidBurn& burn,
                                                  const AtSurface& at) {
  if (const auto* simple = std::get_if<models::SimpleBurn>(&burn.law);
      simple != nullptr && simple->burns(at.pressure, at.hottest))
    return {0, simple->flux(at.pressure)};
  if (const auto* steady = surface_and_flame(burn);
      steady != nullptr && steady->burns(at.pressure, at.hottest))
    return steady->surface(at.pressure, at.solid_temperature, at.density);
  return {};
}

}  // namespace sluice::mpmice
