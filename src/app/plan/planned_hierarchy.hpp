// The levels that a run will begin with, what decides where they lie, and how they are stepped.
//
// With a regridder the first levels are found as the run finds them: the initial state is set and
// flagged, level by level, until the hierarchy settles. No step is taken.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/loading/scene_loader.hpp"

namespace sluice {

struct PlannedLevel {
  Level level;  // with the boxes of the start; none when they are not known
  IntVec3 tile{};
  int substeps = 1;        // in a coarse step
  double share() const;    // of the domain, 0 to 1
  double updates() const;  // of cells, in a coarse step
};

// A rule of the deck: for people, with the line that says so.
struct PlannedRule {
  std::string what;
  std::string value;
  Location where;
};

struct PlannedHierarchy {
  bool adaptive = false;
  bool known = true;                 // the boxes of the finer levels
  std::vector<PlannedLevel> levels;  // all that may ever exist
  std::string stepping;              // "W-cycle" or "lockstep"
  std::string cycle;                 // one line a node of a coarse step
  std::vector<PlannedRule> criteria, rules;
  std::optional<StepLimit> limit;  // over all levels

  // Those that the run begins with.
  std::vector<Level> grid() const;
  // Of cells, in a coarse step.
  double updates() const;
  double uniform_updates() const;  // everywhere as fine as the finest of them
};

// `max_cells`: a coarsest level with more is not set and flagged.
PlannedHierarchy plan_hierarchy(const LoadedScene& loaded, int ranks, int threads,
                                std::int64_t max_cells);

}  // namespace sluice
