#include "framework/run/levels/hierarchy.hpp"

#include <algorithm>

namespace sluice {

Hierarchy::Hierarchy(const Scene& scene, const Component& component, Communicator& communicator,
                     const SolverOptions& options)
    : scene_(&scene),
      component_(&component),
      communicator_(&communicator),
      levels_(scene, component, communicator, options),
      particles_(component.particles() == nullptr
                     ? nullptr
                     : std::make_unique<ParticleCloud>(*component.particles(), communicator)),
      ghosts_(scene, component, levels_),
      rates_(scene, component, levels_, ghosts_, particles_.get()),
      coarse_step_(component, levels_, ghosts_, communicator, particles_.get(), rates_.maxima()),
      regridding_(scene, component, options, communicator, levels_, ghosts_, rates_,
                  particles_.get()),
      balancing_(scene, communicator, levels_, particles_.get()),
      costs_(levels_.possible()) {}

void Hierarchy::initialise() {
  time_ = scene_->time.initial_time;
  for (int l = 0; l < level_count(); ++l) component_->state().initialise(level(l).state());
  const auto start_particles = [this] {
    if (particles_ != nullptr) particles_->start(levels_.existing(), time_);
  };
  start_particles();
  // Each pass may add one level; one more for every level finds that nothing changes.
  for (int pass = 0; regridding_.adaptive() && pass < 2 * levels_.possible(); ++pass) {
    if (!regridding_.add_level_at_start(time_)) break;
    start_particles();
  }
  coarse_step_.renew();
  levels_.restrict_all();
  rates_.measure(0, time_);
}

void Hierarchy::succeed(const Hierarchy& earlier) {
  time_ = earlier.time_;
  coarse_step_.set_previous_dt(earlier.coarse_step_.previous_dt());
  costs_ = earlier.costs_;
  balancing_.succeed(earlier.balancing_);
  if (particles_ == nullptr) return rates_.measure(0, time_);
  particles_->succeed(*earlier.particles_, levels_.existing());
  // A state alone does not tell all that the last step knew of its rates: this goes on where both
  // find the same in the state.
  bool alike = true;
  for (int l = 0; l < level_count(); ++l)
    alike = alike && particles_->rates(l) == earlier.particles_->rates(l);
  if (alike)
    rates_.set_maxima(earlier.rates_.maxima());
  else
    rates_.measure(0, time_);
}

const CycleResult& Hierarchy::attempt(int step, double time, double dt,
                                      const std::vector<Label>& wanted, const RunControl& control,
                                      EventLedger& ledger) {
  time_ = time;
  end_ = time + dt;
  return coarse_step_.attempt({step, time, dt, &wanted, &control, &ledger});
}

void Hierarchy::advance_particles() {
  if (particles_ == nullptr) return;
  bool any = false;
  for (int k = 0; k < particles_->kind_count(); ++k) any |= !component_->particles()->in_stages(k);
  if (!any) return;
  fill_ghosts(end_);
  particles_->advance(levels_.existing(), end_, levels_.substeps_in_coarse_step(level_count() - 1));
}

void Hierarchy::accept() {
  advance_particles();
  coarse_step_.accept();
  time_ = end_;
  for (int l = 0; l < level_count(); ++l) {
    const std::int64_t cells = level(l).level().cell_count();
    costs_[l].updates += levels_.substeps_in_coarse_step(l) * cells;
    costs_[l].max_cells = std::max(costs_[l].max_cells, cells);
  }
}

bool Hierarchy::regrid(int step) {
  const bool changed = regridding_.regrid(step, time_);
  coarse_step_.renew();
  return changed;
}

bool Hierarchy::balance(int step) {
  return balancing_.balance(step);
}

void Hierarchy::compute_diagnostics(double time, const std::vector<Label>& wanted) {
  fill_ghosts(time);
  for (int l = 0; l < level_count(); ++l) level(l).compute_diagnostics(time, wanted);
}

void Hierarchy::add_totals(Totals& totals) const {
  for (int l = 0; l < level_count(); ++l)
    component_->budgets().add_totals(level(l).state(), level(l).graphs().coverage(), totals);
  if (particles_ != nullptr) component_->budgets().add_particle_totals(*particles_, totals);
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
  method.store_on_grid(coarse_step_.scope_between_steps(time_), fields);
  return fields;
}

void Hierarchy::settle_particles() {
  if (particles_ != nullptr && component_->particles()->in_stages()) particles_->relocate();
}

std::vector<LevelCost> Hierarchy::costs() const {
  std::vector<LevelCost> costs = costs_;
  for (int l = 0; l < levels_.possible(); ++l) {
    costs[l].cells = level(l).level().cell_count();
    costs[l].boxes = static_cast<std::int64_t>(level(l).level().boxes.size());
    costs[l].max_cells = std::max(costs[l].max_cells, costs[l].cells);
    costs[l].domain_cells = level(l).level().domain.volume();
    costs[l].substeps = levels_.substeps_in_coarse_step(l);
  }
  return costs;
}

}  // namespace sluice
