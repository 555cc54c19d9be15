// All levels of a run in time: their start, coarse steps, regrids, outputs, checkpoints.
#pragma once
#include <memory>
#include <vector>

#include "framework/run/component/grid_fields.hpp"
#include "framework/run/component/run_report.hpp"
#include "framework/run/levels/balancing.hpp"
#include "framework/run/levels/coarse_step.hpp"
#include "framework/run/levels/ghosts_in_time.hpp"
#include "framework/run/levels/level_rates.hpp"
#include "framework/run/levels/levels.hpp"
#include "framework/run/levels/particle_cloud.hpp"
#include "framework/run/levels/regridding.hpp"

namespace sluice {

class ArchiveStep;

class Hierarchy {
 public:
  Hierarchy(const Scene& scene, const Component& component, Communicator& communicator,
            const SolverOptions& options);
  Hierarchy(const Hierarchy&) = delete;
  Hierarchy& operator=(const Hierarchy&) = delete;

  const Component& component() const { return *component_; }
  const Levels& levels() const { return levels_; }
  int level_count() const { return levels_.count(); }
  LevelSolver& level(int l) { return levels_[l]; }
  const LevelSolver& level(int l) const { return levels_[l]; }
  LevelRates& rates() { return rates_; }
  const LevelRates& rates() const { return rates_; }
  CoarseStep& coarse_step() { return coarse_step_; }
  const CoarseStep& coarse_step() const { return coarse_step_; }
  const Regridding& regridding() const { return regridding_; }
  const Balancing& balancing() const { return balancing_; }
  // Null when there are none.
  const ParticleCloud* particles() const { return particles_.get(); }

  // The state at the start: levels are added until the hierarchy settles.
  void initialise();
  // The state of a checkpoint, on its hierarchy. Throws InputError where it does not fit.
  void restore(const ArchiveStep& checkpoint);
  // The state of a hierarchy of another component on levels like these, between two steps: all that
  // is of particles, and what was spent. Collective.
  void succeed(const Hierarchy& earlier);

  // One attempt at a coarse step; labels in `wanted` are stored in its last substeps.
  const CycleResult& attempt(int step, double time, double dt, const std::vector<Label>& wanted,
                             const RunControl& control, EventLedger& ledger);
  void accept();
  void reject() { coarse_step_.reject(); }
  // New levels where flags ask for them, after an accepted coarse step. True when boxes changed.
  bool regrid(int step);
  // Moves boxes to other ranks where that makes the busiest rank faster.
  bool balance(int step);

  // Ghost cells of all levels at the end of a coarse step.
  void fill_ghosts(double time) { ghosts_.fill_all(time); }
  void compute_diagnostics(double time, const std::vector<Label>& wanted);
  void add_totals(Totals& totals) const;
  // Fields that particles have on the grid, by level. Collective.
  std::vector<GridFields> particle_fields(const std::vector<Label>& labels,
                                          const ParticleCloud::Wanted& wanted);
  // Particles that lag behind in the box they came from go to their own, before they are written.
  void settle_particles();
  std::vector<LevelCost> costs() const;

 private:
  void advance_particles();

  const Scene* scene_;
  const Component* component_;
  Communicator* communicator_;
  Levels levels_;
  std::unique_ptr<ParticleCloud> particles_;
  GhostsInTime ghosts_;
  LevelRates rates_;
  CoarseStep coarse_step_;
  Regridding regridding_;
  Balancing balancing_;
  std::vector<LevelCost> costs_;
  double end_ = 0;   // of the coarse step under way
  double time_ = 0;  // of the states between steps
};

}  // namespace sluice
