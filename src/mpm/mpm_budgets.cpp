#include "mpm/mpm_budgets.hpp"

#include <algorithm>
#include <span>

#include "framework/run/levels/particle_cloud.hpp"
#include "mpm/mpm.hpp"
#include "mpm/step/cohesive_zones.hpp"
#include "mpm/step/step_sums.hpp"

namespace sluice::mpm {

StepBalance MpmBudgets::balance(const std::vector<double>& sums, const StepStart* /*start*/,
                                double /*dt*/) const {
  const std::span<const double> own = mpm_->sums().of(sums);
  StepBalance b;
  for (std::size_t m = 0; m < mpm_->scene().materials.size(); ++m)
    b.mass.push_back(-own[StepSums::count + m]);
  for (int d = 0; d < 3; ++d) {
    b.momentum[d] = own[StepSums::impulse_x + d] - own[StepSums::left_x + d];
    b.momentum_of_forces[d] = own[StepSums::force_x + d];
  }
  // What spins and affine velocities hold is not in the totals of particles, nor is it lost.
  b.energy = own[StepSums::work] - own[StepSums::left_kinetic] - own[StepSums::left_internal] -
             own[StepSums::inner_gain];
  b.energy_of_forces = own[StepSums::force_work] - own[StepSums::heat_from_fluid];
  return b;
}

// docs/theory/mpm_transfers.md, "Energy budget". What each follows: K_p with the nodes' K* - K, U
// with the work of the forces within, what contact took, and what is left of the nodes' balance.
std::vector<std::string> MpmBudgets::tracked_names() const {
  return {"kinetic energy of particles",
          "internal energy of particles",
          "contact",
          "nodes",
          "heat of losses",
          "energy within particles",
          "energy within cells"};
}

std::vector<double> MpmBudgets::tracked_totals(const std::vector<double>& sums) const {
  const std::span<const double> own = mpm_->sums().of(sums);
  const double gain = own[StepSums::node_gain], loss = own[StepSums::contact_loss];
  const double fluid = own[StepSums::corner_work];
  const double within = own[StepSums::node_work] - own[StepSums::load_work] - fluid;  // W_int
  const double outside = own[StepSums::force_work] + own[StepSums::work] + fluid;
  const double beyond = own[StepSums::beyond_nodes];
  const double inner = own[StepSums::inner_gain], heat = own[StepSums::lost_heat];
  const double open = own[StepSums::open_gain];
  return {gain + beyond - inner + own[StepSums::exchange_gain] - own[StepSums::left_kinetic],
          heat + open - within - beyond - own[StepSums::left_internal],
          loss,
          gain - (within + outside - loss),
          heat,
          inner,
          open};
}

std::vector<ConservedTotal> MpmBudgets::tallied_totals(const Totals& totals) const {
  return {totals.kinetic_energy, totals.internal_energy, {}, {}, {}, {}, {}};
}

// T = K_p^n - K_p^(n+1) + (K* - K), R = -W_int - (U^(n+1) - U^n), D_c, summed over the run; all in
// J. "nodes": round-off. Of the midpoint transfer what kicks give to particles takes the place of
// K* - K, as nodes of little mass move further than what reads them: T is then what spins lost.
// "back as heat": what of all that became heat (step/lost_energy.cpp), less than 0; "within
// particles": what spins and affine velocities hold. All of them are what the total energy lost.
std::vector<std::pair<std::string, double>> MpmBudgets::budget(const Conservation& tallies) const {
  return budget_from(tallies, 0);
}

std::vector<std::pair<std::string, double>> MpmBudgets::budget_from(const Conservation& tallies,
                                                                    int first) {
  std::vector<std::pair<std::string, double>> all = {
      {"transfer loss", -tallies.defect(first)},
      {"integration loss", -tallies.defect(first + 1)},
      {"contact loss", tallies.sources(first + 2)},
      {"nodes", tallies.sources(first + 3)}};
  const double heat = tallies.sources(first + 4), inner = tallies.sources(first + 5),
               open = tallies.sources(first + 6);
  if (heat != 0) all.emplace_back("back as heat", -heat);
  if (inner != 0) all.emplace_back("within particles", inner);
  if (open != 0) all.emplace_back("within cells", -open);
  return all;
}

void MpmBudgets::add_totals(const Warehouse& /*state*/, const LevelCoverage& /*coverage*/,
                            Totals& totals) const {
  // Once for each level; fluids of another part may come after the solids.
  totals.mass.resize(std::max(totals.mass.size(), mpm_->scene().materials.size()));
  totals.amounts.resize(std::max(totals.amounts.size(), mpm_->amount_count()));
}

// Of the water in pores, which counts as its material.
static void add_water(const ParticleSet& set, const Columns& c, ConservedTotal& mass,
                      Totals& totals) {
  const double* m = set.column(c.water_mass);
  const auto v = read_columns<3>(set, c.water_velocity);
  for (std::size_t p = 0; p < set.size(); ++p) {
    mass.add(m[p]);
    for (int d = 0; d < 3; ++d) {
      const double vd = v[d][p];
      totals.momentum[d].add(m[p] * vd);
      totals.kinetic_energy.add(0.5 * m[p] * vd * vd);
    }
  }
}

void MpmBudgets::add_particle_totals(const ParticleCloud& cloud, Totals& totals) const {
  totals.mass.resize(std::max(totals.mass.size(), mpm_->scene().materials.size()));
  for (int k = 0; k < static_cast<int>(mpm_->particles()->kinds().size()); ++k) {
    const ParticleStore& store = cloud.store(k);
    if (k >= static_cast<int>(mpm_->scene().materials.size())) {
      add_cohesive_energy(store, totals);
      continue;
    }
    const Columns& c = mpm_->carried()[k].columns;
    for (int l = 0; l < store.level_count(); ++l)
      for (int b = 0; b < store.box_count(l); ++b) {
        const ParticleSet& set = store.set(l, b);
        const double* m = set.column(c.mass);
        const double* energy = set.column(c.energy);
        const double* heat = c.lost_heat >= 0 ? set.column(c.lost_heat) : nullptr;
        const double* open = c.open_energy >= 0 ? set.column(c.open_energy) : nullptr;
        const auto v = read_columns<3>(set, c.velocity);
        for (std::size_t p = 0; p < set.size(); ++p) {
          totals.mass[k].add(m[p]);
          double v2 = 0;
          for (int d = 0; d < 3; ++d) {
            const double vd = v[d][p];
            totals.momentum[d].add(m[p] * vd);
            v2 += vd * vd;
          }
          totals.kinetic_energy.add(0.5 * m[p] * v2);
          totals.internal_energy.add(energy[p]);
          if (heat != nullptr) totals.internal_energy.add(heat[p] + open[p]);
        }
        if (c.water_mass >= 0) add_water(set, c, totals.mass[k], totals);
      }
  }
  if (mpm_->history_sums().any()) mpm_->history_sums().add(cloud, mpm_->carried(), totals);
}

// What the nodes' own balance lacks is what a_0 of particles is beside that of the forces before.
std::vector<std::pair<std::string, double>> ImplicitMpmBudgets::budget(
    const Conservation& tallies) const {
  auto entries = MpmBudgets::budget(tallies);
  entries[2].first = "second differences";  // their work in place of that of contact
  entries[3] = {"carried accelerations", -entries[3].second};
  return entries;
}

}  // namespace sluice::mpm
