// Sources of the block CFD/ICE: ADD_HEAT and fixedPressureGradient.
#pragma once
#include <vector>

#include "framework/base/vec3.hpp"
#include "framework/deck/deck.hpp"
#include "models/sources/added_heat.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::ice {

// A force per volume, the same everywhere: what a constant pressure gradient along a channel would
// do to fluid whose own pressure is periodic.
struct DrivingForce {
  Vec3 force{};  // N/m^3
  Location where;
  bool on() const { return !(force == Vec3{}); }
};

std::vector<TagSpec> body_source_tags();
void check_body_sources(const DeckNode& root, std::vector<Fault>& faults);

// From the block CFD/ICE of a deck that has been checked.
std::vector<models::AddedHeat> read_added_heat(const DeckNode& ice);
DrivingForce read_driving_force(const DeckNode& ice);

}  // namespace sluice::ice
