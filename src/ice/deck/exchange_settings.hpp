// What a deck says about momentum and heat exchange between materials. Plain data.
#pragma once
#include <optional>
#include <vector>

#include "framework/deck/deck.hpp"
#include "ice/fluid/fluid.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::ice {

// How much larger than its coefficient the exchange of a pair is where it varies with the masses
// of the two (linearVariation), a factor, r = max(M_m/M_n, M_n/M_m): r^2/1e5, from 1 to 1e7. With
// the coefficient 1e5 that is r^2 between 1e5 and 1e12.
double growth_with_mass_ratio(double M_m, double M_n);

// Symmetric coefficients of pairs; zero on the diagonal. Of momentum kg/(m^3 s), of heat W/(m^3 K).
class PairCoefficients {
 public:
  PairCoefficients() = default;
  explicit PairCoefficients(int materials)
      : materials_(materials), values_(static_cast<std::size_t>(materials) * materials, 0.0) {}

  int materials() const { return materials_; }
  double operator()(int m, int n) const { return values_[index(m, n)]; }
  void set(int m, int n, double value) {
    values_[index(m, n)] = value;
    values_[index(n, m)] = value;
  }
  // linearVariation: the coefficients are those of equal masses.
  void vary_with_mass() { varies_ = true; }
  bool varies() const { return varies_; }
  // Between masses above zero, per volume of the cell (kg/m^3).
  double between(int m, int n, double M_m, double M_n) const {
    const double k = (*this)(m, n);
    return varies_ && k > 0.0 ? k * growth_with_mass_ratio(M_m, M_n) : k;
  }
  PairCoefficients of(int first, int count) const;  // of some that follow each other
  bool any() const;                                 // one pair at least exchanges
  double min_of_pairs() const;                      // 0 when there is no pair

 private:
  std::size_t index(int m, int n) const { return static_cast<std::size_t>(m) * materials_ + n; }
  int materials_ = 0;
  bool varies_ = false;
  std::vector<double> values_;
};

// Slip of a rarefied gas at the surface of a solid, or of what takes the place of one.
struct MultiVelocityExchange {
  int fluid = 0, solid = 1;
  double momentum_accommodation = 1, thermal_accommodation = 1;  // shares, 0 to 1
  bool use_slip_coefficients = true;
  Location where;

  bool between(int a, int b) const {
    return (a == fluid && b == solid) || (a == solid && b == fluid);
  }
  // What passes the surface, per area: momentum by the difference of the velocities along it,
  // kg/(m^2 s), and heat by that of the temperatures, W/(m^2 K). rho in kg/m^3, T in K, cv in
  // J/(kg K).
  double momentum_transfer(const Fluid& gas, double rho, double T) const;
  double heat_transfer(const Fluid& gas, double rho, double T, double cv) const;
};

// Heat that a surface cell of a solid exchanges with the fluid next to it.
struct ConvectiveExchange {
  int fluid = 0, solid = 1;
  Location where;

  bool between(int a, int b) const {
    return (a == fluid && b == solid) || (a == solid && b == fluid);
  }
};

struct ExchangeSettings {
  PairCoefficients momentum;  // K, kg/(m^3 s): force per volume, K theta_m theta_n (u_n - u_m)
  PairCoefficients heat;      // H, W/(m^3 K)
  std::optional<MultiVelocityExchange> slip;
  std::optional<ConvectiveExchange> convective;
  bool written = false;  // the deck has coefficients
  Location where, momentum_location, heat_location;
};

// Relaxation then takes 1e-10 s in gases of 1 kg/m^3 and 1e-7 s where one of the two is a liquid,
// less than any step of such a deck.
// threshold: momentum exchange coefficient from which on a pair of materials has one velocity;
//   unit: kg/(m^3 s); test: Effects.OneVelocityNeedsEveryPair
inline constexpr double one_velocity_coefficient = 1e10;

// The block of a deck whose tags the schema has checked. Without a block nothing is exchanged.
ExchangeSettings read_exchange(const DeckNode& root, int materials);

TagSpec exchange_tag();
// Numbers of coefficients, indices of materials; what has no kernel yet, by name.
void check_ice_exchange(const DeckNode& root, std::vector<Fault>& faults);

}  // namespace sluice::ice
