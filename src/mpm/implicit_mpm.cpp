#include "mpm/implicit_mpm.hpp"

#include "mpm/implicit/implicit_step.hpp"

namespace sluice::mpm {

// The step, as a table.
void ImplicitMpm::shape_step(StepShape& shape) const {
  const auto step =
      std::make_shared<ImplicitStep>(run_scene(), scene(), carried(), particles()->kinds());
  const auto stage = [&](const char* name, Verdict (ImplicitStep::*act)(const StageScope&)) {
    shape.stage(name, [step, act](const StageScope& scope) { return ((*step).*act)(scope); });
  };
  stage("particles to nodes", &ImplicitStep::begin);
  stage("displacements of the nodes: Newton's method", &ImplicitStep::find_displacements);
  if (scene().implicit->conducts) stage("temperatures of the nodes", &ImplicitStep::conduct);
  stage("nodes to particles, deformation, stress", &ImplicitStep::to_particles);
  stage("take over", &ImplicitStep::take_over);
}

StepLimit ImplicitMpm::step_limit(const std::vector<double>& maxima) const {
  const double rate = maxima.empty() ? 0 : maxima.front();
  if (!(rate > 0)) return {1e300, "nothing moves"};
  return {1 / rate, "displacement of particles, iterations of Newton's method"};
}

// What the nodes' own balance lacks is what a_0 of particles is beside that of the forces before.
std::vector<std::pair<std::string, double>> ImplicitMpm::budget(
    const Conservation& tracked_totals) const {
  auto entries = Mpm::budget(tracked_totals);
  entries.back() = {"carried accelerations", -entries.back().second};
  return entries;
}

std::unique_ptr<Mpm> make_solids(const Scene& scene, MpmScene solids) {
  if (solids.implicit) return std::make_unique<ImplicitMpm>(scene, std::move(solids));
  return std::make_unique<Mpm>(scene, std::move(solids));
}

}  // namespace sluice::mpm
