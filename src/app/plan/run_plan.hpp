// What a run will do and cost, found before it from the scene and the compiled graphs alone.
//
// Of a run on one level no field is allocated; adaptive levels are found by setting the initial
// state.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/loading/scene_loader.hpp"
#include "app/plan/best_settings.hpp"
#include "app/plan/planned_cost.hpp"
#include "app/plan/planned_hierarchy.hpp"
#include "app/plan/planned_memory.hpp"
#include "app/plan/planned_particles.hpp"
#include "framework/run/component/run_report.hpp"
#include "framework/run/component/succession.hpp"
#include "framework/run/component/time_control.hpp"

namespace sluice {

struct PlanOptions {
  int ranks = 1;
  int threads = 1;
  bool force_all = false;
  bool output = true;  // --no-output
  int max_steps = 0;   // 0: to the end of the deck
  IntVec3 block{};
  std::int64_t max_cells_for_limits = 20'000'000;  // more: the first step is not predicted
  std::int64_t max_cells_for_levels = 2'000'000;   // more: adaptive levels are not predicted
};

struct PlannedOutput {
  std::string label;
  std::string made;            // how: "stored in the step", "from the state", "history"
  double bytes_per_cell = 0;   // in the archive, of all its materials
  int materials = 1;           // that are saved
  double memory_per_cell = 0;  // bytes
  double bytes = 0;            // in the archive, of what is not in cells
  Location where;
};

struct PlannedLimit {
  std::string rule;
  std::string value;
  std::string acts;  // "sets the first step", or empty
};

// A component of a switcher.
struct PlannedPart {
  std::string component, deck;
  int after = 0;  // steps of the run before its turn
  // Behind the first, by kind of particles; and what its <init> and the deck's <carry_over> name.
  std::vector<PassedOn> passed_on;
  std::vector<std::string> named;
};

struct RunPlan {
  std::string deck, title, component;
  std::vector<PlannedPart> parts;  // in turn; all that follows is of the first
  IntVec3 cells;
  std::int64_t cell_count = 0;  // of all levels at the start, as far as known
  std::int64_t coarse_cells() const { return std::int64_t{1} * cells.x * cells.y * cells.z; }
  int boxes = 0, blocks = 0, ranks = 1, threads = 1;
  PlannedHierarchy hierarchy;
  PlannedParticles particles;
  std::array<ActiveDirection, 3> directions;
  std::vector<EffectCost> effects;
  std::vector<int> effect_fields;
  std::vector<int> kind_tasks;  // of a step of each kind of blocks; the last is the general one
  IntVec3 halo{};               // ghost layers that a step reads
  PlannedMessages messages;
  int reductions = 1;  // of a step of one level by itself
  BestSettings best;   // of solids; without reasons: nobody asked
  std::vector<PlannedOutput> outputs;
  std::string output_times, checkpoint_times;
  double output_bytes = 0, checkpoint_bytes = 0;  // of one
  bool skipping_allowed = false;
  std::string skipping_reason;
  Location skipping_where;
  std::vector<PlannedLimit> limits;
  std::optional<StepLimit> physics;  // of the first step
  std::optional<double> first_dt;    // s
  std::string first_dt_reason;
  double estimated_steps = 0;  // how many
  PlannedCost cost;
  PlannedMemory memory;
  std::string dot;
};

RunPlan plan_run(const LoadedScene& loaded, const PlanOptions& options);

// Of a plan that is otherwise complete; not known where the first step is not.
PlannedCost cost_of(const RunPlan& plan, const LoadedScene& loaded, int max_steps);

// For people and for scripts.
std::string plan_text(const RunPlan& plan);
std::string plan_json(const RunPlan& plan);

}  // namespace sluice
