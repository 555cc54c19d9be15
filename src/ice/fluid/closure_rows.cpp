// Row loops over every law.
#include "ice/fluid/closure_rows.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace sluice::ice {

void pressure_and_modulus_row(const Fluid& fluid, int n, const double* __restrict rho,
                              const double* __restrict rho_e, double* __restrict p,
                              double* __restrict K) {
  std::visit(
      [&](const auto& law) {
#pragma GCC ivdep
        for (int i = 0; i < n; ++i) {
          p[i] = law.pressure(rho[i], rho_e[i]);
          K[i] = eos::modulus_of_state(law, rho[i], rho_e[i], p[i]);
        }
      },
      fluid.law);
}

void pressure_row(const Fluid& fluid, int n, const double* __restrict rho,
                  const double* __restrict rho_e, double* __restrict p) {
  std::visit(
      [&](const auto& law) {
#pragma GCC ivdep
        for (int i = 0; i < n; ++i) p[i] = law.pressure(rho[i], rho_e[i]);
      },
      fluid.law);
}

void modulus_row(const Fluid& fluid, int n, const double* __restrict rho,
                 const double* __restrict p, double* __restrict K) {
  std::visit(
      [&](const auto& law) {
#pragma GCC ivdep
        for (int i = 0; i < n; ++i) K[i] = law.bulk_modulus(rho[i], p[i]);
      },
      fluid.law);
}

void sound_speed_row(const Fluid& fluid, int n, const double* __restrict rho,
                     const double* __restrict p, double* __restrict c) {
  std::visit(
      [&](const auto& law) {
#pragma GCC ivdep
        for (int i = 0; i < n; ++i) c[i] = law.sound_speed(rho[i], p[i]);
      },
      fluid.law);
}

void energy_from_pressure_row(const Fluid& fluid, int n, const double* __restrict rho,
                              const double* __restrict p, double* __restrict rho_e) {
  std::visit(
      [&](const auto& law) {
        if constexpr (std::decay_t<decltype(law)>::depends_on_energy) {
#pragma GCC ivdep
          for (int i = 0; i < n; ++i) rho_e[i] = law.energy_from_pressure(rho[i], p[i]);
        }
      },
      fluid.law);
}

void energy_scale_row(const Fluid& fluid, int n, const double* __restrict rho,
                      const double* __restrict rho_e, double* __restrict scale) {
  std::visit(
      [&](const auto& law) {
        using Law = std::decay_t<decltype(law)>;
        const double pi = -law.lowest_pressure();
        if constexpr (requires { law.pressure_falls_with_energy(); })
          if (law.pressure_falls_with_energy()) {
            for (int i = 0; i < n; ++i) scale[i] = rho[i] * law.thermal_energy(rho[i], rho_e[i]);
            return;
          }
        if constexpr (Law::depends_on_energy && !eos::TwoTemperatures<Law>) {
#pragma GCC ivdep
          for (int i = 0; i < n; ++i)
            scale[i] = (law.pressure(rho[i], rho_e[i]) + pi) * rho[i] / law.dp_de(rho[i], rho_e[i]);
        } else {
          for (int i = 0; i < n; ++i) scale[i] = rho[i] * law.thermal_energy(rho[i], rho_e[i]);
        }
      },
      fluid.law);
}

void temperature_row(const Fluid& fluid, int n, const double* __restrict rho,
                     const double* __restrict rho_e, double* __restrict T) {
  std::visit(
      [&](const auto& law) {
        if (fluid.heat) {
          for (int i = 0; i < n; ++i) T[i] = fluid.temperature(rho[i], rho_e[i]);
          return;
        }
#pragma GCC ivdep
        for (int i = 0; i < n; ++i) T[i] = law.temperature(rho[i], rho_e[i]);
      },
      fluid.law);
}

void heat_capacity_row(const Fluid& fluid, int n, const double* __restrict rho,
                       const double* __restrict rho_e, double* __restrict cv) {
  if (fluid.gamma_law() != nullptr && !fluid.heat) {
    for (int i = 0; i < n; ++i) cv[i] = fluid.specific_heat;
    return;
  }
  for (int i = 0; i < n; ++i) cv[i] = fluid.heat_capacity(rho[i], rho_e[i]);
}

void heat_capacity_ratio_row(const Fluid& fluid, int n, const double* __restrict rho,
                             const double* __restrict rho_e, double* __restrict ratio) {
  if (const auto constant = fluid.constant_heat_capacity_ratio())
    std::fill_n(ratio, n, *constant);
  else
    for (int i = 0; i < n; ++i) ratio[i] = fluid.heat_capacity_ratio(rho[i], rho_e[i]);
}

void admissible_row(const Fluid& fluid, int n, const double* __restrict rho,
                    const double* __restrict rho_e, double* __restrict admissible) {
  std::visit(
      [&](const auto& law) {
#pragma GCC ivdep
        for (int i = 0; i < n; ++i) admissible[i] = law.admissible(rho[i], rho_e[i]) ? 1.0 : 0.0;
      },
      fluid.law);
}

}  // namespace sluice::ice
