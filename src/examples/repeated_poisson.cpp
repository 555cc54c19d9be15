// Sweeps until the residual is small.
#include "examples/repeated_poisson.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/base/error.hpp"
#include "framework/deck/faults.hpp"
#include "framework/run/levels/level_solver.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice::examples {

void RepeatedPoisson::initialise(Warehouse& state) const {
  fill_state(state, 1.0);
}

void RepeatedPoisson::declare_stages(StepShape& shape) const {
  using Answer = StepShape::Iterate::Answer;
  const IntVec3 cells = level(0).domain.size();
  const int n = std::max({cells.x, cells.y, cells.z});
  const int most = std::max(1000, 100 * n * n);
  const double wanted = settings().max_residual;
  const auto converged = [most, wanted](const StageScope& scope) {
    double residual = 0;  // of the last sweep, over all ranks
    for (const LevelSolver* l : scope.levels) residual += l->attempt_result().sums[0];
    if (residual < wanted) return Answer::done;
    if (scope.pass == most)
      throw PhysicsError(fmt::format(
          "the residual is {:g} after {} sweeps, below {:g} is wanted; try a larger <maxresidual>",
          residual, most, wanted));
    return Answer::again;
  };
  shape.iterate("sweeps", most, converged, [](StepShape& pass) {
    pass.exchange_state();
    pass.sweep("Jacobi");
    pass.commit();
  });
}

std::unique_ptr<Component> make_repeated_poisson(const Deck& deck, const Scene& scene,
                                                 std::vector<Fault>& faults) {
  const PoissonScene settings = read_poisson(deck, scene, faults);
  need_one_level(scene, faults);
  if (any_error(faults)) return nullptr;
  return std::make_unique<RepeatedPoisson>(scene, settings);
}

std::unique_ptr<Component> make_poisson_on_levels(const Deck& deck, const Scene& scene,
                                                  std::vector<Fault>& faults) {
  const PoissonScene settings = read_poisson(deck, scene, faults);
  if (scene.refinement.adaptive)
    add_error(faults, scene.refinement.where, "poisson3 takes the levels of <Grid>",
              "remove <Regridder>");
  else if (scene.grid.levels.size() > 1 && !scene.refinement.lock_step)
    add_error(faults, scene.refinement.where, "the levels of poisson3 step together",
              "write <AMR><useLockStep>true</useLockStep></AMR>");
  if (any_error(faults)) return nullptr;
  return std::make_unique<RepeatedPoisson>(scene, settings);
}

}  // namespace sluice::examples
