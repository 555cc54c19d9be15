// Initial states that a deck names by their kind (customInitialization): vortices, profiles,
// manufactured solutions. Formulas are in ice/start/custom_start.cpp. SI units; heights are above
// the low side of the domain; directions 0, 1, 2 are x, y, z.
#pragma once
#include <optional>
#include <variant>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/grid/level.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::ice {

// A Gaussian vortex about an axis, cut off at its radius.
struct Vortex {
  Vec3 origin{};  // m
  // C: m^2/s in the pressure, kg/(m s) in the velocity; m.
  double strength = 0, radius = 1;
  int axis = 2;
};
struct Vortices {
  std::vector<Vortex> list;
};
struct VortexPairs {    // across the domain, side by side
  double strength = 0;  // largest velocity, m/s
  int axis = 0, pairs = 1;
};
// Directions of pairs in the plane normal to their axis: from side to side, and side by side.
struct PairDirections {
  int across, along;
};
inline PairDirections directions_of(const VortexPairs& pairs, const Level& coarsest) {
  const int b = (pairs.axis + 1) % 3, c = (pairs.axis + 2) % 3;
  const auto periodic = [&](int d) { return coarsest.periodic[d]; };
  return periodic(b) && !periodic(c) ? PairDirections{c, b} : PairDirections{b, c};
}

struct GaussianTemperature {
  Vec3 origin{};                                     // m
  double spread_x = 1, spread_y = 1, amplitude = 0;  // m, m, K
};
struct ManufacturedVortices {  // mms_1: travelling vortices of Taylor and Green at time 0
  double amplitude = 1;        // m/s
};
struct ManufacturedCells {  // mms_3: cells in three dimensions
  double angle = 0;         // rad
};
struct Counterflow {         // two jets that meet in the middle
  double strain_rate = 0;    // 1/s
  IntVec3 reference_cell{};  // of level 0: the pressure there is that of reference
};
struct LogLawProfile {
  int vertical = 2, flow = 0;
  double friction_velocity = 0, roughness = 1, von_karman = 0.4;  // m/s, m, without unit
};
struct PowerLawProfile {
  int vertical = 2;
  double height = 1, exponent = 1;  // m, without unit
  Vec3 velocity{};                  // above the profile, m/s
};
struct ChannelProfile {  // powerLawProfile2: turbulent channel, logarithmic from both walls
  int vertical = 2, flow = 0;
  double reynolds = 1, half_height = 1;  // of friction velocity and half height; m
  std::optional<double> floor, ceiling;  // coordinates of the walls, m; none: the domain's
};
struct LaminarChannel {  // DNS_Moser: parabola of a pressure gradient
  int vertical = 2;
  double pressure_gradient = 0;  // Pa/m
};

using CustomStart = std::variant<Vortices, VortexPairs, GaussianTemperature, ManufacturedVortices,
                                 ManufacturedCells, Counterflow, LogLawProfile, PowerLawProfile,
                                 ChannelProfile, LaminarChannel>;

// The tags of customInitialization, its formulas left out.
std::vector<TagSpec> custom_start_tags();
// In the order in which they act: the last of the deck first.
std::vector<CustomStart> read_custom_starts(const DeckNode& custom_initialization);

}  // namespace sluice::ice
