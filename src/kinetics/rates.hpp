// Net molar production of species by the reactions of a mechanism.
//
//   omega_k = sum_r (nu''_kr - nu'_kr) s_r (k_f prod c^nu' - k_r prod c^nu''),  mol/(m^3 s)
//   k_f = A T^b exp(-E/(R T)),  k_r = k_f/Kc (0 where not reversible),
//   ln Kc = -sum_k (nu''_kr - nu'_kr) (g_k/(R T) - ln(p0/(R T))),  p0 = reference_pressure
// with g_k of species_potentials.hpp; s = 1, or [M] = sum of efficiencies times concentrations, or
// the factor of falloff_factor.hpp with k_f the limit of high pressure. Concentrations c in mol/m^3
// may be a little negative: each is used as it is.
#pragma once
#include <cstddef>
#include <vector>

#include "kinetics/falloff_factor.hpp"
#include "kinetics/species_gas.hpp"
#include "kinetics/species_potentials.hpp"

namespace sluice::kinetics {

// Holds workspaces: one object per thread. Nothing is allocated after construction.
class Rates {
 public:
  explicit Rates(const SpeciesGas& gas);

  std::size_t species() const { return count_; }
  std::size_t reactions() const { return steps_.size(); }
  // Rate coefficients and potentials at T > 0, K, for what follows.
  void at(double T);
  const SpeciesPotentials& potentials() const { return potentials_; }
  // k_f and k_r of reaction r in mol, m^3, s; of a falloff reaction at the limit of high pressure.
  double forward(std::size_t r) const { return forward_[r]; }
  double backward(std::size_t r) const { return backward_[r]; }

  // omega of all species, in the mechanism's order.
  void production(const double* c, double* omega) const;
  // d omega_i/d c_j at by_c[j * species() + i], 1/s, and d omega_i/dT at by_T[i].
  void derivatives(const double* c, double* by_c, double* by_T) const;

 private:
  enum class Form { elementary, third_body, falloff };
  struct Law {
    double log_A = 0, b = 0, E = 0;  // E/R, K
    double log(double log_T, double inverse_T) const { return log_A + b * log_T - E * inverse_T; }
    double log_slope(double inverse_T) const { return (b + E * inverse_T) * inverse_T; }
  };
  struct Change {
    std::size_t species;
    double count;  // nu'' - nu'
  };
  struct Span {
    std::size_t begin = 0, end = 0;
  };
  struct Step {
    Law law, low;
    Form form = Form::elementary;
    bool reversible = true;
    double moles = 0;         // sum of nu'' - nu'
    Span left, right;         // in molecules_: each as often as it takes part
    Span changes, bodies;     // in changes_, bodies_
    std::size_t falloff = 0;  // in falloffs_
  };
  struct Factor {
    double value = 1, by_M = 0, by_T = 0;
  };

  static Law law_of(const Arrhenius& rate);
  void add_changes(const Reaction& reaction, Step& step);
  double product(Span side, const double* c) const;
  double third_body(const Step& step, double total, const double* c) const;
  Factor factor(std::size_t r, double M) const;
  void add_products_slopes(const Step& step, Span side, double coefficient, const double* c,
                           double* by_c) const;

  std::size_t count_;
  double T_ = 0;
  SpeciesPotentials potentials_;
  std::vector<Step> steps_;
  std::vector<std::size_t> molecules_;
  std::vector<Change> changes_;
  std::vector<Change> bodies_;  // efficiency less 1
  std::vector<Falloff> falloffs_;
  std::vector<double> forward_, backward_;              // by reaction
  std::vector<double> forward_slope_, backward_slope_;  // d ln k/dT, 1/K
  std::vector<double> ratio_, ratio_slope_;             // k_0/k_inf, and d ln/dT, by falloff
  std::vector<ValueAndSlope> centre_;                   // by falloff
};

}  // namespace sluice::kinetics
