// Labels that are functions of a state alone, as tasks that read it as old state.
#include "ice/saved/state_quantities.hpp"

#include <stdexcept>

#include "ice/fluid/closure_rows.hpp"
#include "ice/saved/criteria.hpp"
#include "ice/saved/mixed_gas_quantities.hpp"
#include "ice/saved/mixture_quantities.hpp"
#include "ice/saved/quantity_list.hpp"
#include "ice/saved/wave_labels.hpp"
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
  if (o.transport.molecular_varies()) {
    molecular = q.fresh(l.viscosity, 0);
    add_molecular_viscosity(task(l.viscosity), state, molecular);
  } else {
    molecular = constant(l.viscosity, o.viscosity);
  }
  if (o.transport.turbulence) {
    eddy = q.fresh(l.eddy_viscosity, 0);
    add_eddy_viscosity(task(l.eddy_viscosity), state, eddy);
    add_subgrid_stress({q.list(), o, effect_diagnostics, "compute the subgrid stress"}, state, eddy,
                       {q.fresh(l.subgrid_normal, 0), q.fresh(l.subgrid_shear, 0)});
  } else {
    eddy = constant(l.eddy_viscosity, 0.0);
  }
  q.of(molecular, eddy, l.total_viscosity, 0, [](double a, double b) { return a + b; });
}

// What one material makes of its state.
void declare_of_one(QuantityList& q) {
  const Labels& l = labels();
  const SchemeOptions& o = q.options();
  const Fluid fluid = o.fluid;
  const VariableId rho = q.list().old_state(l.mass, 0, 1), E = q.list().old_state(l.energy, 0, 1);
  for (const Label density : {l.rho, l.rho_micro, l.sum_rho}) q.add(density, 0, rho);
  const VariableId u = q.velocity(rho, q.list().old_state(l.momentum, 0, o.components));
  VariableId p, T, c, compressibility;
  if (o.mixed != nullptr) {
    const MixedQuantities b = declare_mixed_quantities(q, rho, E);
    p = b.pressure;
    T = b.temperature;
    c = b.sound_speed;
    compressibility = b.compressibility;
  } else {
    // Asked for by most criteria of refinement, at every look.
    p = q.of_rows(rho, E, l.pressure, 0,
                  [fluid](int n, const double* r, const double* e, double* pressure) {
                    pressure_row(fluid, n, r, e, pressure);
                  });
    T = q.of_rows(rho, E, l.temperature, 0,
                  [fluid](int n, const double* r, const double* e, double* temperature) {
                    temperature_row(fluid, n, r, e, temperature);
                  });
    c = q.of(rho, p, l.sound_speed, 0,
             [fluid](double r, double pressure) { return fluid.sound_speed(r, pressure); });
    compressibility = q.of(rho, p, l.compressibility, 0, [fluid](double r, double pressure) {
      const double speed = fluid.sound_speed(r, pressure);
      return 1.0 / (r * speed * speed);
    });
  }
  q.of(rho, p, l.specific_volume, 0, [](double r, double) { return 1.0 / r; });
  const auto constant = [&](Label label, double value) {
    q.of(rho, rho, label, 0, [value](double, double) { return value; });
  };
  q.add(l.compressibility_of_cell, 0, compressibility);
  constant(l.compressibility_share, 1.0);
  constant(l.volume_fraction, 1.0);
  constant(l.gradient_volume_fraction, 0.0);
  declare_viscosities(q, {rho, E, u, true});
  if (o.mixed == nullptr) {
    constant(l.thermal_conductivity, o.conductivity);
    constant(l.gamma, fluid.gamma);
    constant(l.specific_heat, fluid.specific_heat);
  }
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

}  // namespace

std::vector<DiagnosticQuantity> declare_quantities(TaskList& list, const SchemeOptions& options) {
  QuantityList quantities(list, options);
  if (options.fluids.size() > 1)
    mixture::declare_quantities(quantities);
  else
    declare_of_one(quantities);
  declare_amounts(quantities);
  for (const models::TransportedScalar& s : options.scalars) {
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
  add_refine_flag(list, quantities, o, criteria);
  add_error_estimates(list, quantities, o, estimates);
}

}  // namespace sluice::ice
