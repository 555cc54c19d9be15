// What passes through the boundary of the domain in a step, summed exactly.
//
//   mass F, momentum F U + p_f dt/dx n (minus the viscous stress), total energy
//   p_f u_f dt/dx + F |U|^2/2 + G, each per volume of the cell behind the face; counted positive
// when it enters. Gravity adds m g dt to momentum and its work to the energy of every cell: that
// is counted in the Lagrangian momentum, cell by cell.
#include "framework/task/reductions.hpp"
#include "ice/conservative/variables.hpp"

namespace sluice::ice {
namespace {

struct Handles {
  In flux, face_velocity, face_pressure, stress, velocity;
};

struct Side {
  int axis = 0;
  bool plus = false;
  int shift = 0;  // face index relative to the cell: 0 low, 1 high
};

void account_face(const Row& row, const Handles& h, const SchemeOptions& o, const Side& s, int i) {
  const double sign = s.plus ? -1.0 : 1.0;
  const double volume = row.step().spacing.x * row.step().spacing.y * row.step().spacing.z;
  const double l = row.step().dt / row.step().spacing[o.axes.direction[s.axis]];
  auto face = [&](In in, int c = 0) { return row(in, c, s.axis, s.shift)[i]; };
  const double F = face(h.flux, 0), G = face(h.flux, 1);
  const double uf = face(h.face_velocity), pf = face(h.face_pressure);
  Reductions& sums = row.reductions();
  sums.sum(StepSlots::mass).add(sign * F * volume);
  double FU2 = 0, friction = 0;
  for (int c = 0; c < o.components; ++c) {
    // The flux holds U, or F U in the classic form.
    const double carried = face(h.flux, 2 + c);
    const double FU = o.classic ? carried : F * carried;
    const double U = !o.classic ? carried : F != 0.0 ? carried / F : 0.0;
    FU2 += FU * U;
    double impulse = c == s.axis ? l * pf : 0.0;
    if (o.viscous) {
      const double t = face(h.stress, c);
      impulse -= l * t;
      friction +=
          l * t * 0.5 *
          (row(h.velocity, c, s.axis, s.shift - 1)[i] + row(h.velocity, c, s.axis, s.shift)[i]);
    }
    const int direction = o.direction[static_cast<std::size_t>(c)];
    sums.sum(StepSlots::momentum + direction).add(sign * (FU + impulse) * volume);
    sums.sum(StepSlots::pressure_impulse + direction).add(sign * impulse * volume);
  }
  sums.sum(StepSlots::energy).add(sign * (l * pf * uf + 0.5 * FU2 + G - friction) * volume);
}

// The faces of this row that lie on one side of the domain.
void account_side(const Row& row, const Handles& h, const SchemeOptions& o, const Side& s) {
  const int d = o.axes.direction[s.axis];
  const int wanted = s.plus ? o.domain.upper[d] - 1 : o.domain.lower[d];
  if (s.axis == 0) {
    const int i = wanted - row.cell()[d];
    if (i >= 0 && i < row.count()) account_face(row, h, o, s, i);
    return;
  }
  if (row.cell()[d] != wanted) return;
  for (int i = 0; i < row.count(); ++i) account_face(row, h, o, s, i);
}

}  // namespace

void add_boundary_account(TaskList& list, const SchemeVariables& v, const SchemeOptions& o,
                          int effect) {
  static const char* names[] = {"boundary account 0", "boundary account 1", "boundary account 2"};
  for (int axis = 0; axis < o.axes.count; ++axis) {
    const int direction = o.axes.direction[axis];
    if (o.periodic[static_cast<std::size_t>(direction)]) continue;
    const auto face = static_cast<std::size_t>(axis);
    const Stencil both = Stencil::along(direction, 0, 1);
    TaskBuilder task = list.task(names[axis], effect);
    Handles h;
    h.flux = task.read(v.flux[face], both);
    h.face_velocity = task.read(v.face_velocity[face], both);
    h.face_pressure = task.read(v.face_pressure[face], both);
    if (o.viscous) {
      h.stress = task.read(v.stress[face], both);
      h.velocity = task.read(v.velocity, Stencil::along(direction, 1, 1));
    }
    task.always().kernel([=](const Row& row) {
      account_side(row, h, o, {axis, false, 0});
      account_side(row, h, o, {axis, true, 1});
    });
  }
}

}  // namespace sluice::ice
