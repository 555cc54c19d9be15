// The shape of a step above single sweeps: halo points, loops, level cycles, and its acceptance.
//
// A schedule is a list of nodes, carried out in order; loops and level cycles hold schedules of
// their own. The unit of acceptance is the coarse step: wherever a node rejects, the whole body of
// the outermost Retry is done again with a smaller step. For that, a step may write only what a
// rejected attempt may leave behind: new state, temporaries, outputs. Everything else that a step
// causes (flux registers, particles, histories, counters, solver set-up, the event ledger) is
// handed to the StepJournal and done when the step is accepted.
#pragma once
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/task/halo.hpp"
#include "framework/task/sweep_executor.hpp"

namespace sluice {

// Where a node runs. The scope of a fine substep knows the coarser step that it is part of.
struct StepScope {
  int level = 0;
  double time = 0;                     // start, s
  double dt = 0;                       // s
  int substep = 0, substeps = 1;       // within the coarser step
  const StepScope* coarser = nullptr;  // null on the coarsest level

  // Start and end as shares of the coarser step: for ghost values interpolated in time.
  double start_share() const { return static_cast<double>(substep) / substeps; }
  double end_share() const { return static_cast<double>(substep + 1) / substeps; }
};

enum class Verdict { good, reject };
// The verdict of the rank that is worst off. Collective.
Verdict agree(Verdict mine, Communicator& ranks);

// What is to happen only if the step is accepted.
class StepJournal {
 public:
  void at_acceptance(std::function<void()> act) { acts_.push_back(std::move(act)); }
  void accept();  // carries out all of it in order
  void reject() { acts_.clear(); }
  std::size_t size() const { return acts_.size(); }

 private:
  std::vector<std::function<void()>> acts_;
};

// All ranks must return the same verdict.
using Action = std::function<Verdict(const StepScope&, StepJournal&)>;

struct Node;
using Schedule = std::vector<Node>;

// One pass over the blocks of a level.
struct Sweep {
  std::string name;
  int level = 0;
  Action run;
};

// Ghost cells, or the particles of neighbour boxes within `width` cells: the width is declared by
// who reads them (a stencil, a shape function).
struct GhostExchange {
  std::string name;
  int level = 0;
  int width = 0;
  Action exchange;
};

// An action on all levels at once: a solve, a sweep over each of them. Of steps that no level takes
// alone (framework/run/component/step_shape.hpp).
struct Stage {
  std::string name;
  Action run;
};

// The body until `converged` (asked after each pass, counted from 1); rejects after `most` passes.
struct Loop {
  std::string name;
  Schedule body;
  std::function<bool(const StepScope&, int pass)> converged;
  int most = 1;
};

// The next finer level's part of a step, in `substeps` equal substeps.
struct LevelCycle {
  std::string name;
  int level = 1;
  int substeps = 1;
  Schedule body;
};

// A step and its acceptance; outermost only.
struct Retry {
  std::string name;
  Schedule body;
  int most = 20;        // smaller attempts
  double factor = 0.5;  // of the step, from one attempt to the next
  std::function<void(const StepScope&, int attempts)> accepted;  // before the journal is done
};

struct Node {
  std::variant<Sweep, GhostExchange, Stage, Loop, LevelCycle, Retry> what;
};

// Throws std::logic_error naming the node: nodes stand in a step of their own level, cycles go one
// level finer, loops and cycles end, acceptance is outermost, nothing is without an action.
void check(const Schedule& schedule);

// One step. Verdict::reject when the smallest attempt of a Retry failed as well (or a node did,
// where there is none).
Verdict run(const Schedule& schedule, const StepScope& scope, StepJournal& journal);

// One line a node, indented: for `sluice plan`.
std::string describe(const Schedule& schedule);

}  // namespace sluice
