// Start profiles and labels of transported scalars.
#include "models/scalars/transported_scalar.hpp"

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
  if (line) return line->at(point);
  const auto last = std::find_if(start.rbegin(), start.rend(),
                                 [&](const ScalarRegion& r) { return r.piece->inside(point); });
  return last == start.rend() ? everywhere : last->at(point);
}

void TransportedScalar::declare_labels() const {
  value();
  gradient();
  total();
  if (plain_name) return;
  source();
  if (decay.any) coefficient();
  if (spreads_by_law) diffusion();
}

std::vector<std::string> labels_of(const TransportedScalar& s) {
  const std::string name = s.variable();
  std::vector<std::string> labels = {name, "mag_grad_" + name, "totalSum_" + name};
  if (!s.plain_name) labels.push_back((s.of_species ? "scalar_" + s.name : name) + "_src");
  if (s.decay.any) labels.push_back(name + "_expDecayCoef");
  if (s.spreads_by_law) labels.push_back("diffCoef-" + s.name);
  return labels;
}

Label TransportedScalar::state() const {
  return declare_label(
      {"state." + variable(), ValueType::real, Centring::cell, plain_name ? "J/kg" : "1",
       plain_name ? "State: the heat of mixing released so far, per mass."
                  : "State: the scalar " + name + ", an amount per mass of its material."});
}

Label TransportedScalar::value() const {
  return declare_label({variable(), ValueType::real, Centring::cell, plain_name ? "J/kg" : "1",
                        plain_name ? "The heat of mixing that this mass has released so far."
                                   : "The transported scalar " + name + ", an amount per mass."});
}

Label TransportedScalar::gradient() const {
  return declare_label({"mag_grad_" + variable(), ValueType::real, Centring::cell,
                        plain_name ? "J/(kg m)" : "1/m",
                        plain_name ? "Magnitude of the gradient of the released heat of mixing."
                                   : "Magnitude of the gradient of the scalar " + name + "."});
}

Label TransportedScalar::source() const {
  if (of_species)
    return declare_label({"scalar_" + name + "_src", ValueType::real, Centring::cell, "1",
                          "What reactions add to the mass fraction " + name + " in a step."});
  return declare_label({variable() + "_src", ValueType::real, Centring::cell, "1",
                        "What diffusion, growth, decay and sources add to the scalar " + name +
                            " of a cell's mass in a step."});
}

Label TransportedScalar::diffusion() const {
  return declare_label({"diffCoef-" + name, ValueType::real, Centring::cell, "m^2/s",
                        "Diffusivity of the mass fraction " + name + " in the mixture."});
}

Label TransportedScalar::coefficient() const {
  return declare_label({variable() + "_expDecayCoef", ValueType::real, Centring::cell, "1",
                        "Coefficient c2 of the decay of the scalar " + name + "."});
}

Label TransportedScalar::total() const {
  return declare_label(
      {"totalSum_" + variable(), ValueType::real, Centring::reduction, plain_name ? "J" : "kg",
       plain_name ? "The heat of mixing that the mass in the domain has released so far."
                  : "Sum of the scalar " + name + " times mass over the domain."});
}

}  // namespace sluice::models
