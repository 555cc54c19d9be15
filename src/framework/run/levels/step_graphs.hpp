// The compiled task graphs of a level, and what they have cost.
//
// Variants (which labels are stored this step, slopes masked or not) are compiled when first needed
// and kept, also when the level is laid out anew.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/run/component/component.hpp"
#include "framework/run/levels/level_states.hpp"
#include "framework/run/levels/solver_options.hpp"
#include "framework/task/sweep_executor.hpp"

namespace sluice {

class StepGraphs {
 public:
  StepGraphs(const Component& component, LevelStates& states, const Communicator& ranks,
             const SolverOptions& options);
  ~StepGraphs();

  // What graphs store beside the state.
  Warehouse& outputs() { return outputs_; }
  const Warehouse& outputs() const { return outputs_; }
  bool is_step_label(Label label) const;
  bool is_diagnostic_label(Label label) const;

  // Where the level meets others; tables and boxes of finer levels belong to the caller.
  void join(const FluxRecorder& recorder, LevelCoverage coverage);
  const LevelCoverage& coverage() const { return coverage_; }
  // Control volumes on the boxes as they are now.
  void watch(VolumeFaces volumes) { volumes_ = std::move(volumes); }
  // The states have other boxes.
  void lay_out();

  // Graphs that store the labels `stored`, which are sorted, bound to the states as they are:
  // of a step (with slopes masked), of a step without its new state, of the labels of a state.
  SweepExecutor& step(bool masked, const std::vector<Label>& stored);
  SweepExecutor& preparation(const std::vector<Label>& stored);
  SweepExecutor& diagnostics(const std::vector<Label>& stored);

  // What was spent so far.
  std::vector<double> effect_seconds() const;  // by effect
  // Tasks of the plain step, by effect: the most of any kind of block that occurred.
  std::vector<int> effect_tasks() const;
  std::vector<double> effect_doubles() const;  // doubles a cell of state, old and new, by effect
  std::vector<double> box_seconds() const;     // by local box, since the level was laid out
  std::int64_t blocks_run() const;
  std::int64_t blocks_run(int kind) const;
  std::int64_t blocks_skipped() const;
  std::int64_t cells_skipped() const;
  std::size_t bytes() const;  // outputs and scratch

 private:
  struct Variant;
  // What a graph is compiled for.
  enum class Purpose { step, preparation, diagnostics };
  struct Key {
    Purpose purpose = Purpose::step;
    bool masked = false;
    std::vector<Label> stored;
    friend auto operator<=>(const Key&, const Key&) = default;
  };
  // Outputs of a list of tasks, and their labels, sorted.
  struct Outputs {
    std::vector<Variable> variables;
    std::vector<Label> labels;
  };

  SweepExecutor& bound(Key key);
  std::unique_ptr<Variant> make(const Key& key);
  SweepGraph graph_of(const TaskList& list, const Key& key) const;
  std::vector<AbsentSlot> absent_slots(const TaskList& list, const Key& key, int kind) const;
  SweepOptions sweep_options(const Key& key) const;
  bool chooses_kinds() const;
  // The plain step; null: it was not asked for yet.
  const Variant* plain() const;
  template <class Count>
  std::int64_t sum_over_steps(Count count) const;

  const Component* component_;
  LevelStates* states_;
  const Communicator* ranks_;
  SolverOptions options_;  // with a team
  Warehouse outputs_;
  FluxRecorder recorder_;
  LevelCoverage coverage_;
  VolumeFaces volumes_;
  Outputs step_, diagnostics_;
  std::map<Key, std::unique_ptr<Variant>> variants_;
  int layout_ = 0;  // counts the calls of lay_out and join
  int boxes_ = 0;   // counts the calls of lay_out
};

}  // namespace sluice
