// Sedov constants against Kamm and Timmes (LA-UR-07-2849) and an independent quadrature; Noh
// plateaus in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "exact/radial/noh.hpp"
#include "exact/radial/sedov.hpp"
#include "framework/base/error.hpp"

namespace sluice::exact::point_blast_test {
namespace {

// alpha of the shock radius, gamma 1.4, from an independent quadrature over V (8 million points).
TEST(Sedov, EnergyIntegralsOfTheStandardBlasts) {
  EXPECT_NEAR(SedovProfile(1, 1.4).alpha(), 2 * 0.53874279, 2e-8);
  EXPECT_NEAR(SedovProfile(2, 1.4).alpha(), 0.98407402, 1e-8);
  EXPECT_NEAR(SedovProfile(3, 1.4).alpha(), 0.85107185, 1e-8);
}

// Published energies (one side of the plane) that put the shock at 0.5, 0.75 and 1 at t = 1; they
// keep the radii to about 1e-4.
TEST(Sedov, ShockRadiiOfTheStandardBlasts) {
  struct Case {
    int dimension;
    double energy, radius;
  };
  for (const Case& c : {Case{1, 2 * .0673185, .5}, Case{2, .311357, .75}, Case{3, .851072, 1.}}) {
    Sedov::Blast blast;
    blast.dimension = c.dimension;
    blast.energy = c.energy;
    const Sedov solution(blast);
    EXPECT_NEAR(solution.shock_radius(1), c.radius, 2e-4 * c.radius) << c.dimension;
    EXPECT_NEAR(solution.shock_speed(1), 2 * c.radius / (c.dimension + 2), 2e-4);
  }
}

TEST(Sedov, JumpAtTheShockIsTheStrongOne) {
  Sedov::Blast blast;
  blast.energy = .851072;
  const Sedov solution(blast);
  const State behind = solution.at({solution.shock_radius(1) * (1 - 1e-12), 0, 0}, 1);
  EXPECT_NEAR(behind.density, 6, 1e-8);
  EXPECT_NEAR(behind.velocity.x, 1. / 3, 1e-6);
  EXPECT_NEAR(behind.pressure, .4 / 3, 1e-6);
  const State ahead = solution.at({1.01, 0, 0}, 1);
  EXPECT_EQ(ahead.density, 1);
  EXPECT_EQ(ahead.velocity.x, 0);
}

// The profile satisfies the equations: mass within a radius is conserved (density integrates to
// the mass swept up) and pressure is flat at the centre at the tabulated share of the jump.
TEST(Sedov, ProfileHoldsTheMassItSweptUp) {
  for (int dimension : {1, 2, 3}) {
    const SedovProfile profile(dimension, 1.4);
    const int n = 20000;
    double mass = 0;
    for (int i = 0; i < n; ++i) {
      const double lambda = (i + .5) / n;
      mass += 6 * profile.at(lambda).density * std::pow(lambda, dimension - 1) / n;
    }
    EXPECT_NEAR(mass, 1. / dimension, 5e-5 / dimension) << dimension;
  }
  // Central pressure of the spherical blast, gamma 1.4: 0.366 of the jump (Sedov 1959, ch. IV).
  EXPECT_NEAR(SedovProfile(3, 1.4).at(0).pressure, .366, 1e-3);
}

TEST(Sedov, RefusesGasesWithAVoidAtTheCentre) {
  EXPECT_THROW(SedovProfile(3, 7.5), InputError);
  EXPECT_THROW(SedovProfile(3, 1.0), InputError);
  EXPECT_NO_THROW(SedovProfile(2, 7.5));
}

TEST(Noh, PlateausAreFourSixteenSixtyFour) {
  for (int dimension : {1, 2, 3}) {
    Noh::Inflow in;
    in.dimension = dimension;
    in.axis = dimension == 2 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
    const Noh noh(in);
    const double density = std::pow(4, dimension);
    EXPECT_NEAR(noh.shock_radius(.6), .2, 1e-15);
    const State inside = noh.at({.1, 0, 0}, .6);
    EXPECT_NEAR(inside.density, density, 1e-12);
    EXPECT_NEAR(inside.pressure, density / 3, 1e-12);
    EXPECT_EQ(inside.velocity.x, 0);
    // Mass is conserved: what came in through r = .5 and what was there.
    const State outside = noh.at({.5, 0, 0}, .6);
    EXPECT_NEAR(outside.density, std::pow(1 + .6 / .5, dimension - 1), 1e-13);
    EXPECT_NEAR(outside.velocity.x, -1, 1e-15);
  }
}

}  // namespace
}  // namespace sluice::exact::point_blast_test
