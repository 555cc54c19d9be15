// The schedule of one coarse step: what each level does in it, or all levels together.
//
// Levels that step for themselves: exchange, sweep, take over, then the finer level in its
// substeps, then the matching of both. A component that declares stages (step_shape.hpp) has them
// carried out on all levels in lockstep, and the levels matched at the end, finest first.
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "framework/run/levels/hierarchy.hpp"

namespace sluice {
namespace {

constexpr int masked_attempts = 3;  // at one substep, each with more cells at first order

}  // namespace

Schedule Hierarchy::schedule_of(int l) {
  Schedule s = component_->before_sweep(level(l));
  const int width = halo_width(*component_);
  s.push_back(
      {GhostExchange{"of old state", l, width, [this, l](const StepScope& scope, StepJournal&) {
                       fill(l, scope.time);
                       return Verdict::good;
                     }}});
  s.push_back({Sweep{"step", l, [this, l](const StepScope& scope, StepJournal&) {
                       if (const auto& joint = interfaces_[l]) joint->fluxes.clear();
                       const Verdict verdict = sweep(l, scope, {});
                       if (verdict == Verdict::good) commit(l, scope);
                       return verdict;
                     }}});
  if (l + 1 >= level_count()) return s;
  s.push_back({LevelCycle{"finer level", l + 1, substeps_[l + 1], schedule_of(l + 1)}});
  s.push_back({Sweep{"matching of fluxes and restriction", l,
                     [this, l](const StepScope& scope, StepJournal&) { return match(l, scope); }}});
  return s;
}

StageScope Hierarchy::stage_scope(const StepScope& scope, StepJournal& journal) {
  StageScope s;
  s.levels = existing_levels();
  s.ranks = communicator_;
  s.step = scope;
  s.dt_before = previous_dt_;
  s.pass = pass_;
  s.journal = &journal;
  s.events = ledger_;
  s.reason = &result_.reason;
  s.particles = particles_.get();
  s.sums = &result_.sums;
  s.maxima = &maxima_;
  s.judge = &judge_;
  return s;
}

// A sweep of all levels, finest first.
Node Hierarchy::sweeping_node(std::string name, LevelAction act) {
  return {
      Stage{std::move(name), [this, act = std::move(act)](const StepScope& scope, StepJournal&) {
              for (int l = level_count() - 1; l >= 0; --l) {
                if (link_ && l + 1 < level_count()) link_(level(l), level(l + 1));
                if (act(l, scope) == Verdict::reject) return Verdict::reject;
              }
              return Verdict::good;
            }}};
}

// One stage on all levels.
Node Hierarchy::stage_node(const StepShape::Stage& stage) {
  if (const auto* iterate = std::get_if<StepShape::Iterate>(&stage))
    return iteration_node(*iterate);
  const auto on_levels = [this](std::string name, auto act) {
    return Node{Stage{std::move(name), [this, act](const StepScope& scope, StepJournal&) {
                        for (int l = 0; l < level_count(); ++l)
                          if (act(l, scope) == Verdict::reject) return Verdict::reject;
                        return Verdict::good;
                      }}};
  };
  if (std::holds_alternative<StepShape::Exchange>(stage))
    return on_levels("ghost exchange of the state", [this](int l, const StepScope&) {
      fill(l, ends_[l]);
      return Verdict::good;
    });
  if (std::holds_alternative<StepShape::Commit>(stage))
    return on_levels("take over", [this](int l, const StepScope& scope) {
      commit(l, scope);
      return Verdict::good;
    });
  if (const auto* prepare = std::get_if<StepShape::Prepare>(&stage))
    return sweeping_node("prepare " + prepare->name,
                         [this, stored = prepare->stored](int l, const StepScope& scope) {
                           level(l).set_previous_dt(previous_dt_);
                           level(l).prepare(scope.time, scope.dt, stored);
                           return Verdict::good;
                         });
  if (const auto* sweep = std::get_if<StepShape::Sweep>(&stage))
    return sweeping_node("sweep " + sweep->name,
                         [this, stored = sweep->stored](int l, const StepScope& scope) {
                           return this->sweep(l, scope, stored);
                         });
  const auto& solve = std::get<StepShape::Solve>(stage);
  return {
      Stage{solve.name, [this, act = solve.action](const StepScope& scope, StepJournal& journal) {
              return act(stage_scope(scope, journal));
            }}};
}

// The pass is counted where it begins, so that stages of the body know it. An answer that rejects
// lets the next pass begin with its rejection.
Node Hierarchy::iteration_node(const StepShape::Iterate& iterate) {
  using Answer = StepShape::Iterate::Answer;
  Schedule body;
  body.push_back({Stage{"next pass", [this](const StepScope&, StepJournal&) {
                          ++pass_;
                          return stopped_ ? Verdict::reject : Verdict::good;
                        }}});
  for (const StepShape::Stage& stage : iterate.body) body.push_back(stage_node(stage));
  return {Loop{iterate.name, std::move(body),
               [this, converged = iterate.converged](const StepScope& scope, int) {
                 const Answer answer = converged(stage_scope(scope, journal_));
                 stopped_ = answer == Answer::reject;
                 if (answer == Answer::done) pass_ = 0;
                 return answer == Answer::done;
               },
               iterate.most}};
}

// All levels together, in lockstep.
Schedule Hierarchy::schedule_of(const StepShape& shape) {
  Schedule s;
  link_ = shape.link();
  s.push_back({Stage{"clear flux records", [this](const StepScope&, StepJournal&) {
                       for (auto& joint : interfaces_)
                         if (joint != nullptr) joint->fluxes.clear();
                       return Verdict::good;
                     }}});
  for (const StepShape::Stage& stage : shape.stages()) s.push_back(stage_node(stage));
  for (int l = level_count() - 2; l >= 0; --l)
    s.push_back(
        {Sweep{"matching of fluxes and restriction", 0,
               [this, l](const StepScope& scope, StepJournal&) { return match(l, scope); }}});
  return s;
}

Schedule Hierarchy::cycle_of_levels() {
  StepShape shape;
  component_->shape_step(shape);
  if (shape.plain()) return schedule_of(0);
  for (int l = 1; l < possible_levels(); ++l)
    if (substeps_[l] != 1) throw std::logic_error("a step of stages needs levels in lockstep");
  return schedule_of(shape);
}

// Where the present state of a level stands between the two states of the next coarser one. Outside
// a coarse step, and before the coarser level has advanced in it, both levels are at its end.
double Hierarchy::share_of(int l) const {
  return advancing_ ? static_cast<double>(done_[l]) / substeps_[l] : 1.0;
}

void Hierarchy::fill(int l, double time) {
  LevelSolver& solver = level(l);
  if (l == 0) {
    solver.fill_ghosts(time);
    return;
  }
  const auto interface = [&](Warehouse& state) {
    LevelSolver& coarser = level(l - 1);
    const double share = share_of(l);
    // Its new state stands at the end of its own step; the old one was filled when it was swept.
    if (share > 0) fill(l - 1, advancing_ ? ends_[l - 1] : time);
    const Warehouse* before = share < 1 ? &coarser.previous() : nullptr;
    const Warehouse* after = share > 0 ? &coarser.state() : nullptr;
    interfaces_[l - 1]->ghosts.run(before, after, share, state, solver.state_slots(),
                                   component_->transfer(), scene_->refinement.interface_order,
                                   solver.team());
  };
  solver.fill_ghosts(time, interface, &level(0));
}

// Is it the last substep of the coarse step: its outputs and rates are asked for.
bool Hierarchy::ends_coarse_step(const StepScope& scope) {
  bool last = true;
  for (const StepScope* s = &scope; s != nullptr; s = s->coarser)
    last = last && s->substep + 1 == s->substeps;
  return last;
}

// The new state beside the old one.
Verdict Hierarchy::sweep(int l, const StepScope& scope, const std::vector<Label>& stored) {
  LevelSolver& solver = level(l);
  const bool last = ends_coarse_step(scope);
  std::vector<Label> wanted = stored;
  if (last) wanted.insert(wanted.end(), wanted_->begin(), wanted_->end());
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  const RunControl* control = l == 0 ? control_ : nullptr;
  solver.set_previous_dt(previous_dt_);
  for (int masked = 0;; ++masked) {
    const StepAttempt& a = solver.attempt(scope.time, scope.dt, wanted, control, last);
    if (l == 0) {
      result_.control = a.control;
      asked_ = true;
    }
    if (a.faults == 0) break;
    if (masked == 0) result_.unsound = solver.unsound_start();
    if (result_.unsound || masked == masked_attempts || solver.mask_faults() == 0) {
      result_.first_fault = a.first_fault;
      result_.faults = a.faults;
      return Verdict::reject;
    }
    EventPlace place;
    place.step = step_;
    place.level = l;
    place.cell = a.first_fault.cell;
    place.material = a.first_fault.material;
    place.task = "update";
    place.value = a.first_fault.value;
    ledger_->keep("step redone with first-order faces", place);
  }
  return Verdict::good;
}

// The new state becomes the present one.
void Hierarchy::commit(int l, const StepScope& scope) {
  const std::size_t n = l;
  LevelSolver& solver = level(l);
  const StepAttempt& a = solver.attempt_result();
  for (std::size_t s = 0; s < a.sums.size(); ++s) result_.sums[s] += a.sums[s];
  if (ends_coarse_step(scope)) maxima_[n] = a.maxima;
  solver.advance();
  ends_[n] = scope.time + scope.dt;
  if (l > 0) {
    interfaces_[n - 1]->fluxes.add_substep();
    ++done_[n];
  }
  if (n + 1 < done_.size()) done_[n + 1] = 0;
}

Verdict Hierarchy::match(int l, const StepScope& /*scope*/) {
  LevelInterface& joint = *interfaces_[l];
  LevelSolver& coarse = level(l);
  LevelSolver& fine = level(l + 1);
  const CorrectionReport report = joint.fluxes.correct(
      coarse.state(), fine.state(), coarse.state_slots(), component_->transfer(), *communicator_);
  if (report.limited > 0) {
    EventPlace place;
    place.step = step_;
    place.level = l;
    place.cell = report.first;
    place.task = "matching of fluxes";
    place.value = static_cast<double>(report.limited);
    ledger_->keep("correction of fluxes limited", place);
  }
  if (report.failed) {
    result_.first_fault = {report.first, l, 0, 0, 0.0};
    result_.faults = report.limited;
    result_.unmatched = true;
    return Verdict::reject;
  }
  joint.restriction.run(fine.state(), coarse.state(), coarse.state_slots(), component_->transfer(),
                        coarse.team());
  coarse.mark_modified();
  fine.mark_modified();
  return Verdict::good;
}

}  // namespace sluice
