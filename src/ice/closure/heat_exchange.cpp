// Heat exchange at a point, by relaxation of the temperatures of each pair.
#include "ice/closure/heat_exchange.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "ice/closure/pair_relaxation.hpp"
#include "ice/closure/surface_law.hpp"

namespace sluice::ice::mixture {
namespace {

// threshold: share of its temperature below which the exchange of heat leaves a material too few
//   digits of its energy; unit: 1; test: HeatExchange.NextToNothingTakesTheTemperatureOfTheLiquid
constexpr double min_share = 1e-6;

bool has_constant_heat(const Fluid& fluid) {
  if (fluid.heat) return false;
  return std::visit([](const auto& law) { return requires { law.specific_heat; }; }, fluid.law);
}

}  // namespace

HeatExchange::HeatExchange(const std::vector<Fluid>& fluids, const PairCoefficients& H,
                           std::optional<MultiVelocityExchange> slip)
    : fluids_(fluids),
      H_(H),
      slip_(std::move(slip)),
      on_(fluids.size() > 1 && H.materials() > 0 && H.any()) {
  for (const Fluid& fluid : fluids) constant_heat_.push_back(has_constant_heat(fluid));
}

bool HeatExchange::exchange(const Equilibration::Cell& cell, double dt,
                            const Surface& surface) const {
  Present in;
  for (int m = 0; m < static_cast<int>(fluids_.size()); ++m)
    if (cell.M[m] > 0.0) in.index[in.count++] = m;
  const int n = in.count;
  if (n < 2) return false;
  for (int i = 0; i < n; ++i) {
    const int m = in.index[i];
    const Fluid& fluid = fluids_[m];
    const double rho = cell.M[m] / cell.V[m], rho_e = cell.E[m] / cell.V[m];
    in.T[i] = fluid.temperature(rho, rho_e);
    in.C[i] =
        cell.M[m] * (constant_heat_[m] ? fluid.specific_heat : fluid.heat_capacity(rho, rho_e));
  }
  const auto [coldest, hottest] = std::minmax_element(in.T, in.T + n);
  if (*coldest == *hottest) return false;
  double k[max_materials * max_materials], gain[max_materials];
  couple(cell, in, dt, surface, k);
  relax_pairs(n, in.C, in.T, k, gain);
  bool sound = true;
  for (int i = 0; i < n; ++i) {
    const double after = in.T[i] + gain[i] / in.C[i];
    sound = sound && after >= *coldest && after <= *hottest && after >= min_share * in.T[i];
  }
  if (!sound) {
    couple(cell, in, dt, surface, k);
    take_means(cell, in, k, gain);
  }
  const auto largest = std::max_element(in.C, in.C + n) - in.C;
  double others = 0;
  for (int i = 0; i < n; ++i)
    if (i != largest) others += gain[i];
  for (int i = 0; i < n; ++i) {
    double& E = cell.E[in.index[i]];
    E = i == largest ? E - others : sound ? E + gain[i] : in.E[i];
  }
  return true;
}

void HeatExchange::couple(const Equilibration::Cell& cell, const Present& in, double dt,
                          const Surface& surface, double* k) const {
  for (int i = 0; i < in.count; ++i)
    for (int j = 0; j < in.count; ++j) {
      const int m = in.index[i], n = in.index[j];
      const double H = i == j ? 0.0 : H_.between(m, n, cell.M[m], cell.M[n]);
      double passes = H * (cell.V[m] * cell.V[n]);
      if (slip_ && slip_->between(m, n))
        passes = through_surface(passes, surface.share, surface.heat);
      k[i * in.count + j] = dt * passes;
    }
}

// A step of backward Euler: (C + K) T' = C T has no differences, so that T' are means of T with all
// their digits. Energies are those of T'.
void HeatExchange::take_means(const Equilibration::Cell& cell, Present& in, double* k,
                              double* gain) const {
  double T[max_materials];
  for (int i = 0; i < in.count; ++i) T[i] = in.C[i] * in.T[i];
  solve_pairs(in.count, in.C, k, T);
  for (int i = 0; i < in.count; ++i) {
    const int m = in.index[i];
    const Fluid& fluid = fluids_[m];
    in.E[i] = cell.V[m] * fluid.energy_from_temperature(cell.M[m] / cell.V[m], T[i]);
    gain[i] = in.E[i] - cell.E[m];
  }
}

}  // namespace sluice::ice::mixture
