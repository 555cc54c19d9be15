// Step 6 of the classic form: limited slopes of density, energy and momentum, and what is left of
// a cell after outflow.
//
//   s_d = (q_{i+1} - q_{i-1})/2 per cell, times phi of limited_slopes.hpp; zero in cells outside
//   the domain and in cells that the mask names
//   shift_d = l_d (max(0,-u_f-) - max(0,u_f+))/2: the centroid of what does not leave along d
#include "ice/internal_energy_form/limited_slopes.hpp"
#include "ice/internal_energy_form/variables.hpp"

namespace sluice::ice::internal_energy_form {
namespace {

struct Handles {
  In rho, energy, momentum, mask;
  std::array<In, 3> face_velocity;
  Out slope, shift;
};

// Rows of a quantity in the neighbours of a row of cells.
template <int D>
struct Neighbours {
  const double* middle;
  const double* low[D];
  const double* high[D];
};

template <int D>
Neighbours<D> neighbours(const Row& row, In in, int component) {
  Neighbours<D> q;
  q.middle = row(in, component);
  for (int d = 0; d < D; ++d) {
    q.low[d] = row(in, component, d, -1);
    q.high[d] = row(in, component, d, 1);
  }
  return q;
}

// Slopes of quantity number `quantity` along all axes. Mass: the limited slopes of the density,
// used when the quantity is weighted with it.
template <int D, bool Weighted>
void slope_rows(const Row& row, const Handles& h, const Neighbours<D>& q, int quantity) {
  const int n = row.count();
  const double* __restrict rho = row(h.rho);
  const double* mass_slope[D];
  double* out[D];
  for (int d = 0; d < D; ++d) {
    mass_slope[d] = row(h.slope, slope_index(0, d, D));
    out[d] = row(h.slope, slope_index(quantity, d, D));
  }
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    double low[D], high[D], s[D];
    MassSlopes<D> mass;
    mass.rho = rho[i];
    for (int d = 0; d < D; ++d) {
      low[d] = q.low[d][i];
      high[d] = q.high[d][i];
      s[d] = 0.5 * (high[d] - low[d]);
      if constexpr (Weighted) mass.slope[d] = mass_slope[d][i];
    }
    const double phi = limiter_of_cell<D, Weighted>(q.middle[i], low, high, s, mass);
    for (int d = 0; d < D; ++d) out[d][i] = phi * s[d];
  }
}

// Scales the density's or any other slopes of cells [first, last) of the row to zero.
void flatten(const Row& row, const Handles& h, int slopes, int first, int last) {
  for (int k = 0; k < slopes; ++k) {
    double* s = row(h.slope, k);
    for (int i = first; i < last; ++i) s[i] = 0.0;
  }
}

// No slopes in ghost cells outside the domain: what comes in has the ghost's own value.
void flatten_outside(const Row& row, const Handles& h, const SchemeOptions& o, int slopes) {
  const int n = row.count();
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    const int d = o.grid.axes.direction[axis];
    if (o.grid.periodic[d]) continue;
    const int first = o.grid.domain.lower[d] - row.cell()[d],
              last = o.grid.domain.upper[d] - row.cell()[d];
    if (axis == 0) {
      flatten(row, h, slopes, 0, first < n ? first : n);
      flatten(row, h, slopes, last > 0 ? last : 0, n);
    } else if (first > 0 || last <= 0) {
      flatten(row, h, slopes, 0, n);
    }
  }
}

void apply_mask(const Row& row, const Handles& h, int slopes) {
  const double* mask = row(h.mask);
  for (int k = 0; k < slopes; ++k) {
    double* s = row(h.slope, k);
    for (int i = 0; i < row.count(); ++i) s[i] *= mask[i];
  }
}

template <int D>
void shift_rows(const Row& row, const Handles& h, const SchemeOptions& o) {
  const int n = row.count();
  for (int d = 0; d < D; ++d) {
    const double half = 0.5 * row.step().dt / row.step().spacing[o.grid.axes.direction[d]];
    const double* __restrict um = row(h.face_velocity[d]);
    const double* __restrict up = row(h.face_velocity[d], 0, d, 1);
    double* __restrict shift = row(h.shift, d);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) shift[i] = half * (larger(0.0, -um[i]) - larger(0.0, up[i]));
  }
}

template <int D, int C>
void all_rows(const Row& row, const Handles& h, const SchemeOptions& o) {
  constexpr int slopes = (2 + C) * D;
  slope_rows<D, false>(row, h, neighbours<D>(row, h.rho, 0), 0);
  // The density's own slopes must be final before others are weighted with them.
  if (o.scheme.masked) apply_mask(row, h, D);
  for (int q = 1; q < 2 + C; ++q) {
    const Neighbours<D> near =
        q == 1 ? neighbours<D>(row, h.energy, 0) : neighbours<D>(row, h.momentum, q - 2);
    if (o.scheme.compatible_fluxes)
      slope_rows<D, true>(row, h, near, q);
    else
      slope_rows<D, false>(row, h, near, q);
  }
  if (o.scheme.masked) apply_mask(row, h, slopes);
  flatten_outside(row, h, o, slopes);
  if constexpr (D > 1) shift_rows<D>(row, h, o);
}

}  // namespace

void add_slopes(TaskList& list, const SlopesInput& v, const SchemeOptions& o, int effect) {
  if (!o.scheme.second_order) return;
  TaskBuilder task = list.task("limited slopes", effect);
  Stencil around;
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    around.low[o.grid.axes.direction[axis]] = 1;
    around.high[o.grid.axes.direction[axis]] = 1;
  }
  Handles h;
  h.rho = task.read(v.rho, around);
  h.energy = task.read(v.energy, around);
  h.momentum = task.read(v.momentum, around);
  if (o.scheme.masked) h.mask = task.read(v.mask);
  h.slope = task.write(v.slope);
  if (o.grid.axes.count > 1) {
    for (int axis = 0; axis < o.grid.axes.count; ++axis) {
      h.face_velocity[axis] =
          task.read(v.face_velocity[axis], Stencil::along(o.grid.axes.direction[axis], 0, 1));
    }
    h.shift = task.write(v.shift);
  }
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=](const Row& row) { all_rows<D, C>(row, h, o); });
  });
}

}  // namespace sluice::ice::internal_energy_form
