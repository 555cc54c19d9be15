// Step 7 of the classic form: what flows through each face from the upwind cell.
//
//   r   = sign(H) (1 - |H|)/2 along the normal, shift_t across it;  H = l u_f   (lengths in cells)
//   F   = H rho_s,                      rho_s = rho + s . r
//   F_q = H (rho_s q + rho s_q . r)     compatible fluxes, q per mass
//   F_q = H (q + s_q . r)               otherwise, q per volume
// First order: r = 0. r is the centroid of the slab that leaves.
#include "ice/internal_energy_form/variables.hpp"

namespace sluice::ice::internal_energy_form {
namespace {

struct Handles {
  In rho, energy, momentum, slope, shift, face_velocity;
  Out flux;
};

// A cell row left (a) and right (b) of each face.
struct Pair {
  const double *a, *b;
  double donor(int i, bool left) const { return left ? b[i] : a[i]; }
};

Pair pair(const Row& row, In in, int component, int axis) {
  return {row(in, component, axis, -1), row(in, component)};
}

// s . r of the donor; the normal axis first.
template <int D>
struct SlopePairs {
  Pair slope[D], shift[D];

  double along(int i, bool left, int axis, double normal) const {
    double across = 0;
    if constexpr (D > 1)
      for (int d = 0; d < D; ++d)
        if (d != axis) across += slope[d].donor(i, left) * shift[d].donor(i, left);
    return slope[axis].donor(i, left) * normal + across;
  }
};

template <int D>
SlopePairs<D> slope_pairs(const Row& row, const Handles& h, int quantity, int axis) {
  SlopePairs<D> p;
  for (int d = 0; d < D; ++d) {
    p.slope[d] = pair(row, h.slope, slope_index(quantity, d, D), axis);
    p.shift[d] = D > 1 ? pair(row, h.shift, d, axis) : Pair{};
  }
  return p;
}

inline double centroid(double H) {
  return (H < 0.0 ? -0.5 : 0.5) * (1.0 - std::fabs(H));
}

template <int D, int C, bool Second, bool Specific>
void flux_row(const Row& row, const Handles& h, int axis, double l) {
  const int n = row.count();
  const double* __restrict uf = row(h.face_velocity);
  const Pair rho = pair(row, h.rho, 0, axis);
  SlopePairs<D> mass;
  if constexpr (Second) mass = slope_pairs<D>(row, h, 0, axis);
  double* __restrict F = row(h.flux, 0);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double H = l * uf[i];
    const bool left = H < 0.0;
    double slab = rho.donor(i, left);
    if constexpr (Second) slab += mass.along(i, left, axis, centroid(H));
    F[i] = H * slab;
  }
  for (int q = 0; q < 1 + C; ++q) {
    const Pair value = q == 0 ? pair(row, h.energy, 0, axis) : pair(row, h.momentum, q - 1, axis);
    SlopePairs<D> slopes;
    if constexpr (Second) slopes = slope_pairs<D>(row, h, 1 + q, axis);
    double* __restrict G = row(h.flux, 1 + q);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double H = l * uf[i];
      const bool left = H < 0.0;
      double deviation = 0;
      if constexpr (Second) deviation = slopes.along(i, left, axis, centroid(H));
      if constexpr (Specific)
        G[i] = F[i] * value.donor(i, left) + H * (rho.donor(i, left) * deviation);
      else
        G[i] = H * (value.donor(i, left) + deviation);
    }
  }
}

}  // namespace

void add_fluxes(TaskList& list, const FluxesInput& v, const SchemeOptions& o, int effect) {
  static const char* names[] = {"fluxes of axis 0", "fluxes of axis 1", "fluxes of axis 2"};
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    const int direction = o.grid.axes.direction[axis];
    const Stencil both = Stencil::along(direction, 1, 0);
    TaskBuilder task = list.task(names[axis], effect);
    Handles h;
    h.rho = task.read(v.rho, both);
    h.energy = task.read(v.energy, both);
    h.momentum = task.read(v.momentum, both);
    if (o.scheme.second_order) h.slope = task.read(v.slope, both);
    if (o.scheme.second_order && o.grid.axes.count > 1) h.shift = task.read(v.shift, both);
    h.face_velocity = task.read(v.face_velocity[axis]);
    h.flux = task.write(v.flux[axis]);
    const bool per_mass = specific(o);
    dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
      task.kernel([=](const Row& row) {
        const double l = row.step().dt / row.step().spacing[direction];
        if (!o.scheme.second_order)
          flux_row<D, C, false, true>(row, h, axis, l);
        else if (per_mass)
          flux_row<D, C, true, true>(row, h, axis, l);
        else
          flux_row<D, C, true, false>(row, h, axis, l);
      });
    });
  }
}

}  // namespace sluice::ice::internal_energy_form
