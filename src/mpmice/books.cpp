// The books of fluid and solids together: totals, what passes, the account of energy, histories.
#include <algorithm>

#include "framework/run/levels/particle_cloud.hpp"
#include "ice/fluid/labels.hpp"
#include "mpm/step/solid_step.hpp"
#include "mpmice/burn/burned_sums.hpp"
#include "mpmice/mpmice.hpp"

namespace sluice::mpmice {
namespace {

std::vector<double> fluid_part(const std::vector<double>& all, int first) {
  return {all.begin() + first, all.end()};
}

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

std::size_t MpmIce::first_burned_sum() const {
  return solids_.reduction_sums() + fluid_.reduction_sums();
}

std::vector<std::string> MpmIce::tracked_names() const {
  std::vector<std::string> names = fluid_.tracked_names();
  if (!burns_.empty()) names.insert(names.end(), {"burned mass of solids", "heat of burning"});
  if (has_budget()) {
    for (const std::string& name : solids_.tracked_names()) names.push_back(name);
    names.emplace_back("surfaces");
  }
  return names;
}

bool MpmIce::has_budget() const {
  const auto& solids = solids_.scene().materials;
  return burns_.empty() &&
         std::none_of(solids.begin(), solids.end(), [](const auto& m) { return m.rigid; });
}

std::vector<double> MpmIce::tracked_totals(const std::vector<double>& sums) const {
  std::vector<double> all = fluid_.tracked_totals(fluid_part(sums, solids_.reduction_sums()));
  if (has_budget()) {
    for (const double of_solids : solids_.tracked_totals(sums)) all.push_back(of_solids);
    all.push_back(sums[mpm::StepSums::surface_work] + sums[mpm::StepSums::corner_work]);
  }
  if (burns_.empty()) return all;
  const std::size_t beside = first_burned_sum() + material_count();
  all.push_back(sums[beside + BurnedSums::burned]);
  all.push_back(sums[beside + BurnedSums::heat]);
  return all;
}

// The kinetic and the internal energy of the solids are the last of the amounts.
std::vector<ConservedTotal> MpmIce::tallied_totals(const Totals& totals) const {
  if (!has_budget()) return {};
  std::vector<ConservedTotal> all(fluid_.tracked_names().size());
  all.insert(all.end(), totals.amounts.end() - 2, totals.amounts.end());
  all.resize(all.size() + 5);
  return all;
}

// What surfaces work on the fluid and its forces on the nodes of solids is one but for the time of
// the velocity (v* of the swept volume, (v + v*)/2 of the nodes) and places within a step.
std::vector<std::pair<std::string, double>> MpmIce::budget(
    const Conservation& tracked_totals) const {
  if (!has_budget()) return {};
  const auto first = static_cast<int>(fluid_.tracked_names().size());
  auto all = mpm::Mpm::budget_from(tracked_totals, first);
  all.emplace_back("surfaces", -tracked_totals.sources(first + 6));
  return all;
}

void MpmIce::add_totals(const Warehouse& state, const LevelCoverage& coverage,
                        Totals& totals) const {
  Totals fluid_totals;
  fluid_.add_totals(state, coverage, fluid_totals);
  solids_.add_totals(state, coverage, totals);
  totals.mass.resize(material_count());
  totals.amounts.resize(solids_.amount_count() + fluid_totals.amounts.size());
  join(fluid_totals, solids_.material_count(), solids_.amount_count(), totals);
}

void MpmIce::add_particle_totals(const ParticleCloud& particles, Totals& totals) const {
  Totals own;
  own.amounts.resize(solids_.amount_count());
  solids_.add_particle_totals(particles, own);
  join(own, 0, 0, totals);
  if (has_budget()) {
    totals.amounts.push_back(own.kinetic_energy);
    totals.amounts.push_back(own.internal_energy);
  }
  add_reference_work(particles, totals);
}

// Solids free of stress bear the reference pressure, which works on them: -p_ref V.
void MpmIce::add_reference_work(const ParticleCloud& particles, Totals& totals) const {
  for (int k = 0; k < solids_.material_count(); ++k) {
    const double reference = solids_.scene().materials[k].constants.reference_pressure;
    const ParticleStore& store = particles.store(k);
    for (int l = 0; l < store.level_count() && reference != 0; ++l)
      for (int b = 0; b < store.box_count(l); ++b) {
        const ParticleSet& set = store.set(l, b);
        const double* volume = set.column(solids_.carried()[k].columns.volume);
        for (std::size_t p = 0; p < set.size(); ++p)
          totals.internal_energy.add(-reference * volume[p]);
      }
  }
}

StepBalance MpmIce::balance(const std::vector<double>& sums, const StepStart* start,
                            double dt) const {
  StepBalance b = solids_.balance(sums, start, dt);
  b.energy -= sums[mpm::StepSums::left_reference];
  StepStart fluid_totals;
  if (start != nullptr) fluid_totals = {fluid_part(start->mass, solids_.material_count()), {}};
  const StepBalance f = fluid_.balance(fluid_part(sums, solids_.reduction_sums()),
                                       start != nullptr ? &fluid_totals : nullptr, dt);
  b.mass.insert(b.mass.end(), f.mass.begin(), f.mass.end());
  if (!f.mass_of_sources.empty()) {
    b.mass_of_sources.assign(solids_.material_count(), 0.0);
    b.mass_of_sources.insert(b.mass_of_sources.end(), f.mass_of_sources.begin(),
                             f.mass_of_sources.end());
  }
  b.momentum = b.momentum + f.momentum;
  b.momentum_of_forces = b.momentum_of_forces + f.momentum_of_forces;
  b.energy += f.energy;
  b.energy_of_forces += f.energy_of_forces;
  if (burns_.empty()) return b;
  b.mass_of_sources.resize(material_count(), 0.0);
  for (std::size_t m = 0; m < b.mass_of_sources.size(); ++m)
    b.mass_of_sources[m] += sums[first_burned_sum() + m];
  b.energy_of_forces += sums[first_burned_sum() + b.mass_of_sources.size() + BurnedSums::energy];
  return b;
}

// The amounts of the fluid come after those of the solids.
Totals MpmIce::fluid_totals(const Totals& all) const {
  Totals own = all;
  if (has_budget()) own.amounts.resize(own.amounts.size() - 2);
  own.tracked_totals.resize(std::min(own.tracked_totals.size(), fluid_.tracked_names().size()));
  const auto scalars =
      static_cast<std::ptrdiff_t>(fluid_.part().options().materials.scalars.size());
  if (static_cast<std::ptrdiff_t>(own.amounts.size()) > scalars)
    own.amounts.erase(own.amounts.begin(), own.amounts.end() - scalars);
  return own;
}

double MpmIce::history_value(Label label, const Totals& totals) const {
  const std::size_t tallied = totals.tracked_totals.size();
  if (!burns_.empty() && tallied >= 2) {
    // Fluids alone may burn too.
    const double fluid = tallied > 2 && (label == ice::labels().total_mass_burned ||
                                         label == ice::labels().total_heat_released)
                             ? fluid_.history_value(label, totals)
                             : 0.0;
    if (label == ice::labels().total_mass_burned) return totals.tracked_totals[tallied - 2] + fluid;
    if (label == ice::labels().total_heat_released)
      return totals.tracked_totals[tallied - 1] + fluid;
  }
  return solids_.has_history(label) ? solids_.history_value(label, totals)
                                    : fluid_.history_value(label, fluid_totals(totals));
}

Vec3 MpmIce::history_vector(Label label, const Totals& totals) const {
  return solids_.has_history(label) ? solids_.history_vector(label, totals)
                                    : fluid_.history_vector(label, fluid_totals(totals));
}

}  // namespace sluice::mpmice
