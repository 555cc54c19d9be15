// Successive halving: everyone on one system, the better ones on all, the best ones again.
// K. Jamieson, A. Talwalkar, Non-stochastic best arm identification and hyperparameter
// optimization, AISTATS (2016).
#include "app/tune/tune_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sluice {
namespace {

using solve::SolverSettings;
using solve::SolverTrial;

constexpr double leaves_at = 2.5;         // times the fastest on the first system
constexpr double stays_until = 1.6;       // times the fastest on several
constexpr int probe_iterations = 5;       // that tell what an iteration costs
constexpr int min_iterations = 20;        // are always allowed
constexpr std::size_t finalists = 5;      // that are measured again
constexpr int max_repeats = 5;            // of each system
constexpr double curve_step = 0.1;        // from tolerance to tolerance
constexpr double worth_repeating = 0.02;  // seconds
constexpr double dear_seconds = 0.1;

template <class F>
double median_of(const std::vector<SolverTrial>& trials, F&& number) {
  std::vector<double> values;
  for (const SolverTrial& t : trials) values.push_back(static_cast<double>(number(t)));
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

}  // namespace

double TunedSolver::seconds() const {
  return median_of(trials, [](const SolverTrial& t) { return t.seconds(); });
}
double TunedSolver::set_up_seconds() const {
  return median_of(trials, [](const SolverTrial& t) { return t.set_up_seconds; });
}
double TunedSolver::solve_seconds() const {
  return median_of(trials, [](const SolverTrial& t) { return t.solve_seconds; });
}
int TunedSolver::iterations() const {
  return static_cast<int>(
      std::lround(median_of(trials, [](const SolverTrial& t) { return t.iterations; })));
}
double TunedSolver::bytes() const {
  return median_of(trials, [](const SolverTrial& t) { return t.bytes; });
}

TuneSearch::TuneSearch(const CapturedSystems& systems, std::vector<SolverSettings> candidates,
                       Clock clock, double budget, Tell tell)
    : systems_(systems),
      goal_(candidates.at(0)),
      clock_(std::move(clock)),
      budget_(budget),
      tell_(std::move(tell)) {
  for (SolverSettings& s : candidates) solvers_.emplace_back().settings = std::move(s);
}

void TuneSearch::report(const std::string& doing, int done, int all) {
  if (!tell_) return;
  const double now = clock_();
  const double expected = done > 0 ? now / done * (all - done) : budget_ - now;
  tell_({doing, done, all, now, std::clamp(expected, 0.0, std::max(0.0, budget_ - now))});
}

std::vector<TunedSolver*> TuneSearch::in_the_race() {
  std::vector<TunedSolver*> list;
  for (TunedSolver& s : solvers_)
    if (s.state == TuneState::ranked) list.push_back(&s);
  std::sort(list.begin(), list.end(),
            [](const TunedSolver* a, const TunedSolver* b) { return a->seconds() < b->seconds(); });
  return list;
}

// Trials of a solver lie in the order in which systems are tried: the last one of the run first.
void TuneSearch::measure(TunedSolver& solver, std::size_t n) {
  const solve::CapturedSystem& system = *systems_[systems_.size() - 1 - n];
  SolverTrial trial = system.attempt(solver.settings, goal_);
  // What takes microseconds is measured often enough that a disturbance does not decide.
  double spent = trial.seconds();
  for (int again = 0; again < 4 && spent < worth_repeating && trial.failure.empty(); ++again) {
    const SolverTrial other = system.attempt(solver.settings, goal_);
    spent += other.seconds();
    if (other.failure.empty() && other.seconds() < trial.seconds()) trial = other;
  }
  if (!trial.failure.empty()) {
    solver.state = TuneState::failed;
    solver.note = trial.failure;
  }
  if (n == solver.trials.size())
    solver.trials.push_back(trial);
  else if (trial.failure.empty() && trial.seconds() < solver.trials[n].seconds())
    solver.trials[n] = trial;
}

// A few iterations first, so that a solver that will lose takes no more than a few times the time
// of the best.
void TuneSearch::first_trial(TunedSolver& solver, double best) {
  const SolverSettings all = solver.settings;
  solver.state = TuneState::ranked;
  SolverSettings few = all;
  few.max_iterations = std::min(all.max_iterations, probe_iterations);
  const solve::CapturedSystem& system = *systems_.back();
  const SolverTrial probe = system.attempt(few, goal_, 1);
  if (!std::isfinite(probe.residual)) {
    solver.state = TuneState::failed;
    solver.note = probe.failure;
    solver.trials.push_back(probe);
    return;
  }
  const double each = probe.solve_seconds / std::max(1, probe.iterations);
  const double allowed = (leaves_at * best - probe.set_up_seconds) / std::max(each, 1e-12);
  solver.settings.max_iterations = static_cast<int>(std::clamp<double>(
      allowed, std::min(min_iterations, all.max_iterations), all.max_iterations));
  measure(solver, 0);
  const bool bounded = solver.settings.max_iterations < all.max_iterations;
  solver.settings = all;
  if (solver.state == TuneState::failed && bounded && std::isfinite(solver.trials[0].residual)) {
    solver.state = TuneState::slow;
    solver.note = "stopped there, much slower";
  }
}

void TuneSearch::first_round() {
  const int all = static_cast<int>(solvers_.size());
  report(short_name(goal_), 0, all);
  solvers_.front().state = TuneState::ranked;
  measure(solvers_.front(), 0);
  double best = solvers_.front().trials[0].seconds();
  for (int n = 1; n < all && time_left(); ++n) {
    TunedSolver& s = solvers_[n];
    report(short_name(s.settings), n, all);
    first_trial(s, best);
    if (s.state == TuneState::ranked) best = std::min(best, s.trials[0].seconds());
  }
  leave_behind(leaves_at);
}

// System by system, fastest first; those that fall behind leave. Where the budget ends within a
// system all are ranked by those before it.
void TuneSearch::all_systems() {
  for (std::size_t n = 1; n < systems_.size(); ++n) {
    const auto race = in_the_race();
    int done = 0;
    for (TunedSolver* s : race) {
      if (!time_left()) {
        for (TunedSolver& other : solvers_)
          if (other.trials.size() > n) other.trials.pop_back();
        return;
      }
      report(fmt::format("{}, system {} of {}", short_name(s->settings), n + 1, systems_.size()),
             done++, static_cast<int>(race.size()));
      measure(*s, n);
    }
    systems_done_ = n + 1;
    leave_behind(stays_until);
  }
}

// The deck's own stays.
void TuneSearch::leave_behind(double times) {
  const auto race = in_the_race();
  for (TunedSolver* s : race) {
    if (s == &solvers_.front() || s->seconds() <= times * race.front()->seconds()) continue;
    s->state = TuneState::slow;
    s->note =
        fmt::format("excluded after {} system{}", systems_done_, systems_done_ == 1 ? "" : "s");
  }
}

void TuneSearch::repeat() {
  for (int again = 1; again < max_repeats; ++again) {
    auto race = in_the_race();
    if (race.size() > finalists) race.resize(finalists);
    TunedSolver* own = &solvers_.front();
    if (own->state == TuneState::ranked && std::find(race.begin(), race.end(), own) == race.end())
      race.push_back(own);
    for (TunedSolver* s : race)
      for (std::size_t n = 0; n < systems_done_; ++n) {
        if (!time_left()) return;
        report(short_name(s->settings) + ", again", again, max_repeats);
        if (s->state == TuneState::ranked) measure(*s, n);
      }
  }
}

std::vector<TunedSolver> TuneSearch::run() {
  first_round();
  all_systems();
  repeat();
  std::vector<TunedSolver> ranking = solvers_;
  std::stable_sort(ranking.begin(), ranking.end(), [](const TunedSolver& a, const TunedSolver& b) {
    if (a.state != b.state) return a.state < b.state;
    return (a.state == TuneState::ranked || a.state == TuneState::slow) &&
           a.seconds() < b.seconds();
  });
  return ranking;
}

// Decade by decade; of solves that take long every other decade.
ResidualCurve TuneSearch::curve(const SolverSettings& solver, double tolerance) const {
  SolverSettings measure;  // share 1 of the right-hand side: what is left is the share itself
  measure.tolerance = 1;
  SolverSettings to = solver;
  to.norm = solve::Norm::two;
  to.absolute_tolerance = 0;
  to.tolerance = 1;
  ResidualCurve curve{short_name(solver), {0.0}, {1.0}};
  double set_up = HUGE_VAL;
  while (to.tolerance > 1.001 * tolerance) {
    const bool dear = curve.seconds.back() > dear_seconds;
    to.tolerance =
        std::max(tolerance, to.tolerance * (dear ? curve_step * curve_step : curve_step));
    SolverTrial trial = systems_.back()->attempt(to, measure, 1);
    for (int again = 0; again < 2 && trial.seconds() < worth_repeating; ++again)
      trial.solve_seconds =
          std::min(trial.solve_seconds, systems_.back()->attempt(to, measure, 1).solve_seconds);
    set_up = std::min(set_up, trial.set_up_seconds);
    if (trial.residual == curve.residuals.back()) continue;  // no further iteration
    curve.seconds.push_back(trial.solve_seconds);
    curve.residuals.push_back(trial.residual);
  }
  // A solve to less does all that a solve to more does: what took longer was disturbed.
  for (std::size_t n = curve.seconds.size() - 1; n-- > 0;)
    curve.seconds[n] = std::min(curve.seconds[n], curve.seconds[n + 1]);
  for (double& s : curve.seconds) s += set_up;
  return curve;
}

std::vector<ResidualCurve> TuneSearch::curves(const std::vector<TunedSolver>& ranking,
                                              double tolerance, std::size_t most,
                                              double until) const {
  std::vector<ResidualCurve> list;
  const std::string own = short_name(goal_);
  for (const TunedSolver& s : ranking)
    if (s.state == TuneState::ranked && short_name(s.settings) == own)
      list.push_back(curve(s.settings, tolerance));
  const std::size_t always = list.size() + 1;  // the fastest beside it
  for (const TunedSolver& s : ranking)
    if (s.state == TuneState::ranked && short_name(s.settings) != own && list.size() < most &&
        (list.size() < always || clock_() < until))
      list.push_back(curve(s.settings, tolerance));
  return list;
}

}  // namespace sluice
