// Viscous stress on faces (Newtonian, Stokes hypothesis).
//
//   t_n = mu (du_n/dn + du_n/dn) - (2/3) mu div u,   t_c = mu (du_c/dn + du_n/dc)
// on a face with normal n. Normal derivatives from the two cells, transverse ones as the mean of
// the central differences of the two cells. Inactive directions have no derivative. mu is one
// number, or the harmonic mean of the two cells' values (face_mean.hpp).
#include "ice/conservative/face_mean.hpp"
#include "ice/conservative/variables.hpp"

namespace sluice::ice {
namespace {

struct Handles {
  In velocity, viscosity;
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
  for (int t = 0; t < D; ++t) inverse[t] = 1.0 / row.step().spacing[o.axes.direction[t]];
  auto across = [&](int c, int t, int i) {
    const TransverseRows& x = rows[c][t];
    return 0.25 * inverse[t] * ((x.ap[i] - x.am[i]) + (x.bp[i] - x.bm[i]));
  };
  const double mu = o.viscosity;
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

}  // namespace

void add_viscous_stress(TaskList& list, const SchemeVariables& v, const SchemeOptions& o,
                        int effect) {
  if (!o.viscous) return;
  static const char* names[] = {"stress on axis 0", "stress on axis 1", "stress on axis 2"};
  for (int axis = 0; axis < o.axes.count; ++axis) {
    TaskBuilder task = list.task(names[axis], effect);
    Handles h;
    h.velocity = task.read(v.velocity, Stencil::box(1));
    if (o.viscosity_varies)
      h.viscosity = task.read(v.viscosity, Stencil::along(o.axes.direction[axis], 1, 0));
    h.stress = task.write(v.stress[static_cast<std::size_t>(axis)]);
    dispatch(o.axes.count, o.components, [&]<int D, int C>() {
      task.kernel([=](const Row& row) {
        TransverseRows rows[3][3] = {};
        for (int c = 0; c < D; ++c)
          for (int t = 0; t < D; ++t) {
            if (t == axis) continue;
            rows[c][t] = {row.at_corner(h.velocity, c, axis, -1, t, -1),
                          row.at_corner(h.velocity, c, axis, -1, t, 1), row(h.velocity, c, t, -1),
                          row(h.velocity, c, t, 1)};
          }
        if (o.viscosity_varies)
          stress_row<D, C, true>(row, h, o, axis, rows);
        else
          stress_row<D, C, false>(row, h, o, axis, rows);
      });
    });
  }
}

}  // namespace sluice::ice
