// Each function hands the row to the rows of its kind of law.
#include "ice/fluid/law_row.hpp"

#include <algorithm>
#include <cmath>

#include "ice/fluid/closure_rows.hpp"
#include "ice/fluid/mixed_gas.hpp"
#include "ice/fluid/species_rows.hpp"

namespace sluice::ice {

using models::MixedGas;

namespace {

// 1/rho, and c in the place of K.
void speeds_row(int n, const double* __restrict r, double* __restrict w, double* __restrict c) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    w[i] = 1.0 / r[i];
    c[i] = std::sqrt(c[i] * w[i]);
  }
}

void primitive_row(const Fluid& fluid, int n, const double* __restrict r,
                   const double* __restrict E, double* __restrict w, double* __restrict p,
                   double* __restrict c) {
  if (const eos::IdealGas* gas = fluid.gamma_law()) {
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      w[i] = 1.0 / r[i];
      p[i] = gas->pressure(r[i], E[i]);
      c[i] = std::sqrt(gas->gamma * p[i] * w[i]);
    }
    return;
  }
  pressure_and_modulus_row(fluid, n, r, E, p, c);
  speeds_row(n, r, w, c);
}

}  // namespace

LawRow::LawRow(const MixedGas& gas, const FractionRows& fractions)
    : gas_(gas.species ? nullptr : &gas),
      species_(gas.species ? gas.species->gas.get() : nullptr),
      rows_(fractions) {}

void LawRow::pressure(int n, const double* rho, const double* rho_e, double* p) const {
  if (species_ != nullptr) return species_pressure_row(*species_, n, rows_, rho, rho_e, p);
  if (gas_ != nullptr) return mixed_pressure_row(*gas_, n, rows_.alone(), rho_e, p);
  pressure_row(*plain_, n, rho, rho_e, p);
}

void LawRow::pressure_and_modulus(int n, const double* rho, const double* rho_e, double* p,
                                  double* K) const {
  if (species_ != nullptr)
    return species_pressure_and_modulus_row(*species_, n, rows_, rho, rho_e, p, K);
  if (gas_ != nullptr) return mixed_pressure_and_modulus_row(*gas_, n, rows_.alone(), rho_e, p, K);
  pressure_and_modulus_row(*plain_, n, rho, rho_e, p, K);
}

void LawRow::modulus(int n, const double* rho, const double* p, double* K) const {
  if (species_ != nullptr) return species_modulus_row(*species_, n, rows_, rho, p, K);
  if (gas_ != nullptr) return mixed_modulus_row(*gas_, n, rows_.alone(), p, K);
  modulus_row(*plain_, n, rho, p, K);
}

void LawRow::primitives(int n, const double* rho, const double* rho_e, double* inverse_rho,
                        double* p, double* c) const {
  if (species_ != nullptr) {
    species_pressure_and_modulus_row(*species_, n, rows_, rho, rho_e, p, c);
    return speeds_row(n, rho, inverse_rho, c);
  }
  if (gas_ != nullptr)
    return mixed_primitive_row(*gas_, n, rows_.alone(), rho, rho_e, inverse_rho, p, c);
  primitive_row(*plain_, n, rho, rho_e, inverse_rho, p, c);
}

void LawRow::sound_speed(int n, const double* rho, const double* p, double* c) const {
  if (species_ != nullptr) {
    species_modulus_row(*species_, n, rows_, rho, p, c);
    for (int i = 0; i < n; ++i) c[i] = std::sqrt(c[i] / rho[i]);
    return;
  }
  if (gas_ != nullptr) return mixed_sound_speed_row(*gas_, n, rows_.alone(), rho, p, c);
  sound_speed_row(*plain_, n, rho, p, c);
}

void LawRow::compressibility(int n, const double* __restrict rho, const double* __restrict p,
                             double* __restrict kappa) const {
  if (species_ != nullptr) {
    species_modulus_row(*species_, n, rows_, rho, p, kappa);
    for (int i = 0; i < n; ++i) kappa[i] = 1.0 / kappa[i];
    return;
  }
  if (gas_ != nullptr) {
    mixed_modulus_row(*gas_, n, rows_.alone(), p, kappa);
    for (int i = 0; i < n; ++i) kappa[i] = 1.0 / kappa[i];
    return;
  }
  sound_speed_row(*plain_, n, rho, p, kappa);
  for (int i = 0; i < n; ++i) kappa[i] = 1.0 / (rho[i] * kappa[i] * kappa[i]);
}

void LawRow::temperature(int n, const double* rho, const double* rho_e, double* T) const {
  if (species_ != nullptr) return species_temperature_row(*species_, n, rows_, rho, rho_e, T);
  if (gas_ != nullptr) return mixed_temperature_row(*gas_, n, rows_.alone(), rho, rho_e, T);
  temperature_row(*plain_, n, rho, rho_e, T);
}

void LawRow::heat_capacity(int n, const double* rho, const double* rho_e, double* cv) const {
  if (species_ != nullptr) return species_heat_capacity_row(*species_, n, rows_, rho, rho_e, cv);
  if (gas_ != nullptr) return property_row(*gas_, &MixedGas::Node::cv, n, rows_.alone(), cv);
  heat_capacity_row(*plain_, n, rho, rho_e, cv);
}

void LawRow::heat_capacity_ratio(int n, const double* rho, const double* rho_e,
                                 double* ratio) const {
  if (species_ == nullptr && gas_ == nullptr)
    return heat_capacity_ratio_row(*plain_, n, rho, rho_e, ratio);
  Fluid room;
  for (int i = 0; i < n; ++i) ratio[i] = at(i, room).heat_capacity_ratio(rho[i], rho_e[i]);
}

void LawRow::viscosity(int n, double given, double* mu) const {
  if (gas_ != nullptr) return property_row(*gas_, &MixedGas::Node::viscosity, n, rows_.alone(), mu);
  std::fill_n(mu, n, given);
}

void LawRow::conductivity(int n, double given, double* k) const {
  if (gas_ != nullptr)
    return property_row(*gas_, &MixedGas::Node::conductivity, n, rows_.alone(), k);
  std::fill_n(k, n, given);
}

double LawRow::conductivity(int i, double given) const {
  return gas_ != nullptr ? gas_->at(rows_.alone()[i])(&MixedGas::Node::conductivity) : given;
}

void LawRow::conductivity_with_eddies(int n, double given, double prandtl,
                                      const double* __restrict rho, const double* __restrict rho_e,
                                      const double* __restrict mu_t, double* __restrict k) const {
  if (species_ != nullptr) {
    for (int i = 0; i < n; ++i) {
      const eos::Nasa7Heat heat = blend(*species_, rows_, i);
      const double cp = heat.specific_heat(heat.temperature(rho_e[i] / rho[i])) + heat.gas_constant;
      k[i] = given + cp * mu_t[i] / prandtl;
    }
    return;
  }
  if (gas_ != nullptr) {
    const double inverse = 1.0 / prandtl;
    return gas_->for_each_in_row(n, rows_.alone(), [=](int i, const MixedGas::Between& at) {
      k[i] = at(&MixedGas::Node::conductivity) + inverse * at.cp() * mu_t[i];
    });
  }
  heat_capacity_row(*plain_, n, rho, rho_e, k);
  if (const auto ratio = plain_->constant_heat_capacity_ratio()) {
    const double scale = *ratio / prandtl;
    for (int i = 0; i < n; ++i) k[i] = given + scale * k[i] * mu_t[i];
    return;
  }
  for (int i = 0; i < n; ++i) {
    const double scale = plain_->heat_capacity_ratio(rho[i], rho_e[i]) / prandtl;
    k[i] = given + scale * k[i] * mu_t[i];
  }
}

const Fluid& LawRow::at(int i, Fluid& room) const {
  if (plain_ != nullptr) return *plain_;
  return room = species_ != nullptr ? fluid_of_species(*species_, rows_, i)
                                    : fluid_of(*gas_, rows_, i);
}

}  // namespace sluice::ice
