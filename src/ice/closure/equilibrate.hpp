// One pressure for all materials of a cell, by relaxation with the final pressure.
//
// Find q with sum V_m'(q) = 1, where each material gives or takes the work of its change of volume
// at that pressure and ends at it:
//   E_m' = E_m - q (V_m' - V_m),   p_m(M_m/V_m', E_m'/V_m') = q
// The volumes sum to one, so the work sums to zero: total energy is kept, and both entropies rise,
// T ds_m = (p_m - q) dV_m >= 0. For laws p = G (rho e) - gamma pi, with g = G/(1 + G),
//   V' = g V + g (E - pi V)/(q + pi), falling and convex in q:
// for ideal gases alone q = sum g_m E_m/(1 - sum g_m V_m), and a pair solves a quadratic. How q is
// found for others: equilibrate_search.cpp. The largest material takes the rest of volume and
// energy: both are exact to the round-off of the sums. Materials that are at one pressure already
// (to a few units of the last place of their moduli) are left alone. Where no pressure suits all (a
// solid that knows no tension, beside a liquid under tension), traces keep their density and the
// others fill the rest. Where all together leave room at the least pressure that the weakest bears,
// a cavity opens, which it fills.
#pragma once
#include <vector>

#include "ice/fluid/fluid.hpp"
#include "ice/fluid/material_set.hpp"

namespace sluice::ice::mixture {

// threshold: difference of pressures, relative to the modulus, up to which materials are at one
//   pressure: the round-off of p = G (rho e) + F; unit: 1; test:
//   IdealRelaxation.KeepsVolumeEnergyAndWhatIsInEquilibrium
constexpr double same_pressure = 4e-15;

// The laws of a scene, sorted for speed when made.
class Equilibration {
 public:
  explicit Equilibration(const std::vector<Fluid>& fluids);
  // Of a gas whose law is another in every cell.
  void set_law(int m, const Fluid& fluid);

  struct Cell {
    double* M;  // mass, volume, energy of each material, per volume of the cell: kg/m^3,
    double* V;  // fraction,
    double* E;  // J/m^3
  };
  struct Result {
    double pressure = 0;         // Pa
    double modulus = 0;          // rho c^2 of the mixture, Pa
    int failed = -1;             // the material without a state, or -1
    bool is_cavitating = false;  // a liquid bears no more: the weakest material holds a cavity open
  };
  // Materials with M = 0 are absent and must have V = E = 0. At least one is present.
  Result equilibrate(const Cell& cell) const;
  // Pressure and modulus as they are, nothing changed.
  Result look(const Cell& cell) const;

  int materials() const { return static_cast<int>(fluids_.size()); }

 private:
  struct Linear {  // p = G (E - q M)/V - gamma pi
    bool is = false;
    double G = 0, g = 0, gamma_pi = 0, pi = 0, q = 0;

    // (p + pi) V/gamma: what its volume goes by beside g V.
    double thermal(double M, double V, double E) const { return g * (E - q * M - pi * V); }
  };
  static Linear linear_of(const Fluid& fluid);
  struct Stiffness {
    double pressure, modulus;
  };
  struct Present {
    int index[max_materials];
    int count = 0;
    int largest = -1, weakest = -1;    // by volume; by the tension that it bears
    double stiffest = 0;               // pi, Pa
    double volume = 1.0;               // that they fill together
    Stiffness before[max_materials];   // by material
    double relaxed[max_materials];     // by material: what is not linear has this volume at q
    bool linear = true, ideal = true;  // all laws
  };
  struct Balance;

  // Who is there, at which mean pressure; true: pressures differ.
  bool survey(const Cell& cell, Present& in, Result& result) const;
  Stiffness stiffness(int m, double M, double V, double E) const;
  double modulus(int m, double rho, double rho_e, double p) const;
  bool mend(const Cell& cell) const;
  bool is_weaker(int m, int n, const Cell& cell) const;
  // Without the materials of which there is a trace; false: there are none, or only one.
  bool leave_traces_out(const Cell& cell, Present& in) const;
  double relax(const Cell& cell, const Present& in, double q, int rest) const;
  void find_modulus(const Cell& cell, const Present& in, Result& result) const;
  void fill_cavity(const Cell& cell, const Present& in, double q) const;

  bool settle(const Cell& cell, Present& in, Result& result) const;

  // --- equilibrate_search.cpp ---
  // Do all together leave room at q? If so, what is not linear has its volume at q.
  bool leaves_room(const Cell& cell, Present& in, double q) const;
  // From the start q; false: there is none.
  bool find_pressure(const Cell& cell, Present& in, double& q) const;
  Balance balance(const Cell& cell, const Present& in) const;
  bool search_together(const Cell& cell, Present& in, const Balance& b, double& x) const;
  bool search_in_bracket(const Cell& cell, Present& in, const Balance& b, double& x) const;
  const Fluid& fluid(int m) const { return fluids_[m]; }

  std::vector<Fluid> fluids_;
  std::vector<Linear> linear_;
};

}  // namespace sluice::ice::mixture
