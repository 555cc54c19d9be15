// The numbers of an equation of state as decks name them: what reads a law, checks it and writes
// the reference goes through these tables, and asks no law which one it is.
#pragma once
#include <limits>
#include <string_view>

namespace sluice::eos {

// What a number may be.
struct Bound {
  double low = -std::numeric_limits<double>::infinity();
  bool open = false;  // low itself is left out
};
constexpr Bound any_number() {
  return {};
}
constexpr Bound above(double low) {
  return {low, true};
}
constexpr Bound at_least(double low) {
  return {low, false};
}

// Where a deck gives a number: in <EOS>, or in the material for all that ask for it.
enum class Given { in_law, in_law_or_default, by_material };

// A number of a law or of a base of it. The default is the member's own.
template <class Owner>
struct Parameter {
  std::string_view name, unit, meaning;  // unit: empty where it has none
  double Owner::*member;
  Bound bound;
  Given given = Given::in_law;
};

// <gamma> and <specific_heat> of the material.
template <class Owner>
constexpr Parameter<Owner> gamma_of_material() {
  return {"gamma", "", "ratio of specific heats", &Owner::gamma, above(1), Given::by_material};
}
template <class Owner>
constexpr Parameter<Owner> heat_of_material() {
  return {"specific_heat",       "J/(kg K)", "at constant volume",
          &Owner::specific_heat, above(0),   Given::by_material};
}

}  // namespace sluice::eos
