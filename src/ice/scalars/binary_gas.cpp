// Rows and labels of a gas whose properties follow from a scalar.
#include "ice/scalars/binary_gas.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::ice::scalars {

const models::TransportedScalar& binary_scalar(const SchemeOptions& o) {
  return *std::find_if(o.scalars.begin(), o.scalars.end(),
                       [&](const auto& s) { return s.name == o.binary->scalar; });
}

void binary_primitive_row(const models::BinaryGas& gas, int n, const double* __restrict f,
                          const double* __restrict rho, const double* __restrict E,
                          double* __restrict w, double* __restrict p, double* __restrict c) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double ratio = gas.gas_constant(f[i]) / gas.specific_heat(f[i]);  // gamma - 1
    w[i] = 1.0 / rho[i];
    p[i] = ratio * E[i];
    c[i] = std::sqrt((1.0 + ratio) * p[i] * w[i]);
  }
}

namespace {

// g of f, density and energy.
template <class G>
VariableId of_state(QuantityList& q, VariableId f, VariableId rho, VariableId E, Label label, G g) {
  const VariableId v = q.fresh(label, 0);
  TaskBuilder task = q.task(label, 0);
  const In a = task.read(f), b = task.read(rho), c = task.read(E);
  const Out out = task.write(v);
  task.kernel([=](const Row& row) {
    const double *x = row(a), *y = row(b), *z = row(c);
    double* to = row(out);
    for (int i = 0; i < row.count(); ++i) to[i] = g(x[i], y[i], z[i]);
  });
  return v;
}

}  // namespace

BinaryQuantities declare_binary_quantities(QuantityList& q, VariableId rho, VariableId E) {
  const Labels& l = labels();
  const models::BinaryGas gas = *q.options().binary;
  const models::TransportedScalar& scalar = binary_scalar(q.options());
  const VariableId f = q.list().old_state(scalar.state(), scalar.material, 1);
  const auto pressure = [gas](double x, double e) { return (gas.gamma(x) - 1.0) * e; };
  BinaryQuantities b;
  b.pressure = of_state(q, f, rho, E, l.pressure,
                        [=](double x, double, double e) { return pressure(x, e); });
  b.temperature = of_state(q, f, rho, E, l.temperature, [gas](double x, double r, double e) {
    return e / (r * gas.specific_heat(x));
  });
  b.sound_speed = of_state(q, f, rho, E, l.sound_speed, [=](double x, double r, double e) {
    return std::sqrt(gas.gamma(x) * pressure(x, e) / r);
  });
  of_state(q, f, rho, E, l.compressibility,
           [=](double x, double, double e) { return 1.0 / (gas.gamma(x) * pressure(x, e)); });
  of_state(q, f, rho, E, l.gamma, [gas](double x, double, double) { return gas.gamma(x); });
  of_state(q, f, rho, E, l.specific_heat,
           [gas](double x, double, double) { return gas.specific_heat(x); });
  return b;
}

}  // namespace sluice::ice::scalars
