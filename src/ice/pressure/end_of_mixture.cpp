// Steps i5 and i6 where several materials may meet.
//
//   p_L = sum(V_m p_mL/K_mL)/sum(V_m/K_mL),   p_mL = p(M_m/(V_m J), E_mL/(V_m J))
// is the pressure at which the materials of a cell agree after the Lagrangian phase, to first order
// in what they disagree by. Where one material is alone it is that of its law; so is that of the
// new state, which elsewhere is the one pressure at which the step ended.
#include <cmath>

#include "ice/mixture/variables.hpp"
#include "ice/pressure/variables.hpp"
#include "ice/step/laws_of_cells.hpp"
#include "ice/step/material_runs.hpp"

namespace sluice::ice::pressure {
namespace {

struct Handles {
  mixture::StateReads state;
  In pure, rho_L, energy_L, specific_energy_L, stretch;
  LawsOfCells laws;
  Out p, scratch;
};

// Cells of one material alone.
void alone(const Row& row, const Handles& h, std::size_t m) {
  h.laws.of(row, m).pressure(row.count(), row(h.rho_L), row(h.energy_L), row(h.p));
}

// Several, or near others.
void mixed(const Row& row, const Handles& h, std::size_t materials) {
  const int n = row.count();
  const double* J = row(h.stretch, 0);
  double *rho = row(h.scratch, 0), *e = row(h.scratch, 1), *pm = row(h.scratch, 2),
         *Km = row(h.scratch, 3), *sum = row(h.scratch, 4);
  double* p = row(h.p);
  std::fill_n(sum, n, 0.0);
  std::fill_n(p, n, 0.0);
  for (std::size_t m = 0; m < materials; ++m) {
    const double *M = row(h.state.mass[m]), *V = row(h.state.volume[m]);
    const double* of_volume = row(h.specific_energy_L, static_cast<int>(m));
    for (int i = 0; i < n; ++i) {
      if (!(M[i] > 0.0)) continue;
      rho[i] = M[i] / (V[i] * J[i]);
      e[i] = of_volume[i];
      h.laws.of(row.part(i, 1), m).pressure_and_modulus(1, rho + i, e + i, pm + i, Km + i);
      const double softness = V[i] / Km[i];
      p[i] += softness * pm[i];
      sum[i] += softness;
    }
  }
  for (int i = 0; i < n; ++i) p[i] /= sum[i];
}

VariableId add_lagrangian_pressure(TaskList& list, const mixture::Variables& v,
                                   const SchemeOptions& o, int effect) {
  const VariableId p_L = list.temporary("Lagrangian pressure");
  TaskBuilder task = list.task("Lagrangian pressure", effect);
  Handles h;
  h.state = mixture::read_state(task, v);
  h.pure = task.read(v.pure);
  h.rho_L = task.read(v.common.rho_L);
  h.energy_L = task.read(v.common.energy_L);
  h.specific_energy_L = task.read(v.specific_energy_L);
  h.stretch = task.read(v.stretch);
  h.laws = LawsOfCells(task, list, o);
  h.p = task.write(p_L);
  h.scratch = task.write(list.temporary("closure after the Lagrangian phase", 5));
  task.kernel([=, materials = o.fluids.size()](const Row& row) {
    for_each_run(runs_of(row, h.pure), row.count(), [&](int first, int count, double pure) {
      const Row part = row.part(first, count);
      pure >= 0.0 ? alone(part, h, static_cast<std::size_t>(pure)) : mixed(part, h, materials);
    });
  });
  return p_L;
}

VariableId add_new_pressure(TaskList& list, const mixture::Variables& v, const SchemeOptions& o,
                            int effect) {
  const VariableId p_new = list.temporary("pressure of the new state");
  TaskBuilder task = list.task("pressure of the new state", effect);
  std::vector<In> mass, energy;
  for (std::size_t m = 0; m < o.fluids.size(); ++m) {
    mass.push_back(task.read(v.mass_new[m]));
    energy.push_back(task.read(v.energy_new[m]));
  }
  const In pure_in = task.read(v.pure), closed = task.read(v.common.new_pressure);
  const Out out = task.write(p_new);
  const LawsOfCells laws(task, list, o, LawsOfCells::When::new_state);
  task.kernel([=](const Row& row) {
    for_each_run(runs_of(row, pure_in), row.count(), [&](int first, int count, double pure) {
      const Row part = row.part(first, count);
      if (pure < 0.0) {
        std::copy_n(part(closed), count, part(out));
        return;
      }
      const auto m = static_cast<std::size_t>(pure);
      laws.of(part, m).pressure(count, part(mass[m]), part(energy[m]), part(out));
    });
  });
  return p_new;
}

}  // namespace

void add_end_of_mixture(TaskList& list, const mixture::Variables& v, const SchemeVariables& faces,
                        const SchemeOptions& o, int effect) {
  add_volume_error(list, faces, o, add_lagrangian_pressure(list, v, o, effect), effect);
  add_offset(list, faces, o, add_new_pressure(list, v, o, effect), effect);
}

}  // namespace sluice::ice::pressure
