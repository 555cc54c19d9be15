#include "mpmice/mpmice_budgets.hpp"

#include <algorithm>
#include <span>

#include "framework/run/levels/particle_cloud.hpp"
#include "mpm/step/solid_step.hpp"
#include "mpmice/mpmice.hpp"

namespace sluice::mpmice {
namespace {

// Those of a part, whose materials and amounts begin there, join the totals of both.
void join(const Totals& part, std::size_t first_material, std::size_t first_amount, Totals& all) {
  for (std::size_t m = 0; m < part.mass.size(); ++m)
    all.mass[first_material + m].merge(part.mass[m]);
  for (int d = 0; d < 3; ++d) all.momentum[d].merge(part.momentum[d]);
  all.internal_energy.merge(part.internal_energy);
  all.kinetic_energy.merge(part.kinetic_energy);
  for (std::size_t n = 0; n < part.amounts.size(); ++n)
    all.amounts[first_amount + n].merge(part.amounts[n]);
}

}  // namespace

std::vector<std::string> MpmIceBudgets::tracked_names() const {
  std::vector<std::string> names = both_->fluid().budgets().tracked_names();
  if (!both_->burns().empty())
    names.insert(names.end(), {"burned mass of solids", "heat of burning"});
  if (both_->has_budget()) {
    for (const std::string& name : both_->solids().budgets().tracked_names()) names.push_back(name);
    names.emplace_back("surfaces");
  }
  return names;
}

std::vector<double> MpmIceBudgets::tracked_totals(const std::vector<double>& sums) const {
  std::vector<double> all = both_->fluid().budgets().tracked_totals(sums);
  if (both_->has_budget()) {
    for (const double of_solids : both_->solids().budgets().tracked_totals(sums))
      all.push_back(of_solids);
    const std::span<const double> own = both_->solids().sums().of(sums);
    all.push_back(own[mpm::StepSums::surface_work] + own[mpm::StepSums::corner_work]);
  }
  if (both_->burns().empty()) return all;
  const std::span<const double> beside =
      both_->burn_reductions().burned.of(sums).subspan(both_->material_count());
  all.push_back(beside[BurnedSums::burned]);
  all.push_back(beside[BurnedSums::heat]);
  return all;
}

// The kinetic and the internal energy of the solids are the last of the amounts.
std::vector<ConservedTotal> MpmIceBudgets::tallied_totals(const Totals& totals) const {
  if (!both_->has_budget()) return {};
  std::vector<ConservedTotal> all(both_->fluid().budgets().tracked_names().size());
  all.insert(all.end(), totals.amounts.end() - 2, totals.amounts.end());
  all.resize(all.size() + 6);
  return all;
}

// What surfaces work on the fluid and its forces on the nodes of solids is one but for the time of
// the velocity (v* of the swept volume, (v + v*)/2 of the nodes) and places within a step.
std::vector<std::pair<std::string, double>> MpmIceBudgets::budget(
    const Conservation& tallies) const {
  if (!both_->has_budget()) return {};
  const auto first = static_cast<int>(both_->fluid().budgets().tracked_names().size());
  auto all = mpm::MpmBudgets::budget_from(tallies, first);
  all.emplace_back("surfaces", -tallies.sources(first + 7));
  return all;
}

void MpmIceBudgets::add_totals(const Warehouse& state, const LevelCoverage& coverage,
                               Totals& totals) const {
  Totals fluid_totals;
  both_->fluid().budgets().add_totals(state, coverage, fluid_totals);
  both_->solids().budgets().add_totals(state, coverage, totals);
  totals.mass.resize(both_->material_count());
  totals.amounts.resize(both_->solids().amount_count() + fluid_totals.amounts.size());
  join(fluid_totals, both_->solids().material_count(), both_->solids().amount_count(), totals);
}

void MpmIceBudgets::add_particle_totals(const ParticleCloud& particles, Totals& totals) const {
  Totals own;
  own.amounts.resize(both_->solids().amount_count());
  both_->solids().budgets().add_particle_totals(particles, own);
  join(own, 0, 0, totals);
  if (both_->has_budget()) {
    totals.amounts.push_back(own.kinetic_energy);
    totals.amounts.push_back(own.internal_energy);
  }
  add_reference_work(particles, totals);
}

// Solids free of stress bear the reference pressure, which works on them: -p_ref V.
void MpmIceBudgets::add_reference_work(const ParticleCloud& particles, Totals& totals) const {
  for (int k = 0; k < both_->solids().material_count(); ++k) {
    const double reference = both_->solids().scene().materials[k].constants.reference_pressure;
    const ParticleStore& store = particles.store(k);
    for (int l = 0; l < store.level_count() && reference != 0; ++l)
      for (int b = 0; b < store.box_count(l); ++b) {
        const ParticleSet& set = store.set(l, b);
        const double* volume = set.column(both_->solids().carried()[k].columns.volume);
        for (std::size_t p = 0; p < set.size(); ++p)
          totals.internal_energy.add(-reference * volume[p]);
      }
  }
}

StepBalance MpmIceBudgets::balance(const std::vector<double>& sums, const StepStart* start,
                                   double dt) const {
  StepBalance b = both_->solids().budgets().balance(sums, start, dt);
  b.energy -= both_->solids().sums().of(sums)[mpm::StepSums::left_reference];
  StepStart fluid_totals;
  if (start != nullptr)
    fluid_totals.mass.assign(start->mass.begin() + both_->solids().material_count(),
                             start->mass.end());
  const StepBalance f =
      both_->fluid().budgets().balance(sums, start != nullptr ? &fluid_totals : nullptr, dt);
  b.mass.insert(b.mass.end(), f.mass.begin(), f.mass.end());
  if (!f.mass_of_sources.empty()) {
    b.mass_of_sources.assign(both_->solids().material_count(), 0.0);
    b.mass_of_sources.insert(b.mass_of_sources.end(), f.mass_of_sources.begin(),
                             f.mass_of_sources.end());
  }
  b.momentum = b.momentum + f.momentum;
  b.momentum_of_forces = b.momentum_of_forces + f.momentum_of_forces;
  b.energy += f.energy;
  b.energy_of_forces += f.energy_of_forces;
  if (both_->burns().empty()) return b;
  const std::span<const double> burned = both_->burn_reductions().burned.of(sums);
  b.mass_of_sources.resize(both_->material_count(), 0.0);
  for (std::size_t m = 0; m < b.mass_of_sources.size(); ++m) b.mass_of_sources[m] += burned[m];
  b.energy_of_forces += burned[b.mass_of_sources.size() + BurnedSums::energy];
  return b;
}

std::optional<VolumeSums> MpmIceBudgets::volume_sums() const {
  return both_->fluid().budgets().volume_sums();
}

std::vector<BodyEnergy> MpmIceBudgets::body_energies(const std::vector<double>& sums) const {
  return both_->solids().budgets().body_energies(sums);
}

std::string MpmIceBudgets::place_of_gain(const ParticleCloud& cloud, int material,
                                         Communicator& ranks) const {
  return both_->solids().budgets().place_of_gain(cloud, material, ranks);
}

}  // namespace sluice::mpmice
