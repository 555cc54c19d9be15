#include "mpmice/mpmice.hpp"

#include <algorithm>

#include "ice/fluid/labels.hpp"
#include "ice/step/effect_ids.hpp"
#include "mpm/levels/solid_levels.hpp"
#include "mpmice/burn/burned_sums.hpp"
#include "mpmice/step/coupling_on_levels.hpp"

namespace sluice::mpmice {
namespace {

// Where the fluid's numbers begin.
IndexOffsets places_of_fluid(const mpm::Mpm& solids, int fluids) {
  IndexOffsets places;
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
    mpm::SolidMaterial& solid = solids.materials[burn.solid];
    solid.burns = true;
    const models::BurningMemory memory = burn.law->memory();
    solid.awaits_flames |= memory.flame;
    solid.surface_remembers |= memory.surface;
  }
  solids.carry_corners(level.active);
  solids.whole_kicks = true;
  return solids;
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
      burning_(scene, burns_, solids_.material_count(), fluid.models.any_source()) {
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

namespace {

// Adds stages to a step, each a function of the solids or of the coupling.
class Stages {
 public:
  using Solids = mpm::SolidLevels;
  Stages(std::shared_ptr<Solids> solids, std::shared_ptr<CouplingOnLevels> coupling,
         const mpm::MpmScene& scene)
      : solids_(std::move(solids)), coupling_(std::move(coupling)), scene_(&scene) {}

  void solids(StepShape& to, const char* name, Verdict (Solids::*act)(const StageScope&)) const {
    to.stage(name,
             [solids = solids_, act](const StageScope& scope) { return ((*solids).*act)(scope); });
  }
  void both(StepShape& to, const char* name,
            Verdict (CouplingOnLevels::*act)(const StageScope&)) const {
    to.stage(name, [coupling = coupling_, act](const StageScope& scope) {
      return ((*coupling).*act)(scope);
    });
  }
  void press_on_solids(StepShape& to) const {
    both(to, "force of the fluid on solids", &CouplingOnLevels::press_on_solids);
  }
  void move_solids(StepShape& to) const {
    solids(to, "particles to grid", &Solids::to_grid);
    solids(to, "sums of images and ranks", &Solids::share_sums);
    solids(to, "nodes: contact, forces, contact, boundary", &Solids::move_nodes);
    if (scene_->transfer == mpm::Transfer::xpic)
      solids(to, "filtered velocities (XPIC)", &Solids::filter_velocities);
    if (scene_->midpoint())
      solids(to, "new velocities; to grid at the middle of the step", &Solids::map_back);
    solids(to, "grid to particles, deformation, stress", &Solids::from_grid);
    both(to, "volumes that solids sweep", &CouplingOnLevels::find_swept_volumes);
  }

 private:
  std::shared_ptr<Solids> solids_;
  std::shared_ptr<CouplingOnLevels> coupling_;
  const mpm::MpmScene* scene_;
};

}  // namespace

// The step, as a table. A semi-implicit one moves the solids once to see what they sweep, which the
// system needs, and again in each pass, pressed on by what was solved for: what the fluid loses to
// a surface the solid gets, whatever the solver's tolerance. Rigid solids do not feel it.
void MpmIce::shape_step(StepShape& shape) const {
  using mpm::SolidLevels;
  const auto solids = solids_.make_step();
  const auto coupling =
      std::make_shared<CouplingOnLevels>(scene_, fluid_.part(), solids_, solids, burns_, burning_);
  const Stages stages(solids, coupling, solids_.scene());
  stages.solids(shape, "bounds of the sums", &SolidLevels::begin);
  if (solids_.scene().midpoint() && mpm::files_give_velocities(solids_.scene()))
    stages.solids(shape, "spins of the start", &SolidLevels::start_spins);
  stages.both(shape, "surfaces of solids, pressure on them", &CouplingOnLevels::find_surfaces);
  const auto& kinds = solids_.scene().materials;
  const bool rigid = std::all_of(kinds.begin(), kinds.end(), [](const auto& m) { return m.rigid; });
  const bool implicit = fluid_.part().options().scheme.implicit;
  // What the solids book in a pass, the next one books anew.
  const auto before = std::make_shared<std::vector<double>>();
  if (implicit)
    shape.stage("sums before solids move", [before](const StageScope& scope) {
      *before = *scope.sums;
      return Verdict::good;
    });
  if (!(implicit && rigid)) stages.press_on_solids(shape);
  stages.move_solids(shape);
  if (implicit)
    fluid_.part().declare_passes(shape, [&](StepShape& pass) {
      stages.both(pass, "pressure on solids", &CouplingOnLevels::renew_pressures);
      if (rigid) return stages.both(pass, "pressure on walls", &CouplingOnLevels::tell_pressures);
      pass.stage("sums before solids move", [before](const StageScope& scope) {
        *scope.sums = *before;
        return Verdict::good;
      });
      stages.solids(pass, "bounds of the sums", &SolidLevels::begin);
      stages.press_on_solids(pass);
      stages.move_solids(pass);
    });
  else
    shape.sweep("step of the fluid");
  if (implicit && rigid) stages.press_on_solids(shape);
  stages.both(shape, "small cells, exchange, state of the fluid", &CouplingOnLevels::finish_cells);
  if (implicit)
    stages.both(shape, "work pressure beside solids", &CouplingOnLevels::keep_work_pressure);
  shape.stage("energies of solids", judge_step);
  shape.commit();
  stages.both(shape, "limits of the next step", &CouplingOnLevels::limit_step);
  stages.solids(shape, "take over", &SolidLevels::commit);
  if (!burns_.empty()) stages.both(shape, "burned particles go", &CouplingOnLevels::remove_burned);
}

int MpmIce::reduction_maxima() const {
  return solids_.reduction_maxima() + fluid_.reduction_maxima();
}

int MpmIce::reduction_sums() const {
  return static_cast<int>(first_burned_sum()) +
         (burns_.empty()
              ? 0
              : BurnedSums::count(material_count()) + static_cast<int>(output_switches().size()));
}

// In the order in which the step finds them.
std::vector<OutputSwitch> MpmIce::output_switches() const {
  std::vector<OutputSwitch> switches;
  for (const models::SolidBurn& burn : burns_)
    for (const OutputSwitch& to : burn.law->output_switches()) switches.push_back(to);
  return switches;
}

bool MpmIce::passes_switch(std::size_t n, const std::vector<double>& sums) const {
  const std::size_t behind = BurnedSums::count(material_count());
  return sums[first_burned_sum() + behind + n] > 0;
}

StepLimit MpmIce::step_limit(const std::vector<double>& maxima) const {
  const StepLimit solid = solids_.step_limit(maxima),
                  fluid = fluid_.step_limit(
                      {maxima.begin() + solids_.reduction_maxima(), maxima.end()});
  return solid.dt < fluid.dt ? solid : fluid;
}

}  // namespace sluice::mpmice
