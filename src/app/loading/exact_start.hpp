// Whether a run starts from what its deck's <exact_solution> says of that time: an error against
// the exact solution of another problem is a number that means nothing.
#pragma once
#include <optional>

#include "framework/deck/deck.hpp"

namespace sluice {

class Hierarchy;
class Communicator;

// A warning with the worst cell; none where they agree, where the deck names no exact solution, or
// where one quantity is not known to both. `hierarchy`: initialised, at `time` (s). Collective; the
// warning is complete on rank 0.
//
// Density, pressure and velocity of a cell agree when they lie in the range that the exact solution
// has within a cell's width around the centre, widened by 2 % of the largest magnitude: that allows
// for means over cells and for jumps within a cell. A start that disagrees in at most 1 % of the
// cells (or two) is taken as one with a point source, whose cells no exact solution has.
std::optional<Fault> exact_start_fault(const DeckNode& root, Hierarchy& hierarchy,
                                       Communicator& ranks, double time);

}  // namespace sluice
