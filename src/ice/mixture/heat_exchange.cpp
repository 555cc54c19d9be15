// Heat exchange at a point, by relaxation of the temperatures of each pair.
#include "ice/mixture/heat_exchange.hpp"

#include <type_traits>

#include "ice/mixture/pair_relaxation.hpp"

namespace sluice::ice::mixture {
namespace {

bool has_constant_heat(const Fluid& fluid) {
  if (fluid.heat) return false;
  return std::visit([](const auto& law) { return requires { law.specific_heat; }; }, fluid.law);
}

}  // namespace

HeatExchange::HeatExchange(const std::vector<Fluid>& fluids, const PairCoefficients& H)
    : fluids_(fluids), H_(H), on_(fluids.size() > 1 && H.materials() > 0 && H.any()) {
  for (const Fluid& fluid : fluids) constant_heat_.push_back(has_constant_heat(fluid));
}

bool HeatExchange::exchange(const Equilibration::Cell& cell, double dt) const {
  int present[most_materials], n = 0;
  for (int m = 0; m < static_cast<int>(fluids_.size()); ++m)
    if (cell.M[m] > 0.0) present[n++] = m;
  if (n < 2) return false;
  double T[most_materials], C[most_materials], gain[most_materials];
  double k[most_materials * most_materials];
  bool differ = false;
  for (int i = 0; i < n; ++i) {
    const int m = present[i];
    const auto a = static_cast<std::size_t>(m);
    const Fluid& fluid = fluids_[a];
    const double rho = cell.M[m] / cell.V[m], rho_e = cell.E[m] / cell.V[m];
    T[i] = fluid.temperature(rho, rho_e);
    C[i] = cell.M[m] * (constant_heat_[a] ? fluid.specific_heat : fluid.heat_capacity(rho, rho_e));
    differ = differ || T[i] != T[0];
    for (int j = 0; j < n; ++j)
      k[i * n + j] = i == j ? 0.0 : dt * H_(m, present[j]) * cell.V[m] * cell.V[present[j]];
  }
  if (!differ) return false;
  relax_pairs(n, C, T, k, gain);
  for (int i = 0; i < n; ++i) cell.E[present[i]] += gain[i];
  return true;
}

}  // namespace sluice::ice::mixture
