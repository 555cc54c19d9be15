// What a run tells when it ends.
#include "framework/base/json.hpp"
#include "framework/base/memory.hpp"
#include "framework/run/simulation/simulation.hpp"

namespace sluice {
namespace {

std::vector<EffectCost> costs_of(const EffectList& effects, const StepGraphs& graphs,
                                 const std::vector<double>& seconds) {
  const std::vector<int> tasks = graphs.effect_tasks();
  const std::vector<double> doubles = graphs.effect_doubles();
  std::vector<EffectCost> costs;
  for (int e = 0; e < effects.size(); ++e)
    costs.push_back(
        {effects[e], tasks[e], doubles[e] * static_cast<double>(sizeof(double)), seconds[e]});
  return costs;
}

}  // namespace

RunReport Simulation::report() const {
  RunReport r;
  r.status = status_;
  r.message = message_;
  if (output_ != nullptr) r.archive = output_->archive_folder();
  r.steps = steps_;
  r.last_step = time_.state().step;
  r.last_checkpoint = last_checkpoint_step_;
  r.time = time_.state().time;
  r.cells = hierarchy_->levels().cell_count();
  r.ranks = communicator_->size();
  r.threads = options_.threads;
  r.wall_seconds = control_.wall_seconds();
  r.stepping_seconds = stepping_seconds_;
  r.start_seconds = start_seconds_;
  r.output_seconds = output_ != nullptr ? output_->seconds() : 0.0;
  r.peak_memory_bytes = peak_resident_bytes_of_all(*communicator_);
  r.step_limit = limit_.reason;
  r.levels = hierarchy_->costs();
  if (const ParticleCloud* particles = hierarchy_->particles()) r.particles = particles->counts();
  r.regrids = hierarchy_->regridding().count();
  r.regrid_seconds = hierarchy_->regridding().seconds();
  r.balances = hierarchy_->balancing().count();
  r.balance_seconds = hierarchy_->balancing().seconds();
  for (const LevelCost& level : r.levels) r.cell_updates += level.updates;
  std::vector<double> seconds(component_->effects().size(), 0.0);
  for (int l = 0; l < hierarchy_->levels().possible(); ++l) {
    const LevelSolver& solver = hierarchy_->level(l);
    r.blocks_run += solver.graphs().blocks_run();
    r.blocks_skipped += solver.graphs().blocks_skipped();
    r.updates_skipped += solver.graphs().cells_skipped();
    const std::vector<double> own = solver.graphs().effect_seconds();
    for (std::size_t e = 0; e < own.size(); ++e) seconds[e] += own[e];
  }
  Reduction of_all;
  const auto run = of_all.add_count(r.blocks_run), asleep = of_all.add_count(r.blocks_skipped),
             updates = of_all.add_count(r.updates_skipped),
             particles_moved = of_all.add_count(particle_updates_),
             sends = of_all.add_count(messages_.sends.calls),
             bytes_sent = of_all.add_count(messages_.sends.bytes);
  communicator_->reduce(of_all);
  r.blocks_run = of_all.count(run);
  r.blocks_skipped = of_all.count(asleep);
  r.updates_skipped = of_all.count(updates);
  r.particle_updates = of_all.count(particles_moved);
  r.messages = messages_;
  r.messages.sends = {of_all.count(sends), of_all.count(bytes_sent)};
  r.particles_alone = component_->particles() != nullptr && component_->state().slots().empty();
  r.stages = hierarchy_->coarse_step().stage_costs();
  r.effects = costs_of(component_->effects(), hierarchy_->level(0).graphs(), seconds);
  r.events_json = ledger_.to_json().dump();
  r.conservation_json = conservation_.to_json().dump();
  r.worst_drift = conservation_.worst_drift();
  r.budget = component_->budgets().budget(tracked_);
  r.solids_json = energies_.to_json().dump();
  r.solids_text = energies_.summary(component_->budgets().better_for_energy()) + parted_.summary();
  r.energy_scale = conservation_.scale(component_->material_count() + 3);
  return r;
}

}  // namespace sluice
