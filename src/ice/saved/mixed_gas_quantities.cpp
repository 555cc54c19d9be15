#include "ice/saved/mixed_gas_quantities.hpp"

#include <cmath>

#include "ice/step/mixed_fraction.hpp"

namespace sluice::ice {

using models::MixedGas;

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

}  // namespace sluice::ice
