// Keeps what passes through the faces where levels meet, so that both agree on it afterwards.
//
// Conservative scheme: mass, momentum and total energy (face_flux.hpp); with several materials the
// mass of each, momentum, the energy and the volume of each, total energy. Then of each scalar its
// amount, mass times value and what spreads. Classic form: what it balances itself, mass, momentum
// and the internal energy that is advected. Absent with one level.
#include <array>
#include <optional>

#include "framework/refine/face_table.hpp"
#include "ice/budgets/face_flux.hpp"
#include "ice/budgets/tasks.hpp"

namespace sluice::ice {
namespace {

struct ScalarHandles {
  std::vector<int> place, carrier;  // by scalar of the scene; place -1: not in this graph
  In mass, face, spread;
};

ScalarHandles read_scalars(TaskBuilder& task, const ScalarVariables& s, const SchemeOptions& o,
                           int axis) {
  ScalarHandles h;
  h.place.assign(o.materials.scalars.size(), -1);
  h.carrier.assign(o.materials.scalars.size(), 0);
  if (s.each.empty()) return h;
  const Stencil both = Stencil::along(o.grid.axes.direction[axis], 0, 1);
  h.mass = task.read(s.carrier[axis], both);
  h.face = task.read(s.face[axis], both);
  if (s.diffusive) h.spread = task.read(s.spread[axis], both);
  for (std::size_t n = 0; n < s.each.size(); ++n) {
    const std::size_t index = s.each[n].index;
    h.place[index] = static_cast<int>(n);
    h.carrier[index] = s.each[n].carrier;
  }
  return h;
}

// The amount of a scalar that passes the low (shift 0) or high face of cell i.
double scalar_flux(const Row& row, const ScalarHandles& h, std::size_t scalar, int axis, int shift,
                   int i) {
  const int place = h.place[scalar];
  if (place < 0) return 0.0;
  const auto face = [&](In in, int c) { return row(in, c, axis, shift)[i]; };
  const double carried = face(h.mass, h.carrier[scalar]) * face(h.face, place);
  return h.spread.index < 0 ? carried : carried + face(h.spread, place);
}

// `rows`: of the faces of the segment, `next` cells on.
void record_segment(const Row& row, const FaceFluxRows& rows, int next, const FaceFluxHandles& h,
                    const ScalarHandles& scalars, const SchemeOptions& o, int axis,
                    const FaceTable::Segment& s, FaceTable& table) {
  const int start = s.first - row.cell()[o.grid.axes.direction[0]];
  const int shift = s.high ? 1 : 0;
  const int materials = static_cast<int>(o.materials.fluids.size());
  const auto value = [&](int q, int n) -> double& { return table.values(q)[s.slot + n]; };
  for (int n = 0; n < s.count; ++n) {
    const int i = start + n;
    const FaceFlux flux = rows(i + next);
    const int momentum = materials, energies = momentum + o.grid.components;
    const int apart = o.materials.multi_velocity ? materials * o.grid.components : 0;
    const int amounts = energies + (materials == 1 ? 1 : 2 * materials + 1 + apart);
    for (std::size_t k = 0; k < o.materials.scalars.size(); ++k)
      value(amounts + static_cast<int>(k), n) = scalar_flux(row, scalars, k, axis, shift, i);
    for (int c = 0; c < o.grid.components; ++c) value(momentum + c, n) = flux.momentum[c];
    if (materials == 1) {
      value(0, n) = flux.mass;
      value(energies, n) =
          o.scheme.internal_energy_form ? row(h.flux, 1, axis, shift)[i] : flux.energy;
      continue;
    }
    for (int m = 0; m < materials; ++m) {
      const MaterialFlux part = material_flux(row, h, o, axis, shift, i, m);
      value(m, n) = part.mass;
      value(energies + m, n) = part.energy;
      value(energies + materials + m, n) = part.volume;
    }
    value(energies + 2 * materials, n) = flux.energy;
    if (!o.materials.multi_velocity) continue;
    for (int m = 0; m < materials; ++m) {
      const MaterialFlux part = material_flux(row, h, o, axis, shift, i, m);
      for (int c = 0; c < o.grid.components; ++c)
        value(energies + 2 * materials + 1 + m * o.grid.components + c, n) = part.momentum[c];
    }
  }
}

void record_row(const Row& row, const FaceFluxHandles& h, const ScalarHandles& scalars,
                const SchemeOptions& o, int axis, FaceTable* table) {
  if (table == nullptr || table->empty()) return;
  std::array<std::optional<FaceFluxRows>, 2> rows;  // low and high ones
  for (const FaceTable::Segment& s : table->segments(row.box(), axis, row.cell())) {
    // A row is the part of a box's row that one block holds.
    const int low = row.cell()[o.grid.axes.direction[0]], high = low + row.count();
    FaceTable::Segment here = s;
    here.first = s.first > low ? s.first : low;
    here.count = (s.first + s.count < high ? s.first + s.count : high) - here.first;
    here.slot += here.first - s.first;
    if (here.count <= 0) continue;
    // Along the row the high face of a cell is the low one of the next.
    const int shift = s.high ? 1 : 0, next = axis == 0 ? shift : 0;
    auto& faces = rows[shift - next];
    if (!faces) faces.emplace(row, h, o, axis, shift - next);
    record_segment(row, *faces, next, h, scalars, o, axis, here, *table);
  }
}

// The cells of a block whose faces along an axis are recorded.
IndexBox recorded_cells(const FluxRecorder& recorder, int box, int axis, const IndexBox& block) {
  IndexBox all;
  for (const FaceTable* table : {recorder.as_coarse, recorder.as_fine}) {
    if (table == nullptr) continue;
    const IndexBox cells = table->cells_with_faces(box, axis, block);
    if (!cells.empty()) all = all.empty() ? cells : bounding(all, cells);
  }
  return all;
}

}  // namespace

void add_flux_record(TaskList& list, const BudgetInput& v, const SchemeOptions& o, int effect) {
  if (o.budgets.recorder == nullptr) return;
  static const char* names[] = {"flux record of axis 0", "flux record of axis 1",
                                "flux record of axis 2"};
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    TaskBuilder task = list.task(names[axis], effect);
    const FaceFluxHandles h = read_face_fluxes(task, v.faces, o, axis);
    const ScalarHandles scalars = read_scalars(task, v.scalars, o, axis);
    task.always().only_in([recorder = o.budgets.recorder, axis](int box, const IndexBox& block) {
      return recorded_cells(*recorder, box, axis, block);
    });
    task.kernel([=](const Row& row) {
      record_row(row, h, scalars, o, axis, o.budgets.recorder->as_coarse);
      record_row(row, h, scalars, o, axis, o.budgets.recorder->as_fine);
    });
  }
}

}  // namespace sluice::ice
