// Step 5 with velocities of their own: with which velocity each material meets a face.
//
//   u_fm = c + r_m,   r_m = (M_a d_a + M_b d_b)/(M_a + M_b) of the drifts of both cells
//   sum_m V_m(donor) (c + r_m) = u_f, the donor of each by the sign of c + r_m
// (r_m of the ghost cell alone where a side prescribes how fast they pass).
// The sum rises with c in straight pieces: Newton's step ends on the piece of the solution. Without
// drift u_fm = u_f to the bit. Cells: outflow Courant number of each material,
// N_m = (1/J) sum_d l_d [max(0, u_fm+) + max(0, -u_fm-)], and the largest l |u_fm| of its outlets,
// negative if there are several, minus infinity if several are the largest. At a cell that solids
// touch nothing drifts; its N_m is that of the mixture.
#include <cmath>
#include <limits>

#include "framework/base/infinity.hpp"
#include "ice/fluid/limiters.hpp"
#include "ice/multi_velocity/tasks.hpp"
#include "ice/step/held_faces.hpp"
#include "ice/step/material_runs.hpp"

namespace sluice::ice::mixture {
namespace {

struct FaceHandles {
  std::vector<In> mass, volume;
  In pure, drift, face_velocity, cut, velocity, sound;
  Out own;
  bool has_cut_cells = false;
};

// Volume fractions and drifts on both sides of a face.
struct Face {
  int count = 0;
  double a[max_materials], b[max_materials], r[max_materials];
  double u = 0;

  double velocity_of_volume() const {
    double c = u;
    for (int k = 0; k < count; ++k) c -= 0.5 * (a[k] + b[k]) * r[k];
    for (int round = 0; round < 2 * count + 2; ++round) {
      double sum = 0, slope = 0;
      for (int k = 0; k < count; ++k) {
        const double x = c + r[k];
        const double V = x > 0.0 ? a[k] : x < 0.0 ? b[k] : 0.5 * (a[k] + b[k]);
        sum += V * x;
        slope += V;
      }
      if (!(slope > min_slope)) return std::numeric_limits<double>::quiet_NaN();
      const double next = c + (u - sum) / slope;
      if (next == c || std::fabs(next - c) <= iteration_ends * (std::fabs(c) + std::fabs(u)))
        return next;
      c = next;
    }
    return c;
  }
  // threshold: slope of the velocity of the volume below which Newton finds no velocity of the
  //   mixture; unit: 1; test: none
  static constexpr double min_slope = 1e-3;
  // threshold: relative step at which its iteration ends: round-off; unit: 1; test: none
  static constexpr double iteration_ends = 1e-15;
};

// `a`, `b`: which of the cells aside say what drifts.
void mixed_face(const Row& row, const FaceHandles& h, int axis, int axes, int i, bool a, bool b) {
  const int materials = static_cast<int>(h.mass.size());
  Face f;
  f.u = row(h.face_velocity)[i];
  f.count = materials;
  bool any = false;
  const bool bound = h.has_cut_cells && (row(h.cut, 0, axis, -1)[i] != 0 || row(h.cut)[i] != 0);
  for (int m = 0; m < materials; ++m) {
    const double Ma = a ? row(h.mass[m], 0, axis, -1)[i] : 0.0, Mb = b ? row(h.mass[m])[i] : 0.0;
    const double da = row(h.drift, m * axes + axis, axis, -1)[i];
    const double db = row(h.drift, m * axes + axis)[i];
    f.a[m] = row(h.volume[m], 0, axis, -1)[i];
    f.b[m] = row(h.volume[m])[i];
    f.r[m] = !bound && Ma + Mb > 0.0 ? (Ma * da + Mb * db) / (Ma + Mb) : 0.0;
    any = any || f.r[m] != 0.0;
  }
  const double c = any ? f.velocity_of_volume() : f.u;
  for (int m = 0; m < materials; ++m) row(h.own, m)[i] = any && std::isfinite(c) ? c + f.r[m] : f.u;
}

void mixed_faces(const Row& row, const FaceHandles& h, int axis, const SchemeOptions& o) {
  for (int i = 0; i < row.count(); ++i) mixed_face(row, h, axis, o.grid.axes.count, i, true, true);
  for_each_prescribed_face(row, o, axis, h.velocity, h.sound, [&](int i, bool plus, double) {
    mixed_face(row, h, axis, o.grid.axes.count, i, !plus, plus);
  });
}

void add_faces_of_materials(TaskList& list, const SlipFacesInput& v, const SchemeOptions& o,
                            int effect) {
  static const char* names[] = {"faces of each material, axis 0", "faces of each material, axis 1",
                                "faces of each material, axis 2"};
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    const Stencil both = Stencil::along(o.grid.axes.direction[axis], 1, 0);
    TaskBuilder task = list.task(names[axis], effect);
    FaceHandles h;
    for (std::size_t m = 0; m < v.state.mass.size(); ++m) {
      h.mass.push_back(task.read(v.state.mass[m], both));
      h.volume.push_back(task.read(v.state.volume[m], both));
    }
    h.pure = task.read(v.pure, both);
    h.drift = task.read(v.drift, both);
    h.face_velocity = task.read(v.face_velocity[axis]);
    if (holds_velocities(o)) {
      h.velocity = task.read(v.moving.velocity, both);
      h.sound = task.read(v.moving.sound, both);
    }
    h.own = task.write(v.own_face_velocity[axis]);
    h.has_cut_cells = o.grid.has_cut_cells;
    if (o.grid.has_cut_cells) h.cut = task.read(v.cut, both);
    task.kernel([=](const Row& row) {
      for_each_face_run(runs_of(row, h.pure, axis, -1), runs_of(row, h.pure), row.count(),
                        [&](int first, int count, double pure) {
                          if (pure < 0.0) mixed_faces(row.part(first, count), h, axis, o);
                        });
    });
  }
}

struct CellHandles {
  In pure, inverse_J, velocity, cut, courant;
  std::array<In, 3> face_velocity;
  Out outflow;
};

void count_outflow(const Row& row, const CellHandles& h, const SchemeOptions& o, int materials) {
  const int D = o.grid.axes.count;
  double l[3] = {};
  for (int c = 0; c < o.grid.components; ++c)
    l[c] = row.step().dt / row.step().spacing[o.grid.direction[c]];
  for (int m = 0; m < materials; ++m) {
    double* N = row(h.outflow, m);
    double* outlet = row(h.outflow, materials + m);
    for (int i = 0; i < row.count(); ++i) {
      double out = 0, carried = 0, count = 0, largest = 0;
      for (int d = 0; d < D; ++d) {
        const In face = h.face_velocity[d];
        const double low = row(face, m)[i], high = row(face, m, d, 1)[i];
        out += l[d] * (larger(0.0, high) + larger(0.0, -low));
        count += (high > 0.0 ? 1.0 : 0.0) + (low < 0.0 ? 1.0 : 0.0);
        largest = larger(largest, l[d] * larger(high, -low));
      }
      double ties = 0;
      for (int d = 0; d < D; ++d) {
        const In face = h.face_velocity[d];
        const double low = row(face, m)[i], high = row(face, m, d, 1)[i];
        ties += (l[d] * high == largest ? 1.0 : 0.0) + (l[d] * -low == largest ? 1.0 : 0.0);
      }
      for (int c = D; c < o.grid.components; ++c)
        carried += l[c] * std::fabs(row(h.velocity, c)[i]);
      const bool bound = o.grid.has_cut_cells && row(h.cut)[i] != 0;
      N[i] = bound ? row(h.courant)[i] : (out + carried) * row(h.inverse_J)[i];
      const double several = ties > 1.0 ? -infinity : -largest;
      outlet[i] = count > 1.0 ? several : largest;
    }
  }
}

}  // namespace

void add_slip_faces(TaskList& list, const SlipFacesInput& v, const SchemeOptions& o, int effect) {
  add_faces_of_materials(list, v, o, effect);
  TaskBuilder task = list.task("outflow of each material", effect);
  CellHandles h;
  h.pure = task.read(v.pure);
  h.inverse_J = task.read(v.inverse_J);
  h.velocity = task.read(v.velocity);
  if (o.grid.has_cut_cells) {
    h.cut = task.read(v.cut);
    h.courant = task.read(v.courant);
  }
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    h.face_velocity[axis] =
        task.read(v.own_face_velocity[axis], Stencil::along(o.grid.axes.direction[axis], 0, 1));
  }
  h.outflow = task.write(v.outflow);
  const int materials = static_cast<int>(v.state.mass.size());
  task.kernel([=](const Row& row) {
    for_each_run(runs_of(row, h.pure), row.count(), [&](int first, int count, double pure) {
      if (pure < 0.0) count_outflow(row.part(first, count), h, o, materials);
    });
  });
}

}  // namespace sluice::ice::mixture
