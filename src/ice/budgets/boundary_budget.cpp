// What passes through the boundary of the domain in a step, summed exactly.
//
// Mass, momentum and total energy (face_flux.hpp), counted positive when they enter. Gravity adds
// m g dt to momentum and its work to the energy of every cell: that is counted in the Lagrangian
// momentum, cell by cell. With several levels a cell under a finer one counts nothing.
#include "ice/budgets/face_flux.hpp"
#include "ice/budgets/tasks.hpp"
#include "ice/step/cell_sums.hpp"

namespace sluice::ice {
namespace {

struct Side {
  int axis = 0;
  bool plus = false;
  int shift = 0;  // face index relative to the cell: 0 low, 1 high
};

// Faces of the cells first to end - 1 of the row.
void account_faces(const Row& row, const FaceFluxHandles& h, const SchemeOptions& o, const Side& s,
                   int first, int end) {
  const double sign = s.plus ? -1.0 : 1.0, volume = cell_volume(row);
  const FaceFluxRows fluxes(row, h, o, s.axis, s.shift);
  const PartReductions sums = row.reductions();
  for (int i = first; i < end; ++i) {
    const FaceFlux flux = fluxes(i);
    for (int m = 0; m < static_cast<int>(o.materials.fluids.size()); ++m) {
      const double mass = material_flux(row, h, o, s.axis, s.shift, i, m).mass;
      sums.sum(StepSlots::mass_of(m, o.budgets.sums)).add(sign * mass * volume);
    }
    for (int c = 0; c < o.grid.components; ++c) {
      const int direction = o.grid.direction[c];
      sums.sum(StepSlots::momentum + direction).add(sign * flux.momentum[c] * volume);
      sums.sum(StepSlots::pressure_impulse + direction).add(sign * flux.impulse[c] * volume);
    }
    sums.sum(StepSlots::energy).add(sign * flux.energy * volume);
  }
}

// The cells of a block that lie at one of both sides of the domain.
IndexBox cells_at_sides(const IndexBox& domain, int d, const IndexBox& block) {
  IndexBox cells = block;
  if (block.lower[d] != domain.lower[d]) cells.lower[d] = domain.upper[d] - 1;
  if (block.upper[d] != domain.upper[d]) cells.upper[d] = domain.lower[d] + 1;
  return intersection(cells, block);
}

// The faces of this row that lie on one side of the domain.
void account_side(const Row& row, const FaceFluxHandles& h, const SchemeOptions& o, const Side& s) {
  const int d = o.grid.axes.direction[s.axis];
  const int wanted = s.plus ? o.grid.domain.upper[d] - 1 : o.grid.domain.lower[d];
  const auto budget = [&](int first, int end) { account_faces(row, h, o, s, first, end); };
  const int cell = wanted - row.cell()[d];
  if (s.axis == 0 && cell >= 0 && cell < row.count())
    for_uncovered(row, o, cell, cell + 1, budget);
  else if (s.axis != 0 && cell == 0)
    for_uncovered(row, o, budget);
}

}  // namespace

void add_boundary_budget(TaskList& list, const FaceFluxInput& v, const SchemeOptions& o,
                         int effect) {
  static const char* names[] = {"boundary account 0", "boundary account 1", "boundary account 2"};
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    if (o.grid.periodic[o.grid.axes.direction[axis]]) continue;
    TaskBuilder task = list.task(names[axis], effect);
    const FaceFluxHandles h = read_face_fluxes(task, v, o, axis);
    task.always().only_in(
        [domain = o.grid.domain, d = o.grid.axes.direction[axis]](int, const IndexBox& block) {
          return cells_at_sides(domain, d, block);
        });
    task.kernel([=](const Row& row) {
      account_side(row, h, o, {axis, false, 0});
      account_side(row, h, o, {axis, true, 1});
    });
  }
}

}  // namespace sluice::ice
