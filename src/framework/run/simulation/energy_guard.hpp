// Watches the energy of bodies: what a step makes of it by numerical error alone.
//
// The kick of step n takes velocities from v- to v+, which stand in the middle of the steps before
// and behind the time of the stored energy U^n. What the leapfrog conserves to the bit is
//
//   H^n = m v- . v+/2 + U^n,  numerical gain of step n: g = H^n - H^(n-1) - W,
//
// W: work of everything but the stress, of each impulse J the part J . v-/2 in its own step and
// J . v+/2 in the next. What happens to particles between steps is not counted. Neither kinetic nor
// potential energy of one time alone would do: their sum swings with omega dt. Steps of unequal
// length a and b: m v- . v+/2 is (1 - s) K(v-) + s K(v+) - s (1 - s) m |v+ - v-|^2, s = a/(a + b).
//
// H says nothing of modes that are unstable, omega dt > 2: their kinetic part is negative. Those
// show in
//
//   D^n = m |v+ - v-|^2/6 + (U^(n+1) - 2 U^n + U^(n-1))/12 = (omega dt)^2/6 of the energy,
//
// which is steady and small for modes that the grid resolves and grows in every step with an
// unstable one. (Of v+ - v- what loads and contact make is left out.) Of one amplitude H is less by
// omega^2 a b/4 of the energy: a step of another length than the one before, as the last one of a
// run, may change it by up to 3/2 D, which is taken off what a run has gained.
//
// A step whose g, or whose growth of a large and growing D, is above `max_step_gain` of the scale,
// the largest energy or work of the body so far, is to be redone with half its length, and steps
// stay shorter for a while after that. What a shorter step does not lessen has come with the step
// before and is let pass; but steps grow shorter as long as bodies gain, and after `max_halvings`
// the run is to end.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/run/component/body_energy.hpp"

namespace sluice {

class Json;

class EnergyGuard {
 public:
  // Shares of the scale.
  static constexpr double max_step_gain = 1e-3;  // the step is redone
  static constexpr double max_run_gain = 5e-3;   // an event: of H
  static constexpr double large_growth = 0.03;   // D over the scale, of a growing mode
  static constexpr double max_growth = 0.3;      // the same, where one step of growth is enough
  static constexpr double max_run_loss = 0.1;    // an event
  static constexpr int max_halvings = 8;

  struct Excess {
    int body = 0;                // in the order of the step's bodies
    double gain = 0, scale = 0;  // J
  };
  // Of a run so far: a body beyond one of its limits, and since which step.
  struct Crossing {
    int material = 0;
    bool gains = true;
    int since = 0;
    double share = 0;  // of the scale
  };

  // The body that gains most above the limit of a step; nothing: the step may be accepted.
  // `dt`: s. `spacing`: the smallest of the finest level, m; energies of velocities below 1e-8 of
  // it a step are round-off.
  std::optional<Excess> judge(const std::vector<BodyEnergy>& step, double dt, double spacing) const;
  // Books the step. Bodies keep their order.
  void accept(const std::vector<BodyEnergy>& step, int number, double dt, double spacing);
  std::vector<Crossing> crossings() const;
  // A step has gained too much: it and those to come are shorter. False: they were so already.
  bool shorten();
  // By what the length that the physics allows is to be multiplied.
  double factor() const { return factor_; }

  // {name: {scale, gain, gain_share, largest_step_gain, first_step_of_gain, ...}}
  Json to_json() const;
  // One line for each body that has passed a limit.
  std::string summary(std::string_view better) const;
  bool any() const { return !budgets_.empty(); }

  // Exact state for a checkpoint.
  Json checkpoint() const;
  void restore(const Json& json);

 private:
  struct BodyBudget {
    std::string name;
    int material = 0;
    int steps = 0;         // booked; at most 2
    double carried = 0;    // part of the energy of the next step that this one made, less its work
    double rise = 0;       // U^n - U^(n-1)
    double growth = 0;     // D
    double record = 0;     // largest D over the scale, slowly forgotten
    int streak = 0;        // steps in which D was large and grew
    double dt = 0;         // of the step before
    double work = 0;       // likewise
    double swing = 0;      // by what a change of its length changed H at most
    double most = 0;       // largest energy
    double work_in = 0;    // positive work and heat so far
    double gain = 0;       // sum of g
    double max_swing = 0;  // largest swing so far
    double slack = 0;      // sum of slacks of contact
    double worst = 0;      // largest g of a step, as a share
    int gained_since = 0, lost_since = 0;  // step; 0: not beyond the limit
  };
  struct Change {
    double gain = 0, carried = 0, rise = 0, growth = 0, scale = 0;
    double swing = 0;   // by what a change of the length of the step changes H at most
    double unjust = 0;  // of the gain, what no change of the step's length explains
    double more = 0;    // of D, where it is large and grows
    double of_scale(double x) const { return scale > 0 ? x / scale : 0; }
  };
  static double run_gain_of(const BodyBudget& a);
  static double scale_of(const BodyBudget& a) { return a.most > a.work_in ? a.most : a.work_in; }
  static Change change(const BodyBudget& budget, const BodyEnergy& step, double dt, double spacing);

  std::vector<BodyBudget> budgets_;
  double factor_ = 1;
  int patience_ = first_patience, left_ = 0;  // accepted steps until the factor may grow
  static constexpr int first_patience = 64;
};

}  // namespace sluice
