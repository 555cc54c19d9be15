// Exact sums in the numbers that ranks pack, and what is computed of them with twice the digits; of
// numbers of any unit.
#pragma once
#include <vector>

#include "framework/analysis/sampler.hpp"
#include "framework/base/exact_sum.hpp"

namespace sluice {

// Few numbers a sum: only those words that are not zero.
void pack_sum(const ExactSum& sum, std::vector<double>& numbers);
// Adds the next sum of every rank.
ExactSum take_sum(RankNumbers& numbers);

// A number as the sum of two doubles: 106 bits. (T. J. Dekker, Numer. Math. 18 (1971) 224-242.)
struct Double2 {
  double high = 0, low = 0;
};
Double2 value2(const ExactSum& sum);
Double2 operator+(Double2 a, Double2 b);
Double2 operator-(Double2 a, Double2 b);
Double2 operator*(Double2 a, Double2 b);
inline Double2 as_double2(double x) {
  return {x, 0};
}
// The product of two doubles without error (unless it underflows).
Double2 product(double a, double b);

}  // namespace sluice
