// A mechanism of gas-phase chemistry: species, reactions, fits of molecular transport. Plain data,
// in SI units with moles: m, kg, s, K, mol, J.
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sluice::kinetics {

inline constexpr double molar_gas_constant = 8.31446261815324;  // R, J/(mol K)

// NASA polynomials of seven coefficients, two ranges:
//   cp/R = a1 + a2 T + a3 T^2 + a4 T^3 + a5 T^4
//   h/(R T) = a1 + a2 T/2 + a3 T^2/3 + a4 T^3/4 + a5 T^4/5 + a6/T
//   s/R = a1 ln T + a2 T + a3 T^2/2 + a4 T^3/3 + a5 T^4/4 + a7     at reference_pressure
// Collections of these polynomials that combustion uses were fitted at one atmosphere, and so were
// the rates of reverse reactions that follow from them. (NASA's own sets since 1993 are at 1 bar:
// s/R higher by ln 1.01325 = .013, which would move Kc by 1.3 % where the number of moles changes.)
inline constexpr double reference_pressure = 101325;  // Pa

struct Nasa7 {
  double T_low = 200, T_mid = 1000, T_high = 3500;
  std::array<double, 7> low{}, high{};
};

// A polynomial of fourth degree in ln T.
using Fit = std::array<double, 5>;

struct Species {
  std::string name;
  double molar_mass = 0;  // kg/mol
  Nasa7 thermo;
  std::optional<Fit> viscosity;     // sqrt(mu) = T^(1/4) fit
  std::optional<Fit> conductivity;  // lambda = T^(1/2) fit
  std::vector<int> atoms;           // in a molecule, by element of the mechanism
};

// k = A T^b exp(-E/(R T)); A in (m^3/mol)^(order - 1)/s, E in J/mol.
struct Arrhenius {
  double A = 0, b = 0, E = 0;
};

struct Participant {
  std::size_t species = 0;
  int count = 1;
};

struct Falloff {
  Arrhenius low;             // k0, at the limit of low pressure
  bool troe = false;         // Lindemann's form otherwise
  double a = 0;              // Troe's alpha
  double T3 = 0, T1 = 0;     // T***, T*, K
  std::optional<double> T2;  // T**, K
};

struct Reaction {
  std::string equation;
  std::vector<Participant> reactants, products;
  Arrhenius rate;  // k, of a falloff reaction k at the limit of high pressure
  bool reversible = true;
  bool third_body = false;  // the rate is multiplied by [M]; not of falloff reactions
  std::optional<Falloff> falloff;
  std::vector<double> efficiency;  // by species, in [M]; empty where there is no M
};

struct Mechanism {
  std::string name;
  std::vector<std::string> elements;
  std::vector<Species> species;
  std::vector<Reaction> reactions;
  // p D_jk = T^(3/2) fit, Pa m^2/s; entry j * species + k, symmetric. Empty: none are given.
  std::vector<Fit> diffusion;
};

}  // namespace sluice::kinetics
