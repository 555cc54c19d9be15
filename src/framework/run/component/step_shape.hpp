// The shape of a step, as a component declares it: what all levels do together, in order.
//
// A step that declares nothing is exchange, sweep, take over on each level, finer levels in
// substeps of the coarser one (levels/coarse_step.cpp). A step that solves a system between sweeps
// declares stages instead; all levels then take the same step, each stage on all of them before the
// next begins:
//
//   shape.prepare("pressure system", labels);       // stored: coefficients, right-hand side
//   shape.iterate("pressure", most, converged,      // until converged(scope)
//                 [&](StepShape& pass) {
//                   pass.solve("pressure", solve);  // writes work slots of the states
//                   pass.sweep("step", labels);     // the new state beside the old one
//                 });
//   shape.commit();                                 // the new state becomes the present one
//
// Ghost cells of the state are filled when a step begins. An attempt leaves nothing behind when it
// is rejected: what lasts goes to the journal.
#pragma once
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "framework/field/label.hpp"
#include "framework/task/schedule.hpp"

namespace sluice {

class LevelSolver;
class Communicator;
class EventLedger;
class ParticleCloud;

// Whether a step with these sums (as StepFacet::reductions() numbers them, in the component's
// units) may be taken; else the reason.
using StepJudge = std::function<bool(const std::vector<double>& sums, std::string& reason)>;

// What a stage between sweeps sees.
struct StageScope {
  std::vector<LevelSolver*> levels;  // coarse to fine
  Communicator* ranks = nullptr;
  StepScope step;        // of the coarsest level; the finer ones take the same step
  double dt_before = 0;  // length of the step before, s; 0: there was none
  int pass = 0;          // of the iteration around it, counted from 1
  StepJournal* journal = nullptr;
  EventLedger* events = nullptr;       // of the attempt
  std::string* reason = nullptr;       // why it rejects the step, for the message
  ParticleCloud* particles = nullptr;  // of the run; null: it has none
  // Of the step, for a stage that takes it without a sweep: its sums (over levels and ranks), and
  // by level the maxima on which the next step's length rests; as StepFacet::reductions() numbers
  // them.
  std::vector<double>* sums = nullptr;
  std::vector<std::vector<double>>* maxima = nullptr;
  const StepJudge* judge = nullptr;  // of the run; null: none
};

// A stage behind which the new state becomes the present one: the run's say on the step's sums.
inline Verdict judge_step(const StageScope& scope) {
  if (scope.judge == nullptr || !*scope.judge) return Verdict::good;
  return (*scope.judge)(*scope.sums, *scope.reason) ? Verdict::good : Verdict::reject;
}

// All ranks must return the same.
using StageAction = std::function<Verdict(const StageScope&)>;

class StepShape {
 public:
  struct Exchange {};
  struct Prepare {
    std::string name;
    std::vector<Label> stored;
  };
  struct Solve {
    std::string name;  // with what it is: "solve pressure"
    StageAction action;
  };
  struct Sweep {
    std::string name;
    std::vector<Label> stored;  // beside those that are saved
  };
  struct Commit {};
  struct Iterate;
  using Stage = std::variant<Exchange, Prepare, Solve, Sweep, Commit, Iterate>;
  // Stages until `converged`, which may reject the step by the reason it gives.
  struct Iterate {
    std::string name;
    int most = 1;
    enum class Answer { again, done, reject };
    std::function<Answer(const StageScope&)> converged;
    std::vector<Stage> body;
  };

  // Ghost cells of the state: after commit() within a step.
  void exchange_state() { stages_.push_back(Exchange{}); }
  // A sweep that stores these labels of the step and makes no new state.
  void prepare(std::string name, std::vector<Label> stored) {
    stages_.push_back(Prepare{std::move(name), std::move(stored)});
  }
  void solve(std::string name, StageAction action) {
    stages_.push_back(Solve{"solve " + std::move(name), std::move(action)});
  }
  // Any other action on all levels, such as one on particles.
  void stage(std::string name, StageAction action) {
    stages_.push_back(Solve{std::move(name), std::move(action)});
  }
  void sweep(std::string name, std::vector<Label> stored = {}) {
    stages_.push_back(Sweep{std::move(name), std::move(stored)});
  }
  void commit() { stages_.push_back(Commit{}); }
  void iterate(std::string name, int most,
               std::function<Iterate::Answer(const StageScope&)> converged,
               const std::function<void(StepShape&)>& body) {
    StepShape inner;
    body(inner);
    stages_.push_back(
        Iterate{std::move(name), most, std::move(converged), std::move(inner.stages_)});
  }
  // Sweeps go from the finest level to the coarsest; before a level is swept (or prepared) it is
  // told what the next finer one has stored.
  using Link = std::function<void(LevelSolver& coarser, LevelSolver& finer)>;
  void link_levels(Link link) { link_ = std::move(link); }
  const Link& link() const { return link_; }
  const std::vector<Stage>& stages() const { return stages_; }
  bool plain() const { return stages_.empty(); }

 private:
  std::vector<Stage> stages_;
  Link link_;
};

}  // namespace sluice
