// Viscous stress on faces (Newtonian, Stokes hypothesis).
//
//   t_n = mu (du_n/dn + du_n/dn) - (2/3) mu div u,   t_c = mu (du_c/dn + du_n/dc)
// on a face with normal n. Normal derivatives from the two cells, transverse ones as the mean of
// the central differences of the two cells. Inactive directions have no derivative. mu is one
// number, or the harmonic mean of the two cells' values (face_mean.hpp). On a wall to which the gas
// sticks, semi-implicit steps take du_c/dn of the parabola through wall and two cells,
//   du_c/dn = (8 u_w - 9 u_1 + u_2)/(3 dx) outward,
// which is exact for channels and half as wrong for layers that they barely resolve.
#include <cmath>

#include "ice/fluid/face_mean.hpp"
#include "ice/one_material/tasks.hpp"
#include "ice/step/variables.hpp"
#include "ice/step/wall_faces.hpp"
#include "ice/transport/wall_shear.hpp"

namespace sluice::ice {
namespace {

struct Handles {
  In velocity, viscosity, molecular, rho;
  Out stress;
};

// Mean over the two cells of the face of the central difference of component c along axis t.
struct TransverseRows {
  const double *am, *ap, *bm, *bp;
};

template <int D, int C, bool varies>
void stress_row(const Row& row, const Handles& h, const SchemeOptions& o, int axis,
                const TransverseRows (&rows)[3][3]) {
  const int n = row.count();
  double inverse[3] = {0, 0, 0};
  for (int t = 0; t < D; ++t) inverse[t] = 1.0 / row.step().spacing[o.grid.axes.direction[t]];
  auto across = [&](int c, int t, int i) {
    const TransverseRows& x = rows[c][t];
    return 0.25 * inverse[t] * ((x.ap[i] - x.am[i]) + (x.bp[i] - x.bm[i]));
  };
  const double mu = o.transport.viscosity;
  const double* __restrict mu_a = varies ? row(h.viscosity, 0, axis, -1) : nullptr;
  const double* __restrict mu_b = varies ? row(h.viscosity) : nullptr;
  for (int c = 0; c < C; ++c) {
    const double* __restrict ua = row(h.velocity, c, axis, -1);
    const double* __restrict ub = row(h.velocity, c);
    double* __restrict t = row(h.stress, c);
    for (int i = 0; i < n; ++i) {
      const double normal = (ub[i] - ua[i]) * inverse[axis];
      double value = normal;
      if (c == axis) {
        double divergence = 0;
        for (int d = 0; d < D; ++d)
          if (d != axis) divergence += across(d, d, i);
        value = 2.0 * normal - (2.0 / 3.0) * (normal + divergence);
      } else if (c < D) {
        value += across(axis, c, i);
      }
      if constexpr (varies)
        t[i] = harmonic_mean(mu_a[i], mu_b[i]) * value;
      else
        t[i] = mu * value;
    }
  }
}

// The ghost holds 2 u_w - u_1.
template <int C, bool varies>
void stick_to_walls(const Row& row, const Handles& h, const SchemeOptions& o, int axis) {
  const int direction = o.grid.axes.direction[axis];
  const double per_dx = 1.0 / row.step().spacing[direction];
  const double* mu_a = varies ? row(h.viscosity, 0, axis, -1) : nullptr;
  const double* mu_b = varies ? row(h.viscosity) : nullptr;
  for_each_wall_face(row, o, axis, [&](int i, bool plus) {
    IntVec3 cell = row.cell();
    cell[o.grid.axes.direction[0]] += i;
    if (!o.grid.boundary->is_no_slip(side_of(direction, plus), cell)) return;
    const double mu = varies ? harmonic_mean(mu_a[i], mu_b[i]) : o.transport.viscosity;
    for (int c = 0; c < C; ++c) {
      if (c == axis) continue;
      const auto u = [&](int shift) { return row(h.velocity, c, axis, shift)[i]; };
      const double ghost = u(plus ? 0 : -1), first = u(plus ? -1 : 0), second = u(plus ? -2 : 1);
      const double outward = (4.0 * (ghost - first) - (first - second)) * (per_dx / 3.0);
      row(h.stress, c)[i] = mu * (plus ? outward : -outward);
    }
  });
}

// Subgrid motion ends at walls: the viscosity there is the molecular one.
template <int C>
void take_eddies_from_walls(const Row& row, const Handles& h, const SchemeOptions& o, int axis) {
  const bool varies = o.molecular_varies();
  const double* molecular_a = varies ? row(h.molecular, 0, axis, -1) : nullptr;
  const double* molecular_b = varies ? row(h.molecular) : nullptr;
  const double *mu_a = row(h.viscosity, 0, axis, -1), *mu_b = row(h.viscosity);
  for_each_wall_face(row, o, axis, [&](int i, bool) {
    const double total = harmonic_mean(mu_a[i], mu_b[i]);
    const double molecular =
        varies ? harmonic_mean(molecular_a[i], molecular_b[i]) : o.transport.viscosity;
    for (int c = 0; c < C; ++c) row(h.stress, c)[i] *= total > 0 ? molecular / total : 0.0;
  });
}

// The stress along a wall from the velocity of the cell next to it, relative to the wall's.
template <int C>
void wall_law(const Row& row, const Handles& h, const SchemeOptions& o, int axis,
              const WallShear& law) {
  const int direction = o.grid.axes.direction[axis];
  if (direction_of(law.side) != direction) return;
  const double y = 0.5 * row.step().spacing[direction];
  for_each_wall_face(row, o, axis, [&](int i, bool plus) {
    if (plus != is_plus(law.side)) return;
    IntVec3 cell = row.cell();
    cell[o.grid.axes.direction[0]] += i;
    const Vec3 wall = o.grid.boundary->wall_velocity(law.side, cell);
    const int inside = plus ? -1 : 0;
    const auto value = [&](In in, int c) { return row(in, c, axis, inside)[i]; };
    double relative[C] = {}, along = 0, carried = 0;
    for (int c = 0; c < C; ++c) {
      if (c == axis) continue;
      relative[c] = value(h.velocity, c) - wall[o.grid.direction[c]];
      (c < o.grid.axes.count ? along : carried) += relative[c] * relative[c];
    }
    const double speed = std::sqrt(along + carried);
    if (speed == 0) return;  // as the gradient says: no friction
    const double rho = value(h.rho, 0);
    const double mu = o.molecular_varies() ? value(h.molecular, 0) : o.transport.viscosity;
    const double u_tau = friction_velocity(law, speed, y, mu / rho);
    const double pull = (plus ? -1.0 : 1.0) * rho * u_tau * u_tau / speed;
    for (int c = 0; c < C; ++c)
      if (c != axis) row(h.stress, c)[i] = pull * relative[c];
  });
}

template <int C>
void wall_rows(const Row& row, const Handles& h, const SchemeOptions& o, int axis) {
  if (o.transport.models.turbulence) take_eddies_from_walls<C>(row, h, o, axis);
  for (const WallShear& law : o.transport.models.wall_shear) wall_law<C>(row, h, o, axis, law);
}

// What the walls need beside the velocity.
void read_for_walls(TaskBuilder& task, const ViscousStressInput& v, const SchemeOptions& o,
                    Stencil both, Handles& h) {
  const bool laws = !o.transport.models.wall_shear.empty();
  if (laws) h.rho = task.read(v.rho, both);
  if (o.molecular_varies() && (laws || o.transport.models.turbulence))
    h.molecular =
        task.read(o.transport.models.turbulence ? v.molecular_viscosity : v.viscosity, both);
}

}  // namespace

void add_viscous_stress(TaskList& list, const ViscousStressInput& v, const SchemeOptions& o,
                        int effect) {
  if (!o.transport.viscous) return;
  static const char* names[] = {"stress on axis 0", "stress on axis 1", "stress on axis 2"};
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    TaskBuilder task = list.task(names[axis], effect);
    Handles h;
    Stencil around = Stencil::box(1);
    if (o.scheme.implicit)
      around.low[o.grid.axes.direction[axis]] = 2;  // the second cell from a wall
    h.velocity = task.read(v.velocity, around);
    const Stencil both = Stencil::along(o.grid.axes.direction[axis], 1, 0);
    if (o.transport.viscosity_varies) h.viscosity = task.read(v.viscosity, both);
    read_for_walls(task, v, o, both, h);
    h.stress = task.write(v.stress[axis]);
    dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
      task.kernel([=](const Row& row) {
        TransverseRows rows[3][3] = {};
        for (int c = 0; c < D; ++c)
          for (int t = 0; t < D; ++t) {
            if (t == axis) continue;
            rows[c][t] = {row.at_corner(h.velocity, c, axis, -1, t, -1),
                          row.at_corner(h.velocity, c, axis, -1, t, 1), row(h.velocity, c, t, -1),
                          row(h.velocity, c, t, 1)};
          }
        if (o.transport.viscosity_varies)
          stress_row<D, C, true>(row, h, o, axis, rows);
        else
          stress_row<D, C, false>(row, h, o, axis, rows);
        if (o.scheme.implicit)
          o.transport.viscosity_varies ? stick_to_walls<C, true>(row, h, o, axis)
                                       : stick_to_walls<C, false>(row, h, o, axis);
        if (o.transport.models.turbulence || !o.transport.models.wall_shear.empty())
          wall_rows<C>(row, h, o, axis);
      });
    });
  }
}

}  // namespace sluice::ice
