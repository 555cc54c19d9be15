// Plain loops over cells, gas by gas.
#include "ice/mixture/ideal_relaxation.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/infinity.hpp"
#include "ice/limiters.hpp"
#include "ice/mixture/equilibrate.hpp"

namespace sluice::ice::mixture {
namespace {

using Work = double[IdealRelaxation::most_cells];

}  // namespace

IdealRelaxation::IdealRelaxation(const std::vector<Fluid>& fluids) {
  applies_ = !fluids.empty();
  for (const Fluid& fluid : fluids) {
    const eos::IdealGas* gas = fluid.ideal();
    applies_ = applies_ && gas != nullptr;
    const double gamma = gas != nullptr ? gas->gamma : 1.0;
    G_.push_back(gamma - 1.0);
    share_.push_back((gamma - 1.0) / gamma);
  }
}

bool IdealRelaxation::relax(int n, const GasRows* gases, double* __restrict pressure,
                            double* __restrict modulus) const {
  const int count = static_cast<int>(G_.size());
  // sum V/gamma, sum V/K, sum g E, sum g V; then pressures and what the largest gas does not take.
  Work filled, softness, energy, volume, largest, largest_of, differs, others, spent;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    filled[i] = softness[i] = energy[i] = volume[i] = 0.0;
    largest[i] = largest_of[i] = differs[i] = others[i] = spent[i] = 0.0;
  }
  int bad = 0;
  for (int k = 0; k < count; ++k) {
    const double* __restrict M = gases[k].M;
    const double* __restrict V = gases[k].V;
    const double* __restrict E = gases[k].E;
    const double G = G_[static_cast<std::size_t>(k)], g = share_[static_cast<std::size_t>(k)];
    const double inverse_gamma = 1.0 - g, per_K = inverse_gamma / G, which = k;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const bool here = M[i] != 0.0;
      bad |= int{here} &
             (1 - (int{M[i] > 0.0} & int{V[i] > 0.0} & int{E[i] > 0.0} & int{E[i] < infinity}));
      filled[i] += inverse_gamma * V[i];
      const double soft = per_K * (V[i] * V[i]) / E[i];
      softness[i] += here ? soft : 0.0;
      energy[i] += g * E[i];
      volume[i] += g * V[i];
      largest_of[i] = V[i] > largest[i] ? which : largest_of[i];
      largest[i] = larger(V[i], largest[i]);
    }
  }
  // The mean pressure as it is; the final one in `modulus`.
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double mean = filled[i] / softness[i], q = energy[i] / (1.0 - volume[i]);
    bad |= 1 - (int{q > 0.0} & int{q < infinity} & int{mean < infinity});
    pressure[i] = mean;
    modulus[i] = q;
  }
  if (bad != 0) return false;
  for (int k = 0; k < count; ++k) {
    const double* __restrict V = gases[k].V;
    const double* __restrict E = gases[k].E;
    const double G = G_[static_cast<std::size_t>(k)], gamma = 1.0 + G;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double round_off = same_pressure * (gamma * pressure[i] + 1.0 / softness[i]);
      const double apart = std::fabs(G * E[i] - pressure[i] * V[i]);
      differs[i] = apart > round_off * V[i] ? 1.0 : differs[i];
    }
  }
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    pressure[i] = differs[i] != 0.0 ? modulus[i] : pressure[i];
    modulus[i] = 1.0 / pressure[i];
  }
  for (int k = 0; k < count; ++k) {
    double* __restrict V = gases[k].V;
    double* __restrict E = gases[k].E;
    const double g = share_[static_cast<std::size_t>(k)], which = k;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double relaxed = g * (E[i] * modulus[i] + V[i]);
      const double now = differs[i] != 0.0 ? relaxed : V[i];
      const double work = pressure[i] * (now - V[i]);
      const bool rest = largest_of[i] == which;
      others[i] += rest ? 0.0 : now;
      spent[i] += rest ? 0.0 : work;
      V[i] = rest ? V[i] : now;
      E[i] = rest ? E[i] : E[i] - work;
    }
  }
  for (int i = 0; i < n; ++i) softness[i] = 0.0;
  for (int k = 0; k < count; ++k) {
    double* __restrict V = gases[k].V;
    double* __restrict E = gases[k].E;
    const double inverse_gamma = 1.0 - share_[static_cast<std::size_t>(k)], which = k;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const bool rest = largest_of[i] == which;
      V[i] = rest ? 1.0 - others[i] : V[i];
      E[i] = rest ? E[i] + spent[i] : E[i];
      softness[i] += inverse_gamma * V[i];
    }
  }
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) modulus[i] = pressure[i] / softness[i];
  return true;
}

}  // namespace sluice::ice::mixture
