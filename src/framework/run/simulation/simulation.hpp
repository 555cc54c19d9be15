// A run from start (or checkpoint) to end: the step loop and everything it keeps and tells.
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/run/analysis/analysis_recorder.hpp"
#include "framework/run/component/event_ledger.hpp"
#include "framework/run/component/run_report.hpp"
#include "framework/run/component/succession.hpp"
#include "framework/run/component/time_control.hpp"
#include "framework/run/simulation/energy_guard.hpp"
#include "framework/run/simulation/level_history.hpp"
#include "framework/run/simulation/output_writer.hpp"
#include "framework/run/simulation/parted_bodies.hpp"
#include "framework/run/simulation/progress.hpp"

namespace sluice {

struct RunOptions {
  std::filesystem::path parent = ".";  // -o DIR
  bool output = true;                  // --no-output
  int threads = 1;
  bool force_all = false;
  RunLimits limits;
  ProgressMode progress = ProgressMode::automatic;
  std::string program;   // "sluice 0.1.0"
  std::string deck_xml;  // the deck as run
  // Decks that it names, by the names of files that it has for them.
  std::map<std::string, std::string> other_decks;
  // Files that these decks name, by the names under which the archive keeps them.
  std::map<std::string, std::filesystem::path> kept_files;
  // Components that take over from the first, in the order of their turns.
  std::vector<Successor> successors;
  std::filesystem::path restart;   // archive to go on from; empty: start anew
  int restart_step = -1;           // -1: the last checkpoint
  bool copy_earlier = false;       // copy earlier outputs instead of referring to them
  IntVec3 block{};                 // extents of a block; 0: chosen
  std::int64_t max_box_cells = 0;  // splits boxes of adaptive levels above so many; 0: no limit
  // Is shown the state at the start, s; not after a restart. Collective.
  std::function<void(Hierarchy&, double time)> look_at_start;
  // For tests: plants a NaN into a cell of the state at the start of a step.
  std::optional<std::pair<int, IntVec3>> plant_nan;
};

class ArchiveStep;

class Simulation {
 public:
  Simulation(const Scene& scene, const Component& component, Communicator& communicator,
             RunOptions options);
  ~Simulation();

  // To the end. Failures of the physics are reported (status failed), with a checkpoint of the last
  // good state; bad input and system failures are thrown.
  RunReport run();

 private:
  void start();
  void restart_from(const ArchiveStep& checkpoint);
  StepLimit limit_at_restart(const std::map<std::string, std::string>& kept);
  void step();
  // A run of several components, one after another.
  bool is_next_due() const;
  void hand_over();
  void turn_to(std::size_t number);
  void turn_to_component_of(const std::map<std::string, std::string>& kept);
  void check_saves_of_successors() const;
  std::unique_ptr<Hierarchy> empty_hierarchy(const Scene& scene, const Component& component) const;
  std::vector<Label> labels_to_store(const StepPlan& plan) const;
  StepPlan advance(StepPlan plan, CycleResult& result);
  // What the energies of the attempts at a step have come to.
  struct EnergyAttempts {
    double gain = 0;                         // of the attempt before; 0: none was refused
    bool refused = false, hopeless = false;  // the last one; and so would be any other
  };
  bool judge_energies(const StepPlan& plan, const std::vector<double>& sums,
                      EnergyAttempts& attempts, std::string& reason);
  void tell_energies();
  void record_energies(const StepPlan& plan, const std::vector<double>& sums);
  double min_spacing() const;
  void record(const StepPlan& plan, const std::vector<double>& sums);
  void keep(const StepPlan& plan, const StepEnd& end);
  void prepare_next(const StepPlan& plan, const StepEnd& end);
  void act_on_switches(const std::vector<double>& sums);
  void sample_levels();
  void flush_samples();
  static std::vector<std::string> conserved_names(const Component& component);
  Totals totals();
  void set_totals(bool at_start);
  StepInfo step_info() const;
  RunReport report() const;
  double momentum_of_all_energy() const;
  [[noreturn]] void fail(const StepPlan& plan, const CycleResult& result);
  std::string text_of_failure(const StepPlan& plan, const CycleResult& result) const;
  [[noreturn]] void fail_unsound(const StepPlan& plan, const CycleResult& result);
  void plant_nan(IntVec3 cell);
  void write_last_good_checkpoint();
  std::string text_of_nothing_left() const;

  const Scene* scene_;          // of the component that runs now
  const Component* component_;  // likewise
  Communicator* communicator_;
  RunOptions options_;
  std::size_t running_ = 0;  // 0: the first component, n: the n-th successor
  RunControl control_;
  TimeControl time_;
  std::unique_ptr<Hierarchy> hierarchy_;
  std::unique_ptr<AnalysisRecorder> analysis_;
  LevelHistory level_history_;
  std::unique_ptr<OutputWriter> output_;
  std::unique_ptr<Progress> progress_;
  EventLedger ledger_;
  Conservation conservation_;
  EnergyGuard energies_;
  SeparatedBodies parted_;
  Conservation tracked_;  // beside what is conserved: its "sources" alone
  StepStart step_start_;
  StepLimit limit_;
  RunStatus status_ = RunStatus::running;
  std::string message_;
  int steps_ = 0, last_checkpoint_step_ = -1;
  std::int64_t particle_updates_ = 0;  // of this rank
  double start_seconds_ = 0, stepping_seconds_ = 0;
  MessageCounts messages_;  // of this rank, likewise while steps were taken
  bool state_is_sound_ = true;
};

}  // namespace sluice
