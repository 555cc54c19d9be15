// Reynolds stress of subgrid motion, as the eddy viscosity has it (J. Boussinesq, 1877).
#include "ice/transport/subgrid_stress.hpp"

#include <algorithm>

#include "ice/transport/strain.hpp"

namespace sluice::ice {
namespace {

// Where uv, vw, wu stand, by two directions of the level.
constexpr int place_of(int d, int e) {
  return (4 - d - e) % 3;
}
static_assert(place_of(0, 1) == 0 && place_of(1, 2) == 1 && place_of(0, 2) == 2);

// The strain is by component, the stress by direction; what has no component has no shear.
template <int D, int C>
void stress_row(const Row& row, const VelocityRows<D, C>& u, const SchemeOptions& o, In rho,
                In eddy, Out normal, Out shear) {
  const int n = row.count();
  const double *r = row(rho), *mu_t = row(eddy);
  const auto direction = [&](int c) { return o.grid.direction[c]; };
  for (int d = 0; d < 3; ++d) {
    double* R = row(normal, d);
    std::fill_n(row(shear, d), n, 0.0);
    for (int i = 0; i < n; ++i) {
      double divergence = 0;
      for (int c = 0; c < D; ++c) divergence += u.slope(c, c, i);
      R[i] = 2.0 * mu_t[i] / r[i] * (divergence / 3.0);
    }
  }
  for (int c = 0; c < C; ++c) {
    double* R = row(normal, direction(c));
    for (int i = 0; i < n; ++i) R[i] -= 2.0 * mu_t[i] / r[i] * u.slope(c, c, i);
    for (int b = c + 1; b < C; ++b) {
      double* across = row(shear, place_of(direction(c), direction(b)));
      for (int i = 0; i < n; ++i) across[i] = -2.0 * mu_t[i] / r[i] * u.strain(c, b, i);
    }
  }
}

}  // namespace

void add_subgrid_stress(const TransportTask& t, const StateVariables& state, VariableId eddy,
                        const SubgridStress& stress) {
  TaskBuilder task = t.list.task(t.name, t.effect);
  const In rho = task.read(state.rho), mu_t = task.read(eddy);
  const In velocity = task.read(state.velocity, Stencil::box(1));
  const Out normal = task.write(stress.normal), shear = task.write(stress.shear);
  dispatch(t.options.grid.axes.count, t.options.grid.components, [&]<int D, int C>() {
    task.kernel([=, o = t.options, by_direction = state.by_direction](const Row& row) {
      const VelocityRows<D, C> u(row, velocity, o, by_direction);
      stress_row(row, u, o, rho, mu_t, normal, shear);
    });
  });
}

}  // namespace sluice::ice
