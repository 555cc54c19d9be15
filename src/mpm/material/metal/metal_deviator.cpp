// The deviator of a metal.
#include "mpm/material/metal/metal_deviator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mpm/material/base/maxwell_step.hpp"
#include "mpm/material/base/metal_parts.hpp"

namespace sluice::mpm {
namespace {

Symmetric element(std::span<const double* const> columns, std::size_t n, int i) {
  Symmetric S;
  for (std::size_t k = 0; k < 6; ++k) S[k] = columns[6 * n + k][i];
  return S;
}

const std::vector<Part>& parts() {
  static const std::vector<Part> list = {
      {"hypoElastic", {}},
      {"hypoViscoElastic",
       {tag("mu", "shear moduli of the Maxwell elements, Pa; their sum is <shear_modulus>")
            .once()
            .reals(),
        tag("tau", "times of relaxation, s, one for each of <mu>").once().reals()}}};
  return list;
}

}  // namespace

MaxwellElements::Trial MaxwellElements::trial(std::span<const double* const> old, int i, double mu,
                                              double dt, const Symmetric& strain) const {
  Trial t;
  for (std::size_t n = 0; n < shares_.size(); ++n) {
    const MaxwellStep m = maxwell_step(dt / times_[n]);
    const double mu_n = mu * shares_[n] * m.taken;
    t.S = combined(1, t.S, 1, combined(m.kept, element(old, n, i), 2 * mu_n, strain));
    t.mu += mu_n;
  }
  return t;
}

double MaxwellElements::take(std::span<const double* const> old, std::span<double* const> now,
                             int i, double mu, double dt, const Symmetric& strain) const {
  double heat = 0;
  for (std::size_t n = 0; n < shares_.size(); ++n) {
    const MaxwellStep m = maxwell_step(dt / times_[n]);
    const double mu_n = mu * shares_[n];
    const Symmetric S_0 = element(old, n, i);
    const Symmetric S = combined(m.kept, S_0, 2 * mu_n * m.taken, strain);
    // Strain of the dashpot: that of the element less that of its spring.
    const Symmetric spring = combined(0.5 / mu_n, S, -0.5 / mu_n, S_0);
    heat += double_dot(combined(0.5, S_0, 0.5, S), combined(1, strain, -1, spring));
    for (std::size_t k = 0; k < 6; ++k) now[6 * n + k][i] = S[k];
  }
  return heat;
}

TagSpec deviator_tag() {
  return submodel_tag("deviatoric_stress_model", "elasticity of the deviator", parts());
}

MaxwellElements read_deviator(const Parameters& model, double mu) {
  const ChosenSubmodel chosen = choose_submodel(model, "deviatoric_stress_model", parts());
  if (chosen.index < 1) return {};
  const Parameters p = inside_submodel(model, "deviatoric_stress_model", parts()[chosen.index]);
  if (!p.good()) return {};
  std::vector<double> shares = p.reals("mu");
  const std::vector<double> times = p.reals("tau");
  const auto all_positive = [](const std::vector<double>& list) {
    return std::all_of(list.begin(), list.end(), [](double x) { return x > 0; });
  };
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  if (times.size() != shares.size())
    p.error("tau", fmt::format("<tau> has {} numbers, expected {}, one for each of <mu>",
                               times.size(), shares.size()));
  else if (!all_positive(shares) || !all_positive(times))
    p.error(all_positive(shares) ? "tau" : "mu",
            fmt::format("every number of <{}> must be greater than 0",
                        all_positive(shares) ? "tau" : "mu"));
  else if (!(std::abs(sum / mu - 1) < 1e-3))
    p.error("mu", fmt::format("the sum of <mu> is {:g}, expected <shear_modulus> {:g}", sum, mu));
  for (double& share : shares) share /= sum;
  return {std::move(shares), times};
}

}  // namespace sluice::mpm
