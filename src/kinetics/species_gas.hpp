// A mixture of thermally perfect ideal gases by its mass fractions.
//
//   p = rho R(Y) T,  R(Y) = sum Y_k R_k,  e(T, Y) = sum Y_k e_k(T)
// All species but one, the closure, have their mass fractions carried; that of the closure is what
// they leave of 1. Energies e_k are sensible, from 0 K on (eos/nasa7_heat.hpp), so that they are
// positive; with the energy of formation at 0 K,
//   e0_k = h_k(T_r) - R_k T_r - e_k(T_r),  T_r = 298.15 K,
// a reaction at constant volume keeps e + sum Y_k e0_k. Units: J/kg, J/(kg K).
#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "eos/nasa7_heat.hpp"
#include "kinetics/mechanism.hpp"

namespace sluice::kinetics {

class SpeciesGas {
 public:
  // InputError: no species, a closure beyond them, or species whose two ranges of temperature meet
  // at different temperatures.
  SpeciesGas(Mechanism mechanism, std::size_t closure);

  const Mechanism& mechanism() const { return mechanism_; }
  std::size_t count() const { return mechanism_.species.size(); }
  std::size_t carried() const { return count() - 1; }
  std::size_t closure() const { return closure_; }
  // The species whose mass fraction is carried in place k < carried(), in the mechanism's order.
  std::size_t species_of(std::size_t k) const { return k < closure_ ? k : k + 1; }
  const std::string& name_of(std::size_t k) const { return mechanism_.species[species_of(k)].name; }
  double gas_constant(std::size_t species) const { return table_[species][0]; }  // R_k
  double formation_energy(std::size_t species) const { return formation_[species]; }
  double sensible_energy(std::size_t species, double T) const { return heats_[species].energy(T); }
  // h_k = e_k + R_k T, from 0 K on.
  double sensible_enthalpy(std::size_t species, double T) const {
    return heats_[species].energy(T) + table_[species][0] * T;
  }
  const eos::Nasa7Heat& heat_of(std::size_t species) const { return heats_[species]; }

  // R(Y), cv(T, Y), e(T, Y) of the mixture; Y(k): the fraction carried in place k.
  template <class Fractions>
  eos::Nasa7Heat heat(Fractions&& Y) const {
    Row sum = table_[closure_];
    for (std::size_t k = 0; k + 1 < table_.size(); ++k) {
      const double y = Y(k);
      for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += y * difference_[k][n];
    }
    return from_row(sum);
  }
  // Fractions of all species, in the mechanism's order.
  void all_fractions(const double* carried, double* all) const;

  // Of all species at any temperature: for bounds.
  double highest_gamma() const { return highest_gamma_; }
  double lowest_specific_heat() const { return lowest_specific_heat_; }

 private:
  // R_k, and R_k times the five coefficients of cp/R in both ranges.
  using Row = std::array<double, 11>;
  eos::Nasa7Heat from_row(const Row& row) const {
    eos::Nasa7Heat heat;
    heat.gas_constant = row[0];
    const double inverse = 1.0 / row[0];
    for (std::size_t n = 0; n < 5; ++n) {
      heat.low[n] = row[1 + n] * inverse;
      heat.high[n] = row[6 + n] * inverse;
    }
    heat.T_min = T_min_;
    heat.T_mid = T_mid_;
    heat.T_max = T_max_;
    return heat;
  }

  Mechanism mechanism_;
  std::size_t closure_;
  std::vector<Row> table_;       // by species
  std::vector<Row> difference_;  // by place: less that of the closure
  std::vector<eos::Nasa7Heat> heats_;
  std::vector<double> formation_;
  double T_min_ = 200, T_mid_ = 1000, T_max_ = 3500;
  double highest_gamma_ = 0, lowest_specific_heat_ = 0;
};

}  // namespace sluice::kinetics
