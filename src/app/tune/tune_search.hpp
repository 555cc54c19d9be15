// The search of `sluice tune`: who is tried on what, within a budget of time.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "app/tune/tune_candidates.hpp"

namespace sluice {

// What became of a solver in the search.
enum class TuneState {
  ranked,     // measured on every system of the ranking
  slow,       // fell behind and left
  failed,     // missed its goal, or refused a system
  not_tried,  // the budget was spent
};

struct TunedSolver {
  solve::SolverSettings settings;
  TuneState state = TuneState::not_tried;
  std::string note;                        // why it failed or left
  std::vector<solve::SolverTrial> trials;  // of each system measured, the fastest
  // Medians over the systems measured; 0 without any.
  double seconds() const;
  double set_up_seconds() const;
  double solve_seconds() const;
  int iterations() const;
  double bytes() const;
};

// A solve of the first right-hand side of the last system to smaller and smaller tolerances.
struct ResidualCurve {
  std::string name;
  std::vector<double> seconds, residuals;  // set-up and solve; share of the right-hand side, L2
};

struct TuneProgress {
  std::string doing;
  int done = 0, all = 0;
  double seconds = 0, left = 0;  // spent; expected until the end
};

class TuneSearch {
 public:
  using Tell = std::function<void(const TuneProgress&)>;
  using Clock = std::function<double()>;  // seconds since the command began

  // `budget`: seconds on that clock at which no new trial starts.
  TuneSearch(const CapturedSystems& systems, std::vector<solve::SolverSettings> candidates,
             Clock clock, double budget, Tell tell);

  // The deck's own is measured whatever the budget. Ranked ones first, fastest first; then those
  // that left, failed, and were not tried.
  std::vector<TunedSolver> run();
  std::size_t systems_done() const { return systems_done_; }  // by which all are ranked
  // The deck's own and the fastest, then others, at most `most` in all; of these none begins after
  // `until` (s) on the clock. `tolerance`: share of the right-hand side, L2.
  std::vector<ResidualCurve> curves(const std::vector<TunedSolver>& ranking, double tolerance,
                                    std::size_t most, double until) const;

 private:
  bool time_left() const { return clock_() < budget_; }
  ResidualCurve curve(const solve::SolverSettings& solver, double tolerance) const;
  void report(const std::string& doing, int done, int all);
  void first_round();
  void all_systems();
  void repeat();
  void leave_behind(double times);
  void first_trial(TunedSolver& solver, double best);
  void measure(TunedSolver& solver, std::size_t system);
  std::vector<TunedSolver*> in_the_race();

  const CapturedSystems& systems_;  // the last one is tried first
  std::vector<TunedSolver> solvers_;
  solve::SolverSettings goal_;
  Clock clock_;
  double budget_;
  Tell tell_;
  std::size_t systems_done_ = 1;
};

}  // namespace sluice
