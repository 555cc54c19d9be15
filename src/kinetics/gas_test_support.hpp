// Gases for tests: stoichiometric hydrogen and air, gases of hand-made species, the equilibrium of
// a gas by another way than through reactions. kg/m^3, Pa, K, J/kg, mol/m^3; Y: mass fractions.
#pragma once
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "kinetics/hydrogen_burke.hpp"
#include "kinetics/species_gas.hpp"
#include "kinetics/species_potentials.hpp"

namespace sluice::kinetics::testing_gas {

enum Place { H, H2, O, OH, H2O, O2, HO2, H2O2, N2 };

inline const SpeciesGas& hydrogen() {
  static const SpeciesGas gas(burke_hydrogen(), N2);
  return gas;
}

// Carried fractions of stoichiometric hydrogen and air.
inline std::vector<double> hydrogen_air() {
  std::vector<double> Y(8, 0.0);
  Y[H2] = .028522387527567396;
  Y[O2] = .22635400697103147;
  return Y;
}

inline double density(const SpeciesGas& gas, const std::vector<double>& Y, double p, double T) {
  return p / (gas.heat([&](std::size_t k) { return Y[k]; }).gas_constant * T);
}
inline double energy(const SpeciesGas& gas, const std::vector<double>& Y, double T) {
  return gas.heat([&](std::size_t k) { return Y[k]; }).energy(T);
}
inline double temperature(const SpeciesGas& gas, const std::vector<double>& Y, double e) {
  return gas.heat([&](std::size_t k) { return Y[k]; }).temperature(e);
}

// Of all species, mol/m^3.
inline std::vector<double> concentrations(const SpeciesGas& gas, double rho,
                                          const std::vector<double>& Y) {
  std::vector<double> c(gas.count());
  gas.all_fractions(Y.data(), c.data());
  for (std::size_t k = 0; k < c.size(); ++k) c[k] *= rho / gas.mechanism().species[k].molar_mass;
  return c;
}

// A species of constant specific heat, of one atom of an element A; h and s may differ.
inline Species plain_species(const std::string& name, double a6 = 0, double a7 = 0) {
  Species species;
  species.name = name;
  species.molar_mass = 0.03;
  species.atoms = {1};
  species.thermo.low = species.thermo.high = {3.5, 0, 0, 0, 0, a6, a7};
  return species;
}

// Concentrations c_k = p0/(R T) exp(sum_e a_ek l_e - g_k/(R T)) by the potentials of elements: of
// all such gases the one with given atoms and energy is at rest.
class Equilibrium {
 public:
  Equilibrium(const SpeciesGas& gas, const std::vector<double>& c, double T)
      : gas_(gas), potentials_(gas), target_(totals(c, T)) {}

  // From a guess of potentials and temperature, by Newton's method with differences. 0: no success.
  double solve(std::array<double, 4> guess) {
    x_ = guess;
    for (int n = 0; n < 100; ++n) {
      const std::array<double, 4> step = newton_step();
      double size = 0;
      for (std::size_t i = 0; i < 4; ++i) size = std::max(size, std::abs(step[i] / x_[i]));
      const double damping = std::min(1.0, 0.02 / size);
      for (std::size_t i = 0; i < 4; ++i) x_[i] += damping * step[i];
      if (size < 1e-12) return x_[3];
    }
    return 0;
  }
  std::vector<double> concentrations() { return at(x_); }
  std::vector<double> at(const std::array<double, 4>& x) {
    potentials_.at(x[3]);
    std::vector<double> c(gas_.count());
    for (std::size_t k = 0; k < c.size(); ++k) {
      double power = -potentials_.gibbs()[k];
      for (std::size_t e = 0; e < 3; ++e) power += gas_.mechanism().species[k].atoms[e] * x[e];
      c[k] = reference_pressure / (molar_gas_constant * x[3]) * std::exp(power);
    }
    return c;
  }

 private:
  std::array<double, 4> totals(const std::vector<double>& c, double T) {
    std::array<double, 4> sum{};
    potentials_.at(T);
    for (std::size_t k = 0; k < c.size(); ++k) {
      for (std::size_t e = 0; e < 3; ++e) sum[e] += c[k] * gas_.mechanism().species[k].atoms[e];
      sum[3] += c[k] * molar_gas_constant * T * (potentials_.enthalpy()[k] - 1);
    }
    return sum;
  }
  std::array<double, 4> excess(const std::array<double, 4>& x) {
    std::array<double, 4> sum = totals(at(x), x[3]);
    for (std::size_t i = 0; i < 4; ++i) sum[i] -= target_[i];
    return sum;
  }
  std::array<double, 4> newton_step() {
    std::array<std::array<double, 5>, 4> rows{};
    const std::array<double, 4> here = excess(x_);
    for (std::size_t j = 0; j < 4; ++j) {
      std::array<double, 4> up = x_, down = x_;
      const double h = 1e-6 * std::abs(x_[j]);
      up[j] += h;
      down[j] -= h;
      const std::array<double, 4> above = excess(up), below = excess(down);
      for (std::size_t i = 0; i < 4; ++i) rows[i][j] = (above[i] - below[i]) / (2 * h);
    }
    for (std::size_t i = 0; i < 4; ++i) rows[i][4] = -here[i];
    for (std::size_t i = 0; i < 4; ++i) {  // Gauss and Jordan
      std::size_t largest = i;
      for (std::size_t m = i; m < 4; ++m)
        if (std::abs(rows[m][i]) > std::abs(rows[largest][i])) largest = m;
      std::swap(rows[i], rows[largest]);
      for (std::size_t m = 0; m < 4; ++m) {
        if (m == i) continue;
        const double factor = rows[m][i] / rows[i][i];
        for (std::size_t j = i; j < 5; ++j) rows[m][j] -= factor * rows[i][j];
      }
    }
    std::array<double, 4> step{};
    for (std::size_t i = 0; i < 4; ++i) step[i] = rows[i][4] / rows[i][i];
    return step;
  }

  const SpeciesGas& gas_;
  SpeciesPotentials potentials_;
  std::array<double, 4> target_;
  std::array<double, 4> x_{};
};

// The equilibrium of burnt hydrogen and air: T, and c of all species.
inline std::pair<double, std::vector<double>> burnt(const std::vector<double>& c, double T) {
  const SpeciesGas& gas = hydrogen();
  Equilibrium equilibrium(gas, c, T);
  const double hot = 2900;
  SpeciesPotentials potentials(gas);
  potentials.at(hot);
  const auto power = [&](Place k, double amount) {
    return potentials.gibbs()[k] + std::log(amount * molar_gas_constant * hot / reference_pressure);
  };
  const double of_O = power(O2, 0.02 * c[O2]) / 2;
  const double of_H = (power(H2O, 0.9 * c[H2]) - of_O) / 2;
  const double T_end = equilibrium.solve({of_H, of_O, power(N2, c[N2]) / 2, hot});
  return {T_end, equilibrium.concentrations()};
}

}  // namespace sluice::kinetics::testing_gas
