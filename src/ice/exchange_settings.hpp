// What a deck says about momentum and heat exchange between materials. Plain data.
#pragma once
#include <optional>
#include <vector>

#include "framework/deck/schema.hpp"

namespace sluice::ice {

// Symmetric coefficients of pairs; zero on the diagonal.
class PairCoefficients {
 public:
  PairCoefficients() = default;
  explicit PairCoefficients(int materials)
      : materials_(materials),
        values_(static_cast<std::size_t>(materials) * static_cast<std::size_t>(materials), 0.0) {}

  int materials() const { return materials_; }
  double operator()(int m, int n) const { return values_[index(m, n)]; }
  void set(int m, int n, double value) {
    values_[index(m, n)] = value;
    values_[index(n, m)] = value;
  }
  bool any() const;               // one pair at least exchanges
  double least_of_pairs() const;  // 0 when there is no pair

 private:
  std::size_t index(int m, int n) const {
    return static_cast<std::size_t>(m) * static_cast<std::size_t>(materials_) +
           static_cast<std::size_t>(n);
  }
  int materials_ = 0;
  std::vector<double> values_;
};

// Slip of a rarefied gas at the surface of a solid.
struct SlipExchange {
  int fluid = 0, solid = 1;
  double momentum_accommodation = 1, thermal_accommodation = 1;
  bool use_slip_coefficients = true;
  Location where;
};

// Heat that a surface cell of a solid exchanges with the fluid next to it.
struct ConvectiveExchange {
  int fluid = 0, solid = 1;
  Location where;
};

struct ExchangeSettings {
  PairCoefficients momentum;     // K, kg/(m^3 s): force per volume, K theta_m theta_n (u_n - u_m)
  PairCoefficients heat;         // H, W/(m^3 K)
  bool momentum_varies = false;  // linearVariation: K grows with the ratio of masses squared
  bool heat_varies = false;
  std::optional<SlipExchange> slip;
  std::optional<ConvectiveExchange> convective;
  bool written = false;  // the deck has coefficients
  Location where, momentum_where, heat_where;
};

// From this coefficient on a pair moves with one velocity: relaxation takes 1e-10 s in gases of
// 1 kg/m^3 and 1e-7 s where one of the two is a liquid, less than any step of such a deck.
inline constexpr double one_velocity_coefficient = 1e10;

// The block of a deck whose tags the schema has checked. Without a block nothing is exchanged.
ExchangeSettings read_exchange(const DeckNode& root, int materials);

TagSpec exchange_tag();
// Numbers of coefficients, indices of materials; what has no kernel yet, by name.
void check_ice_exchange(const DeckNode& root, std::vector<Fault>& faults);

}  // namespace sluice::ice
