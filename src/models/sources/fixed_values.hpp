// Model "mass_momentum_energy_src": sources that hold a material at given values in a region.
//
// Where the material fills more than 0.001 of a cell whose centre lies in the region, every step
// that overlaps the time window ends with the density, velocity and temperature of the deck: mass,
// momentum and energy are added or taken as that needs, and counted as sources. Where regions of
// one material overlap the last one holds, as for geometry objects.
#pragma once
#include <string>
#include <vector>

#include "framework/base/vec3.hpp"
#include "framework/deck/deck.hpp"
#include "framework/scene/geometry_reader.hpp"
#include "models/sources/time_window.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::models {

struct FixedValues {
  static constexpr double min_volume_fraction = 1e-3;

  int material = 0;
  PiecePtr region;
  double density = 0;      // of the material itself, kg/m^3
  Vec3 velocity{};         // m/s
  double temperature = 0;  // K
  TimeWindow when;
  Location where;
};

TagSpec fixed_values_tag();
void check_fixed_values(const DeckNode& parameters, const std::vector<std::string>& materials,
                        std::vector<Fault>& faults);
// One for each region.
std::vector<FixedValues> read_fixed_values(const DeckNode& parameters,
                                           const std::vector<std::string>& materials,
                                           const GeometryReader& geometry,
                                           std::vector<Fault>& faults);

}  // namespace sluice::models
