// Which fine cells of a rank are interpolated, and from where their coarse cells come.
#pragma once
#include <vector>

#include "framework/refine/region_exchange.hpp"

namespace sluice {

// The fine cells to interpolate in one box of a level, by box.
using FineRegions = std::vector<std::vector<IndexBox>>;
// `width` layers around every box that no box of the level holds, inside the domain; once where
// arrays are shared.
FineRegions interface_ghosts(const Level& fine, int width, Arrays arrays);
// What no earlier box held.
FineRegions new_cells(const Level& fine, const std::vector<GridBox>& earlier);

struct InterpolationPlan {
  InterpolationPlan(const Level& coarse, int coarse_ghosts, const Level& fine,
                    const FineRegions& regions, int rank);

  // A coarse box (or a periodic image of it) that holds cells near a fine box.
  struct Holder {
    int box = 0, number = -1, owner = 0;  // `number`: the local one, or -1
    IntVec3 shift{};                      // to the cells of the box
    // Without and with ghost layers, and with those that every box fills alike; all shifted to the
    // fine box.
    IndexBox cells, filled, trusted;
  };
  // Coarse cells that come from one place.
  struct Source {
    IndexBox cells;               // in the indices of the target
    int box = -1;                 // local coarse box, or -1: from another rank
    IntVec3 shift{};              // to the cells of `box`
    PackedMessages::Piece piece;  // where box is -1
  };
  struct Target {
    int box = 0;             // local fine box
    IndexBox cells, coarse;  // `coarse`: with one layer around
    int direct = -1;         // a local coarse box that holds all of `coarse`, or -1: gather
    IntVec3 shift{};         // to the cells of `direct`
    std::size_t first_source = 0, last_source = 0;
  };
  struct Send {
    int box = 0;  // local coarse box
    IndexBox cells;
    PackedMessages::Piece piece;
  };

  Level coarse, fine;  // without boxes
  TransferGeometry geometry;
  std::vector<Target> targets;  // first those that need no message
  std::size_t without_messages = 0;
  std::vector<Source> sources;
  std::vector<Send> sends;
  PackedMessages messages;
  std::int64_t max_coarse_cells = 0;  // of one target
  std::int64_t coarse_cells_of_all = 0;
  std::int64_t fine_cells = 0;

 private:
  IndexBox coarse_cells_of(const IndexBox& cells) const;
  // Where the coarse cells of a target in `box` come from, on this rank (sources) or by its help
  // (sends). True when the target waits for messages.
  bool find_sources(Target& target, const GridBox& box, const std::vector<Holder>& holders);
  int rank = 0;
};

}  // namespace sluice
