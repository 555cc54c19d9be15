// Which material each cluster of grains gets: a velocity field of its own, while there are any.
//
// The rules, for clusters from the largest to the smallest, equal ones by label:
// 1. A cluster stays in the material that has most of its particles, if contacts act on that and no
//    larger one stays there: when a body parts, its largest part keeps the material.
// 2. Those left get the first material without cluster, of those on which contacts act.
// 3. Then one whose clusters are all far on the grid: with no node in common they are as good as in
//    materials of their own. The one that it is in comes first.
// 4. Then the one that it is in, else the first without cluster, of those on which no contact acts.
// 5. Then they stay where they are, near another cluster in one velocity field: what grains did
//    without the method. Such clusters are counted.
#pragma once
#include <cstdint>
#include <set>
#include <tuple>
#include <vector>

#include "framework/base/vec3.hpp"
#include "mpm/deck/mpm_scene.hpp"

namespace sluice::mpm {

// A part of the grid: clusters have no node in common when no parts of theirs are neighbours.
using GridPart = std::tuple<int, int, int>;

// Parts at least `width` cells wide; neighbours through periodic sides too. Places in m.
class GridParts {
 public:
  GridParts(const Level& level, int width);
  GridPart of(Vec3 place) const;
  // The part itself is among its neighbours.
  std::vector<GridPart> around(const GridPart& part) const;

 private:
  const Level* level_;
  IntVec3 count_{1, 1, 1};
};

struct Cluster {
  std::int64_t label = 0, size = 0;
  int home = 0;              // the material with most of its particles
  std::set<GridPart> parts;  // asked for only where there are more clusters than materials
};

struct SlotChoice {
  std::vector<int> slots;      // by cluster
  std::int64_t near_ones = 0;  // clusters by rule 5
};

// Do clusters fit into materials of their own without asking where they are.
bool all_fit(std::size_t clusters, const GrainFamily& family);

// `family` has those materials alone that take part now.
SlotChoice choose_slots(const std::vector<Cluster>& clusters, const GrainFamily& family,
                        const GridParts& parts);

}  // namespace sluice::mpm
