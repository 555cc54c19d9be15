// The pressure of a metal.
#include "mpm/material/metal/metal_pressure.hpp"

#include <cmath>

#include "mpm/material/base/batch_math.hpp"
#include "mpm/material/base/metal_parts.hpp"

namespace sluice::mpm {

MetalPressure::Result MetalPressure::operator()(const Step& s) const {
  switch (form) {
    case Form::hypo: {
      const double warmed = 3 * expansion * (s.temperature - s.old_temperature);
      return {s.p_0 - K * (std::log(s.J_1 / s.J_0) - warmed), K};
    }
    case Form::hyper: {
      const double J_T = thermal_volume(expansion, s.temperature, s.old_temperature);
      return {-0.5 * K * (s.J_1 - 1 / s.J_1 - (J_T - 1 / J_T)), 0.5 * K * (s.J_1 + 1 / s.J_1)};
    }
    case Form::mie_gruneisen:
      break;
  }
  const double eta = 1 - s.J_1, growth = s.J_1 - s.J_0;
  double cold = stiffness * eta, slope = stiffness;  // and d cold/d eta
  if (eta > 0) {
    const double d = 1 - eta * (S_1 + eta * (S_2 + eta * S_3));
    if (!(d > 0)) return {0, 0, false};
    const double d_slope = -(S_1 + eta * (2 * S_2 + eta * 3 * S_3));
    const double n = eta * (1 - 0.5 * Gamma_0 * eta);
    cold = stiffness * n / (d * d);
    slope = stiffness * ((1 - Gamma_0 * eta) / (d * d) - 2 * n * d_slope / (d * d * d));
  }
  const double p =
      (cold + Gamma_0 * (s.E_0 + s.work - 0.5 * s.p_0 * growth)) / (1 + 0.5 * Gamma_0 * growth);
  return {p, s.J_1 * (slope + Gamma_0 * p)};
}

namespace {

const std::vector<Part>& parts() {
  static const std::vector<Part> list = {
      {"default_hypo", {tag("bulk_modulus", "Pa; absent: that of the model").real().above(0)}},
      {"default_hyper", {tag("bulk_modulus", "Pa; absent: that of the model").real().above(0)}},
      {"mie_gruneisen",
       {positive("C_0", "sound speed of weak shocks, m/s"),
        tag("Gamma_0", "Grueneisen coefficient").once().real().at_least(0),
        tag("S_alpha", "slope of shock speed against particle speed").once().real().at_least(0),
        number("S_2", "second coefficient of the shock speed", 0),
        number("S_3", "third coefficient of the shock speed", 0)}}};
  return list;
}
const std::vector<std::string> not_supported = {"mie_gruneisen_energy"};

}  // namespace

TagSpec metal_pressure_tag() {
  return submodel_tag("equation_of_state", "model of the pressure", parts(), not_supported);
}

MetalPressure read_metal_pressure(const Parameters& model, double K) {
  MetalPressure pressure;
  pressure.K = K;
  const ChosenSubmodel chosen = choose_submodel(model, "equation_of_state", parts(), not_supported);
  if (chosen.index < 0) return pressure;
  const Parameters p = inside_submodel(model, "equation_of_state", parts()[chosen.index]);
  if (!p.good()) return pressure;
  pressure.form = static_cast<MetalPressure::Form>(chosen.index);
  if (pressure.form != MetalPressure::Form::mie_gruneisen) {
    if (p.has("bulk_modulus")) pressure.K = p.real("bulk_modulus");
    return pressure;
  }
  pressure.stiffness = model.constants().density * p.real("C_0") * p.real("C_0");
  pressure.Gamma_0 = p.real("Gamma_0");
  pressure.S_1 = p.real("S_alpha");
  pressure.S_2 = p.real("S_2");
  pressure.S_3 = p.real("S_3");
  return pressure;
}

}  // namespace sluice::mpm
