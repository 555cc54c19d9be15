// Subgrid viscosity of J. Smagorinsky, Monthly Weather Review 91 (1963) 99.
//
//   mu_t = rho (C_s Delta)^2 |S|,  |S| = sqrt(2 S:S),  S_ij = (du_i/dx_j + du_j/dx_i)/2
// with central differences between cells. Directions that are no dimension have no derivative and
// do not count in Delta.
#include <cmath>

#include "ice/transport/strain.hpp"
#include "ice/transport/viscosity.hpp"

namespace sluice::ice {

void add_eddy_viscosity(const TransportTask& t, const StateVariables& state, VariableId eddy) {
  if (t.options.transport.models.turbulence->dynamic)
    return add_dynamic_eddy_viscosity(t, state, eddy);
  TaskBuilder task = t.list.task(t.name + "eddy viscosity", t.effect);
  const In rho = task.read(state.rho), velocity = task.read(state.velocity, Stencil::box(1));
  const Out out = task.write(eddy);
  dispatch(t.options.grid.axes.count, t.options.grid.components, [&]<int D, int C>() {
    task.kernel([=, o = t.options, by_direction = state.by_direction](const Row& row) {
      const VelocityRows<D, C> u(row, velocity, o, by_direction);
      const double length =
          o.transport.models.turbulence->constant * filter_width(o, row.step().spacing);
      const double square = length * length;
      const double* __restrict r = row(rho);
      double* __restrict mu = row(out);
      const int n = row.count();
      for (int i = 0; i < n; ++i) mu[i] = r[i] * square * std::sqrt(u.strain_squared(i));
    });
  });
}

}  // namespace sluice::ice
