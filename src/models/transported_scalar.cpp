// Start profiles and labels of transported scalars.
#include "models/transported_scalar.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sluice::models {
namespace {

// exp(-1/(x (1 - x))), all derivatives of which vanish at the ends.
double bell(double x) {
  const double room = x * (1.0 - x);
  return room > 0 ? std::exp(-1.0 / room) : 0.0;
}

double along(ScalarProfile profile, double weight, double x) {
  const double y = std::min(x, 1.0 - x);
  switch (profile) {
    case ScalarProfile::linear:
      return weight * x;
    case ScalarProfile::sinusoidal:
      return std::sin(2.0 * std::numbers::pi * weight * x);
    case ScalarProfile::triangular:
      return weight * y;
    case ScalarProfile::quadratic:
      return weight * x * (x - 1.0);
    case ScalarProfile::cubic:
      return weight * y * y * (1.0 - 4.0 / 3.0 * y);
    default:
      return weight * bell(x);
  }
}

}  // namespace

double ScalarRegion::at(Vec3 point) const {
  if (profile == ScalarProfile::constant) return value;
  const Bounds box = piece->bounds();
  double part[3] = {0, 0, 0};
  for (int d = 0; d < 3; ++d) {
    if (weight[d] == 0) continue;
    part[d] = along(profile, weight[d], (point[d] - box.lower[d]) / (box.upper[d] - box.lower[d]));
  }
  if (profile == ScalarProfile::exponential_2d) return part[0] * part[1];
  return (part[0] + part[1]) + part[2];
}

double TransportedScalar::at_start(Vec3 point) const {
  const auto last = std::find_if(start.rbegin(), start.rend(),
                                 [&](const ScalarRegion& r) { return r.piece->inside(point); });
  return last == start.rend() ? 0.0 : last->at(point);
}

void TransportedScalar::declare_labels() const {
  value();
  gradient();
  total();
}

Label TransportedScalar::state() const {
  return declare_label({"state.scalar-" + name, ValueType::real, Centring::cell, "1",
                        "State: the scalar " + name + ", an amount per mass of its material."});
}

Label TransportedScalar::value() const {
  return declare_label({"scalar-" + name, ValueType::real, Centring::cell, "1",
                        "The transported scalar " + name + ", an amount per mass."});
}

Label TransportedScalar::gradient() const {
  return declare_label({"mag_grad_scalar-" + name, ValueType::real, Centring::cell, "1/m",
                        "Magnitude of the gradient of the scalar " + name + "."});
}

Label TransportedScalar::total() const {
  return declare_label({"totalSum_scalar-" + name, ValueType::real, Centring::reduction, "kg",
                        "Sum of the scalar " + name + " times mass over the domain."});
}

}  // namespace sluice::models
