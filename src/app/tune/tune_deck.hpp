// A solver as tags of a deck: to paste, and written into a copy of the deck's own text.
#pragma once
#include <string>

#include "framework/solve/solver_settings.hpp"

namespace sluice {

// The lines <Solver> and <Parameters> of a solver. `deck`: the settings that it replaces, of which
// what it leaves alone (tolerance, maxiterations) is taken over.
std::string solver_xml(const solve::SolverSettings& solver);

// The text of a deck with the tags of this solver in place of its own: values are replaced, missing
// tags added, every other byte kept. `name`: of the deck, for messages. Throws InputError where the
// block of the solve is not in the text itself (it may come from an <include>).
std::string tuned_deck(const std::string& text, const std::string& name,
                       const solve::SolverSettings& deck, const solve::SolverSettings& solver);

}  // namespace sluice
