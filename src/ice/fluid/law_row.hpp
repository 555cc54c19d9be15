// The law of one material along a row of cells; which kind of law it is, is asked once a row.
//
// A plain law is the same in every cell and goes to closure_rows.hpp; a gas whose properties follow
// from scalars has one in each, by its fractions there, and goes to mixed_gas.hpp (two streams) or
// species_rows.hpp. Who computes with a law asks here and need not know which it is.
//
// Rows of n cells from the first cell of the row on: rho (kg/m^3), rho_e: internal energy per
// volume (J/m^3), p (Pa). They must not overlap; cells without the material may hold anything.
#pragma once
#include "ice/fluid/fluid.hpp"
#include "ice/fluid/fractions.hpp"

namespace sluice::models {
class MixedGas;
}
namespace sluice::kinetics {
class SpeciesGas;
}

namespace sluice::ice {

class LawRow {
 public:
  explicit LawRow(const Fluid& plain) : plain_(&plain) {}
  // `fractions`: from the first cell of the row on.
  LawRow(const models::MixedGas& gas, const FractionRows& fractions);

  // Whether rows may run past their cells, on any numbers: no law searches for a root there.
  bool takes_any_number() const { return plain_ != nullptr && plain_->gamma_law() != nullptr; }

  void pressure(int n, const double* rho, const double* rho_e, double* p) const;
  // p and K = rho c^2 (Pa), and that at another pressure.
  void pressure_and_modulus(int n, const double* rho, const double* rho_e, double* p,
                            double* K) const;
  void modulus(int n, const double* rho, const double* p, double* K) const;
  // 1/rho, p and c (m/s).
  void primitives(int n, const double* rho, const double* rho_e, double* inverse_rho, double* p,
                  double* c) const;
  void sound_speed(int n, const double* rho, const double* p, double* c) const;
  void compressibility(int n, const double* rho, const double* p, double* kappa) const;  // 1/Pa
  // T (K), and cv (J/(kg K)).
  void temperature(int n, const double* rho, const double* rho_e, double* T) const;
  void heat_capacity(int n, const double* rho, const double* rho_e, double* cv) const;
  void heat_capacity_ratio(int n, const double* rho, const double* rho_e, double* ratio) const;
  // Of the molecules, Pa s and W/(m K); `given`: what the deck gives a material with a plain law,
  // or species that do not spread. Those of species that do: transport/species_transport.hpp.
  void viscosity(int n, double given, double* mu) const;
  void conductivity(int n, double given, double* k) const;
  double conductivity(int i, double given) const;
  // k + cp mu_t/Pr_t, W/(m K); mu_t in Pa s, Pr_t without unit.
  void conductivity_with_eddies(int n, double given, double prandtl, const double* rho,
                                const double* rho_e, const double* mu_t, double* k) const;

  // In cell i of the row; `room` holds a law that is made for it.
  const Fluid& at(int i, Fluid& room) const;

 private:
  const Fluid* plain_ = nullptr;
  const models::MixedGas* gas_ = nullptr;          // two streams
  const kinetics::SpeciesGas* species_ = nullptr;  // in place of those
  FractionRows rows_;
};

}  // namespace sluice::ice
