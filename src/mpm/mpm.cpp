#include "mpm/mpm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "framework/deck/faults.hpp"
#include "framework/run/levels/particle_cloud.hpp"
#include "mpm/contact/contact.hpp"
#include "mpm/effects.hpp"
#include "mpm/histories.hpp"
#include "mpm/levels/solid_levels.hpp"
#include "mpm/step/cohesive_zones.hpp"

namespace sluice::mpm {

namespace {

// The share by which a step of h/(c + |v|) is to be multiplied before the deck's multiplier is.
StepLimit stable_limit(const Scene& scene, const MpmScene& solids) {
  const double multiplier = scene.time.timestep_multiplier;
  const StableShare stable = stable_share(solids, scene.grid.levels.front().active);
  if (multiplier <= stable.share) return {1, "waves in particles"};
  return {stable.share / multiplier,
          fmt::format("waves in particles: {:g} of h/(c + |v|) is stable with {}", stable.share,
                      stable.reason)};
}

}  // namespace

Mpm::Mpm(const Scene& scene, MpmScene solids)
    : scene_(scene),
      solids_(std::move(solids)),
      particles_(scene_, solids_),
      effects_(effects_of(scene_, solids_)),
      history_sums_(solids_),
      stable_(stable_limit(scene_, solids_)) {
  declare_histories();
  need_sums(scene_, history_sums_);
  for (const ContactRule& rule : solids_.contacts) friction_of(rule, solids_);  // or InputError
}

void Mpm::warn_of_absent_labels(std::vector<Fault>& faults) const {
  for (const SaveRequest& save : scene_.output.saves)
    if (particles_.is_absent(save.label))
      add_warning(faults, save.where,
                  "<save label=\"" + save.label +
                      "\">: no material of this deck has it; nothing "
                      "is saved of it");
}

std::shared_ptr<SolidLevels> Mpm::make_step() const {
  return std::make_shared<SolidLevels>(scene_, solids_, particles_.carried(), particles_.kinds());
}

// The step, as a table.
void Mpm::shape_step(StepShape& shape) const {
  const auto step = make_step();
  const auto stage = [&](const char* name, Verdict (SolidLevels::*act)(const StageScope&)) {
    shape.stage(name, [step, act](const StageScope& scope) { return ((*step).*act)(scope); });
  };
  stage("bounds of the sums", &SolidLevels::begin);
  if (solids_.midpoint() && files_give_velocities(solids_))
    stage("spins of the start", &SolidLevels::start_spins);
  stage("particles to grid", &SolidLevels::to_grid);
  stage("sums of images and ranks", &SolidLevels::share_sums);
  stage("nodes: contact, forces, contact, boundary", &SolidLevels::move_nodes);
  if (solids_.transfer == Transfer::xpic)
    stage("filtered velocities (XPIC)", &SolidLevels::filter_velocities);
  if (solids_.midpoint())
    stage("new velocities; to grid at the middle of the step", &SolidLevels::map_back);
  else if (solids_.maps_back())
    stage("particles move; velocities to grid (MUSL)", &SolidLevels::map_back);
  stage("grid to particles, deformation, stress", &SolidLevels::from_grid);
  shape.stage("energies of solids", judge_step);
  stage("take over", &SolidLevels::commit);
}

int Mpm::reduction_maxima() const {
  // Behind the rates: on how many particles each load acts.
  return static_cast<int>(rate_count(solids_.materials.size()) + solids_.loads.size());
}

int Mpm::reduction_sums() const {
  return static_cast<int>(StepSums::all(solids_.materials.size()));
}

// dt = min over p, d of h_d/(c_p + |v_p,d|), times the deck's timestep_multiplier or the share that
// is stable, whichever is less.
StepLimit Mpm::step_limit(const std::vector<double>& maxima) const {
  const double rate = maxima.empty() ? 0 : maxima.front();
  if (!(rate > 0)) return {1e300, "nothing moves"};
  return {stable_.dt / rate, stable_.reason};
}

StepBalance Mpm::balance(const std::vector<double>& sums, const StepStart* /*start*/,
                         double /*dt*/) const {
  StepBalance b;
  for (std::size_t m = 0; m < solids_.materials.size(); ++m)
    b.mass.push_back(-sums[StepSums::count + m]);
  for (int d = 0; d < 3; ++d) {
    b.momentum[d] = sums[StepSums::impulse_x + d] - sums[StepSums::left_x + d];
    b.momentum_of_forces[d] = sums[StepSums::force_x + d];
  }
  b.energy = sums[StepSums::work] - sums[StepSums::left_kinetic] - sums[StepSums::left_internal];
  b.energy_of_forces = sums[StepSums::force_work] - sums[StepSums::heat_from_fluid];
  return b;
}

// docs/theory/mpm_transfers.md, "Energy budget". What each follows: K_p with the nodes' K* - K, U
// with the work of the forces within, what contact took, and what is left of the nodes' balance.
std::vector<std::string> Mpm::tracked_names() const {
  return {"kinetic energy of particles",
          "internal energy of particles",
          "contact",
          "nodes",
          "heat of losses",
          "energy within particles"};
}

std::vector<double> Mpm::tracked_totals(const std::vector<double>& sums) const {
  const double gain = sums[StepSums::node_gain], loss = sums[StepSums::contact_loss];
  const double fluid = sums[StepSums::corner_work];
  const double within = sums[StepSums::node_work] - sums[StepSums::load_work] - fluid;  // W_int
  const double outside = sums[StepSums::force_work] + sums[StepSums::work] + fluid;
  const double beyond = sums[StepSums::beyond_nodes];
  const double inner = sums[StepSums::inner_gain], heat = sums[StepSums::lost_heat];
  return {gain + beyond - inner + sums[StepSums::exchange_gain] - sums[StepSums::left_kinetic],
          heat - within - beyond - sums[StepSums::left_internal],
          loss,
          gain - (within + outside - loss),
          heat,
          inner};
}

std::vector<ConservedTotal> Mpm::tallied_totals(const Totals& totals) const {
  return {totals.kinetic_energy, totals.internal_energy, {}, {}, {}, {}};
}

// T = K_p^n - K_p^(n+1) + (K* - K), R = -W_int - (U^(n+1) - U^n), D_c, summed over the run; all in
// J. "nodes": round-off. Of the midpoint transfer what kicks give to particles takes the place of
// K* - K, as nodes of little mass move further than what reads them: T is then what spins lost.
// "back as heat": what of all that became heat (step/lost_energy.cpp), less than 0; "within
// particles": what spins and affine velocities hold. All of them are what the total energy lost.
std::vector<std::pair<std::string, double>> Mpm::budget(const Conservation& tracked_totals) const {
  return budget_from(tracked_totals, 0);
}

std::vector<std::pair<std::string, double>> Mpm::budget_from(const Conservation& tracked_totals,
                                                             int first) {
  std::vector<std::pair<std::string, double>> all = {
      {"transfer loss", -tracked_totals.defect(first)},
      {"integration loss", -tracked_totals.defect(first + 1)},
      {"contact loss", tracked_totals.sources(first + 2)},
      {"nodes", tracked_totals.sources(first + 3)}};
  const double heat = tracked_totals.sources(first + 4), inner = tracked_totals.sources(first + 5);
  if (heat != 0) all.emplace_back("back as heat", -heat);
  if (inner != 0) all.emplace_back("within particles", inner);
  return all;
}

void Mpm::add_totals(const Warehouse& /*state*/, const LevelCoverage& /*coverage*/,
                     Totals& totals) const {
  // Once for each level; fluids of another part may come after the solids.
  totals.mass.resize(std::max(totals.mass.size(), solids_.materials.size()));
  totals.amounts.resize(std::max(totals.amounts.size(), amount_count()));
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

void Mpm::add_particle_totals(const ParticleCloud& cloud, Totals& totals) const {
  totals.mass.resize(std::max(totals.mass.size(), solids_.materials.size()));
  for (int k = 0; k < static_cast<int>(particles_.kinds().size()); ++k) {
    const ParticleStore& store = cloud.store(k);
    if (k >= static_cast<int>(solids_.materials.size())) {
      add_cohesive_energy(store, totals);
      continue;
    }
    const Columns& c = particles_.carried()[k].columns;
    for (int l = 0; l < store.level_count(); ++l)
      for (int b = 0; b < store.box_count(l); ++b) {
        const ParticleSet& set = store.set(l, b);
        const double* m = set.column(c.mass);
        const double* energy = set.column(c.energy);
        const double* heat = c.lost_heat >= 0 ? set.column(c.lost_heat) : nullptr;
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
          if (heat != nullptr) totals.internal_energy.add(heat[p]);
        }
        if (c.water_mass >= 0) add_water(set, c, totals.mass[k], totals);
      }
  }
  if (history_sums_.any()) history_sums_.add(cloud, particles_.carried(), totals);
}

bool Mpm::has_history(Label label) const {
  return is_history(label);
}

double Mpm::history_value(Label label, const Totals& totals) const {
  return history_of(label, totals, history_sums_);
}

Vec3 Mpm::history_vector(Label label, const Totals& totals) const {
  return vector_history_of(label, totals, history_sums_);
}

void Mpm::declare_diagnostics(TaskList& /*list*/, int /*level*/) const {}

Label Mpm::refine_flag() const {
  return declare_label({"refineFlag", ValueType::integer, Centring::cell, "1",
                        "1 where a finer level is needed, 0 elsewhere"});
}

Label Mpm::mask_label() const {
  return declare_label({"state.slope_mask", ValueType::real, Centring::cell, "1",
                        "1 where a repeated step uses slopes; not used by solids"});
}

std::string Mpm::describe_fault(int /*kind*/) const {
  return "value (must be finite)";
}

}  // namespace sluice::mpm
