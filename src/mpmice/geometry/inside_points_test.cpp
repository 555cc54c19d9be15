// Points in particles: what adds up over a body, ties, particles turned inside out.
#include "mpmice/geometry/inside_points.hpp"

#include <gtest/gtest.h>

#include "mpmice/geometry/bodies_test_support.hpp"

namespace sluice::mpmice::inside_points {
namespace {

template <int D>
ParticleCorners<D> corners_of(const Body<D>& body, std::size_t p) {
  ParticleCorners<D> x;
  for (std::size_t k = 0; k < Body<D>::corners; ++k)
    for (std::size_t d = 0; d < D; ++d) x[k][d] = body.start[k][d][p];
  return x;
}

template <int D>
int in_body(const Body<D>& body, const Point<D>& point) {
  int sum = 0;
  for (std::size_t p = 0; p < body.size(); ++p)
    sum += winding_number<D>(corners_of<D>(body, p), point);
  return sum;
}

// [2, 6]^D of particles half a cell wide; their corners are the lattice of half cells. A point in
// one of their faces lies on its higher side, as does one in the surface.
template <int D>
void check_lattice() {
  const Body<D> body = block<D>("", 8, [] {
    Point<D> low;
    low.fill(2);
    return low;
  }());
  for_each_cell_of<D>({all<D>(2), all<D>(15)}, [&](const Cell<D>& c) {
    for (const double off : {0.0, 0.25}) {
      Point<D> point;
      bool inside = true;
      for (std::size_t d = 0; d < D; ++d) {
        point[d] = 0.5 * c[d] + off;
        inside = inside && point[d] >= 2 && point[d] < 6;
      }
      EXPECT_EQ(in_body<D>(body, point), inside ? 1 : 0) << D << " " << point[0] << " " << off;
    }
  });
}

TEST(InsidePoints, EveryPointLiesInOneParticleOfALattice) {
  check_lattice<1>();
  check_lattice<2>();
  check_lattice<3>();
}

// Whatever the corners, of a body that has one piece: 1 deep inside, 0 outside.
template <int D>
void check_random() {
  for (const Body<D>& body : bodies<D>()) {
    Point<D> middle, outside;
    for (std::size_t d = 0; d < D; ++d) {
      middle[d] = body_middle[d] - 0.2;
      outside[d] = body_middle[d] + 2.6;
    }
    EXPECT_EQ(in_body<D>(body, middle), 1) << D << ", " << body.name;
    EXPECT_EQ(in_body<D>(body, outside), 0) << D << ", " << body.name;
  }
}

TEST(InsidePoints, BodiesHoldTheirMiddle) {
  check_random<1>();
  check_random<2>();
  check_random<3>();
}

TEST(InsidePoints, AParticleTurnedInsideOutCountsNegative) {
  Body<3> body = block<3>("", 1, {0, 0, 0});
  body.move([](const Point<3>& x) -> Point<3> { return {-x[0], x[1], x[2]}; });
  body.take_step();
  EXPECT_EQ(in_body<3>(body, {-0.2, 0.2, 0.3}), -1);
  EXPECT_EQ(in_body<3>(body, {0.2, 0.2, 0.3}), 0);
}

}  // namespace
}  // namespace sluice::mpmice::inside_points
