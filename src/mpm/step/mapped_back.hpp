// Velocities that particles give back to nodes once more within a step, on one level: of them
// gradients are taken (MUSL, and the midpoint transfer: SolidLevels::map_back).
#pragma once
#include <vector>

#include "mpm/step/contact_stage.hpp"
#include "mpm/step/level_nodes.hpp"
#include "mpm/step/sum_bounds.hpp"

namespace sluice::mpm {

// How far particles and corners go at most in half a step of the midpoint transfer, cells: windows
// reach no farther.
inline constexpr double farthest_middle = 0.5;

// Where the velocities that were mapped back are read: the places of the middle of the step in the
// midpoint transfer, else those of its start.
std::array<const double*, 3> places_of_gradients(const BlockWork& work, const Columns& columns,
                                                 bool middle);
// Corners that particles carry are those of the middle of the step; the shape of others is that of
// its start, so that a gradient that is constant in a particle is read as it is.
ParticleShape shape_of_gradients(const BlockWork& work, const Columns& columns, bool middle);

// How far corners may be from their particle at the middle of a step, cells.
double extent_of_middle(const MpmScene& solids, const Body& body);

class MappedBack {
 public:
  // Keeps references. `contact`: null without rules.
  MappedBack(const MpmScene& solids, const LevelNodes& nodes, std::vector<Body>& bodies,
             const ContactStage* contact);

  // Sums of new velocities; `bounds` of these, by body, of all ranks.
  void sum(std::span<const BlockWork> work, const LevelSpacings& spacings,
           std::span<const KindRates> bounds);
  // Once ranks and levels agree: sums become velocities, with what contact and sides give.
  void finish();

  // Sums, then v - v_ref, 1 where there is mass | ., .
  NodeLanes& of(int body) { return lanes_[static_cast<std::size_t>(body)]; }
  const NodeLanes& of(int body) const { return lanes_[static_cast<std::size_t>(body)]; }
  const SumUnits& units(int body) const { return units_[static_cast<std::size_t>(body)]; }

 private:
  void give(const BlockWork& work, Window& window, bool shared);
  void hold_met(int m);
  void hold_boundary(int m);

  const MpmScene* solids_;
  const LevelNodes* nodes_;
  std::vector<Body>* bodies_;
  const ContactStage* contact_;
  std::vector<NodeLanes> lanes_;
  std::vector<SumUnits> units_;
};

}  // namespace sluice::mpm
