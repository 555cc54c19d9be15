// What the run loop asks of the fluid alone; the time steps are in step_tables.cpp.
#include "ice/ice.hpp"

#include "ice/budgets/rates.hpp"
#include "ice/budgets/step_limit.hpp"
#include "ice/budgets/totals.hpp"
#include "ice/fluid/labels.hpp"

namespace sluice::ice {

void Ice::fill_boundary(Warehouse& state, double time, std::span<const double> sums,
                        const ThreadTeam& team) const {
  fluid_.boundary(state.level().index).fill(state, team, time, sums);
}

void Ice::fill_work_boundary(Warehouse& state, Label label, const ThreadTeam& team) const {
  // Faces that a finer level gives lie inside the domain.
  if (label == labels().pressure_increment)
    fluid_.boundary(state.level().index)
        .fill_increment(state, state.find(label, fluid_.options().place(0)), team);
}

int Ice::boundary_sums() const {
  return fluid_.boundary(0).sum_count();
}

void Ice::add_boundary_sums(const Warehouse& state, std::span<ExactSum> sums) const {
  fluid_.boundary(0).add_sums(state, sums);
}

std::optional<double> Ice::absent_value(Label label, int material, int kind) const {
  const IndexOffsets& places = fluid_.options().accounts.places;
  return label == labels().volume && material == places.material_of(kind) ? 1.0 : 0.0;
}

Label Ice::refine_flag() const {
  return labels().refine_flag;
}

Label Ice::mask_label() const {
  return labels().mask;
}

bool Ice::diffusive() const {
  return ice::diffusive(fluid_.options());
}

void Ice::measure_rates(const Warehouse& state, Reductions& rates) const {
  const ice::SchemeOptions o = fluid_.at_level(state.level().index);
  ice::measure_rates(state, o, {rates, o.accounts.places.reduction_offsets()});
}

StepLimit Ice::step_limit(const std::vector<double>& maxima) const {
  return ice::step_limit(fluid_.options(), maxima);
}

void Ice::add_totals(const Warehouse& state, const LevelCoverage& coverage, Totals& totals) const {
  ice::add_totals(state, coverage, fluid_.options(), totals);
}

StepBalance Ice::balance(const std::vector<double>& sums, const StepStart* start, double dt) const {
  return ice::balance(fluid_.options(), sums, start, dt);
}

std::vector<std::string> Ice::tracked_names() const {
  return ice::tracked_names(fluid_.options());
}

std::vector<double> Ice::tracked_totals(const std::vector<double>& sums) const {
  return ice::tracked_totals(fluid_.options(), sums);
}

double Ice::history_value(Label label, const Totals& totals) const {
  if (const auto found = fluid_.solves().value(label)) return *found;
  return ice::history_value(fluid_.options(), label, totals);
}

Vec3 Ice::history_vector(Label label, const Totals& totals) const {
  return ice::history_vector(label, totals);
}

}  // namespace sluice::ice
