// Labels of what laws remember of a particle; several laws share some.
#pragma once
#include <stdexcept>
#include <string>
#include <string_view>

#include "framework/field/label.hpp"

namespace sluice::mpm {

struct HistoryInfo {
  const char *name, *unit, *definition;
  ValueType type = ValueType::real;
};
inline constexpr HistoryInfo history_table[] = {
    {"p.alpha", "1", "Distension: volume over that of the solid."},
    {"p.alphaUnloaded", "1", "Distension without pressure."},
    {"p.ArenaFSLOPE", "1", "Slope of the limit curve at p.ArenaPEAKI1."},
    {"p.ArenaPEAKI1", "Pa", "Largest trace of the stress that grains sustain, in tension."},
    {"p.ArenaSTREN", "Pa", "Largest square root of J2."},
    {"p.ArenaYSLOPE", "1", "Slope of the limit curve far in compression."},
    {"p.BackStress", "Pa", "Centre of the yield surface."},
    {"p.bElBar", "1", "Isochoric elastic left Cauchy-Green tensor."},
    {"p.capX", "Pa", "Trace of the stress at the end of the cap, with the pore pressure."},
    {"p.COHER", "1", "Fraction of stiffness and strength that remains after damage."},
    {"p.crackRad", "m", "Radius of the cracks."},
    {"p.damage", "1", "Damage, 0 for an undamaged particle."},
    {"p.damageForce", "Pa^0.5", "Largest tension so far, of brittle damage."},
    {"p.elasticDeviator", "Pa",
     "Deviator of the second Piola-Kirchhoff stress without relaxation."},
    {"p.elasticVolStrain", "1", "Elastic change of volume, logarithmic."},
    {"p.epsf", "1", "Threshold of failure of the particle."},
    {"p.eve", "1", "Elastic change of volume, logarithmic."},
    {"p.evp", "1", "Plastic change of volume, logarithmic."},
    {"p.fail", "1", "1: matrix failed, 2: fibres, 3: both."},
    {"p.Kappa", "Pa", "Trace of the stress at the start of the cap."},
    {"p.lightTime", "s", "Arrival time of the detonation."},
    {"p.localizedMPM", "1", "0 for an undamaged particle; 1, 2: failed in tension, in shear."},
    {"p.maxwellDeviators", "Pa", "Deviators of the Maxwell elements, in the axes of the body."},
    {"p.maxwellElement", "Pa", "Stress of the Maxwell element."},
    {"p.maxwellStress", "Pa", "Deviators of the five Maxwell elements."},
    {"p.plasticCumEqStrain", "1", "Equivalent plastic strain."},
    {"p.plasticStrain", "1", "Equivalent plastic strain."},
    {"p.plasticStrainRate", "1/s", "Rate of the equivalent plastic strain."},
    {"p.plasticVolStrain", "1", "Plastic change of volume, logarithmic."},
    {"p.porePressure", "Pa", "Pressure of water and air in the pores."},
    {"p.porosity", "1", "Porosity."},
    {"p.progressdelF", "1", "Fraction of the explosive that burnt in the step."},
    {"p.progressF", "1", "Burnt fraction of the explosive."},
    {"p.relaxingStress", "Pa", "Six relaxing parts of p.elasticDeviator."},
    {"p.saturation", "1", "Water saturation of the pores."},
    {"p.strainRate", "1/s", "(2/3 D : D)^(1/2) of the step."},
    {"p.strainTemperature", "K",
     "Temperature up to which the thermal strain of a rate-form law is applied."},
    {"p.stressQS", "Pa", "Stress without rate dependence.", ValueType::tensor},
    {"p.stretch", "1", "Isochoric stretch of the fibres."},
    {"p.TGROW", "s", "Time of plastic flow."},
    {"p.thermalPressure", "Pa", "Pressure of the solid due to its initial temperature."},
    {"p.timeofloc", "s", "Time of failure of the particle."},
    {"p.yieldStress", "Pa", "Random yield stress of the particle."},
};

inline Label declare_history(const HistoryInfo& h) {
  return declare_label({h.name, h.type, Centring::particle, h.unit, h.definition});
}
// std::logic_error for a name that the table does not have.
inline Label history_label(std::string_view name) {
  for (const HistoryInfo& h : history_table)
    if (name == h.name) return declare_history(h);
  throw std::logic_error("history_label: " + std::string(name));
}
// So that pages tell of all.
inline void declare_history_labels() {
  for (const HistoryInfo& h : history_table) declare_history(h);
}

inline Label plastic_strain_label() {
  return history_label("p.plasticStrain");
}
inline Label plastic_strain_rate_label() {
  return history_label("p.plasticStrainRate");
}
inline Label strain_temperature_label() {
  return history_label("p.strainTemperature");
}
inline Label yield_stress_label() {
  return history_label("p.yieldStress");
}
inline Label localized_label() {
  return history_label("p.localizedMPM");
}
inline Label damage_label() {
  return history_label("p.damage");
}

}  // namespace sluice::mpm
