// Nanoseconds that one pressure for the materials of a cell takes, by the pair of laws.
//
// Cells as the remap leaves them: shares from 1e-6 to 1 - 1e-6, pressures up to a tenth apart. The
// pair is the argument: gases (two ideal gases, in rows of 8 cells as at an interface), liquid
// (stiffened gas and ideal gas) or jwl (detonation products and ideal gas). Prints one line that
// ends with "ns N", the median over repetitions.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <vector>

#include "ice/closure/equilibrate.hpp"
#include "ice/closure/ideal_relaxation.hpp"

namespace {

using sluice::ice::Fluid;
using sluice::ice::ideal_gas;
using sluice::ice::mixture::Equilibration;
using sluice::ice::mixture::GasRows;
using sluice::ice::mixture::IdealRelaxation;

// A repetition ends before others get the processor: the median is that of a quiet machine.
constexpr int cells = 256, together = 8, sweeps = 4, repetitions = 251;

struct Pair {
  const char* name;
  Fluid first, second;
  double rho_first, rho_second, pressure;  // kg/m^3, Pa
};

Fluid water() {
  sluice::eos::StiffenedGas law;
  law.gamma = 4.4;
  law.pinf = 6e8;
  law.specific_heat = 1000;
  return {law, std::nullopt, law.gamma, law.specific_heat};
}

// Products of PBX 9501.
Fluid products() {
  sluice::eos::Jwl law;
  law.A = 852e9;
  law.B = 18e9;
  law.R1 = 4.6;
  law.R2 = 1.3;
  law.om = 0.38;
  law.rho0 = 1840;
  law.specific_heat = 1000;
  return {law, std::nullopt, 1.4, 1000};
}

Pair pair_of(std::string_view name) {
  if (name == "liquid") return {"liquid and gas", water(), ideal_gas(1.4, 717), 1000, 50, 1e7};
  if (name == "jwl") return {"JWL and gas", products(), ideal_gas(1.4, 717), 500, 50, 1e9};
  return {"two ideal gases", ideal_gas(1.4, 717), ideal_gas(1.667, 300), 1, 10, 1e5};
}

// Mass, volume and energy of both materials, cell by cell.
struct Cells {
  std::vector<double> M[2], V[2], E[2];
};

Cells cells_of(const Pair& pair) {
  Cells c;
  for (int i = 0; i < cells; ++i) {
    const double s = std::sin(1.7 * i), V = 1e-6 + (1 - 2e-6) * (0.5 + 0.5 * std::sin(0.37 * i));
    const auto add = [&](int m, const Fluid& fluid, double share, double rho, double p) {
      c.M[m].push_back(share * rho);
      c.V[m].push_back(share);
      c.E[m].push_back(share * fluid.energy_from_pressure(rho, p, 300));
    };
    add(0, pair.first, V, pair.rho_first, pair.pressure * (1 + 0.05 * s));
    add(1, pair.second, 1 - V, pair.rho_second, pair.pressure * (1 - 0.05 * s));
  }
  return c;
}

// Sums of pressures, so that nothing may be left out.
double relax_rows(const IdealRelaxation& ideal, Cells& c) {
  double p[together], K[together], sum = 0;
  for (int i = 0; i < cells; i += together) {
    const GasRows gases[2] = {{&c.M[0][i], &c.V[0][i], &c.E[0][i]},
                              {&c.M[1][i], &c.V[1][i], &c.E[1][i]}};
    if (!ideal.relax(together, gases, p, K)) return NAN;
    sum += p[0];
  }
  return sum;
}

double relax_cells(const Equilibration& equilibration, Cells& c) {
  double sum = 0;
  for (int i = 0; i < cells; ++i) {
    double M[2] = {c.M[0][i], c.M[1][i]}, V[2] = {c.V[0][i], c.V[1][i]},
           E[2] = {c.E[0][i], c.E[1][i]};
    const auto result = equilibration.equilibrate({M, V, E});
    if (result.failed >= 0) return NAN;
    sum += result.pressure + V[0] + E[0];
  }
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  const Pair pair = pair_of(argc > 1 ? argv[1] : "gases");
  const IdealRelaxation ideal({pair.first, pair.second});
  const Equilibration equilibration({pair.first, pair.second});
  const Cells start = cells_of(pair);
  std::vector<double> times;
  double sum = 0;
  for (int r = 0; r < repetitions; ++r) {
    double spent = 0;
    for (int s = 0; s < sweeps; ++s) {
      Cells c = start;
      const auto began = std::chrono::steady_clock::now();
      sum += ideal.applies() ? relax_rows(ideal, c) : relax_cells(equilibration, c);
      spent += std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - began)
                   .count();
    }
    times.push_back(spent / (sweeps * cells));
  }
  if (!std::isfinite(sum)) {
    std::printf("%s: a cell has no common pressure\n", pair.name);
    return 1;
  }
  std::nth_element(times.begin(), times.begin() + repetitions / 2, times.end());
  std::printf("one pressure of %s: ns %.1f\n", pair.name, times[repetitions / 2]);
  return 0;
}
