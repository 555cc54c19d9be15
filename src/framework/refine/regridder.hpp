// The Tiled regridder: from flagged cells to the tiles, and from tiles to the boxes, of each level.
//
// Tiles are part of the problem (they decide what is refined), boxes are not: tiles are merged into
// boxes as large as storage, threads and ranks allow. All work here is on integers and the same on
// every rank.
//
// Flags of level l are widened twice, each time in cells of level l. By the stability dilation: as
// long as tiles of level l + 1 cover that, nothing happens. By stability and regrid dilation: what
// new tiles cover. Existing tiles stay while a flag lies within the deletion dilation beyond that,
// or lay there few steps ago. Tiles of level l + 1 with a margin of min_boundary_cells cells of
// level l ask for tiles of level l in turn: levels nest properly.
//
// Flags are looked at between coarse steps. In that time a wave crosses up to courant * P cells of
// level l, P being the steps of level l in a coarse step (one on level 0; with subcycling the
// product of the ratios below it). The stability dilation is what the deck says, or that many whole
// cells where they are more: shocks that outrun their level cost accuracy (1.7 times the error of
// the uniform fine grid on four levels of ratio 4, 0.98 with the wider one). In lockstep a wave
// crosses at most one cell of the finest level a step: there the regrid dilation of level l is
// divided by the ratios of the levels between l and the finest one that is widened, rounded up.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "framework/grid/level.hpp"
#include "framework/refine/flag_field.hpp"
#include "framework/refine/regrid_state.hpp"
#include "framework/refine/tile_layout.hpp"
#include "framework/scene/refinement_settings.hpp"

namespace sluice {

class Regridder {
 public:
  // `levels`: every level that may exist, coarse to fine (those that are adaptive without boxes).
  // `courant`: cells that a wave crosses in one step of its level.
  Regridder(const RefinementSettings& settings, const std::vector<Level>& levels, int ranks,
            int threads, double courant = 0);

  const RegridState& state() const { return state_; }
  // InputError when the state has tiles that these levels do not.
  void restore(const RegridState& state);
  bool adaptive() const { return settings_.adaptive; }
  // Is it time to look at flags after this coarse step at all.
  bool looks_at(int step) const;

  // New tiles from the flags of the levels 0 .. finest that exists (flags of level l ask for level
  // l + 1). True when the hierarchy changes. It is laid anew when flags ask for more than is
  // covered, when the interval ran out, or when tiles that nothing asks for have cost as much as a
  // coarse step, which is what laying it anew may cost. Keeps counters for what is no longer asked
  // for (hysteresis); to be called after every coarse step that is looked at.
  bool regrid(int step, const std::vector<FlagField>& flags);
  // The same at the start of a run, whatever the interval. Tiles are only added, so that repeating
  // it with the flags of the levels that came about ends.
  bool regrid_at_start(const std::vector<FlagField>& flags);

  // The boxes of a level for the present tiles: merged, and split so that every rank gets some;
  // owners by cells.
  std::vector<GridBox> boxes(int level) const;
  // Splits boxes above so many cells, in whole tiles: results must not depend on it.
  void limit_boxes(std::int64_t max_cells) { max_cells_ = max_cells; }
  // Cells of all tiles of a level.
  std::int64_t cells(int level) const;
  IndexBox tile_cells(int level, IntVec3 tile) const;
  const TileLayout& layout(int level) const { return layouts_[level]; }

 private:
  using Flags = std::vector<FlagField>;   // by level, of its cells
  using Fields = std::vector<FlagField>;  // by level, of its tiles; none of level 0

  std::size_t flagged_levels(const Flags& flags) const;
  IntVec3 stability_reach(std::size_t level) const;
  IntVec3 regrid_reach(std::size_t level, const Flags& flags) const;
  // Tiles that flags widened by the regrid reach and `further` ask for, fine to coarse, each set
  // changed by `change` before its margin asks for coarser tiles.
  template <class Change>
  Fields asked(const Flags& flags, IntVec3 further, Change&& change) const;
  FlagField asked_by_margin(std::size_t level, const FlagField& tiles) const;
  bool lacks(const Flags& flags) const;
  void find_present();
  void count_cells();
  void count_idle(const Fields& living);
  Fields lasting() const;
  bool wasteful() const;
  bool take(Fields tiles);

  RefinementSettings settings_;
  std::vector<Level> levels_;
  std::vector<TileLayout> layouts_;  // by level; that of level 0 unused
  std::vector<std::int64_t> cells_;  // of all tiles, by level
  double courant_ = 0;
  int ranks_ = 1, threads_ = 1;
  std::int64_t max_cells_ = 0;  // of a box; 0: no limit
  RegridState state_;
  Fields present_;  // its tiles
};

}  // namespace sluice
