// The end of the update in cells that solids touch, where fluids have one velocity:
// cut_cells/materials.hpp.
#pragma once
#include "ice/mixture/tasks.hpp"
#include "ice/mixture/update_state.hpp"

namespace sluice::ice::mixture {

inline void declare_cut_cells(TaskBuilder& task, const CutCellsInput& v, const SchemeOptions& o,
                              CutCells& t) {
  t.any = o.grid.has_cut_cells;
  if (!t.any) return;
  t.cells = task.read(v.cut);
  t.volume_L = task.read(v.cut_volume);
  t.energy_L = task.read(v.cut_energy);
  t.frame = task.read(v.velocity_L);
  t.gives_old = task.read(v.gives_old);
  t.before = task.read(v.fraction);
  t.next = task.read(v.next);
  t.old_momentum = task.read(v.old_momentum);
  for (const VariableId energy : v.energy) t.old_energy.push_back(task.read(energy));
  t.kinetic = task.write(v.fraction_new);
  for (int axis = 0; axis < o.grid.axes.count && o.materials.multi_velocity; ++axis) {
    t.velocity[axis] =
        task.read(v.material_velocity[axis], Stencil::along(o.grid.axes.direction[axis], 0, 1));
  }
}

// Touched cells hold the old state, while the row is looked at.
inline void hold_cut_cells(const Row& row, const UpdateState& h, const SchemeOptions& o) {
  const double* cells = row(h.cut.cells);
  for (int i = 0; i < row.count(); ++i) {
    if (cells[i] == 0) continue;
    double rho = 0;
    for (std::size_t m = 0; m < h.state.size(); ++m) {
      const double M = row(h.state[m].mass)[i];
      rho += M;
      row(h.state[m].mass_new)[i] = M;
      row(h.state[m].volume_new)[i] = row(h.state[m].volume)[i];
      row(h.state[m].energy_new)[i] = row(h.cut.old_energy[m])[i];
    }
    for (int c = 0; c < o.grid.components; ++c)
      row(h.common.next.momentum, c)[i] = row(h.cut.old_momentum, c)[i];
    row(h.end, 0)[i] = rho;
    row(h.end, 1)[i] = 0;  // no rate: who settles the cell has it
    row(h.pressure)[i] = 0;
  }
}

// What entered with velocities of its own: no slip is left, FM |U_m - U|^2/2 of each is its heat.
template <int D, int C>
void bind_what_enters(const Row& row, const UpdateState& h, int i) {
  for (std::size_t m = 0; m < h.state.size(); ++m) {
    const int of_material = static_cast<int>(m) * C;
    double heat = 0;
    for (int d = 0; d < D; ++d)
      for (int high = 0; high < 2; ++high) {
        const auto face = [&](In in, int c) { return row(in, c, d, high)[i]; };
        const double F = face(h.flux[d], component(static_cast<int>(m), of_mass));
        if (F == 0) continue;
        double squares[3] = {0, 0, 0};
        for (int c = 0; c < C; ++c) {
          const double apart =
              face(h.cut.velocity[d], of_material + c) - face(h.common.flux[d], 2 + c);
          squares[c] = apart * apart;
        }
        heat += (high == 0 ? 0.5 : -0.5) * F * ((squares[0] + squares[1]) + squares[2]);
      }
    row(h.state[m].energy_new)[i] += heat;
    for (int c = 0; c < C; ++c) row(h.slip_new[m], c)[i] = 0.0;
  }
}

// Amounts of touched cells: cut_cells/materials.hpp.
template <int D, int C>
void store_cut_cells(const Row& row, const UpdateState& h, const SchemeOptions& o) {
  const double *cells = row(h.cut.cells), *V_L = row(h.cut.volume_L);
  const double *before = row(h.cut.before), *next = row(h.cut.next);
  double* kinetic = row(h.cut.kinetic);
  for (int i = 0; i < row.count(); ++i) kinetic[i] = next[i];
  bool any = false;
  for (int i = 0; i < row.count(); ++i) any |= cells[i] != 0;
  if (!any) return;
  const double* gives_old = row(h.cut.gives_old);
  mark_alone(row, -1);
  const MotionRows<D, C> motion(row, h.common);
  for (int i = 0; i < row.count(); ++i) {
    if (cells[i] == 0) continue;
    double rho = 0;
    const double V = 1.0 - before[i];
    // Who gives its old state keeps it too: V_L may be anything then, but a volume is above zero.
    const double kept = gives_old[i] == 0 ? V_L[i] : V;
    for (int m = 0; m < static_cast<int>(h.state.size()); ++m) {
      const MaterialState& s = h.state[m];
      const auto gain = [&](Carried q) {
        double sum = 0;
        for (int d = 0; d < D; ++d) {
          const In f = h.flux[d];
          sum += row(f, component(m, q))[i] - row(f, component(m, q), d, 1)[i];
        }
        return sum;
      };
      const double M = row(s.mass)[i] * V + gain(of_mass);
      row(s.volume_new)[i] = row(s.volume)[i] * kept + gain(of_volume);
      row(s.energy_new)[i] = row(h.cut.energy_L, m)[i] + gain(of_energy);
      row(s.mass_new)[i] = M;
      rho += M;
    }
    if (!h.slip_new.empty()) bind_what_enters<D, C>(row, h, i);
    double rest = motion.heat(i, 0.0, 0.0, [](int) { return 0.0; });
    for (int c = 0; c < o.grid.components; ++c) {
      const double v = row(h.cut.frame, c)[i];
      rest += (row(h.common.next.momentum, c)[i] - 0.5 * rho * v) * v;
    }
    kinetic[i] = rest;
    if (o.forces.sources != nullptr) add_sources(row.part(i, 1), h, o, Motion::bound);
  }
}

// A row whose other cells have their new state.
template <int D, int C>
void end_step_next_to_solids(const Row& row, const UpdateState& h, const SchemeOptions& o,
                             const DiffusionRates& diffusion) {
  hold_cut_cells(row, h, o);
  rates_of_mixture<D>(row, h.common.next, o, row(h.end, 1));
  if (diffusion.on()) diffusion_rates_of_row(row, h, diffusion);
  store_cut_cells<D, C>(row, h, o);
}

}  // namespace sluice::ice::mixture
