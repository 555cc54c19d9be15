// Levels that follow the solution: flags, new boxes, and what must be renewed behind them.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "framework/refine/regridder.hpp"
#include "framework/run/levels/ghosts_in_time.hpp"
#include "framework/run/levels/level_rates.hpp"
#include "framework/run/levels/particle_cloud.hpp"
#include "framework/run/levels/refinement_flags.hpp"

namespace sluice {

class Regridding {
 public:
  // `particles`: null without any.
  Regridding(const Scene& scene, const Component& component, const SolverOptions& options,
             Communicator& communicator, Levels& levels, GhostsInTime& ghosts, LevelRates& rates,
             ParticleCloud* particles);

  // False: the levels stay where the deck lays them.
  bool adaptive() const { return regridder_.has_value(); }
  // One pass at the start of a run, which may add one level; false: nothing was to be done.
  bool add_level_at_start(double time);
  // New levels where flags ask for them, after an accepted coarse step. True when boxes changed.
  bool regrid(int step, double time);
  // The levels of a checkpoint; their states are to be filled by the caller.
  void restore(const RegridState& state);
  std::string state() const;  // for checkpoints; empty: not adaptive

  int count() const { return count_; }         // of regrids
  double seconds() const { return seconds_; }  // wall time of them

 private:
  int flagging_levels() const;
  int read_levels() const;
  std::vector<FlagField> flags(double time);
  int lay_out(bool from_deck, double time);
  void return_memory();

  const Scene* scene_;
  Communicator* communicator_;
  Levels* levels_;
  GhostsInTime* ghosts_;
  LevelRates* rates_;
  ParticleCloud* particles_;
  std::optional<Regridder> regridder_;
  RefinementFlags flags_;
  std::size_t max_bytes_ = 0;  // of all levels since memory was returned to the system
  int count_ = 0;
  double seconds_ = 0;
};

}  // namespace sluice
