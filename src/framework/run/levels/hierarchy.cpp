// The cycle of one coarse step.
#include "framework/run/levels/hierarchy.hpp"

#include <algorithm>

#include "framework/base/memory.hpp"

namespace sluice {
namespace {

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
  // Levels that take stages together take the same step.
  StepShape shape;
  component.shape_step(shape);
  const bool lock_step = scene.refinement.lock_step || !shape.plain();
  for (const Level& level : levels) {
    substeps_.push_back(level.index == 0 ? 1 : substeps_of(level, lock_step));
    o.substeps *= substeps_.back();
    in_coarse_step_.push_back(o.substeps);
    solvers_.push_back(std::make_unique<LevelSolver>(component, level, communicator, o));
  }
  done_.assign(levels.size(), 0);
  ends_.assign(levels.size(), 0.0);
  maxima_.resize(levels.size());
  ends_of_levels_.resize(levels.size());
  costs_.resize(levels.size());
  interfaces_.resize(levels.size());
  if (const ParticleMethod* method = component.particles())
    particles_ = std::make_unique<ParticleCloud>(*method, communicator);
  if (component.first_volume_sum() >= 0)
    for (const ControlVolume& v : control_volumes(scene.analysis))
      volumes_.push_back(cells_of(v, levels.front()));
  if (scene.refinement.adaptive && levels.size() > 1)
    regridder_.emplace(scene.refinement, levels, communicator.size(), options.threads,
                       component.courant_number());
  if (regridder_) {
    regridder_->limit_boxes(options.max_box_cells);
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

const CycleResult& Hierarchy::attempt(int step, double time, double dt,
                                      const std::vector<Label>& wanted, const RunControl& control,
                                      EventLedger& ledger) {
  result_ = {};
  result_.sums.assign(component_->reduction_sums(), 0.0);
  step_ = step;
  time_ = time;
  end_ = time + dt;
  dt_ = dt;
  pass_ = 0;
  stopped_ = false;
  asked_ = false;
  wanted_ = &wanted;
  control_ = &control;
  ledger_ = &ledger;
  ledger.begin_step(step);
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
  if (!asked_) ask_control();
  return result_;
}

// Clock and signals, where no sweep of cells has asked for them on the way.
void Hierarchy::ask_control() {
  Reduction reduction;
  const RunControl::Question question = control_->ask(reduction);
  communicator_->reduce(reduction);
  result_.control = control_->read(reduction, question);
}

std::vector<LevelSolver*> Hierarchy::existing_levels() {
  std::vector<LevelSolver*> levels;
  for (int l = 0; l < level_count(); ++l) levels.push_back(&level(l));
  return levels;
}

void Hierarchy::advance_particles() {
  if (particles_ == nullptr) return;
  bool any = false;
  for (int k = 0; k < particles_->kind_count(); ++k) any |= !component_->particles()->in_stages(k);
  if (!any) return;
  fill_ghosts(end_);
  particles_->advance(existing_levels(), end_, in_coarse_step_[level_count() - 1]);
}

void Hierarchy::accept() {
  advance_particles();
  journal_.accept();
  time_ = end_;
  previous_dt_ = dt_;
  for (int l = 0; l < level_count(); ++l) {
    level(l).accept();
    const std::int64_t cells = level(l).level().cell_count();
    costs_[l].updates += in_coarse_step_[l] * cells;
    costs_[l].max_cells = std::max(costs_[l].max_cells, cells);
  }
}

void Hierarchy::reject() {
  journal_.reject();
  for (int l = 0; l < level_count(); ++l) level(l).reject();
}

StepLimit Hierarchy::step_limit() const {
  StepLimit limit;
  for (int l = 0; l < level_count(); ++l) {
    StepLimit own = component_->step_limit(maxima_[l]);
    own.dt *= in_coarse_step_[l];
    if (level_count() > 1) own.reason += " on level " + std::to_string(l);
    if (l == 0 || own.dt < limit.dt) limit = own;
  }
  return limit;
}

StepLimit Hierarchy::first_step_limit() const {
  StepLimit limit = step_limit();
  const int finest = in_coarse_step_[level_count() - 1];
  if (finest == 1) return limit;
  limit.dt /= finest;
  limit.reason = "first step: one of the finest level";
  return limit;
}

void Hierarchy::settle_particles() {
  if (particles_ != nullptr && component_->particles()->in_stages()) particles_->relocate();
}

std::vector<GridFields> Hierarchy::particle_fields(const std::vector<Label>& labels,
                                                   const ParticleCloud::Wanted& wanted) {
  const ParticleMethod& method = *component_->particles();
  std::vector<GridFields> fields;
  for (int l = 0; l < level_count(); ++l) {
    GridFields& of_level = fields.emplace_back(level(l).level(), communicator_->rank());
    for (const Label label : labels)
      for (const ParticleKind& kind : method.kinds())
        if (wanted(label, kind.material, l)) of_level.add(label, kind.material);
  }
  StepScope step;
  step.time = time_;
  step.dt = previous_dt_;
  method.store_on_grid(stage_scope(step, journal_), fields);
  return fields;
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
  if (particles_ != nullptr) component_->add_particle_totals(*particles_, totals);
}

std::vector<LevelCost> Hierarchy::costs() const {
  std::vector<LevelCost> costs = costs_;
  for (int l = 0; l < possible_levels(); ++l) {
    costs[l].cells = level(l).level().cell_count();
    costs[l].boxes = static_cast<std::int64_t>(level(l).level().boxes.size());
    costs[l].max_cells = std::max(costs[l].max_cells, costs[l].cells);
    costs[l].domain_cells = level(l).level().domain.volume();
    costs[l].substeps = in_coarse_step_[l];
  }
  return costs;
}

}  // namespace sluice
