// Rows and labels of a gas whose properties follow from a scalar.
#include "ice/fluid/mixed_gas.hpp"

#include <algorithm>
#include <cmath>

#include "ice/saved/quantity_list.hpp"
#include "ice/transport/viscosity.hpp"
#include "models/transported_scalar.hpp"

namespace sluice::ice::scalars {

using models::MixedGas;

void take_mixed_gas(const MixedGas& gas, SchemeOptions& o) {
  o.mixed = &gas;
  o.releases_heat = !gas.released.empty();
  o.density_bound = DensityBound::as_energy;
  Fluid& fluid = o.fluids[static_cast<std::size_t>(gas.material)];
  fluid = ideal_gas(gas.highest_gamma(), gas.lowest_specific_heat());
  if (o.fluids.size() == 1) o.fluid = fluid;
  // What spreads of the fraction carries enthalpy.
  o.conducting = o.conducting || fraction_of(o).diffusivity > 0;
  const bool several = o.fluids.size() > 1;
  const bool conducts =
      several ? o.conductivities[static_cast<std::size_t>(gas.material)] > 0 : o.conducting;
  o.conductivity_varies = o.conductivity_varies || conducts;
}

const models::TransportedScalar& fraction_of(const SchemeOptions& o) {
  return *std::find_if(o.scalars.begin(), o.scalars.end(),
                       [&](const auto& s) { return s.name == o.mixed->fraction; });
}

VariableId old_fraction(TaskList& list, const SchemeOptions& o) {
  const models::TransportedScalar& f = fraction_of(o);
  return list.old_state(f.state(), f.material, 1);
}

void mixed_primitive_row(const MixedGas& gas, int n, const double* __restrict f,
                         const double* __restrict rho, const double* __restrict E,
                         double* __restrict w, double* __restrict p, double* __restrict c) {
  gas.for_row(n, f, [=](int i, const MixedGas::Between& at) {
    const double ratio = at.ratio();
    w[i] = 1.0 / rho[i];
    p[i] = ratio * E[i];
    c[i] = std::sqrt((1.0 + ratio) * p[i] * w[i]);
  });
}

void mixed_pressure_and_modulus_row(const MixedGas& gas, int n, const double* __restrict f,
                                    const double* __restrict E, double* __restrict p,
                                    double* __restrict K) {
  gas.for_row(n, f, [=](int i, const MixedGas::Between& at) {
    const double ratio = at.ratio();
    p[i] = ratio * E[i];
    K[i] = (1.0 + ratio) * p[i];
  });
}

void mixed_modulus_row(const MixedGas& gas, int n, const double* __restrict f,
                       const double* __restrict p, double* __restrict K) {
  gas.for_row(n, f, [=](int i, const MixedGas::Between& at) { K[i] = (1.0 + at.ratio()) * p[i]; });
}

void mixed_temperature_row(const MixedGas& gas, int n, const double* __restrict f,
                           const double* __restrict rho, const double* __restrict E,
                           double* __restrict T) {
  gas.for_row(n, f, [=](int i, const MixedGas::Between& at) {
    T[i] = E[i] / (rho[i] * at(&MixedGas::Node::cv));
  });
}

void mixed_viscosity_row(const MixedGas& gas, const MolecularViscosity& law, const Row& row,
                         const double* f, const double* rho, const double* E, double* mu) {
  const int n = row.count();
  if (law.models.sutherland) {
    mixed_temperature_row(gas, n, f, rho, E, mu);
    for (int i = 0; i < n; ++i) mu[i] = law.models.sutherland->viscosity(mu[i]);
  } else {
    property_row(gas, &MixedGas::Node::viscosity, n, f, mu);
  }
  law.take_sponges(row, mu);
}

void property_row(const MixedGas& gas, double MixedGas::Node::*property, int n,
                  const double* __restrict f, double* __restrict values) {
  gas.for_row(n, f, [=](int i, const MixedGas::Between& at) { values[i] = at(property); });
}

namespace {

// g of the gas at f, density and energy.
template <class G>
VariableId of_state(QuantityList& q, VariableId f, VariableId rho, VariableId E, Label label, G g) {
  const VariableId v = q.fresh(label, 0);
  TaskBuilder task = q.task(label, 0);
  const In a = task.read(f), b = task.read(rho), c = task.read(E);
  const Out out = task.write(v);
  task.kernel([=, gas = q.options().mixed](const Row& row) {
    const double *x = row(a), *y = row(b), *z = row(c);
    double* to = row(out);
    for (int i = 0; i < row.count(); ++i) to[i] = g(gas->at(x[i]), y[i], z[i]);
  });
  return v;
}

}  // namespace

MixedQuantities declare_mixed_quantities(QuantityList& q, VariableId rho, VariableId E) {
  using At = MixedGas::Between;
  const Labels& l = labels();
  const VariableId f = old_fraction(q.list(), q.options());
  const auto add = [&](Label label, auto g) { return of_state(q, f, rho, E, label, g); };
  MixedQuantities m;
  m.pressure = add(l.pressure, [](const At& at, double, double e) { return at.ratio() * e; });
  m.temperature = add(l.temperature, [](const At& at, double r, double e) {
    return e / (r * at(&MixedGas::Node::cv));
  });
  m.sound_speed = add(l.sound_speed, [](const At& at, double r, double e) {
    return std::sqrt((1.0 + at.ratio()) * (at.ratio() * e) / r);
  });
  m.compressibility = add(l.compressibility, [](const At& at, double, double e) {
    return 1.0 / ((1.0 + at.ratio()) * (at.ratio() * e));
  });
  add(l.gamma, [](const At& at, double, double) { return 1.0 + at.ratio(); });
  add(l.specific_heat, [](const At& at, double, double) { return at(&MixedGas::Node::cv); });
  add(l.thermal_conductivity,
      [](const At& at, double, double) { return at(&MixedGas::Node::conductivity); });
  return m;
}

}  // namespace sluice::ice::scalars
