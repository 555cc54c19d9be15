// The deck's <AMR>: how many levels, how they follow the solution, how they are stepped and joined.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/scene/geometry_reader.hpp"
#include "framework/scene/grid_settings.hpp"

namespace sluice {

// A region that is always refined, up to a level.
struct RefinedRegion {
  std::string name;
  PiecePtr piece;
  int finest_level = 1;
};

// Refine where the estimated error of a variable exceeds a tolerance.
struct ErrorCriterion {
  std::string label;
  int material = 0;
  double tolerance = 0;  // share of the variable's range over the domain
  Location where;
};

// Refine around the interfaces of a material, up to a level.
struct InterfaceCriterion {
  int material = -1;    // -1: of every one
  double distance = 0;  // m
  int finest_level = 1;
  Location where;
};

// What a deck's own finer <Level> covers, in its cells.
struct StartBoxes {
  IntVec3 ratio{1, 1, 1};  // to the next coarser level
  std::vector<IndexBox> boxes;
};

struct RefinementSettings {
  bool adaptive = false;      // a regridder works
  bool lock_step = false;     // all levels take the same step
  int max_levels = 1;         // with static levels: as many as the deck has
  std::vector<IntVec3> tile;  // by level; level 0 unused
  IntVec3 stability_dilation{1, 1, 1}, regrid_dilation{}, deletion_dilation{1, 1, 1};
  IntVec3 min_boundary_cells{1, 1, 1};
  int max_interval = 50;  // coarse steps between regrids; 0: by flags only
  int min_interval = 1;
  bool once = false;                    // only at the start
  int interpolation_order = 1;          // of new cells
  int interface_order = 1;              // of ghost cells where levels meet
  bool reflux = true;                   // honoured by the classic scheme only
  std::vector<StartBoxes> start_boxes;  // with a regridder: of level 1 and finer
  std::vector<RefinedRegion> regions;
  std::vector<ErrorCriterion> errors;
  std::vector<InterfaceCriterion> interfaces;
  double balance_gain = 0.05;  // least gain for which boxes change ranks: share of the work
  Location where, reflux_where;
};

// Reads <AMR> (and <LoadBalancer>) and adds the levels that a regridder may make to `grid`, without
// boxes. Adds faults: ratios other than 1, 2, 4; tiles that do not fit; what is not built.
RefinementSettings read_refinement(const DeckNode& root, GridSettings& grid,
                                   const std::array<bool, 3>& active, std::vector<Fault>& faults);

}  // namespace sluice
