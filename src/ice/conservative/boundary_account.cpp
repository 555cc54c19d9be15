// What passes through the boundary of the domain in a step, summed exactly.
//
// Mass, momentum and total energy (face_flux.hpp), counted positive when they enter. Gravity adds
// m g dt to momentum and its work to the energy of every cell: that is counted in the Lagrangian
// momentum, cell by cell. With several levels a cell under a finer one counts nothing.
#include "framework/refine/coverage.hpp"
#include "framework/task/reductions.hpp"
#include "ice/conservative/face_flux.hpp"

namespace sluice::ice {
namespace {

struct Side {
  int axis = 0;
  bool plus = false;
  int shift = 0;  // face index relative to the cell: 0 low, 1 high
};

void account_face(const Row& row, const FaceFluxHandles& h, const SchemeOptions& o, const Side& s,
                  int i) {
  if (o.coverage != nullptr && o.coverage->any()) {
    IntVec3 cell = row.cell();
    cell[o.axes.direction[0]] += i;
    if (o.coverage->is_covered(row.box(), cell)) return;
  }
  const double sign = s.plus ? -1.0 : 1.0;
  const double volume = row.step().spacing.x * row.step().spacing.y * row.step().spacing.z;
  const FaceFlux flux = face_flux(row, h, o, s.axis, s.shift, i);
  Reductions& sums = row.reductions();
  for (int m = 0; m < static_cast<int>(o.fluids.size()); ++m) {
    const double mass = material_flux(row, h, o, s.axis, s.shift, i, m).mass;
    sums.sum(StepSlots::mass_of(m, o.sums)).add(sign * mass * volume);
  }
  for (int c = 0; c < o.components; ++c) {
    const int direction = o.direction[static_cast<std::size_t>(c)];
    sums.sum(StepSlots::momentum + direction).add(sign * flux.momentum[c] * volume);
    sums.sum(StepSlots::pressure_impulse + direction).add(sign * flux.impulse[c] * volume);
  }
  sums.sum(StepSlots::energy).add(sign * flux.energy * volume);
}

// The faces of this row that lie on one side of the domain.
void account_side(const Row& row, const FaceFluxHandles& h, const SchemeOptions& o, const Side& s) {
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
    if (o.periodic[static_cast<std::size_t>(o.axes.direction[axis])]) continue;
    TaskBuilder task = list.task(names[axis], effect);
    const FaceFluxHandles h = read_face_fluxes(task, v, o, axis);
    task.always().kernel([=](const Row& row) {
      account_side(row, h, o, {axis, false, 0});
      account_side(row, h, o, {axis, true, 1});
    });
  }
}

}  // namespace sluice::ice
