// From a plan to what decides its costs.
#include "app/plan/run_plan.hpp"

namespace sluice {
namespace {

// A pressure solve from rest begins with the step of sound; those of its flow are this much longer.
constexpr double from_rest_gains = 50;
constexpr double history_line_bytes = 45;  // of one label and step

double history_bytes(const RunPlan& plan, double steps) {
  double bytes = 0;
  for (const PlannedOutput& o : plan.outputs)
    if (o.made == "history, one line per step") bytes += steps * history_line_bytes;
  return bytes;
}

// Of a tag of a block of the deck; empty where there is none.
std::string text_at(const LoadedScene& loaded, const char* block, const char* tag) {
  const DeckNode* node = loaded.deck.root->child(block);
  node = node == nullptr ? nullptr : node->child(tag);
  return node == nullptr ? "" : node->text;
}

CostedRun costed(const RunPlan& plan, const LoadedScene& loaded) {
  CostedRun run;
  run.component = plan.component;
  run.dimensions = 0;
  for (const ActiveDirection& d : plan.directions) run.dimensions += d.active ? 1 : 0;
  run.cells = static_cast<double>(plan.cell_count);
  run.cell_updates = plan.hierarchy.updates();
  run.levels = plan.hierarchy.levels.size() > 1;
  for (const PlannedKind& k : plan.particles.kinds) run.particles += static_cast<double>(k.count);
  run.output_bytes = plan.output_bytes;
  run.checkpoint_bytes = plan.checkpoint_bytes;
  for (const EffectCost& e : plan.effects)
    if (e.effect.on) run.effects.push_back(e.effect.name);
  run.interpolator = text_at(loaded, "MPM", "interpolator");
  run.skipping = plan.skipping_allowed;
  run.from_rest = plan.physics->reason.find("from rest") != std::string::npos;
  run.ranks = plan.ranks;
  run.threads = plan.threads;
  return run;
}

}  // namespace

PlannedCost cost_of(const RunPlan& plan, const LoadedScene& loaded, int max_steps) {
  if (!plan.physics) return {};
  const CostedRun run = costed(plan, loaded);
  // With levels the first step is one of the finest, the others have all of its substeps.
  const int substeps = run.levels ? plan.hierarchy.levels.back().substeps : 1;
  const bool fluid = run.component == "ice" || run.component == "mpmice";
  const double change = run.from_rest ? from_rest_gains : fluid ? 1 / fluid_speeds_up : 1;
  const double dt = plan.physics->dt * substeps * change;
  PlannedCost cost = planned_cost(run, planned_steps(loaded.scene, dt, max_steps));
  cost.outputs_bytes += history_bytes(plan, cost.steps.steps);
  return cost;
}

}  // namespace sluice
