// What joins a step of the fluid and one of the solids on a level, stage by stage
// (docs/theory/mpmice_coupling.md has the equations).
#pragma once
#include <memory>

#include "framework/run/component/step_shape.hpp"
#include "ice/ice.hpp"
#include "mpm/levels/solid_levels.hpp"
#include "mpm/mpm.hpp"
#include "mpmice/burn/burned_sums.hpp"

namespace sluice::mpmice {

class Coupling {
 public:
  virtual ~Coupling() = default;

  // The stages, in order. Surfaces at the start of the step, the pressure on them, its force on
  // the solids: before these take their step. Then what they sweep, for the sweep of the fluid.
  virtual Verdict find_surfaces(const StageScope& scope) = 0;
  virtual Verdict press_on_solids(const StageScope& scope) = 0;
  virtual Verdict find_swept_volumes(const StageScope& scope) = 0;
  // Of a semi-implicit step, between a solve and the sweep: the pressure on surfaces from that
  // which was solved for; the fluid is told of it (find_swept_volumes does that too).
  virtual Verdict renew_pressures(const StageScope& scope) = 0;
  virtual Verdict tell_pressures(const StageScope& scope) = 0;
  // Behind the sweep: cells with little fluid share with their neighbours, fluid and solids
  // exchange momentum and heat, amounts become the state of the fluid.
  virtual Verdict finish_cells(const StageScope& scope) = 0;
  // Of a semi-implicit step, behind that: its pressure, for the next step.
  virtual Verdict keep_work_pressure(const StageScope& scope) = 0;
  // Once the fluid's state is taken over: what these cells allow the next step.
  virtual Verdict limit_step(const StageScope& scope) = 0;
  // Once particles are taken over: those that have burned to their end go.
  virtual Verdict remove_burned(const StageScope& scope) = 0;
};

// Of a level with one, two or three active directions.
std::unique_ptr<Coupling> make_coupling(const Level& level, const ice::FluidPart& fluid,
                                        const mpm::Mpm& solids,
                                        std::shared_ptr<mpm::SolidLevels> step,
                                        std::vector<models::SolidBurn> burns = {},
                                        const BurnReductions& places = {});

// theta of the solids as they are at the start of a run, into a state of the fluid.
void start_fractions(Warehouse& state, const ice::FluidPart& fluid, const mpm::Mpm& solids);

}  // namespace sluice::mpmice
