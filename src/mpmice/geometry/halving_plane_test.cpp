// Planes that halve a cell, against faces, diagonals and the integral of Fourier.
#include "mpmice/geometry/halving_plane.hpp"

#include <gtest/gtest.h>

namespace sluice::mpmice::halving_plane_test {
namespace {

// Fourier: the density at 0 of sum w_d x_d is (1/pi) int_0^inf prod sin(w_d t/2)/(w_d t/2) dt.
double density_at_zero(const std::array<double, 3>& w) {
  constexpr double step = 0.01, end = 4000;
  double sum = 0.5;  // of t = 0
  for (double t = step; t < end; t += step) {
    double product = 1;
    for (const double width : w) product *= std::sin(0.5 * width * t) / (0.5 * width * t);
    sum += product;
  }
  return sum * step / 3.14159265358979324;
}

TEST(HalvingPlane, AcrossAnAxisIsAFaceOfTheCell) {
  EXPECT_EQ((width_across<1>({-1}, {0.3})), 0.3);
  EXPECT_EQ((width_across<2>({0, 1}, {0.3, 0.2})), 0.2);
  EXPECT_EQ((width_across<3>({0, 0, -1}, {0.3, 0.2, 0.7})), 0.7);
}

// A diagonal of the square: sqrt(2); a hexagon in the cube: 3 sqrt(3)/4.
TEST(HalvingPlane, AcrossADiagonalOfSquareAndCube) {
  const double two = std::sqrt(0.5), three = std::sqrt(1.0 / 3);
  EXPECT_NEAR((width_across<2>({two, -two}, {1, 1})), 1 / std::sqrt(2), 1e-15);
  EXPECT_NEAR((width_across<3>({three, -three, three}, {1, 1, 1})), 1 / (3 * std::sqrt(3) / 4),
              1e-15);
}

TEST(HalvingPlane, HasTheAreaOfTheSection) {
  for (const std::array<double, 3>& w :
       {std::array{0.9, 0.4, 0.3}, std::array{0.5, 0.6, 0.7}, std::array{0.8, 0.5, 0.31}})
    EXPECT_NEAR(density_at_zero(w) * (width_across<3>(w, {1, 1, 1})), 1, 1e-4);
}

}  // namespace
}  // namespace sluice::mpmice::halving_plane_test
