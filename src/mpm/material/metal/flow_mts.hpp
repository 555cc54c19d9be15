// mts_model, the mechanical threshold stress (Follansbee and Kocks 1988; Banerjee 2007):
//
//   sigma_f = sigma_a + (S_i sigma_i + S_e sigma_e) mu/mu_0,   mu = mu_0 - D/(exp(T_0/T) - 1)
//   S       = [1 - (k T/(g_0 b^3 mu) ln(rate_0/rate))^(1/q)]^(1/p)
//   d sigma_e/d eps_p = theta_0 (1 - X) + theta_IV X,   X = tanh(alpha sigma_e/sigma_es)/tanh alpha
//   theta_0 = a_0 + a_1 ln rate + a_2 rate^(1/2) - a_3 T
//   sigma_es = sigma_es0 (rate/rate_es0)^(k T/(g_0es b^3 mu)), the greatest sigma_e
// sigma_e is integrated from eps_p = 0 at the present rate and temperature. Without theta_IV
// sigma_e/sigma_es is a function of theta_0 eps_p/sigma_es alone, which is kept as a table.
// Stresses, moduli and a_0, a_1, theta_IV in Pa, a_2 in Pa s^(1/2), a_3 in Pa/K, T in K, rates in
// 1/s; energies g, exponents and alpha without unit.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mpm/material/base/parameters.hpp"
#include "mpm/material/metal/metal_state.hpp"

namespace sluice::mpm {

struct MechanicalThreshold {
  double sigma_a, mu_0, D, T_0, k_b3;  // k_b3: k/b^3, Pa/K
  double g_0i, g_0e, rate_0i, rate_0e, p_i, q_i, p_e, q_e, sigma_i;
  double a_0, a_1, a_2, a_3, theta_IV, alpha, rate_es0, g_0es, sigma_es0;

  double ln_rate_0i = std::log(rate_0i), ln_rate_0e = std::log(rate_0e),
         ln_rate_es0 = std::log(rate_es0);
  // Y and dY/dt at t = x/(1 + x), x = theta_0 eps_p/sigma_es: dY/dx = 1 - tanh(alpha Y)/tanh alpha.
  std::vector<std::array<double, 2>> table{};

  struct Here {
    double mu_ratio, thermal, a_3_T;  // thermal: k T/(b^3 mu)
  };
  Here at(const MetalState& s) const {
    const double mu = D == 0 ? mu_0 : mu_0 - D / (std::exp(T_0 / s.temperature) - 1);
    return {std::max(mu, 0.0) / mu_0, k_b3 * s.temperature / std::max(mu, 1e-3 * mu_0),
            a_3 * s.temperature};
  }
  double stress(const Here& here, double strain, double rate_) const {
    const double rate = std::max(rate_, min_rate), ln_rate = std::log(rate);
    double of_barriers = factor(here.thermal / g_0e * (ln_rate_0e - ln_rate), p_e, q_e) *
                         evolved(here, strain, rate, ln_rate);
    if (sigma_i != 0)
      of_barriers += factor(here.thermal / g_0i * (ln_rate_0i - ln_rate), p_i, q_i) * sigma_i;
    return sigma_a + of_barriers * here.mu_ratio;
  }

  static Tags tags();
  static MechanicalThreshold read(const Parameters& p);

 private:
  void tabulate();
  double tabulated(double x) const {
    // Hermite's cubic between the nodes: 1e-9.
    const double n = static_cast<double>(table.size() - 1), t = x / (1 + x) * n;
    const std::size_t k = std::min(static_cast<std::size_t>(t), table.size() - 2);
    const double u = t - static_cast<double>(k), v = 1 - u;
    const auto& [y0, d0] = table[k];
    const auto& [y1, d1] = table[k + 1];
    return y0 * v * v * (1 + 2 * u) + y1 * u * u * (1 + 2 * v) + u * v * (v * d0 - u * d1) / n;
  }
  // S; activation: k T/(g_0 b^3 mu) ln(rate_0/rate)
  static double factor(double activation, double p, double q) {
    const double left = 1 - power(std::max(activation, 0.0), 1 / q);
    return left > 0 ? power(left, 1 / p) : 0;
  }
  static double power(double x, double n) { return n == 1 ? x : std::pow(x, n); }
  double evolved(const Here& here, double strain, double rate, double ln_rate) const {
    const double saturated = sigma_es0 * std::exp(here.thermal / g_0es * (ln_rate - ln_rate_es0));
    const double theta_0 = a_0 + a_1 * ln_rate + a_2 * std::sqrt(rate) - here.a_3_T;
    if (!table.empty() && theta_0 > 0) return saturated * tabulated(theta_0 * strain / saturated);
    const double per_tanh = 1 / std::tanh(alpha), scale = alpha / saturated;
    const auto slope = [&](double sigma) {
      const double X = std::tanh(scale * sigma) * per_tanh;
      return theta_0 * (1 - X) + theta_IV * X;
    };
    // Runge-Kutta of fourth order, four steps: 1e-4 of sigma_e where hardening saturates.
    double sigma = 0;
    const double h = strain / 4;
    for (int k = 0; k < 4 && sigma < saturated; ++k) {
      const double k1 = slope(sigma), k2 = slope(sigma + 0.5 * h * k1);
      const double k3 = slope(sigma + 0.5 * h * k2), k4 = slope(sigma + h * k3);
      sigma += h / 6 * (k1 + 2 * (k2 + k3) + k4);
    }
    return std::clamp(sigma, 0.0, saturated);
  }
};

inline void MechanicalThreshold::tabulate() {
  constexpr int nodes = 512, parts = 8;
  const double per_tanh = 1 / std::tanh(alpha);
  const auto slope = [&](double y, double t) {  // dY/dt
    return (1 - std::tanh(alpha * y) * per_tanh) / ((1 - t) * (1 - t));
  };
  double y = 0;
  table = {{0, 1}};
  for (int k = 1; k < nodes; ++k) {
    const double h = 1.0 / (nodes * parts);
    for (int m = 0; m < parts; ++m) {
      const double t = (k - 1.0) / nodes + m * h;
      const double k1 = slope(y, t), k2 = slope(y + 0.5 * h * k1, t + 0.5 * h);
      const double k3 = slope(y + 0.5 * h * k2, t + 0.5 * h), k4 = slope(y + h * k3, t + h);
      y = std::min(1.0, y + h / 6 * (k1 + 2 * (k2 + k3) + k4));
    }
    table.push_back({y, slope(y, static_cast<double>(k) / nodes)});
  }
  table.push_back({1, 0});
}

inline Tags MechanicalThreshold::tags() {
  return {number("sigma_a", "part without temperature and rate, Pa"),
          positive("mu_0", "shear modulus at 0 K, Pa"),
          number("D", "coefficient of the decrease of the shear modulus with temperature, Pa"),
          positive("T_0", "temperature of its decrease, K"),
          positive("koverbcubed", "k/b^3, Pa/K"),
          number("g_0i", "activation energy of constant barriers", 0),
          positive("g_0e", "activation energy of evolving barriers"),
          number("edot_0i", "largest rate of constant barriers, 1/s", 0),
          positive("edot_0e", "largest rate of evolving barriers, 1/s"),
          number("p_i", "exponent p of constant barriers", 0),
          number("q_i", "exponent q of constant barriers", 0),
          positive("p_e", "exponent p of evolving barriers"),
          positive("q_e", "exponent q of evolving barriers"),
          number("sigma_i", "strength of constant barriers, Pa", 0),
          number("a_0", "hardening, Pa"),
          number("a_1", "growth of the hardening a_0 with ln rate, Pa", 0),
          number("a_2", "growth of the hardening a_0 with the root of the rate, Pa s^(1/2)", 0),
          number("a_3", "decrease of the hardening a_0 with temperature, Pa/K", 0),
          number("theta_IV", "hardening of stage IV, Pa", 0),
          positive("alpha", "sharpness of saturation"),
          positive("edot_es0", "rate of saturation, 1/s"),
          positive("g_0es", "activation energy of saturation"),
          positive("sigma_es0", "strength at saturation, Pa")};
}

inline MechanicalThreshold MechanicalThreshold::read(const Parameters& p) {
  const auto x = [&](const char* name) { return p.real(name); };
  if (x("sigma_i") != 0)
    for (const char* name : {"g_0i", "edot_0i", "p_i", "q_i"})
      if (!(x(name) > 0)) p.error(name, std::string("<sigma_i> needs <") + name + "> above 0");
  MechanicalThreshold m = {
      x("sigma_a"),  x("mu_0"),    x("D"),        x("T_0"),   x("koverbcubed"), x("g_0i"),
      x("g_0e"),     x("edot_0i"), x("edot_0e"),  x("p_i"),   x("q_i"),         x("p_e"),
      x("q_e"),      x("sigma_i"), x("a_0"),      x("a_1"),   x("a_2"),         x("a_3"),
      x("theta_IV"), x("alpha"),   x("edot_es0"), x("g_0es"), x("sigma_es0")};
  if (m.theta_IV == 0) m.tabulate();
  return m;
}

}  // namespace sluice::mpm
