#include "mpmice/mpmice_step.hpp"

#include <algorithm>

#include "mpm/solids_beside_fluid.hpp"
#include "mpmice/coupling_memory.hpp"
#include "mpmice/mpmice.hpp"
#include "mpmice/step/coupling_on_levels.hpp"

namespace sluice::mpmice {
namespace {

// Adds the tasks of the coupling to a step.
class Tasks {
 public:
  explicit Tasks(std::shared_ptr<CouplingOnLevels> coupling) : coupling_(std::move(coupling)) {}
  void operator()(StepShape& to, const char* name, CouplingTask task) const {
    to.stage(name, [coupling = coupling_, task](const StageScope& scope) {
      return coupling->run(task, scope);
    });
  }

 private:
  std::shared_ptr<CouplingOnLevels> coupling_;
};

}  // namespace

MpmIceStep::MpmIceStep(const MpmIce& both)
    : FluidStep(both.fluid().part(), both.fluid().blocks(), both.fluid().levels()), both_(&both) {}

// The step, as a table. A semi-implicit one moves the solids once to see what they sweep, which the
// system needs, and again in each pass, pressed on by what was solved for: what the fluid loses to
// a surface the solid gets, whatever the solver's tolerance. Rigid solids do not feel it.
void MpmIceStep::declare_stages(StepShape& shape) const {
  using Task = CouplingTask;
  const ice::FluidPart& fluid = both_->fluid().part();
  const std::shared_ptr<solids::CoupledSolids> solids =
      mpm::make_solids_beside_fluid(both_->solids());
  const Tasks task(std::make_shared<CouplingOnLevels>(both_->run_scene(), fluid, solids,
                                                      both_->burns(), both_->burn_reductions(),
                                                      both_->burning_cells()));
  const auto& kinds = solids->kinds();
  const bool rigid = std::all_of(kinds.begin(), kinds.end(), [](const auto& k) { return k.rigid; });
  const bool implicit = fluid.options().scheme.implicit;
  const auto push_solids = [&](StepShape& to) {
    task(to, "force of the fluid on solids", Task::push_solids);
  };
  const auto move_solids = [&](StepShape& to) {
    solids->declare_motion(to);
    task(to, "volumes that solids sweep", Task::sweep_volumes);
    task(to, "solids as the fluid sees them", Task::write_fluid_inputs);
  };
  // What the solids book in a pass, the next one books anew.
  const auto before = std::make_shared<std::vector<double>>();

  solids->declare_start(shape);
  task(shape, "cells near solids", Task::find_cells);
  task(shape, "surfaces of solids, fluid beside them", Task::find_surfaces);
  task(shape, "pressure and friction on surfaces", Task::press_on_walls);
  if (implicit)
    shape.stage("sums before solids move", [before](const StageScope& scope) {
      *before = *scope.sums;
      return Verdict::good;
    });
  if (!(implicit && rigid)) push_solids(shape);
  move_solids(shape);
  if (implicit)
    declare_passes(shape, [&](StepShape& pass) {
      task(pass, "pressure on solids", Task::renew_pressures);
      if (rigid) return task(pass, "pressure on walls", Task::write_fluid_inputs);
      pass.stage("sums before solids move", [before](const StageScope& scope) {
        *scope.sums = *before;
        return Verdict::good;
      });
      solids->declare_pass(pass);
      push_solids(pass);
      move_solids(pass);
    });
  else
    shape.sweep("step of the fluid");
  if (implicit && rigid) push_solids(shape);
  task(shape, "separation of particles", Task::part_solids);
  task(shape, "small cells share with their neighbours", Task::share_small_cells);
  if (exchanges_through_surfaces(fluid, both_->solids().material_count()))
    task(shape, "exchange of momentum and heat", Task::exchange);
  if (!both_->burns().empty()) task(shape, "burning of solids", Task::burn);
  task(shape, "state of the fluid beside solids", Task::settle);
  if (implicit) task(shape, "work pressure beside solids", Task::keep_work_pressure);
  shape.stage("energies of solids", judge_step);
  shape.commit();
  solids->declare_commit(shape);
  task(shape, "limits of the next step", Task::end_step);
}

double MpmIceStep::array_bytes(const Level& finest) const {
  return coupling_bytes(*both_, finest);
}

StepLimit MpmIceStep::limit(const std::vector<double>& maxima) const {
  const StepLimit solid = both_->solids().step().limit(maxima), fluid = FluidStep::limit(maxima);
  return solid.dt < fluid.dt ? solid : fluid;
}

}  // namespace sluice::mpmice
