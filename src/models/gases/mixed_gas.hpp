// An ideal gas whose properties follow from transported fractions: of two streams, or of species.
//
// Two streams, one mixture fraction f:
//   e = cv(f) T,  p = rho R(f) T = (gamma - 1) rho e,  gamma = 1 + R/cv,  mu(f),  k(f)
// f is the mass fraction of one of two streams; cv, R, mu, k and the heat of mixing Q are given at
// nodes of f, linear between two of them and constant beyond the last. Linear cv and R are those of
// two gases that have together the energy and the pressure which they have apart.
//
// Q(f), J/kg: heat that a mass of the mixture has released since its streams were apart. What has
// been released so far, q, is carried with the mass; where f has become another by mixing, Q(f) - q
// is released. Without Q the gas has no such scalar.
//
// Species, one mass fraction Y_k for each but one: kinetics/species_gas.hpp. What reactions release
// is a source at the end of a step.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"
#include "models/gases/combustion.hpp"

namespace sluice::models {

// That a model may bring in place of the material's.
enum class Coefficient { viscosity, conductivity };

class MixedGas {
 public:
  struct Node {
    double f = 0;                            // mass fraction
    double cv = 1, R = 1;                    // J/(kg K)
    double viscosity = 0, conductivity = 0;  // Pa s, W/(m K)
    double heat = 0;                         // Q, J/kg
  };
  // A value between two nodes.
  struct Between {
    const Node &low, &high;
    double weight;
    double operator()(double Node::*property) const {
      return low.*property + weight * (high.*property - low.*property);
    }
    double ratio() const { return (*this)(&Node::R) / (*this)(&Node::cv); }  // gamma - 1
    // J/(kg K).
    double cp() const { return (*this)(&Node::R) + (*this)(&Node::cv); }
  };

  std::string type;                    // of the model
  std::vector<std::string> fractions;  // names of the scalars: f, or Y_k in the order of species
  std::string released;                // of the scalar q; empty: no heat of mixing
  std::optional<Combustion> species;   // in place of the nodes below
  int material = 0;
  // Whether the model says them; otherwise they are those of the material.
  bool own_heat_capacity = false, own_viscosity = false, own_conductivity = false;
  std::optional<std::array<double, 2>> start_density;     // of both gases apart, kg/m^3
  double oxidizer_temperature = 0, fuel_temperature = 0;  // K, that a flame sheet supposes; 0: none
  Location where;

  // At least two, of increasing f, else std::logic_error.
  void set_nodes(std::vector<Node> nodes);
  const std::vector<Node>& nodes() const { return nodes_; }
  template <class Change>
  void change_nodes(Change change) {
    for (Node& node : nodes_) change(node);
  }

  Between at(double f) const {
    const std::size_t n = nodes_.size() == 2 ? 0 : interval(f);
    const double x = (f - nodes_[n].f) * inverse_width_[n];
    return {nodes_[n], nodes_[n + 1], std::min(std::max(x, 0.0), 1.0)};
  }
  double specific_heat(double f) const { return at(f)(&Node::cv); }
  double gamma(double f) const { return 1.0 + at(f).ratio(); }
  double heat(double f) const { return at(f)(&Node::heat); }
  // Whether the end of a step releases heat, by mixing or by reactions.
  bool releases_heat() const { return !released.empty() || (species && species->reacts); }
  bool is_fraction(const std::string& scalar) const {
    return std::find(fractions.begin(), fractions.end(), scalar) != fractions.end();
  }
  double highest_gamma() const;
  double lowest_specific_heat() const;
  double most(double Node::*property) const;
  // 1/rho = f/rho_B + (1 - f)/rho_A, kg/m^3: both keep their volumes.
  double density_at_start(double f) const;

  // Calls use(i, between) for a row of fractions; between two nodes alone without a search.
  template <class Use>
  void for_each_in_row(int n, const double* __restrict f, Use&& use) const {
    if (nodes_.size() > 2) {
      for (int i = 0; i < n; ++i) use(i, at(f[i]));
      return;
    }
    const Node a = nodes_[0], b = nodes_[1];
    const double inverse = inverse_width_[0];
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double x = (f[i] - a.f) * inverse, above = x > 0.0 ? x : 0.0;
      use(i, Between{a, b, above < 1.0 ? above : 1.0});
    }
  }

 private:
  // The last node below f, but for the last of all.
  std::size_t interval(double f) const;

  std::vector<Node> nodes_;
  std::vector<double> inverse_width_;  // of the intervals
  std::vector<std::size_t> first_;     // of equal parts of the range: the node to look from
  double parts_per_f_ = 0;
};

}  // namespace sluice::models
