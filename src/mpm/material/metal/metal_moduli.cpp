// Shear modulus, melting temperature and specific heat.
#include "mpm/material/metal/metal_moduli.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/material/base/metal_parts.hpp"

namespace sluice::mpm {
namespace {

constexpr double boltzmann = 1.380649e-23;         // J/K
constexpr double atomic_mass = 1.66053906660e-27;  // kg

double nadal_le_poac(const ShearModulus& m, const MetalState& s, double per_cube_root) {
  const double t = s.temperature / s.melt;
  if (t >= 1 + m.zeta) return 0;
  const double left = 1 - t;
  const double J = left == 0 ? 2 : 1 + std::exp(-(1 + 1 / m.zeta) / (1 + m.zeta / left));
  const double cold = (m.mu_0 + m.A * m.mu_0 * s.pressure * per_cube_root) * left;
  return (cold + s.density * boltzmann * s.temperature / (m.C * m.atom)) / J;
}

}  // namespace

double ShearModulus::operator()(const MetalState& s) const {
  const double per_cube_root =
      form == Form::constant || form == Form::mts ? 1 : 1 / std::cbrt(s.compression);
  double mu = mu_0;
  switch (form) {
    case Form::constant:
      return mu_0;
    case Form::mts:
      mu = mu_0 - D / (std::exp(T_0 / s.temperature) - 1);
      break;
    case Form::scg:
      mu = mu_0 * (1 + A * s.pressure * per_cube_root - B * (s.temperature - 300));
      break;
    case Form::np:
      mu = nadal_le_poac(*this, s, per_cube_root);
      break;
    case Form::ptw:
      mu = mu_0 * (1 + A * s.pressure * per_cube_root) * (1 - B * s.temperature / s.melt);
      break;
  }
  return std::max(mu, 1e-6 * mu_0);
}

double MeltingTemperature::operator()(const MetalState& s) const {
  switch (form) {
    case Form::constant:
      break;
    case Form::linear:
      return std::max(T_m0 + b * s.pressure, 1e-3 * T_m0);
    case Form::scg:
      return T_m0 * std::exp(2 * a * (1 - 1 / s.compression)) *
             std::pow(s.compression, 2 * (Gamma_0 - a - 1.0 / 3));
  }
  return T_m0;
}

double SpecificHeat::operator()(double T) const {
  switch (form) {
    case Form::constant:
      break;
    case Form::copper:
      return std::max(T < 270 ? ((4.16e-5 * T - 0.027) * T + 6.21) * T - 142.6 : 0.1009 * T + 358.4,
                      1.0);
    case Form::steel: {
      const double* c = T < T_c ? low : high;
      const double t = T / T_c - 1;
      // The peak at T_c is cut at half a per cent of T_c on either side.
      return c[0] + c[1] * t + c[2] * std::pow(std::max(std::abs(t), 5e-3), -c[3]);
    }
  }
  return value;
}

namespace {

const std::vector<Part>& shear_parts() {
  static const std::vector<Part> parts = {
      {"constant_shear", {tag("shear_modulus", "Pa; absent: that of the model").real().above(0)}},
      {"mts_shear",
       {positive("mu_0", "shear modulus at 0 K, Pa"),
        number("D", "coefficient of the decrease of the shear modulus with temperature, Pa"),
        positive("T_0", "temperature of its decrease, K")}},
      {"scg_shear",
       {positive("mu_0", "shear modulus at 300 K, Pa"), number("A", "increase with pressure, 1/Pa"),
        number("B", "decrease with temperature, 1/K")}},
      {"np_shear",
       {positive("mu_0", "shear modulus at 0 K, Pa"), positive("zeta", "width of melting"),
        number("slope_mu_p_over_mu0", "increase with pressure, 1/Pa"),
        positive("C", "constant of Lindemann's law"), positive("m", "mass of an atom, u")}},
      {"ptw_shear",
       {positive("mu_0", "shear modulus at 0 K, Pa"), number("alpha", "without effect", 0),
        number("alphap", "decrease up to the melting temperature"),
        number("slope_mu_p_over_mu0", "increase with pressure, 1/Pa")}}};
  return parts;
}

const std::vector<Part>& melting_parts() {
  static const std::vector<Part> parts = {
      {"constant_Tm", {tag("T_m", "K; absent: <melt_temp> of the material").real().above(0)}},
      {"linear_Tm",
       {positive("T_m0", "melting temperature without pressure, K"),
        number("b", "increase with pressure, K/Pa", 0), number("a", "b = a T_m0/K_T", 0),
        number("Gamma_0", "a = 2 (Gamma_0 - 1/3)", 0), number("K_T", "bulk modulus, Pa", 0)}},
      {"scg_Tm",
       {positive("T_m0", "melting temperature without pressure, K"),
        number("Gamma_0", "Grueneisen coefficient"),
        number("a", "coefficient of the change of Gamma_0 with compression")}}};
  return parts;
}

const std::vector<Part>& heat_parts() {
  static const std::vector<Part> parts = {
      {"constant_Cp", {}},
      {"copper_Cp", {}},
      {"steel_Cp",
       {positive_or("T_transition", "temperature between the two forms, K", 1040),
        number("A_LowT", "J/kg/K", 190.14), number("B_LowT", "J/kg/K", 273.75),
        number("C_LowT", "J/kg/K", 418.30), number("n_LowT", "exponent", 0.2),
        number("A_HighT", "J/kg/K", 465.21), number("B_HighT", "J/kg/K", 267.52),
        number("C_HighT", "J/kg/K", 58.16), number("n_HighT", "exponent", 0.35)}}};
  return parts;
}
const std::vector<std::string> heats_not_supported = {"cubic_Cp"};
const std::vector<std::string> meltings_not_supported = {"bps_Tm"};

}  // namespace

TagSpec shear_modulus_tag() {
  return submodel_tag("shear_modulus_model", "model of the shear modulus", shear_parts());
}
TagSpec melting_tag() {
  return submodel_tag("melting_temp_model", "model of the melting temperature", melting_parts(),
                      meltings_not_supported);
}
TagSpec specific_heat_tag() {
  return submodel_tag("specific_heat_model", "model of the specific heat", heat_parts(),
                      heats_not_supported);
}

ShearModulus read_shear_modulus(const Parameters& model, double constant) {
  ShearModulus m;
  m.mu_0 = constant;
  const ChosenSubmodel chosen = choose_submodel(model, "shear_modulus_model", shear_parts());
  if (chosen.index < 0) return m;
  const Part& part = shear_parts()[chosen.index];
  const Parameters p = inside_submodel(model, "shear_modulus_model", part);
  if (!p.good()) return m;
  m.form = static_cast<ShearModulus::Form>(chosen.index);
  switch (m.form) {
    case ShearModulus::Form::constant:
      if (p.has("shear_modulus")) m.mu_0 = p.real("shear_modulus");
      return m;
    case ShearModulus::Form::mts:
      m.D = p.real("D");
      m.T_0 = p.real("T_0");
      break;
    case ShearModulus::Form::scg:
      m.A = p.real("A");
      m.B = p.real("B");
      break;
    case ShearModulus::Form::np:
      m.zeta = p.real("zeta");
      m.A = p.real("slope_mu_p_over_mu0");
      m.C = p.real("C");
      m.atom = p.real("m") * atomic_mass;
      break;
    case ShearModulus::Form::ptw:
      m.A = p.real("slope_mu_p_over_mu0");
      m.B = p.real("alphap");
      break;
  }
  m.mu_0 = p.real("mu_0");
  return m;
}

MeltingTemperature read_melting(const Parameters& model) {
  MeltingTemperature m;
  m.T_m0 = model.constants().melt_temperature;
  const ChosenSubmodel chosen =
      choose_submodel(model, "melting_temp_model", melting_parts(), meltings_not_supported);
  if (chosen.index < 0) return m;
  const Part& part = melting_parts()[chosen.index];
  const Parameters p = inside_submodel(model, "melting_temp_model", part);
  if (!p.good()) return m;
  m.form = static_cast<MeltingTemperature::Form>(chosen.index);
  if (m.form == MeltingTemperature::Form::constant) {
    if (p.has("T_m")) m.T_m0 = p.real("T_m");
    return m;
  }
  m.T_m0 = p.real("T_m0");
  m.a = p.real("a");
  m.Gamma_0 = p.real("Gamma_0");
  if (m.form == MeltingTemperature::Form::linear) {
    const double a = m.Gamma_0 != 0 ? 2 * (m.Gamma_0 - 1.0 / 3) : m.a;
    m.b = p.real("K_T") > 0 ? a * m.T_m0 / p.real("K_T") : p.real("b");
  }
  return m;
}

SpecificHeat read_specific_heat(const Parameters& model) {
  SpecificHeat heat;
  heat.value = model.constants().specific_heat;
  const ChosenSubmodel chosen =
      choose_submodel(model, "specific_heat_model", heat_parts(), heats_not_supported);
  if (chosen.index < 0) return heat;
  const Part& part = heat_parts()[chosen.index];
  const Parameters p = inside_submodel(model, "specific_heat_model", part);
  if (!p.good()) return heat;
  heat.form = static_cast<SpecificHeat::Form>(chosen.index);
  if (heat.form != SpecificHeat::Form::steel) return heat;
  heat.T_c = p.real("T_transition");
  const char* names[4] = {"A", "B", "C", "n"};
  for (int k = 0; k < 4; ++k) {
    heat.low[k] = p.real(std::string(names[k]) + "_LowT");
    heat.high[k] = p.real(std::string(names[k]) + "_HighT");
  }
  return heat;
}

}  // namespace sluice::mpm
