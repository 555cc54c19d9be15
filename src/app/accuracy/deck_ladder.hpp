// A deck run at several resolutions, and the error bars of all that it saves.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/accuracy/error_bar.hpp"
#include "app/accuracy/quantity.hpp"
#include "framework/deck/deck.hpp"

namespace sluice {

// One resolution.
struct Rung {
  double factor = 1;  // of the cells along each direction, to those of the deck
  IntVec3 cells;      // of the coarsest level
  int steps = 0;
  double seconds = 0;  // wall time of the steps
  std::filesystem::path archive;
  std::string command;  // repeats the run
};

struct QuantityBar {
  Quantity quantity;
  double size = 0;  // mean of its absolute value in the finest run, in its unit
  ErrorBar error;   // of the finest run, relative to that size
};

class DeckLadder {
 public:
  // `folder`: for archives; `overrides`: PATH=VALUE of every run. InputError where the deck has
  // faults or its resolution cannot be scaled.
  DeckLadder(std::filesystem::path executable, std::string deck, std::vector<std::string> overrides,
             std::filesystem::path folder);

  const std::string& title() const { return title_; }
  // Of the coarsest level of the deck itself.
  IntVec3 own_cells() const { return own_cells_; }
  int directions() const;  // with several cells
  // The least number of cells along a direction with several cells.
  int fewest_cells() const;

  // Runs the deck with its cells times `factor`; factors ascend from call to call. Throws
  // PhysicsError where the run does not come to its end.
  const Rung& run(double factor);
  const std::vector<Rung>& rungs() const { return rungs_; }
  double seconds() const;  // of all runs

  // From the last three or four runs, of all quantities that the last one holds. Needs three runs.
  std::vector<QuantityBar> bars() const;
  // Wall time of a run with so many cells, from the last two.
  double predicted_seconds(double factor) const;
  // What sets this resolution, as PATH=VALUE.
  std::vector<std::string> resolution(double factor) const;

 private:
  std::filesystem::path executable_, folder_;
  std::string deck_, title_;
  std::vector<std::string> overrides_;
  Deck read_;
  IntVec3 own_cells_;
  std::vector<Rung> rungs_;
};

// Factors of the runs that say most of a deck's own resolution at the least cost: an eighth, a
// quarter, half and all of it; finer ones where the coarsest would have fewer than eight cells
// along a direction.
std::vector<double> factors_for(int fewest_cells);

}  // namespace sluice
