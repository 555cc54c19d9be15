// Faces where solids are, and the volume of fluid that passes each (l = dt/dx):
//
//   fluid on both sides:  u_f, p_f of the Riemann problem
//   on one side:          u_f = v_sf, p_f = p_w of the cell with fluid
//   on none:              u_f = v_sf, p_f = mean of both p_w
//   H = l (1 - A) u_f - C,   the velocity of what passes is w = H/l
// with v_sf the velocity of the solid at the face, A the mean of its covered share, C the volume
// that surfaces sweep through it. Nothing passes between two cells without fluid, unless one opens.
// A cell without fluid has nothing to give: what its faces do not close to
//   r = V' + sum (H+ - H-) = 0
// is shared by those that meet fluid.
#include <cmath>

#include "ice/cut_cells/variables.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice::cut_cells {
namespace {

struct FaceHandles {
  In fraction, next, pressure, covered, mean, swept, solid, u, p;
  Out u_f, p_f, flow;
};

void face_row(const Row& row, const FaceHandles& h, int axis, double dx_dt) {
  const int n = row.count();
  const double *ta = row(h.fraction, 0, axis, -1), *tb = row(h.fraction);
  const double *na = row(h.next, 0, axis, -1), *nb = row(h.next);
  const double *pa = row(h.pressure, 0, axis, -1), *pb = row(h.pressure);
  const double *A = row(h.mean), *C = row(h.swept), *v = row(h.solid);
  const double *u = row(h.u), *p = row(h.p);
  double* __restrict uf = row(h.u_f);
  double* __restrict pf = row(h.p_f);
  double* __restrict w = row(h.flow);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const bool a = ta[i] < 1, b = tb[i] < 1, open = a & b;
    const double dry = 0.5 * (pa[i] + pb[i]), above = b ? pb[i] : dry, wall = a ? pa[i] : above;
    const double velocity = open ? u[i] : v[i], passes = (1.0 - A[i]) * velocity - C[i] * dx_dt;
    uf[i] = velocity;
    pf[i] = open ? p[i] : wall;
    const bool closed = !(a | b) & (na[i] >= 1) & (nb[i] >= 1);
    w[i] = closed ? 0.0 : passes;
  }
}

// r of cells without fluid, shared by their faces that meet some (of volume per time: without dt).
void outflow_row(const Row& row, In fraction, In next, const std::array<In, 3>& flow, Out to,
                 const SchemeOptions& o) {
  const int n = row.count();
  const double *theta = row(fraction), *after = row(next);
  double* r = row(to);
  const double dt = row.step().dt;
  for (int i = 0; i < n; ++i) {
    r[i] = 0;
    if (theta[i] < 1) continue;
    double sum = (1.0 - after[i]) / dt;
    int wet = 0;
    for (int a = 0; a < o.grid.axes.count; ++a) {
      const In w = flow[a];
      const double inverse_dx = 1.0 / row.step().spacing[o.grid.axes.direction[a]];
      sum += (row(w, 0, a, 1)[i] - row(w)[i]) * inverse_dx;
      wet += (row(fraction, 0, a, -1)[i] < 1) + (row(fraction, 0, a, 1)[i] < 1);
    }
    if (wet > 0) r[i] = sum / wet;
  }
}

void close_row(const Row& row, In fraction, In raw, In outflow, Out to, int axis, double dx,
               double least) {
  const int n = row.count();
  const double *ta = row(fraction, 0, axis, -1), *tb = row(fraction);
  const double *ra = row(outflow, 0, axis, -1), *rb = row(outflow), *w = row(raw);
  double* __restrict flow = row(to);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const bool a = ta[i] < 1, b = tb[i] < 1;
    const double above = w[i] + rb[i] * dx, from_above = a ? above : w[i];
    const double below = from_above - ra[i] * dx, sum = b ? below : from_above;
    const double closed = std::fabs(sum) < least ? 0.0 : sum;
    flow[i] = (a & b) ? w[i] : closed;
  }
}

}  // namespace

void add_open_faces(TaskList& list, const OpenFacesInput& v, const SchemeOptions& o, int effect) {
  // threshold: outflow of a cell without fluid, as a share of its volume, up to which it is the
  //   round-off of overlaps; unit: 1; test: none
  constexpr double round_off = 1e-12;
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    const int d = o.grid.axes.direction[axis];
    const Stencil both = Stencil::along(d, 1, 0);
    TaskBuilder task = list.task("faces with solids " + std::to_string(axis), effect);
    FaceHandles h;
    h.fraction = task.read(v.fraction, both);
    h.next = task.read(v.next, both);
    h.pressure = task.read(v.wall_pressure, both);
    h.mean = task.read(v.mean_covered[axis]);
    h.swept = task.read(v.swept[axis]);
    h.solid = task.read(v.solid_velocity[axis]);
    h.u = task.read(v.fluid_velocity[axis]);
    h.p = task.read(v.fluid_pressure[axis]);
    h.u_f = task.write(v.face_velocity[axis]);
    h.p_f = task.write(v.face_pressure[axis]);
    h.flow = task.write(v.raw_flow[axis]);
    task.kernel(
        [=](const Row& row) { face_row(row, h, axis, row.step().spacing[d] / row.step().dt); });
  }
  TaskBuilder closing = list.task("outflow of cells without fluid", effect);
  const In fraction = closing.read(v.fraction, Stencil::box(1));
  const In next = closing.read(v.next);
  std::array<In, 3> flows;
  for (int axis = 0; axis < o.grid.axes.count; ++axis)
    flows[axis] = closing.read(v.raw_flow[axis], Stencil::along(o.grid.axes.direction[axis], 0, 1));
  const Out outflow = closing.write(v.outflow);
  closing.kernel([=](const Row& row) { outflow_row(row, fraction, next, flows, outflow, o); });
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    const int d = o.grid.axes.direction[axis];
    const Stencil both = Stencil::along(d, 1, 0);
    TaskBuilder task = list.task("volume flow " + std::to_string(axis), effect);
    const In theta = task.read(v.fraction, both), raw = task.read(v.raw_flow[axis]);
    const In out = task.read(v.outflow, both);
    const Out flow = task.write(v.flow[axis]);
    task.kernel([=](const Row& row) {
      const double dx = row.step().spacing[d];
      close_row(row, theta, raw, out, flow, axis, dx, round_off * dx / row.step().dt);
    });
  }
}

void add_open_share(TaskList& list, const OpenShareInput& v, const SchemeOptions& o, int axis,
                    int components, const std::string& name, int effect) {
  TaskBuilder task = list.task(name, effect);
  const In theta = task.read(v.fraction, Stencil::along(o.grid.axes.direction[axis], 1, 0));
  const In covered = task.read(v.covered[axis]), in = task.read(v.whole[axis]);
  const Out out = task.write(v.open[axis]);
  task.kernel([=](const Row& row) {
    const double *ta = row(theta, 0, axis, -1), *tb = row(theta), *a = row(covered);
    for (int c = 0; c < components; ++c) {
      const double* q = row(in, c);
      double* __restrict open = row(out, c);
      const int count = row.count();
#pragma GCC ivdep
      for (int i = 0; i < count; ++i) {
        const double passes = (1.0 - a[i]) * q[i];
        const bool wet = (ta[i] < 1) & (tb[i] < 1);
        open[i] = wet ? passes : 0.0;
      }
    }
  });
}

// Friction and conduction between cells of fluid, on the open share of their face.
void add_shares(TaskList& list, const SharesInput& v, const SchemeOptions& o, int effect) {
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    if (o.transport.viscous)
      add_open_share(list, v.stress, o, axis, o.grid.components,
                     "stress of open faces " + std::to_string(axis), effect);
    if (o.transport.conducting)
      add_open_share(list, v.heat_flux, o, axis, 1,
                     "heat flux of open faces " + std::to_string(axis), effect);
  }
}

}  // namespace sluice::ice::cut_cells
