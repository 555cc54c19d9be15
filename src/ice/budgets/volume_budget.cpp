// What control volumes of analyses exchange through their sides, and what forces add inside.
//
// Through a face (face_flux.hpp): mass of each material, momentum that is advected, pressure along
// the normal, viscous momentum flux (shear along strong shocks is such), total energy, its part
// that is conducted; amounts of the step, positive along the axis.
// Inside, over the uncovered cells: impulse and work of gravity as in gravity_budget.cpp. All sums
// are exact.
// Absent without control volumes.
#include <algorithm>

#include "framework/refine/volume_faces.hpp"
#include "ice/budgets/face_flux.hpp"
#include "ice/budgets/tasks.hpp"
#include "ice/step/cell_sums.hpp"

namespace sluice::ice {
namespace {

// Low (shift 0) or high (1) faces of the cells first to end - 1 of the row.
void account_side(const Row& row, const FaceFluxHandles& h, const SchemeOptions& o, int axis,
                  int shift, int first, int end, int side) {
  const VolumeSums slots(0, static_cast<int>(o.materials.fluids.size()));
  const int volume = side / 6, s = side % 6;
  const double V = cell_volume(row);
  const double l = row.step().dt / row.step().spacing[o.grid.axes.direction[axis]];
  const double* p = row(h.face_pressure, 0, axis, shift);
  const double* q = o.transport.conducting ? row(h.heat_flux, 0, axis, shift) : nullptr;
  const FaceFluxRows fluxes(row, h, o, axis, shift);
  const PartReductions reductions = row.reductions();
  const auto sum = [&](int slot) -> ExactSum& {
    return reductions.sum(o.budgets.volume_sums, slot);
  };
  for (int i = first; i < end; ++i) {
    const FaceFlux flux = fluxes(i);
    const double pressed = l * p[i];
    for (int m = 0; m < static_cast<int>(o.materials.fluids.size()); ++m)
      sum(slots.mass(volume, s, m)).add(material_flux(row, h, o, axis, shift, i, m).mass * V);
    sum(slots.pressure(volume, s)).add(pressed * V);
    sum(slots.energy(volume, s)).add(flux.energy * V);
    if (o.transport.conducting) sum(slots.heat(volume, s)).add(l * q[i] * V);
    for (int c = 0; c < o.grid.components; ++c) {
      const int d = o.grid.direction[c];
      sum(slots.momentum(volume, s) + d).add((flux.momentum[c] - flux.impulse[c]) * V);
      if (o.transport.viscous || o.scheme.shears_shocks)
        sum(slots.viscous(volume, s) + d).add((flux.impulse[c] - (c == axis ? pressed : 0.0)) * V);
    }
  }
}

void account_faces(const Row& row, const FaceFluxHandles& h, const SchemeOptions& o, int axis) {
  const int low = row.cell()[o.grid.axes.direction[0]], high = low + row.count();
  for (const FaceTable::Segment& s : o.budgets.volumes->segments(row.box(), axis, row.cell())) {
    const int first = std::max(s.first, low), end = std::min(s.first + s.count, high);
    if (first < end)
      account_side(row, h, o, axis, s.high ? 1 : 0, first - low, end - low,
                   o.budgets.volumes->side_of(s));
  }
}

struct Handles {
  In rho, momentum, impulse;
};

// Cells first ... end - 1 of the row.
void account_forces(const Row& row, const Handles& h, const SchemeOptions& o, int volume, int first,
                    int end) {
  const VolumeSums slots(0, static_cast<int>(o.materials.fluids.size()));
  const double* rho = row(h.rho);
  for (int c = 0; c < o.grid.components; ++c) {
    const int d = o.grid.direction[c];
    const double kick = row.step().dt * o.forces.gravity[d] * cell_volume(row);
    const double push = row.step().dt * o.forces.driving[d] * cell_volume(row);
    if (kick == 0.0 && push == 0.0) continue;
    const double* m = row(h.momentum, c);
    const double* dp = row(h.impulse, c);
    for (int i = first; i < end; ++i) {
      row.reductions()
          .sum(o.budgets.volume_sums, slots.force(volume) + d)
          .add(kick * rho[i] + push);
      const double along = kick + push / rho[i];
      row.reductions()
          .sum(o.budgets.volume_sums, slots.work(volume))
          .add(along * (m[i] - 0.5 * dp[i]));
    }
  }
}

void account_inside(const Row& row, const Handles& h, const SchemeOptions& o) {
  const int along = o.grid.axes.direction[0];
  const int low = row.cell()[along], high = low + row.count();
  for (int volume = 0; volume < o.budgets.volumes->count(); ++volume) {
    const IndexBox& inside = o.budgets.volumes->inside(volume);
    IntVec3 cell = row.cell();
    cell[along] = inside.lower[along];
    if (!inside.contains(cell)) continue;
    const int from = std::max(low, inside.lower[along]), to = std::min(high, inside.upper[along]);
    for_uncovered(row, o, from - low, to - low,
                  [&](int first, int end) { account_forces(row, h, o, volume, first, end); });
  }
}

}  // namespace

void add_volume_budget(TaskList& list, const BudgetInput& v, const SchemeOptions& o, int effect) {
  if (o.budgets.volumes == nullptr || o.budgets.volumes->count() == 0) return;
  static const char* names[] = {"control volumes, axis 0", "control volumes, axis 1",
                                "control volumes, axis 2"};
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    TaskBuilder task = list.task(names[axis], effect);
    const FaceFluxHandles h = read_face_fluxes(task, v.faces, o, axis);
    task.always().only_in([volumes = o.budgets.volumes, axis](int box, const IndexBox& block) {
      return volumes->cells_with_faces(box, axis, block);
    });
    task.kernel([=](const Row& row) { account_faces(row, h, o, axis); });
  }
  if (!o.forces.on) return;
  TaskBuilder task = list.task("control volumes, gravity", effect);
  Handles h;
  h.rho = task.read(v.cells.rho);
  h.momentum = task.read(v.cells.momentum);
  h.impulse = task.read(v.cells.impulse);
  task.always().kernel([=](const Row& row) { account_inside(row, h, o); });
}

}  // namespace sluice::ice
