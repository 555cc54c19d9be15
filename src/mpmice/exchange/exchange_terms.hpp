// Terms of the exchange through surfaces (surface_exchange.hpp).
#pragma once
#include <algorithm>
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/base/reduction.hpp"

namespace sluice::mpmice {

// Coefficients per volume of the cell of a solid with each fluid, kg/(m^3 s) and W/(m^3 K).
struct FilmCoefficients {
  std::vector<double> drag, heat;

  bool any_drag() const { return any(drag); }
  bool any_heat() const { return any(heat); }
  bool any() const { return any_drag() || any_heat(); }

 private:
  static bool any(const std::vector<double>& all) {
    return std::any_of(all.begin(), all.end(), [](double k) { return k > 0; });
  }
};

// The largest values of a step, in which sums are counted: of particles and fluid; of the mass and
// heat capacity of a fluid, per cell volume.
struct ExchangeScales {
  double mass = 1e-300, speed = 1e-100, temperature = 1e-300;  // kg, m/s, K
  double fluid_mass = 1e-300, fluid_capacity = 1e-300;         // kg/m^3, J/(m^3 K)

  // Of all ranks. Collective.
  void join(Communicator& ranks) {
    Reduction all;
    double* const each[] = {&mass, &speed, &temperature, &fluid_mass, &fluid_capacity};
    std::vector<Reduction::Maximum> slots;
    for (const double* most : each) slots.push_back(all.add_maximum(*most));
    ranks.reduce(all);
    for (std::size_t n = 0; n < slots.size(); ++n) *each[n] = all.maximum(slots[n]);
  }
};

// What passes a pair of cells for a unit of difference: see above. Capacities without end: 0 for
// their inverse.
inline double passes(double G, double dt, double sum_g, double inverse_g, double sum_s,
                     double inverse_s) {
  return G / (1 / dt + sum_g * inverse_g + sum_s * inverse_s);
}

// How far heat comes in a time with k/(rho c), m: as if what lies there had met at its beginning.
double reach_of_heat(double k, double capacity, double time);

}  // namespace sluice::mpmice
