#include "framework/run/levels/coarse_step.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace sluice {
namespace {

constexpr int masked_attempts = 3;  // at one substep, each with more cells at first order

// Is it the last substep of the coarse step: its outputs and rates are asked for.
bool ends_coarse_step(const StepScope& scope) {
  bool last = true;
  for (const StepScope* s = &scope; s != nullptr; s = s->coarser)
    last = last && s->substep + 1 == s->substeps;
  return last;
}

}  // namespace

CoarseStep::CoarseStep(const Component& component, Levels& levels, GhostsInTime& ghosts,
                       Communicator& communicator, ParticleCloud* particles,
                       std::vector<std::vector<double>>& maxima)
    : component_(&component),
      levels_(&levels),
      ghosts_(&ghosts),
      communicator_(&communicator),
      particles_(particles),
      maxima_(&maxima) {
  renew();
}

void CoarseStep::renew() {
  if (levels_->count() == levels_in_cycle_) return;
  levels_in_cycle_ = levels_->count();
  StepShape shape;
  component_->step().declare_stages(shape);
  for (int l = 1; l < levels_->possible() && !shape.plain(); ++l)
    if (levels_->substeps(l) != 1)
      throw std::logic_error("a step of stages needs levels in lockstep");
  cycle_ = shape.plain() ? schedule_of(0) : schedule_of(shape);
  check(cycle_);
}

const CycleResult& CoarseStep::attempt(const CoarseStepRequest& request) {
  result_ = {};
  result_.sums.assign(component_->step().reductions().sums(), 0.0);
  attempt_ = {};
  attempt_.request = request;
  request.ledger->begin_step(request.step);
  ghosts_->begin();
  StepScope scope;
  scope.time = request.time;
  scope.dt = request.dt;
  journal_.reject();
  // Ghosts of the start of the step come from states that are all at that time.
  ghosts_->set_advancing(false);
  ghosts_->fill_all(request.time);
  ghosts_->set_advancing(true);
  result_.good = run(cycle_, scope, journal_) == Verdict::good;
  ghosts_->set_advancing(false);
  if (!attempt_.asked) ask_control();
  return result_;
}

// Clock and signals, where no sweep of cells has asked for them on the way.
void CoarseStep::ask_control() {
  const RunControl& control = *attempt_.request.control;
  Reduction reduction;
  const RunControl::Question question = control.ask(reduction);
  communicator_->reduce(reduction);
  result_.control = control.read(reduction, question);
}

void CoarseStep::accept() {
  journal_.accept();
  previous_dt_ = attempt_.request.dt;
  for (int l = 0; l < levels_->count(); ++l) (*levels_)[l].accept();
}

void CoarseStep::reject() {
  journal_.reject();
  for (int l = 0; l < levels_->count(); ++l) (*levels_)[l].reject();
}

Schedule CoarseStep::schedule_of(int l) {
  Schedule s = component_->step().before_sweep((*levels_)[l]);
  const int width = (*levels_)[l].states().width();
  s.push_back(
      {GhostExchange{"of old state", l, width, [this, l](const StepScope& scope, StepJournal&) {
                       ghosts_->fill(l, scope.time);
                       return Verdict::good;
                     }}});
  s.push_back({Sweep{"step", l, [this, l](const StepScope& scope, StepJournal&) {
                       if (LevelInterface* joint = levels_->interface(l)) joint->fluxes.clear();
                       const Verdict verdict = sweep(l, scope, {});
                       if (verdict == Verdict::good) commit(l, scope);
                       return verdict;
                     }}});
  if (l + 1 >= levels_->count()) return s;
  s.push_back({LevelCycle{"finer level", l + 1, levels_->substeps(l + 1), schedule_of(l + 1)}});
  s.push_back({Sweep{"matching of fluxes and restriction", l,
                     [this, l](const StepScope&, StepJournal&) { return match(l); }}});
  return s;
}

StageScope CoarseStep::stage_scope(const StepScope& scope, StepJournal& journal) {
  StageScope s;
  s.levels = levels_->existing();
  s.ranks = communicator_;
  s.step = scope;
  s.dt_before = previous_dt_;
  s.pass = attempt_.pass;
  s.journal = &journal;
  s.events = attempt_.request.ledger;
  s.reason = &result_.reason;
  s.particles = particles_;
  s.sums = &result_.sums;
  s.maxima = maxima_;
  s.judge = &judge_;
  return s;
}

StageScope CoarseStep::scope_between_steps(double time) {
  StepScope step;
  step.time = time;
  step.dt = previous_dt_;
  return stage_scope(step, journal_);
}

// A stage whose time counts.
Node CoarseStep::measured(Stage stage) {
  return {
      Stage{stage.name, [this, place = stage_costs_.place_of(stage.name),
                         run = std::move(stage.run)](const StepScope& scope, StepJournal& journal) {
              return stage_costs_.measure(place, [&] { return run(scope, journal); });
            }}};
}

// A sweep of all levels, finest first.
Node CoarseStep::sweeping_node(std::string name, LevelAction act) {
  return measured(
      {std::move(name), [this, act = std::move(act)](const StepScope& scope, StepJournal&) {
         for (int l = levels_->count() - 1; l >= 0; --l) {
           if (link_ && l + 1 < levels_->count()) link_((*levels_)[l], (*levels_)[l + 1]);
           if (act(l, scope) == Verdict::reject) return Verdict::reject;
         }
         return Verdict::good;
       }});
}

// One stage on all levels.
Node CoarseStep::stage_node(const StepShape::Stage& stage) {
  if (const auto* iterate = std::get_if<StepShape::Iterate>(&stage))
    return iteration_node(*iterate);
  const auto on_levels = [this](std::string name, auto act) {
    return measured({std::move(name), [this, act](const StepScope& scope, StepJournal&) {
                       for (int l = 0; l < levels_->count(); ++l)
                         if (act(l, scope) == Verdict::reject) return Verdict::reject;
                       return Verdict::good;
                     }});
  };
  if (std::holds_alternative<StepShape::Exchange>(stage))
    return on_levels("ghost exchange of the state", [this](int l, const StepScope&) {
      ghosts_->fill(l, ghosts_->end(l));
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
                           (*levels_)[l].set_previous_dt(previous_dt_);
                           (*levels_)[l].prepare(scope.time, scope.dt, stored);
                           return Verdict::good;
                         });
  if (const auto* sweep = std::get_if<StepShape::Sweep>(&stage))
    return sweeping_node("sweep " + sweep->name,
                         [this, stored = sweep->stored](int l, const StepScope& scope) {
                           return this->sweep(l, scope, stored);
                         });
  const auto& solve = std::get<StepShape::Solve>(stage);
  return measured(
      {solve.name, [this, act = solve.action](const StepScope& scope, StepJournal& journal) {
         return act(stage_scope(scope, journal));
       }});
}

// The pass is counted where it begins, so that stages of the body know it. An answer that rejects
// lets the next pass begin with its rejection.
Node CoarseStep::iteration_node(const StepShape::Iterate& iterate) {
  using Answer = StepShape::Iterate::Answer;
  Schedule body;
  body.push_back({Stage{"next pass", [this](const StepScope&, StepJournal&) {
                          ++attempt_.pass;
                          return attempt_.stopped ? Verdict::reject : Verdict::good;
                        }}});
  for (const StepShape::Stage& stage : iterate.body) body.push_back(stage_node(stage));
  return {Loop{iterate.name, std::move(body),
               [this, converged = iterate.converged](const StepScope& scope, int) {
                 const Answer answer = converged(stage_scope(scope, journal_));
                 attempt_.stopped = answer == Answer::reject;
                 if (answer == Answer::done) attempt_.pass = 0;
                 return answer == Answer::done;
               },
               iterate.most}};
}

// All levels together, in lockstep.
Schedule CoarseStep::schedule_of(const StepShape& shape) {
  Schedule s;
  link_ = shape.link();
  s.push_back({Stage{"clear flux records", [this](const StepScope&, StepJournal&) {
                       for (int l = 0; l < levels_->possible(); ++l)
                         if (LevelInterface* joint = levels_->interface(l)) joint->fluxes.clear();
                       return Verdict::good;
                     }}});
  for (const StepShape::Stage& stage : shape.stages()) s.push_back(stage_node(stage));
  for (int l = levels_->count() - 2; l >= 0; --l)
    s.push_back({Sweep{"matching of fluxes and restriction", 0,
                       [this, l](const StepScope&, StepJournal&) { return match(l); }}});
  return s;
}

// The new state beside the old one.
Verdict CoarseStep::sweep(int l, const StepScope& scope, const std::vector<Label>& stored) {
  LevelSolver& solver = (*levels_)[l];
  const bool last = ends_coarse_step(scope);
  const std::vector<Label>& also = *attempt_.request.wanted;
  std::vector<Label> wanted = stored;
  if (last) wanted.insert(wanted.end(), also.begin(), also.end());
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  const RunControl* control = l == 0 ? attempt_.request.control : nullptr;
  solver.set_previous_dt(previous_dt_);
  for (int masked = 0;; ++masked) {
    const StepAttempt& a = solver.attempt(scope.time, scope.dt, wanted, control, last);
    if (l == 0) {
      result_.control = a.control;
      attempt_.asked = true;
    }
    if (a.faults == 0) break;
    if (masked == 0) result_.unsound = solver.unsound_start();
    if (result_.unsound || masked == masked_attempts || solver.mask_faults() == 0) {
      result_.first_fault = a.first_fault;
      result_.faults = a.faults;
      return Verdict::reject;
    }
    EventPlace place;
    place.step = attempt_.request.step;
    place.level = l;
    place.cell = a.first_fault.cell;
    place.material = a.first_fault.material;
    place.task = "update";
    place.value = a.first_fault.value;
    attempt_.request.ledger->keep("step redone with first-order faces", place);
  }
  return Verdict::good;
}

// The new state becomes the present one.
void CoarseStep::commit(int l, const StepScope& scope) {
  LevelSolver& solver = (*levels_)[l];
  const StepAttempt& a = solver.attempt_result();
  for (std::size_t s = 0; s < a.sums.size(); ++s) result_.sums[s] += a.sums[s];
  if (ends_coarse_step(scope)) (*maxima_)[l] = a.maxima;
  solver.advance();
  if (l > 0) levels_->interface(l - 1)->fluxes.add_substep();
  ghosts_->note_advance(l, scope.time + scope.dt);
}

Verdict CoarseStep::match(int l) {
  LevelInterface& joint = *levels_->interface(l);
  LevelSolver& coarse = (*levels_)[l];
  LevelSolver& fine = (*levels_)[l + 1];
  const CorrectionReport report =
      joint.fluxes.correct(coarse.state(), fine.state(), coarse.state_slots(),
                           component_->levels().transfer(), *communicator_);
  if (report.limited > 0) {
    EventPlace place;
    place.step = attempt_.request.step;
    place.level = l;
    place.cell = report.first;
    place.task = "matching of fluxes";
    place.value = static_cast<double>(report.limited);
    attempt_.request.ledger->keep("correction of fluxes limited", place);
  }
  if (report.failed) {
    result_.first_fault = {report.first, l, 0, 0, 0.0};
    result_.faults = report.limited;
    result_.unmatched = true;
    return Verdict::reject;
  }
  joint.restriction.run(fine.state(), coarse.state(), coarse.state_slots(),
                        component_->levels().transfer(), coarse.team());
  coarse.mark_modified();
  fine.mark_modified();
  return Verdict::good;
}

}  // namespace sluice
