// What a physics component offers to the run loop.
//
// The run loop owns grids, warehouses, graphs, time and archives; a component declares its state,
// its tasks and its outputs, fills boundaries, and turns what a step reduced into the next step.
#pragma once
#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "framework/base/exact_sum.hpp"
#include "framework/field/warehouse.hpp"
#include "framework/refine/coverage.hpp"
#include "framework/refine/flux_register.hpp"
#include "framework/refine/transfer_operators.hpp"
#include "framework/refine/volume_faces.hpp"
#include "framework/run/component/body_energy.hpp"
#include "framework/run/component/conservation.hpp"
#include "framework/run/component/step_shape.hpp"
#include "framework/scene/output_switch.hpp"
#include "framework/task/effect.hpp"
#include "framework/task/reductions.hpp"
#include "framework/task/schedule.hpp"
#include "framework/task/task.hpp"
#include "framework/task/thread_team.hpp"

namespace sluice {

// The next step that the physics allows, and what limits it.
struct StepLimit {
  double dt = 0;
  std::string reason;
};

// Totals over the cells of this rank.
struct Totals {
  std::vector<ConservedTotal> mass;     // by material, kg
  ConservedTotal momentum[3];           // kg m/s
  ConservedTotal internal_energy;       // J
  ConservedTotal kinetic_energy;        // J
  std::vector<double> tracked_totals;   // Component::tally_names, since the start; of all ranks
  std::vector<ConservedTotal> amounts;  // what else the component carries, in its own order
  // What the last sweep over each level summed, over levels and ranks; empty before the first.
  std::vector<double> sweep_sums;
};

// What came in through the boundary in one accepted step, and what forces and sources added.
struct StepBalance {
  std::vector<double> mass;
  std::vector<double> mass_of_sources;  // by material; empty: none
  Vec3 momentum{}, momentum_of_forces{};
  double energy = 0, energy_of_forces = 0;
};

// Totals of the conserved quantities at the start of a step, over all ranks.
struct StepStart {
  std::vector<double> mass;
  Vec3 momentum{};
};

// Which of the graphs of a step is to be declared.
struct StepVariant {
  int level = 0;        // index; spacing, domain and boundary are that level's
  bool masked = false;  // slopes vanish where the mask slot is zero (a redone step)
  // With several levels: where fluxes are recorded and which cells count in sums. Both outlive the
  // graph; what they hold changes when boxes are laid out anew. Null with one level.
  const FluxRecorder* recorder = nullptr;
  const LevelCoverage* coverage = nullptr;
  int kind = 0;  // of the blocks that the graph is for: see Component::step_kinds
  // Control volumes whose exchange is summed, see Component::first_volume_sum; likewise.
  const VolumeFaces* volumes = nullptr;
};

// A variable whose estimated error decides on refinement: two diagnostic labels.
struct ErrorEstimate {
  Label value, estimate;
  int material = 0;
  double tolerance = 0;  // largest estimate, as a share of the range of the value over the domain
};

// Cells that no row kernel finds (those that hold particles, those that a material's interface
// passes), and how far around them a finer level is wanted.
struct FlagSeeds {
  std::vector<IntVec3> cells;  // in the boxes of this rank
  double distance = 0;         // length, the same on every level
};

class LevelSolver;
class ParticleCloud;
class ParticleMethod;
class Communicator;

class Component {
 public:
  virtual ~Component() = default;

  virtual std::string name() const = 0;
  virtual const EffectList& effects() const = 0;
  virtual int material_count() const = 0;

  // The conserved state: what steps advance, halos exchange and checkpoints keep.
  virtual std::vector<SlotInfo> state_slots() const = 0;
  // The labels under which checkpoints keep the components of each slot.
  virtual std::vector<std::vector<Label>> checkpoint_labels() const = 0;
  virtual void initialise(Warehouse& state) const = 0;
  // Ghost cells outside the domain, after the halo point has filled the others (on a finer level
  // also those at its interface). The level is state.level(). `sums`: of the coarsest level.
  virtual void fill_boundary(Warehouse& state, double time, std::span<const double> sums,
                             const ThreadTeam& team) const = 0;
  // What the boundary needs to know of all cells of the coarsest level, whoever holds them: exact
  // sums, taken whenever its ghosts are filled and good for the finer levels until the next time.
  // 0: nothing is summed, no message is sent.
  virtual int boundary_sums() const { return 0; }
  virtual void add_boundary_sums(const Warehouse& /*state*/, std::span<ExactSum> /*sums*/) const {}

  // Tasks of a step. Every label that can be saved from within a step is declared as an output.
  // With a recorder, a task marked `always` records the conserved fluxes of the faces that it
  // names, and sums count uncovered cells only.
  virtual void declare_step(TaskList& list, const StepVariant& variant) const = 0;
  // Kinds of blocks, each with a graph of its own (StepVariant::kind): a block that holds one
  // material alone need not know of the others. The last kind is the general one, right for every
  // block and taken by all with force_all; the others only leave out work whose result is known, so
  // that no choice changes a bit of the state, of reductions, of fluxes recorded (all quantities
  // are recorded by each kind) or of step labels. Graphs of kinds that do not occur are not made.
  virtual int step_kinds() const { return 1; }
  // The kind of a block: a function of the old state alone, in the block and all ghost layers
  // around it. Asked in every step; Warehouse::any_nonzero is made for it.
  virtual int step_kind(const Warehouse& /*old_state*/, int /*local_box*/,
                        const IndexBox& /*cells_with_halo*/) const {
    return 0;
  }
  // What a state slot or step label that a kind's graph does not write holds throughout a block of
  // that kind after the step; nothing: it is left as it is. Asked with several kinds only.
  virtual std::optional<double> absent_value(Label /*label*/, int /*material*/,
                                             int /*kind*/) const {
    return 0.0;
  }
  // Nodes of a step of a level before its ghost cells are filled: where particles are exchanged and
  // projected into the interior of level.state() (which is then to be touched). A coarse step may
  // be attempted several times: what lasts beyond it goes to the journal, in all ranks alike. Asked
  // for when levels come or go, not when their boxes change.
  virtual Schedule before_sweep(LevelSolver& /*level*/) const { return {}; }
  // Stages of a step that all levels take together (in lockstep); none: exchange, sweep, take over,
  // each level for itself. Asked for when levels come or go.
  virtual void shape_step(StepShape& /*shape*/) const {}
  // Cell fields beside the state that a stage of the step writes and sweeps read as old state, with
  // its ghosts: neither exchanged with it, nor kept, nor carried to the next step.
  virtual std::vector<SlotInfo> work_slots() const { return {}; }
  // Ghost cells of one of them outside the domain, when the others are filled.
  virtual void fill_work_boundary(Warehouse& /*state*/, Label /*label*/,
                                  const ThreadTeam& /*team*/) const {}
  // Tasks that compute saved labels from a state alone (read as old state, with ghosts).
  virtual void declare_diagnostics(TaskList& list, int level) const = 0;
  // What happens where levels meet.
  virtual const TransferOperators& transfer() const = 0;
  // How many cells before its end a level is to know of it, by direction; 0: need not.
  virtual IntVec3 interface_depth(const Level& /*level*/) const { return {}; }
  // The diagnostic label that is 1 in cells that ask for refinement.
  virtual Label refine_flag() const = 0;
  // Criteria that need to know the range of a variable over all levels and ranks.
  virtual std::vector<ErrorEstimate> error_estimates() const { return {}; }
  // Criteria that are no diagnostic of a state; as many on every rank.
  virtual std::vector<FlagSeeds> flag_seeds(const Warehouse& /*state*/) const { return {}; }
  virtual Label mask_label() const = 0;
  // The particles that the scene has; null: none, and nothing of them is made.
  virtual const ParticleMethod* particles() const { return nullptr; }
  virtual int reduction_maxima() const = 0;
  virtual int reduction_sums() const = 0;
  // Where the sums of control volumes begin among these (VolumeSums, a tail as long as the scene
  // has volumes); -1: this scene keeps no account of them. A component that keeps it sums in the
  // segments of StepVariant::volumes what passes, in the uncovered cells inside what forces add.
  virtual int first_volume_sum() const { return -1; }

  // May a block of uniform state sleep: nothing in the scene acts on uniform states.
  virtual bool skipping_allowed() const = 0;
  // And of one kind, where it may.
  virtual bool may_be_skipped(int /*kind*/) const { return true; }
  // Cells that a wave crosses in one step at its limit: flags are widened so that finer levels keep
  // it between two looks.
  virtual double courant_number() const = 0;
  // Does a limit of the step shrink with the square of the spacing.
  virtual bool diffusive() const { return false; }

  // Rates of a state, as the reductions of a step hold them (for the first step and restarts).
  virtual void measure_rates(const Warehouse& state, Reductions& rates) const = 0;
  virtual StepLimit step_limit(const std::vector<double>& maxima) const = 0;

  // Over the uncovered cells.
  virtual void add_totals(const Warehouse& state, const LevelCoverage& coverage,
                          Totals& totals) const = 0;
  virtual void add_particle_totals(const ParticleCloud& /*particles*/, Totals& /*totals*/) const {}
  // From the reduced sums of a step of length dt that began with these totals; `start` is null with
  // several levels: then the sums hold all that forces need.
  virtual StepBalance balance(const std::vector<double>& sums, const StepStart* start,
                              double dt) const = 0;
  // What a run counts beside what is conserved, from start to end and over restarts; names for
  // checkpoints, and what an accepted step with these sums adds to each.
  virtual std::vector<std::string> tracked_names() const { return {}; }
  virtual std::vector<double> tracked_totals(const std::vector<double>& /*sums*/) const {
    return {};
  }
  // What a tally follows, as far as it follows a total; and what a report says of them, by name.
  virtual std::vector<ConservedTotal> tallied_totals(const Totals& /*totals*/) const { return {}; }
  virtual std::vector<std::pair<std::string, double>> budget(
      const Conservation& /*tallies*/) const {
    return {};
  }
  // Bodies whose energy is watched, from the sums of a step, always in the same order; none: no
  // energy is. Where in an attempted step a body has gained most, for a message (collective).
  virtual std::vector<BodyEnergy> body_energies(const std::vector<double>& /*sums*/) const {
    return {};
  }
  virtual std::string place_of_gain(const ParticleCloud& /*cloud*/, int /*material*/,
                                    Communicator& /*ranks*/) const {
    return "";
  }
  // What a deck would take for their energies to be kept better, "<...> ..."; "": it has it.
  virtual std::string better_for_energy() const { return ""; }
  // New intervals of outputs that the scene may come to, and whether a step with these sums has
  // come to the n-th.
  virtual std::vector<OutputSwitch> output_switches() const { return {}; }
  virtual bool passes_switch(std::size_t /*n*/, const std::vector<double>& /*sums*/) const {
    return false;
  }
  // Labels of .dat histories and their values.
  virtual double history_value(Label label, const Totals& totals) const = 0;
  virtual Vec3 history_vector(Label label, const Totals& totals) const = 0;

  // "density", "internal energy": what a fault's kind means, with its unit and allowed range.
  virtual std::string describe_fault(int kind) const = 0;
};

// Ghost layers that every state slot gets: as many as the one that asks for most.
inline int halo_width(const Component& component) {
  int width = 0;
  for (const SlotInfo& s : component.state_slots()) width = std::max(width, s.ghosts);
  return width;
}

}  // namespace sluice
