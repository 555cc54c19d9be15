// What an attempt at a step came to, over all ranks: maxima, sums, inadmissible cells.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/base/reduction.hpp"
#include "framework/run/component/run_control.hpp"
#include "framework/run/levels/level_states.hpp"
#include "framework/task/reduction_layout.hpp"
#include "framework/task/reductions.hpp"

namespace sluice {

struct StepAttempt {
  // As StepFacet::reductions() numbers them, in the component's units; rates in 1/s.
  std::vector<double> maxima;  // over all ranks
  std::vector<double> sums;    // over all ranks, exact
  std::int64_t faults = 0;     // inadmissible cells, over all ranks
  CellFault first_fault;       // the lowest of them
  RunControl::Answer control;  // clock and signals, agreed upon in the same message
};

// A cell of the state that is not a number.
struct UnsoundCell {
  CellFault where;  // kind: the slot
  Label label;
};

class StepReduction {
 public:
  // `layout`: of the component, which must live as long.
  StepReduction(Communicator& ranks, const ReductionLayout& layout)
      : ranks_(&ranks), layout_(&layout) {}

  // One message; `control` may be null. Sums of stages are 0. Collective. Throws std::logic_error
  // where a sweep has added to them.
  const StepAttempt& reduce(const Reductions& local, const RunControl* control);
  const StepAttempt& result() const { return result_; }

 private:
  Communicator* ranks_;
  const ReductionLayout* layout_;
  Reduction reduction_;
  StepAttempt result_;
};

// The lowest cell of a state that is not a finite number, over all ranks: no smaller step can help
// it. Collective.
std::optional<UnsoundCell> first_unsound_cell(const LevelStates& states, Communicator& ranks);

}  // namespace sluice
