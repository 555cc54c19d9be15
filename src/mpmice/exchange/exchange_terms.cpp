#include "mpmice/exchange/exchange_terms.hpp"

#include <cmath>
#include <numbers>

namespace sluice::mpmice {

double reach_of_heat(double k, double capacity, double time) {
  return std::sqrt(std::numbers::pi * k / capacity * time);
}

}  // namespace sluice::mpmice
