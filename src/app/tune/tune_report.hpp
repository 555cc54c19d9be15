// What `sluice tune` found, for people and for scripts.
#pragma once
#include <string>
#include <vector>

#include "app/tune/tune_search.hpp"

namespace sluice {

struct TuneReport {
  std::string deck, title;
  solve::SolverSettings own;             // the deck's
  int first_step = 0;                    // after which the run that made the systems began
  int steps = 0;                         // of that run
  double step_seconds = 0;               // of one, with the deck's own solver; 0: not known
  std::vector<int> numbers;              // of the systems kept, in the order of the run
  std::vector<std::size_t> right_sides;  // of each
  std::int64_t unknowns = 0;             // of the last system
  int levels = 1;
  std::size_t ranked_by = 1;         // systems, counted from the last
  double seconds = 0, budget = 0;    // spent and allowed, s
  std::vector<TunedSolver> ranking;  // as TuneSearch::run gives it
  std::vector<ResidualCurve> curves;
  double curve_goal = 0;  // residual as a share of the right-hand side, L2

  const TunedSolver& own_result() const;
  // The fastest that met the goal everywhere; null: none, not even the deck's own.
  const TunedSolver* best() const;
  // Ratio of the time of the deck's own to that of the best, at least 1; 0 where either has failed.
  double gain() const;
  // Two iterations or fewer per solve, on every system: later ones may be others.
  bool easy() const;
  // Is the best worth a change of the deck: faster by more than 5 %, or the deck's own fails.
  bool worth_it() const;
};

std::string tune_text(const TuneReport& report);
std::string tune_json(const TuneReport& report);

}  // namespace sluice
