// delP_MassX: how the pressure answers to what models add, to first order in that.
//
//   dp = sum (1/K_m) [p_r (dM_m - rho_m dV_m) + (p_e/rho_m) (dE_m - e_m dM_m)] / sum V_m/K_m
// with the slopes of p_m(rho, e) and the moduli K_m of the new state; dM, dV, dE: mass, volume and
// energy that a material is given. One material: V = 1, its modulus cancels; of a gas whose
// properties are mixed dp = (gamma - 1) dE.
#include <algorithm>

#include "ice/fluid/labels.hpp"
#include "ice/outputs/step_labels.hpp"
#include "ice/sources/source_tasks.hpp"
#include "ice/step/laws_of_cells.hpp"

namespace sluice::ice {
namespace {

struct MaterialRows {
  In mass, volume, energy;
};

// What a material is given, and its new state; all per volume of the cell.
struct Given {
  double M, V, E, dM, dV, dE;
};

// K_m and the square bracket above.
struct Answer {
  double modulus, pressed;
};
Answer answer(const Fluid& fluid, const Given& g) {
  const double rho = g.M / g.V, rho_e = g.E / g.V, e = g.E / g.M;
  const auto slopes = std::visit(
      [&](const auto& law) {
        return std::pair{law.dp_drho(rho, rho_e), law.dp_de(rho, rho_e)};
      },
      fluid.law);
  return {fluid.modulus_of_state(rho, rho_e),
          slopes.first * (g.dM - rho * g.dV) + slopes.second / rho * (g.dE - e * g.dM)};
}

void answer_of_mixture(const Row& row, const std::vector<MaterialRows>& state, In change,
                       const SourceChange& layout, const LawsOfCells& laws, double* dp) {
  Fluid room;
  using C = SourceChange;
  for (int i = 0; i < row.count(); ++i) {
    double pressed = 0, compliance = 0;
    for (std::size_t m = 0; m < state.size(); ++m) {
      const double M = row(state[m].mass)[i];
      if (M == 0.0) continue;
      const auto of = [&](C::OfMaterial what) {
        return row(change, layout.of(static_cast<int>(m), what))[i];
      };
      const double V = row(state[m].volume)[i];
      const Answer a = answer(laws.at(row, m, i, room), {M, V, row(state[m].energy)[i], of(C::mass),
                                                         of(C::volume), of(C::energy)});
      pressed += a.pressed / a.modulus;
      compliance += V / a.modulus;
    }
    dp[i] = pressed / compliance;
  }
}

}  // namespace

void declare_source_pressure(TaskList& list, const OutputInput& v, const SchemeOptions& o,
                             const MaterialsOfStep& materials, int effect) {
  TaskBuilder task = list.task("save " + labels().source_pressure.name(), effect);
  const Out out = task.write(list.output(labels().source_pressure, 0));
  if (o.forces.sources == nullptr) {
    static_cast<void>(task.read(v.rho));  // a task must read something
    task.kernel([=](const Row& row) { std::fill_n(row(out), row.count(), 0.0); });
    return;
  }
  const In change = task.read(v.source_change);
  const LawsOfCells laws(task, list, o, LawsOfCells::When::new_state);
  const SourceChange layout = source_change(o);
  if (o.materials.mixture) {
    std::vector<MaterialRows> state;
    for (const MaterialOfStep& m : materials.each)
      state.push_back({task.read(m.mass_new), task.read(m.volume_new), task.read(m.energy_new)});
    task.kernel(
        [=](const Row& row) { answer_of_mixture(row, state, change, layout, laws, row(out)); });
    return;
  }
  const In rho = task.read(v.after.rho), energy = task.read(v.after.energy);
  task.kernel([=, fluid = o.materials.fluid](const Row& row) {
    const double* dM = row(change, layout.of(0, SourceChange::mass));
    const double* dE = row(change, layout.of(0, SourceChange::energy));
    double* dp = row(out);
    // The pressure of such a gas is its energy times a number.
    if (!laws.all_plain()) return laws.of_one(row).pressure(row.count(), row(rho), dE, dp);
    for (int i = 0; i < row.count(); ++i)
      dp[i] = answer(fluid, {row(rho)[i], 1.0, row(energy)[i], dM[i], 0.0, dE[i]}).pressed;
  });
}

}  // namespace sluice::ice
