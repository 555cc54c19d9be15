#include "mpmice/mpmice.hpp"

#include <algorithm>

#include "framework/run/particle_cloud.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/step/effect_ids.hpp"
#include "mpm/levels/solid_levels.hpp"
#include "mpmice/burn/burned_sums.hpp"
#include "mpmice/step/coupling_on_levels.hpp"

namespace sluice::mpmice {
namespace {

// Where the fluid's numbers begin.
Places places_of_fluid(const mpm::Mpm& solids, int fluids) {
  Places places;
  places.effect = solids.effects().size();
  places.maximum = solids.reduction_maxima();
  places.sum = solids.reduction_sums();
  const ice::Labels& l = ice::labels();
  places.common = {l.mask,
                   l.pressure,
                   l.equilibrium_pressure,
                   l.pressure_change,
                   l.source_pressure,
                   l.gradient_pressure};
  for (int d = 0; d < 3; ++d) {
    places.common.push_back(l.face_pressure[d]);
    places.common.push_back(l.face_pressure_gradient[d]);
  }
  for (int m = 0; m < fluids; ++m) places.material.push_back(solids.material_count() + m);
  return places;
}

// The coupling takes particles that carry their corners, whatever basis the deck names.
mpm::MpmScene with_corners(mpm::MpmScene solids, const std::vector<models::SolidBurn>& burns,
                           const Level& level) {
  for (const models::SolidBurn& burn : burns) {
    mpm::SolidMaterial& solid = solids.materials[static_cast<std::size_t>(burn.solid)];
    solid.burns = true;
    solid.surface_remembers |= std::holds_alternative<models::UnsteadyBurn>(burn.law);
  }
  solids.carry_corners(level.active);
  solids.whole_kicks = true;
  return solids;
}

std::vector<double> fluid_part(const std::vector<double>& all, int first) {
  return {all.begin() + first, all.end()};
}

}  // namespace

void bind_solids(const ice::IceScene& fluid, mpm::MpmScene& solids) {
  const int count = static_cast<int>(solids.materials.size());
  for (int m = 0; m < count; ++m)
    for (int n = m + 1; n < count; ++n) {
      if (fluid.momentum_of_all(m, n) < ice::one_velocity_coefficient) continue;
      mpm::ContactRule rule;
      rule.kind = mpm::ContactKind::single_velocity;
      rule.materials = {m, n};
      rule.type = "single_velocity";
      rule.where = fluid.exchange.where;
      solids.contacts.insert(solids.contacts.begin(), rule);
    }
}

MpmIce::MpmIce(const Scene& scene, ice::IceScene fluid, mpm::MpmScene solids,
               std::vector<models::SolidBurn> burns)
    : scene_(scene),
      solids_(scene, with_corners(std::move(solids), burns, scene.grid.levels.front())),
      fluid_(scene, fluid, places_of_fluid(solids_, static_cast<int>(fluid.materials.size()))),
      burns_(std::move(burns)),
      burning_(scene, burns_) {
  for (const EffectList* list : {&solids_.effects(), &fluid_.effects()})
    for (int e = 0; e < list->size(); ++e) effects_.add((*list)[e]);
  if (const ParticleMethod* tracers = fluid_.particles())
    joined_ = std::make_unique<JoinedParticles>(*solids_.particles(), *tracers);
}

void MpmIce::initialise(Warehouse& state) const {
  fluid_.initialise(state);
  start_fractions(state, fluid_.part(), solids_);
  burning_.clear(state);
}

std::vector<SlotInfo> MpmIce::work_slots() const {
  std::vector<SlotInfo> slots = fluid_.work_slots();
  slots.insert(slots.end(), burning_.slots().begin(), burning_.slots().end());
  return slots;
}

void MpmIce::declare_diagnostics(TaskList& list, int level) const {
  fluid_.declare_diagnostics(list, level);
  burning_.declare(list, solids_.effects().size() + ice::effect_diagnostics);
}

// The step, as a table. A semi-implicit one moves the solids once to see what they sweep, which the
// system needs, and again in each pass, pressed on by what was solved for: what the fluid loses to
// a surface the solid gets, whatever the solver's tolerance. Rigid solids do not feel it.
void MpmIce::shape_step(StepShape& shape) const {
  using mpm::SolidLevels;
  const auto solids = solids_.make_step();
  const auto coupling =
      std::make_shared<CouplingOnLevels>(scene_, fluid_.part(), solids_, solids, burns_, burning_);
  const auto of_solids = [&](StepShape& to, const char* name,
                             Verdict (SolidLevels::*act)(const StageScope&)) {
    to.stage(name, [solids, act](const StageScope& scope) { return ((*solids).*act)(scope); });
  };
  const auto of_both = [&](StepShape& to, const char* name,
                           Verdict (CouplingOnLevels::*act)(const StageScope&)) {
    to.stage(name, [coupling, act](const StageScope& scope) { return ((*coupling).*act)(scope); });
  };
  const auto press_on_solids = [&](StepShape& to) {
    of_both(to, "force of the fluid on solids", &CouplingOnLevels::press_on_solids);
  };
  const auto move_solids = [&](StepShape& to) {
    of_solids(to, "particles to grid", &SolidLevels::to_grid);
    of_solids(to, "sums of images and ranks", &SolidLevels::share_sums);
    of_solids(to, "nodes: contact, forces, contact, boundary", &SolidLevels::move_nodes);
    if (solids_.scene().transfer == mpm::Transfer::xpic)
      of_solids(to, "filtered velocities (XPIC)", &SolidLevels::filter_velocities);
    of_solids(to, "grid to particles, deformation, stress", &SolidLevels::from_grid);
    of_both(to, "volumes that solids sweep", &CouplingOnLevels::find_swept_volumes);
  };
  of_solids(shape, "bounds of the sums", &SolidLevels::begin);
  of_both(shape, "surfaces of solids, pressure on them", &CouplingOnLevels::find_surfaces);
  const auto& kinds = solids_.scene().materials;
  const bool rigid = std::all_of(kinds.begin(), kinds.end(), [](const auto& m) { return m.rigid; });
  const bool implicit = fluid_.part().options().implicit;
  // What the solids book in a pass, the next one books anew.
  const auto before = std::make_shared<std::vector<double>>();
  if (implicit)
    shape.stage("sums before solids move", [before](const StageScope& scope) {
      *before = *scope.sums;
      return Verdict::good;
    });
  if (!(implicit && rigid)) press_on_solids(shape);
  move_solids(shape);
  if (implicit)
    fluid_.part().declare_passes(shape, [&](StepShape& pass) {
      of_both(pass, "pressure on solids", &CouplingOnLevels::renew_pressures);
      if (rigid) return of_both(pass, "pressure on walls", &CouplingOnLevels::tell_pressures);
      pass.stage("sums before solids move", [before](const StageScope& scope) {
        *scope.sums = *before;
        return Verdict::good;
      });
      of_solids(pass, "bounds of the sums", &SolidLevels::begin);
      press_on_solids(pass);
      move_solids(pass);
    });
  else
    shape.sweep("step of the fluid");
  if (implicit && rigid) press_on_solids(shape);
  of_both(shape, "small cells, exchange, state of the fluid", &CouplingOnLevels::finish_cells);
  if (implicit)
    of_both(shape, "work pressure beside solids", &CouplingOnLevels::keep_work_pressure);
  shape.take_over();
  of_both(shape, "limits of the next step", &CouplingOnLevels::limit_step);
  of_solids(shape, "take over", &SolidLevels::take_over);
  if (!burns_.empty()) of_both(shape, "burned particles go", &CouplingOnLevels::remove_burned);
}

int MpmIce::reduction_maxima() const {
  return solids_.reduction_maxima() + fluid_.reduction_maxima();
}

int MpmIce::reduction_sums() const {
  return static_cast<int>(first_burned_sum()) +
         (burns_.empty() ? 0 : BurnedSums::count(material_count()));
}

std::size_t MpmIce::first_burned_sum() const {
  return static_cast<std::size_t>(solids_.reduction_sums() + fluid_.reduction_sums());
}

std::vector<std::string> MpmIce::tally_names() const {
  std::vector<std::string> names = fluid_.tally_names();
  if (!burns_.empty()) names.insert(names.end(), {"burned mass of solids", "heat of burning"});
  if (has_account()) {
    for (const std::string& name : solids_.tally_names()) names.push_back(name);
    names.emplace_back("surfaces");
  }
  return names;
}

bool MpmIce::has_account() const {
  const auto& solids = solids_.scene().materials;
  return burns_.empty() &&
         std::none_of(solids.begin(), solids.end(), [](const auto& m) { return m.rigid; });
}

std::vector<double> MpmIce::tallies(const std::vector<double>& sums) const {
  std::vector<double> all = fluid_.tallies(fluid_part(sums, solids_.reduction_sums()));
  if (has_account()) {
    for (const double of_solids : solids_.tallies(sums)) all.push_back(of_solids);
    all.push_back(sums[mpm::StepSums::surface_work] + sums[mpm::StepSums::corner_work]);
  }
  if (burns_.empty()) return all;
  const std::size_t beside = first_burned_sum() + static_cast<std::size_t>(material_count());
  all.push_back(sums[beside + BurnedSums::burned]);
  all.push_back(sums[beside + BurnedSums::heat]);
  return all;
}

// The kinetic and the internal energy of the solids are the last of the amounts.
std::vector<ConservedTotal> MpmIce::tallied_totals(const Totals& totals) const {
  if (!has_account()) return {};
  std::vector<ConservedTotal> all(fluid_.tally_names().size());
  all.insert(all.end(), totals.amounts.end() - 2, totals.amounts.end());
  all.resize(all.size() + 3);
  return all;
}

// What surfaces work on the fluid and its forces on the nodes of solids is one but for the time of
// the velocity (v* of the swept volume, (v + v*)/2 of the nodes) and places within a step.
std::vector<std::pair<std::string, double>> MpmIce::account(const Conservation& tallies) const {
  if (!has_account()) return {};
  const auto first = static_cast<int>(fluid_.tally_names().size());
  auto all = mpm::Mpm::account_from(tallies, first);
  all.emplace_back("surfaces", -tallies.sources(first + 4));
  return all;
}

StepLimit MpmIce::step_limit(const std::vector<double>& maxima) const {
  const StepLimit solid = solids_.step_limit(maxima),
                  fluid = fluid_.step_limit(fluid_part(maxima, solids_.reduction_maxima()));
  return solid.dt < fluid.dt ? solid : fluid;
}

void MpmIce::add_totals(const Warehouse& state, const LevelCoverage& coverage,
                        Totals& totals) const {
  Totals of_fluid;
  fluid_.add_totals(state, coverage, of_fluid);
  solids_.add_totals(state, coverage, totals);
  totals.mass.resize(static_cast<std::size_t>(material_count()));
  for (std::size_t m = 0; m < of_fluid.mass.size(); ++m)
    totals.mass[static_cast<std::size_t>(solids_.material_count()) + m].merge(of_fluid.mass[m]);
  for (int d = 0; d < 3; ++d) totals.momentum[d].merge(of_fluid.momentum[d]);
  totals.internal_energy.merge(of_fluid.internal_energy);
  totals.kinetic_energy.merge(of_fluid.kinetic_energy);
  const std::size_t first = solids_.amount_count();
  totals.amounts.resize(first + of_fluid.amounts.size());
  for (std::size_t n = 0; n < of_fluid.amounts.size(); ++n)
    totals.amounts[first + n].merge(of_fluid.amounts[n]);
}

void MpmIce::add_particle_totals(const ParticleCloud& particles, Totals& totals) const {
  Totals own;
  own.amounts.resize(solids_.amount_count());
  solids_.add_particle_totals(particles, own);
  for (std::size_t m = 0; m < own.mass.size(); ++m) totals.mass[m].merge(own.mass[m]);
  for (int d = 0; d < 3; ++d) totals.momentum[d].merge(own.momentum[d]);
  totals.kinetic_energy.merge(own.kinetic_energy);
  totals.internal_energy.merge(own.internal_energy);
  for (std::size_t n = 0; n < own.amounts.size(); ++n) totals.amounts[n].merge(own.amounts[n]);
  if (has_account()) {
    totals.amounts.push_back(own.kinetic_energy);
    totals.amounts.push_back(own.internal_energy);
  }
  add_reference_work(particles, totals);
}

// Solids free of stress bear the reference pressure, which works on them: -p_ref V.
void MpmIce::add_reference_work(const ParticleCloud& particles, Totals& totals) const {
  for (int k = 0; k < solids_.material_count(); ++k) {
    const auto n = static_cast<std::size_t>(k);
    const double reference = solids_.scene().materials[n].constants.reference_pressure;
    const ParticleStore& store = particles.store(k);
    for (int l = 0; l < store.level_count() && reference != 0; ++l)
      for (int b = 0; b < store.box_count(l); ++b) {
        const ParticleSet& set = store.set(l, b);
        const double* volume =
            set.column(static_cast<std::size_t>(solids_.carried()[n].columns.volume));
        for (std::size_t p = 0; p < set.size(); ++p)
          totals.internal_energy.add(-reference * volume[p]);
      }
  }
}

StepBalance MpmIce::balance(const std::vector<double>& sums, const StepStart* start,
                            double dt) const {
  StepBalance b = solids_.balance(sums, start, dt);
  StepStart of_fluid;
  if (start != nullptr) of_fluid = {fluid_part(start->mass, solids_.material_count()), {}};
  const StepBalance f = fluid_.balance(fluid_part(sums, solids_.reduction_sums()),
                                       start != nullptr ? &of_fluid : nullptr, dt);
  b.mass.insert(b.mass.end(), f.mass.begin(), f.mass.end());
  if (!f.mass_of_sources.empty()) {
    b.mass_of_sources.assign(static_cast<std::size_t>(solids_.material_count()), 0.0);
    b.mass_of_sources.insert(b.mass_of_sources.end(), f.mass_of_sources.begin(),
                             f.mass_of_sources.end());
  }
  b.momentum = b.momentum + f.momentum;
  b.momentum_of_forces = b.momentum_of_forces + f.momentum_of_forces;
  b.energy += f.energy;
  b.energy_of_forces += f.energy_of_forces;
  if (burns_.empty()) return b;
  b.mass_of_sources.resize(static_cast<std::size_t>(material_count()), 0.0);
  for (std::size_t m = 0; m < b.mass_of_sources.size(); ++m)
    b.mass_of_sources[m] += sums[first_burned_sum() + m];
  b.energy_of_forces += sums[first_burned_sum() + b.mass_of_sources.size() + BurnedSums::energy];
  return b;
}

// The amounts of the fluid come after those of the solids.
Totals MpmIce::of_fluid(const Totals& all) const {
  Totals own = all;
  if (has_account()) own.amounts.resize(own.amounts.size() - 2);
  own.tallies.resize(std::min(own.tallies.size(), fluid_.tally_names().size()));
  const auto scalars = static_cast<std::ptrdiff_t>(fluid_.part().options().scalars.size());
  if (static_cast<std::ptrdiff_t>(own.amounts.size()) > scalars)
    own.amounts.erase(own.amounts.begin(), own.amounts.end() - scalars);
  return own;
}

double MpmIce::history_value(Label label, const Totals& totals) const {
  const std::size_t tallied = totals.tallies.size();
  if (!burns_.empty() && tallied >= 2) {
    // Fluids alone may burn too.
    const double fluid = tallied > 2 && (label == ice::labels().total_mass_burned ||
                                         label == ice::labels().total_heat_released)
                             ? fluid_.history_value(label, totals)
                             : 0.0;
    if (label == ice::labels().total_mass_burned) return totals.tallies[tallied - 2] + fluid;
    if (label == ice::labels().total_heat_released) return totals.tallies[tallied - 1] + fluid;
  }
  return solids_.has_history(label) ? solids_.history_value(label, totals)
                                    : fluid_.history_value(label, of_fluid(totals));
}

Vec3 MpmIce::history_vector(Label label, const Totals& totals) const {
  return solids_.has_history(label) ? solids_.history_vector(label, totals)
                                    : fluid_.history_vector(label, of_fluid(totals));
}

}  // namespace sluice::mpmice
