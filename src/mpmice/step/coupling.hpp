// What joins a step of the fluid and one of the solids on a level, task by task
// (docs/theory/mpmice_coupling.md has the equations).
#pragma once
#include <memory>

#include "framework/run/component/particle_method.hpp"
#include "framework/run/component/step_shape.hpp"
#include "ice/fluid_part.hpp"
#include "models/burn/burn_law.hpp"
#include "mpmice/burn/burned_sums.hpp"
#include "solids/coupled_solids.hpp"

namespace sluice::mpmice {

// The tasks of a coupled step. MpmIceStep has the table of the step: their order, and those of the
// fluid and the solids between them.
enum class CouplingTask {
  find_cells,          // near solids, over which all arrays are
  find_surfaces,       // at the start of the step, and the fluid's states beside them
  press_on_walls,      // pressure and friction on surfaces
  renew_pressures,     // of a semi-implicit step: from what was solved for
  push_solids,         // forces of the fluid on corners
  sweep_volumes,       // surfaces at the end of the step, what they have swept
  write_fluid_inputs,  // what the sweep of the fluid takes of the solids
  part_solids,         // torn particles let their neighbours go
  share_small_cells,
  exchange,  // momentum and heat through surfaces
  burn,
  settle,              // from amounts of cells to the state of the fluid
  keep_work_pressure,  // of a semi-implicit step, for the next one
  end_step,            // limits of the next step; burned particles go
};

class Coupling {
 public:
  virtual ~Coupling() = default;
  virtual Verdict run(CouplingTask task, const StageScope& scope) = 0;
};

// Of a level with one, two or three active directions.
std::unique_ptr<Coupling> make_coupling(const Level& level, const ice::FluidPart& fluid,
                                        std::shared_ptr<solids::CoupledSolids> solids,
                                        const std::vector<models::SolidBurn>& burns,
                                        const BurnReductions& places);

// Does the deck ask for exchange of momentum or heat of a solid with a fluid.
bool exchanges_through_surfaces(const ice::FluidPart& fluid, int solids);

// theta of the solids as they are at the start of a run, into a state of the fluid. `kinds`: of the
// particles, in their order.
void start_fractions(Warehouse& state, const ice::FluidPart& fluid, const ParticleMethod& particles,
                     const std::vector<solids::SolidKind>& kinds);

}  // namespace sluice::mpmice
