// Steps i5 and i6 where several materials may meet.
//
//   p_L = sum(V_m p_mL/K_mL)/sum(V_m/K_mL),   p_mL = p(M_m/(V_m J), E_mL/(V_m J))
// is the pressure at which the materials of a cell agree after the Lagrangian phase, to first order
// in what they disagree by. Where one material is alone it is that of its law; so is that of the
// new state, which elsewhere is the one pressure at which the step ended.
//
// Cells that solids cut (cut_cells/materials.hpp; V fluid's volume in the cell) hold M_m V and E_mL
// in V_m V_L, or what they had where they give that (step/walled_donors.hpp); X - p of them follows
// when their state does, behind the sweep.
#include <cmath>

#include "ice/pressure/end_of_mixture.hpp"
#include "ice/step/laws_of_cells.hpp"
#include "ice/step/material_runs.hpp"

namespace sluice::ice::pressure {
namespace {

struct Cut {
  bool any = false;
  In cells, fraction, volume_L, energy_L, gives_old;
};

struct Handles {
  mixture::StateReads state;
  In pure, rho_L, energy_L, specific_energy_L, stretch;
  In strain;  // where the materials of a cell relax before the remap
  Cut cut;
  LawsOfCells laws;
  Out p, scratch;
};

Cut read_touched(TaskBuilder& task, const EndOfMixtureInput& v, const SchemeOptions& o) {
  Cut t;
  t.any = o.grid.has_cut_cells;
  if (!t.any) return t;
  t.cells = task.read(v.cut);
  t.fraction = task.read(v.error.fraction);
  t.volume_L = task.read(v.cut_volume);
  t.energy_L = task.read(v.cut_energy);
  t.gives_old = task.read(v.error.gives_old);
  return t;
}

// Density and energy of a material per its own volume, after the Lagrangian phase.
class OwnState {
 public:
  OwnState(const Row& row, const Handles& h, std::size_t m)
      : M_(row(h.state.mass[m])),
        V_(row(h.state.volume[m])),
        E_(row(h.state.energy[m])),
        J_(row(h.stretch, 0)),
        of_volume_(row(h.specific_energy_L, static_cast<int>(m))) {
    if (h.strain.index >= 0) iJ_ = row(h.strain, static_cast<int>(h.state.mass.size() + m));
    const Cut& t = h.cut;
    if (!t.any) return;
    touched_ = row(t.cells);
    theta_ = row(t.fraction);
    V_L_ = row(t.volume_L);
    E_L_ = row(t.energy_L, static_cast<int>(m));
    gives_old_ = row(t.gives_old);
  }
  void find(int i, double& rho, double& e) const {
    if (touched_ != nullptr && touched_[i] != 0) return beside_solids(i, rho, e);
    rho = iJ_ != nullptr ? M_[i] / V_[i] * iJ_[i] : M_[i] / (V_[i] * J_[i]);
    e = of_volume_[i];
  }

 private:
  void beside_solids(int i, double& rho, double& e) const {
    const double V = 1.0 - theta_[i];
    const bool moved = gives_old_[i] == 0;
    rho = moved ? M_[i] * V / (V_[i] * V_L_[i]) : M_[i] / V_[i];
    e = moved ? E_L_[i] / (V_[i] * V_L_[i]) : E_[i] / V_[i];
  }

  const double *M_, *V_, *E_, *J_, *of_volume_, *iJ_ = nullptr;
  const double *touched_ = nullptr, *theta_ = nullptr, *V_L_ = nullptr, *E_L_ = nullptr,
               *gives_old_ = nullptr;
};

// Cells of one material alone.
void alone(const Row& row, const Handles& h, std::size_t m) {
  h.laws.of(row, m).pressure(row.count(), row(h.rho_L), row(h.energy_L), row(h.p));
}

// Several, or near others.
void mixed(const Row& row, const Handles& h, std::size_t materials) {
  const int n = row.count();
  double *rho = row(h.scratch, 0), *e = row(h.scratch, 1), *pm = row(h.scratch, 2),
         *Km = row(h.scratch, 3), *sum = row(h.scratch, 4);
  double* p = row(h.p);
  std::fill_n(sum, n, 0.0);
  std::fill_n(p, n, 0.0);
  for (std::size_t m = 0; m < materials; ++m) {
    const double *M = row(h.state.mass[m]), *V = row(h.state.volume[m]);
    const OwnState own(row, h, m);
    for (int i = 0; i < n; ++i) {
      if (!(M[i] > 0.0)) continue;
      own.find(i, rho[i], e[i]);
      h.laws.of(row.part(i, 1), m).pressure_and_modulus(1, rho + i, e + i, pm + i, Km + i);
      const double softness = V[i] / Km[i];
      p[i] += softness * pm[i];
      sum[i] += softness;
    }
  }
  for (int i = 0; i < n; ++i) p[i] /= sum[i];
}

VariableId add_lagrangian_pressure(TaskList& list, const EndOfMixtureInput& v,
                                   const SchemeOptions& o, int effect) {
  const VariableId p_L = list.temporary("Lagrangian pressure");
  TaskBuilder task = list.task("Lagrangian pressure", effect);
  Handles h;
  h.state = mixture::read_state(task, v.state);
  h.pure = task.read(v.pure);
  h.rho_L = task.read(v.rho_L);
  h.energy_L = task.read(v.energy_L);
  h.specific_energy_L = task.read(v.specific_energy_L);
  h.stretch = task.read(v.stretch);
  if (mixture::relaxes_before_remap(o)) h.strain = task.read(v.strain);
  h.cut = read_touched(task, v, o);
  h.laws = LawsOfCells(task, list, o);
  h.p = task.write(p_L);
  h.scratch = task.write(list.temporary("closure after the Lagrangian phase", 5));
  task.kernel([=, materials = o.materials.fluids.size()](const Row& row) {
    for_each_run(runs_of(row, h.pure), row.count(), [&](int first, int count, double pure) {
      const Row part = row.part(first, count);
      pure >= 0.0 ? alone(part, h, static_cast<std::size_t>(pure)) : mixed(part, h, materials);
    });
  });
  return p_L;
}

VariableId add_new_pressure(TaskList& list, const EndOfMixtureInput& v, const SchemeOptions& o,
                            int effect) {
  const VariableId p_new = list.temporary("pressure of the new state");
  TaskBuilder task = list.task("pressure of the new state", effect);
  std::vector<In> mass, energy;
  for (std::size_t m = 0; m < o.materials.fluids.size(); ++m) {
    mass.push_back(task.read(v.mass_new[m]));
    energy.push_back(task.read(v.energy_new[m]));
  }
  const In pure_in = task.read(v.pure), closed = task.read(v.new_pressure);
  const Cut cut = read_touched(task, v, o);
  const Out out = task.write(p_new);
  const LawsOfCells laws(task, list, o, LawsOfCells::When::new_state);
  task.kernel([=](const Row& row) {
    const auto find = [&](int first, int count, double pure) {
      const Row part = row.part(first, count);
      if (pure < 0.0) {
        std::copy_n(part(closed), count, part(out));
        return;
      }
      const auto m = static_cast<std::size_t>(pure);
      laws.of(part, m).pressure(count, part(mass[m]), part(energy[m]), part(out));
    };
    if (cut.any) std::fill_n(row(out), row.count(), 0.0);
    for_each_run(runs_of(row, pure_in), row.count(), [&](int from, int number, double pure) {
      if (!cut.any) return find(from, number, pure);
      for_each_full(row(cut.cells), from, number,
                    [&](int first, int count) { find(first, count, pure); });
    });
  });
  return p_new;
}

}  // namespace

void add_end_of_mixture(TaskList& list, const EndOfMixtureInput& v, const SchemeOptions& o,
                        int effect) {
  const VariableId p_L = add_lagrangian_pressure(list, v, o, effect);
  if (o.grid.has_cut_cells)
    add_cut_cell_error(list, v.error, o, p_L, effect);
  else
    add_volume_error(list, v.error.error, o, p_L, effect);
  add_offset(list, v.error.error.solve, add_new_pressure(list, v, o, effect), effect);
}

}  // namespace sluice::ice::pressure
