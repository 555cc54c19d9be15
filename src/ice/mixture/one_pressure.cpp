// The end of step 9 beside a gas that is a mixture: one pressure, once its new fraction is known.
//
// The state after the remap becomes the new one; in each cell the gas has the gamma and c_v of its
// new fraction there, in the relaxation of pressures and in heat exchange. Absent where no material
// is a mixture: then the update itself ends the step.
#include <algorithm>
#include <optional>

#include "ice/closure/cell_closure.hpp"
#include "ice/mixture/diffusion_rates.hpp"
#include "ice/mixture/tasks.hpp"
#include "ice/mixture/update_state.hpp"
#include "ice/step/laws_of_cells.hpp"
#include "ice/step/material_runs.hpp"

namespace sluice::ice::mixture {
namespace {

// What the remap leaves.
struct Remapped {
  In momentum;
  std::vector<In> mass, volume, energy;
};

struct Handles {
  UpdateState end;  // the new state
  Remapped remapped;
  LawsOfCells laws;  // of the new state
};

Handles declare(TaskBuilder& task, TaskList& list, const OnePressureInput& v,
                const SchemeOptions& o) {
  Handles h;
  UpdateState& end = h.end;
  end.common = read_end_of_step(task, v.end, o);
  end.common.energy_scale = task.read(v.energy_scale);
  end.pure = task.read(v.pure);
  h.remapped.momentum = task.read(v.momentum_remap);
  for (std::size_t m = 0; m < o.materials.fluids.size(); ++m) {
    h.remapped.mass.push_back(task.read(v.remapped.mass[m]));
    h.remapped.volume.push_back(task.read(v.remapped.volume[m]));
    h.remapped.energy.push_back(task.read(v.remapped.energy[m]));
    MaterialState s;
    s.mass_new = task.write(v.next.mass[m]);
    s.volume_new = task.write(v.next.volume[m]);
    s.energy_new = task.write(v.next.energy[m]);
    end.state.push_back(s);
  }
  end.common.next.momentum = task.write(v.momentum_new);
  end.end = task.write(v.density_new);
  end.common.next.rho = end.end;
  end.pressure = task.write(v.new_pressure);
  end.closure = task.write(v.closure);
  h.laws = LawsOfCells(task, list, o, LawsOfCells::When::new_state);
  return h;
}

// The state, and the density of all.
void copy_state(const Row& row, const Handles& h, int components) {
  const int n = row.count();
  const auto copy = [n](const double* from, double* to) { std::copy_n(from, n, to); };
  for (int c = 0; c < components; ++c)
    copy(row(h.remapped.momentum, c), row(h.end.common.next.momentum, c));
  double* __restrict density = row(h.end.end, 0);
  std::fill_n(density, n, 0.0);
  for (std::size_t m = 0; m < h.end.state.size(); ++m) {
    const MaterialState& s = h.end.state[m];
    copy(row(h.remapped.mass[m]), row(s.mass_new));
    copy(row(h.remapped.volume[m]), row(s.volume_new));
    copy(row(h.remapped.energy[m]), row(s.energy_new));
    const double* __restrict M = row(s.mass_new);
    for (int i = 0; i < n; ++i) density[i] += M[i];
  }
}

// Rows where material m is alone. Rates take the largest gamma of a mixed gas, here as in its own
// graph.
void close_alone(const Row& row, const Handles& h, const SchemeOptions& o, std::size_t m) {
  const UpdateHandles u = handles_of(h.end, static_cast<int>(m));
  check_row(row, u, o, static_cast<int>(m));
  end_alone(row, h.end, u, o.materials.fluid);
  if (h.laws.plain(m)) return;
  const double *rho = row(u.next.rho), *E = row(u.next.energy);
  h.laws.of(row, m).pressure(row.count(), rho, E, row(h.end.pressure));
}

// Of a cell at the edge of others, which holds the mixed gas alone: likewise.
void set_rate_of_gas(const Row& row, const UpdateState& h, const SchemeOptions& o, int i) {
  const std::size_t gas = o.materials.mixed->material;
  for (std::size_t m = 0; m < h.state.size(); ++m)
    if (m != gas && row(h.state[m].mass_new)[i] != 0.0) return;
  const eos::IdealGas& law = *o.materials.fluids[gas].gamma_law();
  const MaterialState& s = h.state[gas];
  row(h.end, 1)[i] = law.gamma * law.pressure(row(s.mass_new)[i], row(s.energy_new)[i]);
}

// Can sources have brought others into cells that held material m alone.
bool may_hold_others(const Row& row, const SchemeOptions& o, int m) {
  return o.forces.sources != nullptr && o.forces.sources->takes_from(m, row.step());
}

}  // namespace

void add_one_pressure(TaskList& list, const OnePressureInput& v, const SchemeOptions& o,
                      int effect) {
  if (o.materials.mixed == nullptr) return;
  TaskBuilder task = list.task("one pressure", effect);
  const Handles h = declare(task, list, v, o);
  const std::vector<SchemeOptions> of_material = options_of_materials(o);
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=,
                 closure = CellClosure(o.materials.fluids, o.materials.heat_exchange,
                                       o.materials.multi_velocity_exchange),
                 diffusion = DiffusionRates(o)](const Row& row) {
      mark_alone(row, -1);  // the whole state is written
      copy_state(row, h, C);
      std::optional<ClosingCells> cells;
      std::optional<CellClosure> laws;
      for_each_run(runs_of(row, h.end.pure), row.count(), [&](int first, int count, double pure) {
        const int m = static_cast<int>(pure);
        if (pure >= 0.0 && !may_hold_others(row, o, m))
          return close_alone(row.part(first, count), h, of_material[m], m);
        if (!cells) {
          cells.emplace(row, h.end, o);
          laws.emplace(closure);
        }
        for (int i = first; i < first + count; ++i) {
          h.laws.set(*laws, row, i);
          cells->close(i, *laws);
          set_rate_of_gas(row, h.end, o, i);
        }
      });
      rates_of_mixture<D>(row, h.end.common.next, o, row(h.end.end, 1));
      if (diffusion.on()) diffusion_rates_of_row(row, h.end, diffusion);
    });
  });
}

}  // namespace sluice::ice::mixture
