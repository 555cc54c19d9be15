// What a run tells when it ends: for people, for run.json and for `--json`.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/base/message_counts.hpp"
#include "framework/run/component/run_status.hpp"
#include "framework/task/effect.hpp"

namespace sluice {

class Json;

struct EffectCost {
  Effect effect;
  int tasks = 0;
  double bytes_per_cell = 0;
  double seconds = 0;  // measured on a sample of blocks, scaled up
};

// Wall time of a stage of all steps on rank 0, the attempts that were rejected too.
struct StageCost {
  std::string name;
  double seconds = 0;
};

// What was spent on a level.
struct LevelCost {
  std::int64_t cells = 0;    // now
  std::int64_t boxes = 0;    // now
  std::int64_t updates = 0;  // cells times substeps of accepted coarse steps
  std::int64_t max_cells = 0;
  std::int64_t domain_cells = 0;  // if it were everywhere
  int substeps = 1;               // in a coarse step
};

// What became of the particles of a kind, over all ranks.
struct ParticleCount {
  std::string name;
  std::int64_t made = 0, left = 0, here = 0;  // made = left + here
};

struct RunReport {
  RunStatus status = RunStatus::running;
  std::string message;  // why it failed; empty otherwise
  std::optional<std::string> archive;
  int steps = 0;             // of this process
  int last_step = 0;         // number of the last step of the run
  int last_checkpoint = -1;  // step of the last checkpoint that this process wrote; -1: none
  double time = 0;           // s
  std::int64_t cells = 0;
  int ranks = 1, threads = 1;
  double wall_seconds = 0;      // of the process's run, set-up and output included
  double stepping_seconds = 0;  // of the steps alone
  double output_seconds = 0;
  double start_seconds = 0;                         // before the first step, outputs aside
  std::uint64_t peak_memory_bytes = 0;              // of all ranks together
  std::int64_t blocks_run = 0, blocks_skipped = 0;  // of all ranks
  std::vector<EffectCost> effects;
  std::vector<StageCost> stages;  // none: the component declares no step of its own
  std::vector<LevelCost> levels;  // coarse to fine
  std::int64_t cell_updates = 0;  // of all levels; of these, cells asleep stayed as they were:
  std::int64_t updates_skipped = 0;
  std::vector<ParticleCount> particles;
  std::int64_t particle_updates = 0;  // particles times steps
  bool particles_alone = false;       // cells carry nothing: work is told by particle
  int regrids = 0;
  double regrid_seconds = 0;
  int balances = 0;  // times that boxes moved to other ranks, regrids aside
  double balance_seconds = 0;
  // While steps were taken, output aside: collectives of rank 0, sends of all ranks together.
  MessageCounts messages;
  std::string step_limit;  // what has set the last step
  std::string events_json = "{}";
  std::string conservation_json = "{}";
  double worst_drift = 0;                              // a share: Conservation::worst_drift
  std::vector<std::pair<std::string, double>> budget;  // Component::account
  double energy_scale = 0;                             // J
  std::string solids_json = "{}";                      // EnergyGuard::to_json
  std::string solids_text;                             // what it has to tell

  double ns_per_cell_step() const;
  double ns_per_particle_step() const;
  // Updates of the same steps on a grid that is everywhere as fine as the finest level was.
  double uniform_updates() const;
};

Json to_json(const RunReport& report);
std::string summary(const RunReport& report);
// A line a stage: time per step, share of the stepping time; empty where there is none.
std::string stages_text(const RunReport& report);
// A line a kind: calls and bytes per step; empty where nothing was sent.
std::string messages_text(const RunReport& report);

}  // namespace sluice
