// steinberg_cochran_guinan (Steinberg, Cochran and Guinan 1980; Steinberg and Lund 1989):
//
//   sigma_f = [sigma_T + min(sigma_0 (1 + beta (eps_p + eps_0))^n, Y_max)] mu(p, T)/mu_0
//   rate = 1/[exp(2 U_k/(k T) (1 - sigma_T/sigma_P)^2)/C1 + C2/sigma_T],   sigma_T <= sigma_P
// The thermal part sigma_T is there where the deck gives C1, C2 and the Peierls stress sigma_P.
// Stresses and moduli in Pa, T in K, rates and C1 in 1/s, C2 in Pa s; beta, n and strains without
// unit.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/deck/faults.hpp"
#include "mpm/material/base/parameters.hpp"
#include "mpm/material/metal/metal_state.hpp"

namespace sluice::mpm {

struct SteinbergGuinan {
  double mu_0, sigma_0, Y_max, beta, n, strain_0;
  double C1 = 0, C2 = 0, kink_pair = 0, boltzmann = 0, peierls = 0;  // U_k and k in eV, eV/K

  struct Here {
    double mu_ratio, T;
  };
  Here at(const MetalState& s) const { return {s.shear / mu_0, s.temperature}; }
  double stress(const Here& here, double strain, double rate) const {
    const double athermal = std::min(sigma_0 * std::pow(1 + beta * (strain + strain_0), n), Y_max);
    return (athermal + thermal(here.T, rate)) * here.mu_ratio;
  }
  // By bisection: the rate grows with sigma_T.
  double thermal(double T, double rate) const {
    if (C1 == 0 || rate <= 0) return 0;
    const double energy = 2 * kink_pair / (boltzmann * T);
    double low = 0, high = peierls;
    for (int k = 0; k < 60; ++k) {
      const double sigma = 0.5 * (low + high), left = 1 - sigma / peierls;
      const double reached = 1 / (std::exp(energy * left * left) / C1 + C2 / sigma);
      (reached < rate ? low : high) = sigma;
    }
    return 0.5 * (low + high);
  }

  static Tags tags() {
    return {
        positive("mu_0", "reference shear modulus, Pa"),
        tag("sigma_0", "yield stress, Pa").once().real().at_least(0),
        positive("Y_max", "largest yield stress, Pa"),
        number("beta", "hardening"),
        number("n", "exponent of hardening"),
        number("epsilon_p0", "initial plastic strain", 0),
        number("A", "coefficient of the shear modulus, used by <shear_modulus_model>", 0),
        number("B", "coefficient of the shear modulus, used by <shear_modulus_model>", 0),
        number("T_m0", "parameter of the melting temperature, used by <melting_temp_model>", 0),
        number("Gamma_0", "parameter of the melting temperature, used by <melting_temp_model>", 0),
        number("a", "parameter of the melting temperature, used by <melting_temp_model>", 0),
        number("C1", "largest rate of the thermal part, 1/s; absent: no thermal part", 0),
        number("C2", "drag, Pa s", 0),
        number("energy_to_form_kink_pair", "U_k, eV", 0.31),
        number("Boltzmann_constant", "k, eV/K", 8.617385e-5),
        number("Peierls_stress", "sigma_P, Pa", 0)};
  }
  static SteinbergGuinan read(const Parameters& p) {
    SteinbergGuinan g = {p.real("mu_0"), p.real("sigma_0"), p.real("Y_max"),
                         p.real("beta"), p.real("n"),       p.real("epsilon_p0")};
    if (g.sigma_0 > g.Y_max)
      add_warning(p.faults(), p.block("sigma_0")->where,
                  fmt::format("steinberg_cochran_guinan: <sigma_0> {:g} is above <Y_max> {:g}, the "
                              "largest yield stress: the metal does not harden",
                              g.sigma_0, g.Y_max));
    if (p.real("C1") == 0) return g;
    g.C1 = p.real("C1");
    g.C2 = p.real("C2");
    g.kink_pair = p.real("energy_to_form_kink_pair");
    g.boltzmann = p.real("Boltzmann_constant");
    g.peierls = p.real("Peierls_stress");
    for (const char* name : {"C1", "C2", "Boltzmann_constant", "Peierls_stress"})
      if (!(p.real(name) > 0))
        p.error(name, std::string("the thermal part needs <") + name + "> above 0");
    return g;
  }
};

}  // namespace sluice::mpm
