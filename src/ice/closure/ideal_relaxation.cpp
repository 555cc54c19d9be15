// Plain loops over cells, gas by gas.
#include "ice/closure/ideal_relaxation.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/infinity.hpp"
#include "ice/closure/equilibrate.hpp"
#include "ice/fluid/limiters.hpp"

namespace sluice::ice::mixture {
IdealRelaxation::IdealRelaxation(const std::vector<Fluid>& fluids) {
  applies_ = !fluids.empty();
  for (const Fluid& fluid : fluids) {
    const eos::IdealGas* gas = fluid.gamma_law();
    applies_ = applies_ && gas != nullptr;
    const double gamma = gas != nullptr ? gas->gamma : 1.0;
    gases_.push_back({gamma - 1.0, (gamma - 1.0) / gamma});
  }
}

// What the steps below hand on, of each cell.
struct IdealRelaxation::Sums {
  using Work = double[max_cells];
  Work filled, softness;     // sum V/gamma, sum V/K; then the inverse of the second
  Work energy, volume;       // sum g E, sum g V
  Work largest, largest_of;  // volume and number of the largest gas
  Work differs;              // not 0: the gases are not at one pressure
  Work others, spent;        // volume and work of all gases but that
};

bool IdealRelaxation::relax(int n, const GasRows* gases, double* pressure, double* modulus) const {
  Sums s;
  const auto for_each = [&](auto&& f) {
    f.template operator()<true>(0);
    for (int k = 1; k < static_cast<int>(gases_.size()); ++k) f.template operator()<false>(k);
  };
  bool sound = true;
  for_each([&]<bool First>(int k) { sound = add<First>(k, n, gases[k], s) && sound; });
  if (!find_pressures(n, s, pressure, modulus) || !sound) return false;
  for_each([&]<bool First>(int k) { compare<First>(k, n, gases[k], s, pressure); });
  choose(n, s, pressure, modulus);
  for_each([&]<bool First>(int k) { expand<First>(k, n, gases[k], s, pressure, modulus); });
  for_each([&]<bool First>(int k) { give_rest<First>(k, n, gases[k], s); });
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) modulus[i] = pressure[i] / s.filled[i];
  return true;
}

// Adds gas k to the sums, of which it is the first or not. False: it has no state somewhere.
template <bool First>
bool IdealRelaxation::add(int k, int n, const GasRows& gas, Sums& s) const {
  const double* __restrict M = gas.M;
  const double* __restrict V = gas.V;
  const double* __restrict E = gas.E;
  const Gas& law = gases_[k];
  const double g = law.share, inverse_gamma = 1.0 - g, per_K = inverse_gamma / law.G, which = k;
  int bad = 0;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const auto so_far = [i](const double* sum) { return First ? 0.0 : sum[i]; };
    const bool here = M[i] != 0.0;
    bad |= int{here} &
           (1 - (int{M[i] > 0.0} & int{V[i] > 0.0} & int{E[i] > 0.0} & int{E[i] < infinity}));
    const double soft = per_K * (V[i] * V[i]) / E[i];
    const double largest = so_far(s.largest);
    s.filled[i] = so_far(s.filled) + inverse_gamma * V[i];
    s.softness[i] = so_far(s.softness) + (here ? soft : 0.0);
    s.energy[i] = so_far(s.energy) + g * E[i];
    s.volume[i] = so_far(s.volume) + g * V[i];
    s.largest_of[i] = V[i] > largest ? which : so_far(s.largest_of);
    s.largest[i] = larger(V[i], largest);
  }
  return bad == 0;
}

// The mean pressure as it is; the final one in `modulus`. False: there is none.
bool IdealRelaxation::find_pressures(int n, Sums& s, double* __restrict pressure,
                                     double* __restrict modulus) {
  int bad = 0;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double mean = s.filled[i] / s.softness[i], q = s.energy[i] / (1.0 - s.volume[i]);
    bad |= 1 - (int{q > 0.0} & int{q < infinity} & int{mean < infinity});
    s.softness[i] = 1.0 / s.softness[i];
    pressure[i] = mean;
    modulus[i] = q;
  }
  return bad == 0;
}

// Is the pressure of gas k another than the mean.
template <bool First>
void IdealRelaxation::compare(int k, int n, const GasRows& gas, Sums& s,
                              const double* __restrict pressure) const {
  const double* __restrict V = gas.V;
  const double* __restrict E = gas.E;
  const double G = gases_[k].G, gamma = 1.0 + G;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double round_off = same_pressure * (gamma * pressure[i] + s.softness[i]);
    const double apart = std::fabs(G * E[i] - pressure[i] * V[i]);
    s.differs[i] = apart > round_off * V[i] ? 1.0 : First ? 0.0 : s.differs[i];
  }
}

// The pressure at the end, and its inverse in `modulus`.
void IdealRelaxation::choose(int n, const Sums& s, double* __restrict pressure,
                             double* __restrict modulus) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double p = s.differs[i] != 0.0 ? modulus[i] : pressure[i];
    pressure[i] = p;
    modulus[i] = 1.0 / p;
  }
}

// Volume and energy of gas k at that pressure, unless it is the largest.
template <bool First>
void IdealRelaxation::expand(int k, int n, const GasRows& gas, Sums& s,
                             const double* __restrict pressure,
                             const double* __restrict inverse) const {
  double* __restrict V = gas.V;
  double* __restrict E = gas.E;
  const double g = gases_[k].share, which = k;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double before = V[i], energy = E[i];
    const double relaxed = g * (energy * inverse[i] + before);
    const double now = s.differs[i] != 0.0 ? relaxed : before;
    const double work = pressure[i] * (now - before);
    const bool rest = s.largest_of[i] == which;
    s.others[i] = (First ? 0.0 : s.others[i]) + (rest ? 0.0 : now);
    s.spent[i] = (First ? 0.0 : s.spent[i]) + (rest ? 0.0 : work);
    V[i] = rest ? before : now;
    E[i] = rest ? energy : energy - work;
  }
}

// What the others leave is that of the largest. New sum V/gamma in `filled`.
template <bool First>
void IdealRelaxation::give_rest(int k, int n, const GasRows& gas, Sums& s) const {
  double* __restrict V = gas.V;
  double* __restrict E = gas.E;
  const double inverse_gamma = 1.0 - gases_[k].share, which = k;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const bool rest = s.largest_of[i] == which;
    const double volume = rest ? 1.0 - s.others[i] : V[i];
    V[i] = volume;
    E[i] = rest ? E[i] + s.spent[i] : E[i];
    s.filled[i] = (First ? 0.0 : s.filled[i]) + inverse_gamma * volume;
  }
}

}  // namespace sluice::ice::mixture
