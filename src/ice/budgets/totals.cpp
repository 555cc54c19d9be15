#include "ice/budgets/totals.hpp"

#include <algorithm>

#include "ice/fluid/labels.hpp"
#include "ice/sources/source_tasks.hpp"

namespace sluice::ice {
namespace {

// Adds the cells of a state to totals, row by row. Several materials share one momentum.
class TotalsOfRows {
 public:
  TotalsOfRows(const Warehouse& state, const SchemeOptions& options, int materials, Totals& totals)
      : state_(state),
        options_(options),
        totals_(totals),
        momentum_(state.find(labels().momentum, options.place(0))),
        volume_(state.level().cell_volume()) {
    for (int m = 0; m < materials; ++m) {
      mass_.push_back(state.find(labels().mass, options.place(m)));
      energy_.push_back(state.find(labels().energy, options.place(m)));
      if (options.materials.multi_velocity)
        slip_.push_back(state.find(labels().slip, options.place(m)));
    }
    fraction_ = state.find(labels().solid_fraction, options.place(0));
    for (const models::TransportedScalar& s : options.materials.scalars)
      scalars_.push_back(
          {state.find(s.state(), options.place(s.material)), static_cast<std::size_t>(s.material)});
  }

  void add(int box, const IndexBox& cells) {
    const int along = options_.grid.axes.direction[0];
    values_.resize(cells.size()[along]);
    kinetic_.resize(values_.size());
    IndexBox starts = cells;  // the first cell of every row
    starts.upper[along] = starts.lower[along] + 1;
    for_each_cell(starts, [&](IntVec3 start) { add_row(box, start); });
  }

 private:
  const double* row(int slot, int c, int box, IntVec3 start) const {
    const RealView v = state_.view(slot, c, box);
    return v.data + v.offset(start);
  }
  void add(ConservedTotal& total, const double* q) {
    for (std::size_t i = 0; i < values_.size(); ++i) values_[i] = q[i] * volume_;
    for (std::size_t i = 0; i < values_.size() && solid_ != nullptr; ++i)
      values_[i] *= 1.0 - solid_[i];
    total.add(values_.data(), values_.size());
  }
  void add_row(int box, IntVec3 start) {
    if (fraction_ >= 0) solid_ = row(fraction_, 0, box, start);
    const double* rho = density(box, start);
    for (const int energy : energy_) add(totals_.internal_energy, row(energy, 0, box, start));
    std::fill(kinetic_.begin(), kinetic_.end(), 0.0);
    for (int c = 0; c < options_.grid.components; ++c) {
      const double* m = row(momentum_, c, box, start);
      add(totals_.momentum[options_.grid.direction[c]], m);
      for (std::size_t i = 0; i < kinetic_.size(); ++i) kinetic_[i] += m[i] * m[i];
    }
    for (std::size_t i = 0; i < kinetic_.size(); ++i) kinetic_[i] = 0.5 * kinetic_[i] / rho[i];
    add(totals_.kinetic_energy, kinetic_.data());
    for (std::size_t m = 0; m < slip_.size(); ++m)
      add_slip(row(mass_[m], 0, box, start), m, box, start);
    for (std::size_t s = 0; s < scalars_.size(); ++s) {
      const double* q = row(scalars_[s].slot, 0, box, start);
      const double* mass = row(mass_[scalars_[s].material], 0, box, start);
      for (std::size_t i = 0; i < kinetic_.size(); ++i) kinetic_[i] = mass[i] * q[i];
      add(totals_.amounts[s], kinetic_.data());
    }
  }
  // Kinetic energy of a material relative to the mixture.
  void add_slip(const double* M, std::size_t m, int box, IntVec3 start) {
    std::fill(kinetic_.begin(), kinetic_.end(), 0.0);
    for (int c = 0; c < options_.grid.components; ++c) {
      const double* S = row(slip_[m], c, box, start);
      for (std::size_t i = 0; i < kinetic_.size(); ++i) kinetic_[i] += S[i] * S[i];
    }
    for (std::size_t i = 0; i < kinetic_.size(); ++i)
      kinetic_[i] = kinetic_[i] > 0.0 ? 0.5 * kinetic_[i] / M[i] : 0.0;
    add(totals_.kinetic_energy, kinetic_.data());
  }

  // Of all materials, after adding the mass of each.
  const double* density(int box, IntVec3 start) {
    const double* first = row(mass_.front(), 0, box, start);
    add(totals_.mass.front(), first);
    if (mass_.size() == 1) return first;
    density_.assign(first, first + values_.size());
    for (std::size_t m = 1; m < mass_.size(); ++m) {
      const double* M = row(mass_[m], 0, box, start);
      add(totals_.mass[m], M);
      for (std::size_t i = 0; i < density_.size(); ++i) density_[i] += M[i];
    }
    return density_.data();
  }

  const Warehouse& state_;
  const SchemeOptions& options_;
  Totals& totals_;
  int momentum_;
  int fraction_ = -1;                      // of solids; -1: the scene has none
  const double* solid_ = nullptr;          // its row
  std::vector<int> mass_, energy_, slip_;  // by material
  struct Scalar {
    int slot;
    std::size_t material;
  };
  std::vector<Scalar> scalars_;
  double volume_;
  std::vector<double> values_, kinetic_, density_;
};

void add_source_balance(const SchemeOptions& o, const std::vector<double>& all, StepBalance& b) {
  if (o.forces.sources == nullptr) return;
  const std::span<const double> sums = o.budgets.source_sums.of(all);
  const std::size_t beside = o.materials.fluids.size();
  for (std::size_t s = 0; s < beside; ++s) b.mass_of_sources.push_back(sums[s]);
  for (int d = 0; d < 3; ++d) b.momentum_of_forces[d] += sums[beside + SourceSums::momentum + d];
  b.energy_of_forces += sums[beside + SourceSums::total_energy];
}

}  // namespace

void add_totals(const Warehouse& state, const LevelCoverage& coverage, const SchemeOptions& o,
                Totals& totals) {
  totals.mass.resize(o.materials.fluids.size());
  totals.amounts.resize(o.materials.scalars.size());
  TotalsOfRows rows(state, o, static_cast<int>(o.materials.fluids.size()), totals);
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    if (!coverage.any())
      rows.add(b, state.local_boxes()[b].cells);
    else
      for (const IndexBox& cells : coverage.uncovered(b)) rows.add(b, cells);
  }
}

std::vector<std::string> tracked_names(const SchemeOptions& o) {
  if (o.forces.sources == nullptr) return {};
  return {"model mass",       "model momentum x", "model momentum y",
          "model momentum z", "model energy",     "exchanged mass",
          "exchanged energy", "burned mass",      "released heat"};
}

std::vector<double> tracked_totals(const SchemeOptions& o, const std::vector<double>& all) {
  if (o.forces.sources == nullptr) return {};
  StepBalance added;
  add_source_balance(o, all, added);
  const std::span<const double> sums = o.budgets.source_sums.of(all);
  const std::size_t beside = o.materials.fluids.size();
  double mass = 0;
  for (const double m : added.mass_of_sources) mass += m;
  const Vec3 momentum = added.momentum_of_forces;
  return {mass,
          momentum.x,
          momentum.y,
          momentum.z,
          sums[beside + SourceSums::total_energy] - sums[beside + SourceSums::heat],
          sums[beside + SourceSums::exchanged_mass],
          sums[beside + SourceSums::exchanged_energy],
          sums[beside + SourceSums::burned_mass],
          sums[beside + SourceSums::released_heat]};
}

// Gravity acts on the mass at the start of the step and works along the mean momentum of the
// Lagrangian phase: work = dt g . (P + P_L)/2, P_L = P + pressure impulse + dt g M.
StepBalance balance(const SchemeOptions& o, const std::vector<double>& all, const StepStart* start,
                    double dt) {
  const std::span<const double> sums = o.budgets.places.sums.of(all);
  StepBalance b;
  for (int m = 0; m < static_cast<int>(o.materials.fluids.size()); ++m)
    b.mass.push_back(sums[StepSlots::mass_of(m, o.budgets.sums)]);
  double mass = 0;  // of all materials at the start
  if (start != nullptr)
    for (const double of_one : start->mass) mass += of_one;
  b.energy = sums[StepSlots::energy];
  for (int d = 0; d < 3; ++d) {
    b.momentum[d] = sums[StepSlots::momentum + d];
    if (start == nullptr || o.forces.driving_on) continue;
    const double impulse = sums[StepSlots::pressure_impulse + d];
    const double kick = dt * o.forces.gravity[d] * mass;
    b.momentum_of_forces[d] = kick;
    b.energy_of_forces += dt * o.forces.gravity[d] * (start->momentum[d] + 0.5 * (impulse + kick));
  }
  add_source_balance(o, all, b);
  if (!o.forces.on || (start != nullptr && !o.forces.driving_on)) return b;
  for (int d = 0; d < 3; ++d) b.momentum_of_forces[d] += sums[StepSlots::gravity_impulse + d];
  b.energy_of_forces += sums[StepSlots::gravity_work];
  return b;
}

double history_value(const SchemeOptions& o, Label label, const Totals& totals) {
  if (label == labels().total_mass) {
    ExactSum all;
    for (const ConservedTotal& mass : totals.mass) all.merge(mass.sum);
    return all.value();
  }
  const auto tally = [&](std::size_t n) {
    return n < totals.tracked_totals.size() ? totals.tracked_totals[n] : 0.0;
  };
  if (label == labels().total_model_mass) return tally(0);
  if (label == labels().total_model_energy) return tally(4);
  if (label == labels().total_mass_exchanged) return tally(5);
  if (label == labels().total_energy_exchanged) return tally(6);
  if (label == labels().total_mass_burned) return tally(7);
  if (label == labels().total_heat_released) return tally(8);
  for (std::size_t s = 0; s < o.materials.scalars.size(); ++s)
    if (label == o.materials.scalars[s].total()) return totals.amounts[s].sum.value();
  if (label == labels().total_internal_energy) return totals.internal_energy.sum.value();
  return totals.kinetic_energy.sum.value();
}

Vec3 history_vector(Label label, const Totals& totals) {
  if (label == labels().total_model_momentum) {
    if (totals.tracked_totals.empty()) return {};
    return {totals.tracked_totals[1], totals.tracked_totals[2], totals.tracked_totals[3]};
  }
  return {totals.momentum[0].sum.value(), totals.momentum[1].sum.value(),
          totals.momentum[2].sum.value()};
}

}  // namespace sluice::ice
