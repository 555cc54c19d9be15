// The guard of energies in the step loop.
#include <fmt/format.h>

#include <algorithm>

#include "framework/run/simulation/simulation.hpp"

namespace sluice {

double Simulation::min_spacing() const {
  const Level& finest = hierarchy_->level(hierarchy_->level_count() - 1).level();
  double least = 0;
  for (int d = 0; d < 3; ++d)
    if (finest.active[d] && (least == 0 || finest.spacing[d] < least)) least = finest.spacing[d];
  return least;
}

// Whether the attempted step may be accepted: no body gained more than an honest scheme may make,
// or a shorter step has not made it less or is not allowed.
bool Simulation::judge_energies(const StepPlan& plan, const std::vector<double>& sums,
                                EnergyAttempts& attempts, std::string& reason) {
  attempts.refused = false;
  const std::vector<BodyEnergy> bodies = component_->budgets().body_energies(sums);
  if (bodies.empty()) return true;
  const std::optional<EnergyGuard::Excess> excess = energies_.judge(bodies, plan.dt, min_spacing());
  if (!excess) return true;
  constexpr double no_less = 0.7;  // of what twice the step gained
  const bool inherited = attempts.gain > 0 && excess->gain > no_less * attempts.gain;
  attempts.gain = excess->gain;
  if (inherited || 0.5 * plan.dt < scene_->time.delt_min) return true;
  const BodyEnergy& body = bodies[excess->body];
  const std::string where =
      component_->budgets().place_of_gain(*hierarchy_->particles(), body.material, *communicator_);
  reason = fmt::format(
      "solid '{}' gains {:.3g} J by numerical error of transfer and integration, {:.2g} of its "
      "energy ({:.3g} J; a step may gain {:g} of it){}. The limits of the time step allowed {:g}, "
      "set by {}. Try a smaller <timestep_multiplier>, another <interpolator>, or look at the "
      "state before this step in the last checkpoint",
      body.name, excess->gain, excess->gain / excess->scale, excess->scale,
      EnergyGuard::max_step_gain, where, limit_.dt, limit_.reason);
  attempts.refused = true;
  attempts.hopeless = !energies_.shorten();
  return false;
}

void Simulation::record_energies(const StepPlan& plan, const std::vector<double>& sums) {
  const std::vector<BodyEnergy> bodies = component_->budgets().body_energies(sums);
  if (!bodies.empty()) energies_.accept(bodies, plan.step, plan.dt, min_spacing());
  parted_.accept(bodies, plan.step, plan.end);
}

// At the end of a run: bodies beyond a limit become events of the step since which they are.
void Simulation::tell_energies() {
  for (const EnergyGuard::Crossing& crossed : energies_.crossings()) {
    EventPlace place;
    place.step = crossed.since;
    place.material = crossed.material;
    place.value = crossed.share;
    ledger_.keep(crossed.gains ? "a solid has gained energy by numerical error"
                               : "a solid has lost energy to transfer and integration",
                 place);
  }
  for (const SeparatedBodies::Parting& parting : parted_.all()) {
    EventPlace place;
    place.step = parting.since;
    place.task = fmt::format("since t = {:g}, share of particles", parting.since_time);
    place.material = parting.material;
    place.value = parting.largest;
    ledger_.keep("numerical fracture: neighbours in a solid hardly share a node", place);
  }
  ledger_.accept_step();
}

}  // namespace sluice
