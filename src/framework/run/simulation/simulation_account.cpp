// What a run has of each conserved quantity, and what came in through boundaries and from sources.
#include <algorithm>
#include <cmath>

#include "framework/run/component/particle_method.hpp"
#include "framework/run/simulation/simulation.hpp"

namespace sluice {
namespace {

ConservedTotal single(double q) {
  ConservedTotal t;
  t.add(q);
  return t;
}

void merge_ranks(ConservedTotal& total, Communicator& communicator) {
  if (communicator.size() == 1) return;
  Reduction all;
  const auto sum = all.add_sum(total.sum), magnitude = all.add_sum(total.magnitude);
  communicator.reduce(all);
  total.sum = all.sum(sum);
  total.magnitude = all.sum(magnitude);
}

}  // namespace

std::vector<std::string> Simulation::conserved_names(const Component& component) {
  std::vector<std::string> names;
  for (int m = 0; m < component.material_count(); ++m)
    names.push_back("mass of material " + std::to_string(m));
  for (const char* d : {"x", "y", "z"}) names.push_back(std::string("momentum ") + d);
  names.emplace_back("total energy");
  return names;
}

Totals Simulation::totals() {
  Totals t;
  hierarchy_->add_totals(t);
  for (ConservedTotal& m : t.mass) merge_ranks(m, *communicator_);
  for (ConservedTotal& m : t.momentum) merge_ranks(m, *communicator_);
  merge_ranks(t.internal_energy, *communicator_);
  merge_ranks(t.kinetic_energy, *communicator_);
  for (int n = 0; n < tracked_.count(); ++n) t.tracked_totals.push_back(tracked_.sources(n));
  for (ConservedTotal& a : t.amounts) merge_ranks(a, *communicator_);
  for (int l = 0; l < hierarchy_->level_count(); ++l) {
    const std::vector<double>& own = hierarchy_->level(l).attempt_result().sums;
    t.sweep_sums.resize(std::max(t.sweep_sums.size(), own.size()));
    for (std::size_t n = 0; n < own.size(); ++n) t.sweep_sums[n] += own[n];
  }
  // A step of particles in stages has no sweep: what its stages summed.
  const ParticleMethod* method = component_->particles();
  if (method != nullptr && method->in_stages())
    t.sweep_sums = hierarchy_->coarse_step().result().sums;
  return t;
}

void Simulation::set_totals(bool at_start) {
  const Totals t = totals();
  int q = 0;
  auto set = [&](const ConservedTotal& total) {
    if (at_start) conservation_.set_start(q, total);
    conservation_.set_now(q++, total);
  };
  step_start_ = {};
  for (const ConservedTotal& m : t.mass) {
    set(m);
    step_start_.mass.push_back(m.sum.value());
  }
  for (int d = 0; d < 3; ++d) {
    set(t.momentum[d]);
    step_start_.momentum[d] = t.momentum[d].sum.value();
  }
  ConservedTotal energy = t.internal_energy;
  energy.merge(t.kinetic_energy);
  set(energy);
  q = 0;
  for (const ConservedTotal& total : component_->budgets().tallied_totals(t)) {
    if (at_start) tracked_.set_start(q, total);
    tracked_.set_now(q++, total);
  }
  conservation_.set_vector(component_->material_count(), 3, momentum_of_all_energy());
}

void Simulation::record(const StepPlan& plan, const std::vector<double>& sums) {
  const bool joined = hierarchy_->levels().possible() > 1;
  const StepBalance b =
      component_->budgets().balance(sums, joined ? nullptr : &step_start_, plan.dt);
  int q = 0;
  for (std::size_t m = 0; m < b.mass.size(); ++m) {
    conservation_.add_boundary(q++, single(b.mass[m]));
    step_start_.mass[m] += b.mass[m];
    if (b.mass_of_sources.empty()) continue;
    conservation_.add_sources(q - 1, single(b.mass_of_sources[m]));
    step_start_.mass[m] += b.mass_of_sources[m];
  }
  for (int d = 0; d < 3; ++d) {
    conservation_.add_boundary(q, single(b.momentum[d]));
    conservation_.add_sources(q++, single(b.momentum_of_forces[d]));
    step_start_.momentum[d] += b.momentum[d] + b.momentum_of_forces[d];
  }
  conservation_.add_boundary(q, single(b.energy));
  conservation_.add_sources(q, single(b.energy_of_forces));
  const std::vector<double> added = component_->budgets().tracked_totals(sums);
  for (std::size_t n = 0; n < added.size(); ++n)
    tracked_.add_sources(static_cast<int>(n), single(added[n]));
}

// What the momentum would be if all the energy moved all the mass.
double Simulation::momentum_of_all_energy() const {
  const int masses = component_->material_count(), energy = masses + 3;
  double mass = 0;
  for (int m = 0; m < masses; ++m) mass += std::fabs(conservation_.now(m));
  return std::sqrt(2 * mass * std::fabs(conservation_.now(energy)));
}

}  // namespace sluice
