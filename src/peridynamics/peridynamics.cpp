#include "peridynamics/peridynamics.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/faults.hpp"
#include "framework/scene/deck_values.hpp"
#include "peridynamics/deck/read_scene.hpp"
#include "peridynamics/effects.hpp"
#include "peridynamics/start/family_bound.hpp"
#include "peridynamics/step/peri_step.hpp"

namespace sluice::peridynamics {

Peridynamics::Peridynamics(const Scene& scene, PeriScene solids)
    : scene_(scene),
      solids_(std::move(solids)),
      particles_(solids_, scene.grid),
      effects_(effects_of(solids_)) {
  reductions_.add_sums_of_stages(StepSums::count);
  reductions_.add_maxima(1);
  declare_labels();
}

// The step, as a table.
void Peridynamics::declare_stages(StepShape& shape) const {
  const auto step = std::make_shared<PeriStep>(particles_.bonded());
  const auto stage = [&](const char* name, Verdict (PeriStep::*act)(const StageScope&)) {
    shape.stage(name, [step, act](const StageScope& scope) { return ((*step).*act)(scope); });
  };
  const bool state_based = solids_.any(Law::lps), breaks = solids_.breaks();
  stage("half step of velocities; places", &PeriStep::move);
  stage("exchange of displacements", &PeriStep::exchange_displacements);
  if (state_based) {
    stage("dilatations", &PeriStep::sum_dilatations);
    stage("exchange of dilatations", &PeriStep::exchange_dilatations);
  }
  if (breaks && solids_.breaks_before_force)
    stage("bonds that break", &PeriStep::break_before_forces);
  stage("forces of bonds", &PeriStep::sum_forces);
  stage("second half of velocities", &PeriStep::finish_velocities);
  if (breaks && !solids_.breaks_before_force)
    stage("bonds that break; forces of those that are left", &PeriStep::break_bonds);
  stage("take over", &PeriStep::commit);
}

// dt <= sqrt(2 rho/lambda_max(sum V C n n)): theory/peridynamics.md.
StepLimit Peridynamics::limit(const std::vector<double>& maxima) const {
  const double rate = maxima.empty() ? 0 : maxima.front();
  if (!(rate > 0)) return {1e300, "no point has a bond"};
  return {1 / rate, "bonds: sqrt(2 rho/lambda_max(sum V C n n))"};
}

// Of all ranks, as much as one may have at most.
double Peridynamics::array_bytes(const Level& finest) const {
  double points = 0;
  for (int k = 0; k < material_count(); ++k)
    points += static_cast<double>(particles_.count_at_start(k, finest, finest.domain).value_or(0));
  constexpr double bytes_of_bond = 13, bytes_of_point = 330;
  return points * (bytes_of_point + bytes_of_bond * particles_.typical_family());
}

std::unique_ptr<Component> make(const Deck& deck, const Scene& scene, std::vector<Fault>& faults) {
  PeriScene solids = read_peri_scene(deck, scene, faults);
  if (any_error(faults)) return nullptr;
  check_horizons(scene.grid.levels.front(), solids, faults);
  if (any_error(faults)) return nullptr;
  return std::make_unique<Peridynamics>(scene, std::move(solids));
}

}  // namespace sluice::peridynamics
