// Cells of one level that lie in regions which are always refined, each looked at once in a run.
#pragma once
#include "framework/geometry/piece.hpp"
#include "framework/grid/level.hpp"
#include "framework/refine/flag_field.hpp"
#include "framework/scene/refinement_settings.hpp"

namespace sluice {

class RegionFlags {
 public:
  // Regions that ask for a level finer than this one.
  RegionFlags(const std::vector<RefinedRegion>& regions, const Level& level);
  // Flags the cells of a box whose centres lie in a region.
  void add(const IndexBox& cells, FlagField& flags);
  std::int64_t looked_at() const { return looked_at_; }

 private:
  struct Region {
    PiecePtr piece;
    IndexBox cells;    // holds all centres that can lie inside
    FlagField known;   // cells that were asked
    FlagField inside;  // of those
  };
  void look(Region& region, const IndexBox& cells);

  Level level_;  // without boxes
  std::vector<Region> regions_;
  std::int64_t looked_at_ = 0;
};

}  // namespace sluice
