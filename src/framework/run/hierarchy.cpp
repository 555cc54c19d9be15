// The cycle of one coarse step.
#include "framework/run/hierarchy.hpp"

#include <algorithm>

#include "framework/base/memory.hpp"

namespace sluice {
namespace {

constexpr int masked_attempts = 3;  // at one substep, each with more cells at first order

int substeps_of(const Level& level, bool lock_step) {
  return lock_step ? 1 : std::max({level.ratio.x, level.ratio.y, level.ratio.z});
}

}  // namespace

Hierarchy::Hierarchy(const Scene& scene, const Component& component, Communicator& communicator,
                     const SolverOptions& options)
    : scene_(&scene),
      component_(&component),
      communicator_(&communicator),
      refinement_flags_(scene.refinement, component, scene.grid.levels) {
  const std::vector<Level>& levels = scene.grid.levels;
  SolverOptions o = options;
  o.joined = levels.size() > 1;
  o.substeps = 1;
  if (o.team == nullptr) o.team = std::make_shared<const ThreadTeam>(options.threads);
  for (const Level& level : levels) {
    substeps_.push_back(level.index == 0 ? 1 : substeps_of(level, scene.refinement.lock_step));
    o.substeps *= substeps_.back();
    in_coarse_step_.push_back(o.substeps);
    solvers_.push_back(std::make_unique<LevelSolver>(component, level, communicator, o));
  }
  done_.assign(levels.size(), 0);
  ends_.assign(levels.size(), 0.0);
  maxima_.resize(levels.size());
  ends_of_levels_.resize(levels.size());
  costs_.resize(levels.size());
  joints_.resize(levels.size());
  if (const ParticleMethod* method = component.particles())
    particles_ = std::make_unique<ParticleCloud>(*method, communicator);
  if (component.first_volume_sum() >= 0)
    for (const ControlVolume& v : control_volumes(scene.analysis))
      volumes_.push_back(cells_of(v, levels.front()));
  if (scene.refinement.adaptive && levels.size() > 1)
    regridder_.emplace(scene.refinement, levels, communicator.size(), options.threads,
                       component.courant_number());
  if (regridder_) {
    regridder_->limit_boxes(options.most_box_cells);
    keep_freed_memory();
  }
  for (int l = 0; l + 1 < level_count(); ++l) make_joint(l);
  join_levels();
}

Hierarchy::~Hierarchy() = default;

int Hierarchy::level_count() const {
  int n = 1;
  while (n < possible_levels() && !level(n).level().boxes.empty()) ++n;
  return n;
}

Grid Hierarchy::grid() const {
  Grid grid;
  for (int l = 0; l < level_count(); ++l) grid.levels.push_back(level(l).level());
  return grid;
}

std::int64_t Hierarchy::cell_count() const {
  std::int64_t n = 0;
  for (int l = 0; l < level_count(); ++l) n += level(l).level().cell_count();
  return n;
}

Schedule Hierarchy::schedule_of(int l) {
  Schedule s = component_->before_sweep(level(l));
  const int width = halo_width(*component_);
  s.push_back({HaloPoint{"of old state", l, width, [this, l](const StepScope& scope, StepJournal&) {
                           fill(l, scope.time);
                           return Verdict::good;
                         }}});
  s.push_back({Sweep{"step", l,
                     [this, l](const StepScope& scope, StepJournal&) { return sweep(l, scope); }}});
  if (l + 1 >= level_count()) return s;
  s.push_back({LevelCycle{"finer level", l + 1, substeps_[static_cast<std::size_t>(l) + 1],
                          schedule_of(l + 1)}});
  s.push_back({Sweep{"matching of fluxes and restriction", l,
                     [this, l](const StepScope& scope, StepJournal&) { return match(l, scope); }}});
  return s;
}

// Where the present state of a level stands between the two states of the next coarser one. Outside
// a coarse step, and before the coarser level has advanced in it, both levels are at its end.
double Hierarchy::share_of(int l) const {
  const auto n = static_cast<std::size_t>(l);
  return advancing_ ? static_cast<double>(done_[n]) / substeps_[n] : 1.0;
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
    if (share > 0) fill(l - 1, advancing_ ? ends_[static_cast<std::size_t>(l) - 1] : time);
    const Warehouse* before = share < 1 ? &coarser.previous() : nullptr;
    const Warehouse* after = share > 0 ? &coarser.state() : nullptr;
    joints_[static_cast<std::size_t>(l) - 1]->ghosts.run(
        before, after, share, state, solver.state_slots(), component_->transfer(),
        scene_->refinement.interface_order, solver.team());
  };
  solver.fill_ghosts(time, interface, &level(0));
}

Verdict Hierarchy::sweep(int l, const StepScope& scope) {
  const auto n = static_cast<std::size_t>(l);
  LevelSolver& solver = level(l);
  if (joints_[n] != nullptr) joints_[n]->fluxes.clear();
  bool last = true;  // substep of the coarse step: its outputs and rates are asked for
  for (const StepScope* s = &scope; s != nullptr; s = s->coarser)
    last = last && s->substep + 1 == s->substeps;
  const std::vector<Label> none;
  const RunControl* control = l == 0 ? control_ : nullptr;
  for (int masked = 0;; ++masked) {
    const StepAttempt& a =
        solver.attempt(scope.time, scope.dt, last ? *wanted_ : none, control, last);
    if (l == 0) result_.control = a.control;
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
  const StepAttempt& a = solver.attempt_result();
  for (std::size_t s = 0; s < a.sums.size(); ++s) result_.sums[s] += a.sums[s];
  if (last) maxima_[n] = a.maxima;
  solver.advance();
  ends_[n] = scope.time + scope.dt;
  if (l > 0) {
    joints_[n - 1]->fluxes.add_substep();
    ++done_[n];
  }
  if (n + 1 < done_.size()) done_[n + 1] = 0;
  return Verdict::good;
}

Verdict Hierarchy::match(int l, const StepScope& /*scope*/) {
  Joint& joint = *joints_[static_cast<std::size_t>(l)];
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
  coarse.touch();
  fine.touch();
  return Verdict::good;
}

const CycleResult& Hierarchy::attempt(int step, double time, double dt,
                                      const std::vector<Label>& wanted, const RunControl& control,
                                      EventLedger& ledger) {
  result_ = {};
  result_.sums.assign(static_cast<std::size_t>(component_->reduction_sums()), 0.0);
  step_ = step;
  time_ = time;
  end_ = time + dt;
  wanted_ = &wanted;
  control_ = &control;
  ledger_ = &ledger;
  std::fill(done_.begin(), done_.end(), 0);
  StepScope scope;
  scope.time = time;
  scope.dt = dt;
  journal_.reject();
  // Ghosts of the start of the step come from states that are all at that time.
  advancing_ = false;
  for (int l = 0; l < level_count(); ++l) fill(l, time);
  advancing_ = true;
  result_.good = run(cycle_, scope, journal_) == Verdict::good;
  advancing_ = false;
  return result_;
}

std::vector<LevelSolver*> Hierarchy::existing_levels() {
  std::vector<LevelSolver*> levels;
  for (int l = 0; l < level_count(); ++l) levels.push_back(&level(l));
  return levels;
}

void Hierarchy::advance_particles() {
  if (particles_ == nullptr) return;
  fill_ghosts(end_);
  particles_->advance(existing_levels(), end_,
                      in_coarse_step_[static_cast<std::size_t>(level_count()) - 1]);
}

void Hierarchy::accept() {
  advance_particles();
  journal_.accept();
  time_ = end_;
  for (int l = 0; l < level_count(); ++l) {
    const auto n = static_cast<std::size_t>(l);
    level(l).accept();
    const std::int64_t cells = level(l).level().cell_count();
    costs_[n].updates += in_coarse_step_[n] * cells;
    costs_[n].most_cells = std::max(costs_[n].most_cells, cells);
  }
}

void Hierarchy::reject() {
  journal_.reject();
  for (int l = 0; l < level_count(); ++l) level(l).reject();
}

StepLimit Hierarchy::step_limit() const {
  StepLimit limit;
  for (int l = 0; l < level_count(); ++l) {
    const auto n = static_cast<std::size_t>(l);
    StepLimit own = component_->step_limit(maxima_[n]);
    own.dt *= in_coarse_step_[n];
    if (level_count() > 1) own.reason += " on level " + std::to_string(l);
    if (l == 0 || own.dt < limit.dt) limit = own;
  }
  return limit;
}

StepLimit Hierarchy::first_step_limit() const {
  StepLimit limit = step_limit();
  const int finest = in_coarse_step_[static_cast<std::size_t>(level_count()) - 1];
  if (finest == 1) return limit;
  limit.dt /= finest;
  limit.reason = "first step: one of the finest level";
  return limit;
}

void Hierarchy::fill_ghosts(double time) {
  for (int l = 0; l < level_count(); ++l) fill(l, time);
}

void Hierarchy::compute_diagnostics(double time, const std::vector<Label>& wanted) {
  fill_ghosts(time);
  for (int l = 0; l < level_count(); ++l) level(l).compute_diagnostics(time, wanted);
}

void Hierarchy::add_totals(Totals& totals) const {
  for (int l = 0; l < level_count(); ++l)
    component_->add_totals(level(l).state(), level(l).coverage(), totals);
}

std::vector<LevelCost> Hierarchy::costs() const {
  std::vector<LevelCost> costs = costs_;
  for (int l = 0; l < possible_levels(); ++l) {
    const auto n = static_cast<std::size_t>(l);
    costs[n].cells = level(l).level().cell_count();
    costs[n].boxes = static_cast<std::int64_t>(level(l).level().boxes.size());
    costs[n].most_cells = std::max(costs[n].most_cells, costs[n].cells);
    costs[n].domain_cells = level(l).level().domain.volume();
    costs[n].substeps = in_coarse_step_[n];
  }
  return costs;
}

}  // namespace sluice
