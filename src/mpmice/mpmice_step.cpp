#include "mpmice/mpmice_step.hpp"

#include <algorithm>

#include "mpm/levels/solid_levels.hpp"
#include "mpmice/coupling_memory.hpp"
#include "mpmice/mpmice.hpp"
#include "mpmice/step/coupling_on_levels.hpp"

namespace sluice::mpmice {
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

MpmIceStep::MpmIceStep(const MpmIce& both)
    : FluidStep(both.fluid().part(), both.fluid().blocks(), both.fluid().levels()), both_(&both) {}

// The step, as a table. A semi-implicit one moves the solids once to see what they sweep, which the
// system needs, and again in each pass, pressed on by what was solved for: what the fluid loses to
// a surface the solid gets, whatever the solver's tolerance. Rigid solids do not feel it.
void MpmIceStep::declare_stages(StepShape& shape) const {
  using mpm::SolidLevels;
  const mpm::MpmScene& scene = both_->solids().scene();
  const ice::Ice& fluid = both_->fluid();
  const auto solids = both_->solids().make_step();
  const auto coupling = std::make_shared<CouplingOnLevels>(
      both_->run_scene(), fluid.part(), both_->solids(), solids, both_->burns(),
      both_->burn_reductions(), both_->burning_cells());
  const Stages stages(solids, coupling, scene);
  stages.solids(shape, "bounds of the sums", &SolidLevels::begin);
  if (scene.midpoint() && mpm::files_give_velocities(scene))
    stages.solids(shape, "spins of the start", &SolidLevels::start_spins);
  stages.both(shape, "surfaces of solids, pressure on them", &CouplingOnLevels::find_surfaces);
  const auto& kinds = scene.materials;
  const bool rigid = std::all_of(kinds.begin(), kinds.end(), [](const auto& m) { return m.rigid; });
  const bool implicit = fluid.part().options().scheme.implicit;
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
    declare_passes(shape, [&](StepShape& pass) {
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
  if (!both_->burns().empty())
    stages.both(shape, "burned particles go", &CouplingOnLevels::remove_burned);
}

double MpmIceStep::array_bytes(const Level& finest) const {
  return coupling_bytes(*both_, finest);
}

StepLimit MpmIceStep::limit(const std::vector<double>& maxima) const {
  const StepLimit solid = both_->solids().step().limit(maxima), fluid = FluidStep::limit(maxima);
  return solid.dt < fluid.dt ? solid : fluid;
}

}  // namespace sluice::mpmice
