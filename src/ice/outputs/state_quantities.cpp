// Labels that are functions of a state alone, as tasks that read it as old state.
#include "ice/outputs/state_quantities.hpp"

#include <stdexcept>

#include "ice/outputs/criteria.hpp"
#include "ice/outputs/mixture_quantities.hpp"
#include "ice/outputs/quantity_list.hpp"
#include "ice/outputs/wave_labels.hpp"
#include "ice/step/laws_of_cells.hpp"
#include "ice/transport/species_transport.hpp"
#include "ice/transport/subgrid_stress.hpp"

namespace sluice::ice {
namespace {

// Molecular and subgrid viscosity, and their sum.
void declare_viscosities(QuantityList& q, const StateVariables& state) {
  const Labels& l = labels();
  const SchemeOptions& o = q.options();
  const auto constant = [&](Label label, double value) {
    return q.of(state.rho, state.rho, label, 0, [value](double, double) { return value; });
  };
  const auto task = [&](Label label) {
    return TransportTask{q.list(), o, effect_diagnostics, "compute " + label.name() + ": "};
  };
  VariableId molecular, eddy;
  if (o.transport.spreads_species) {
    molecular = q.fresh(l.viscosity, 0);
    add_species_coefficients(
        q.task(l.viscosity, 0), q.list(), o,
        {state.rho, state.energy, molecular, q.fresh(l.thermal_conductivity, 0), std::nullopt});
  } else if (o.transport.models.molecular_varies()) {
    molecular = q.fresh(l.viscosity, 0);
    add_molecular_viscosity(task(l.viscosity), state, molecular);
  } else {
    molecular = constant(l.viscosity, o.transport.viscosity);
  }
  if (o.transport.models.turbulence) {
    eddy = q.fresh(l.eddy_viscosity, 0);
    add_eddy_viscosity(task(l.eddy_viscosity), state, eddy);
    add_subgrid_stress({q.list(), o, effect_diagnostics, "compute the subgrid stress"}, state, eddy,
                       {q.fresh(l.subgrid_normal, 0), q.fresh(l.subgrid_shear, 0)});
  } else {
    eddy = constant(l.eddy_viscosity, 0.0);
  }
  q.of(molecular, eddy, l.total_viscosity, 0, [](double a, double b) { return a + b; });
}

// A row of the law from two cell variables.
VariableId law_variable(QuantityList& q, VariableId first, VariableId second, Label label,
                        void (LawRow::*rows)(int, const double*, const double*, double*) const) {
  const VariableId v = q.fresh(label, 0);
  TaskBuilder t = q.task(label, 0);
  const In a = t.read(first), b = t.read(second);
  const LawsOfCells laws(t, q.list(), q.options());
  const Out out = t.write(v);
  t.kernel(
      [=](const Row& row) { (laws.of_one(row).*rows)(row.count(), row(a), row(b), row(out)); });
  return v;
}

// f(law of the row, i). `any`: a variable of the cells; a task must read something.
template <class F>
void law_variable(QuantityList& q, VariableId any, Label label, F f) {
  const VariableId v = q.fresh(label, 0);
  TaskBuilder t = q.task(label, 0);
  static_cast<void>(t.read(any));
  const LawsOfCells laws(t, q.list(), q.options());
  const Out out = t.write(v);
  t.kernel([=](const Row& row) {
    const LawRow law = laws.of_one(row);
    double* to = row(out);
    for (int i = 0; i < row.count(); ++i) to[i] = f(law, i);
  });
}

// Specific heat at constant volume and ratio of specific heats at the state of each cell.
void declare_heats(QuantityList& q, VariableId rho, VariableId E) {
  law_variable(q, rho, E, labels().specific_heat, &LawRow::heat_capacity);
  law_variable(q, rho, E, labels().gamma, &LawRow::heat_capacity_ratio);
}

// What one material makes of its state.
void declare_of_one(QuantityList& q) {
  const Labels& l = labels();
  const SchemeOptions& o = q.options();
  const VariableId rho = q.list().old_state(l.mass, 0, 1), E = q.list().old_state(l.energy, 0, 1);
  for (const Label density : {l.rho, l.rho_micro, l.sum_rho}) q.add(density, 0, rho);
  const VariableId u = q.velocity(rho, q.list().old_state(l.momentum, 0, o.grid.components));
  // Pressure and temperature are asked for by most criteria of refinement, at every look.
  const VariableId p = law_variable(q, rho, E, l.pressure, &LawRow::pressure);
  const VariableId T = law_variable(q, rho, E, l.temperature, &LawRow::temperature);
  const VariableId c = law_variable(q, rho, p, l.sound_speed, &LawRow::sound_speed);
  const VariableId compressibility =
      law_variable(q, rho, p, l.compressibility, &LawRow::compressibility);
  q.of(rho, p, l.specific_volume, 0, [](double r, double) { return 1.0 / r; });
  const auto constant = [&](Label label, double value) {
    q.of(rho, rho, label, 0, [value](double, double) { return value; });
  };
  q.add(l.compressibility_of_cell, 0, compressibility);
  constant(l.compressibility_share, 1.0);
  constant(l.volume_fraction, 1.0);
  constant(l.gradient_volume_fraction, 0.0);
  declare_viscosities(q, {rho, E, u, true});
  if (!o.transport.spreads_species)
    law_variable(q, rho, l.thermal_conductivity,
                 [k = o.transport.conductivity](const LawRow& law, int i) {
                   return law.conductivity(i, k);
                 });
  declare_heats(q, rho, E);
  q.mach(u, c, 0);
  q.slopes(rho, l.gradient_rho, 0);
  q.slopes(T, l.gradient_temperature, 0);
  q.slopes(p, l.gradient_pressure, 0);
  q.slopes(u, l.divergence_velocity, 0, true);
  q.vorticity(u, 0);
  declare_wave_amplitudes(q, {rho, u, p, c});
}

void save(TaskList& list, const DiagnosticQuantity& q) {
  TaskBuilder task = list.task("save " + q.label.name(), effect_diagnostics);
  const In in = task.read(q.variable);
  const Out out = task.write(list.output(q.label, q.material));
  task.kernel([=, components = q.components](const Row& row) {
    for (int c = 0; c < components; ++c) {
      const double* __restrict from = row(in, c);
      double* __restrict to = row(out, c);
      const int n = row.count();
      for (int i = 0; i < n; ++i) to[i] = from[i];
    }
  });
}

// c2 of a scalar's decay.
void save_coefficient(TaskList& list, const models::TransportedScalar& s, const SchemeOptions& o) {
  TaskBuilder task = list.task("save " + s.coefficient().name(), effect_diagnostics);
  const In q = task.read(list.old_state(s.state(), s.material, 1));
  const Out out = task.write(list.output(s.coefficient(), s.material));
  task.kernel([=, decay = s.decay, level = *o.grid.level,
               along = o.grid.axes.direction[0]](const Row& row) {
    static_cast<void>(q);
    double* to = row(out);
    IntVec3 cell = row.cell();
    for (int i = 0; i < row.count(); ++i, ++cell[along])
      to[i] = decay.coefficient(level.centre(cell));
  });
}

}  // namespace

std::vector<DiagnosticQuantity> declare_quantities(TaskList& list, const SchemeOptions& options) {
  QuantityList quantities(list, options);
  if (options.materials.fluids.size() > 1)
    mixture::declare_quantities(quantities);
  else
    declare_of_one(quantities);
  declare_amounts(quantities);
  for (const models::TransportedScalar& s : options.materials.scalars) {
    const VariableId q = list.old_state(s.state(), s.material, 1);
    quantities.add(s.value(), s.material, q);
    quantities.slopes(q, s.gradient(), s.material);
  }
  return std::move(quantities).all();
}

const DiagnosticQuantity& quantity(const std::vector<DiagnosticQuantity>& quantities,
                                   const std::string& label, int material) {
  for (const DiagnosticQuantity& q : quantities)
    if (q.label.name() == label && q.material == material) return q;
  throw std::logic_error("criterion of refinement on " + label + " of material " +
                         std::to_string(material) + ": no such variable");
}

void declare_diagnostic_outputs(TaskList& list, const SchemeOptions& o,
                                const std::vector<RefinementCriterion>& criteria,
                                const std::vector<ErrorEstimate>& estimates) {
  const std::vector<DiagnosticQuantity> quantities = declare_quantities(list, o);
  for (const DiagnosticQuantity& q : quantities) save(list, q);
  for (const models::TransportedScalar& s : o.materials.scalars)
    if (s.decay.any && !s.plain_name) save_coefficient(list, s, o);
  add_refine_flag(list, quantities, o, criteria);
  add_error_estimates(list, quantities, o, estimates);
}

}  // namespace sluice::ice
