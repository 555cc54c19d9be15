// The radial reference against exact solutions, its sharp contacts, and its order.
#include "exact/radial/radial_reference.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "exact/radial/sedov.hpp"
#include "exact/test_support/radial_test_support.hpp"
#include "framework/base/error.hpp"

namespace sluice::exact::radial_reference_test {
namespace {

// Measured 2.81e-3 (N = 200) and 6.93e-4 (N = 800).
TEST(RadialLagrangian, PlaneShockTubeConvergesAtFirstOrder) {
  const double coarse = sod_error<RadialLagrangian>(200, 20000),
               fine = sod_error<RadialLagrangian>(800, 20000);
  EXPECT_LT(coarse, 2.9e-3);
  EXPECT_LT(fine, 8e-4) << coarse << " " << fine;
  RecordProperty("fine", std::to_string(fine));
  EXPECT_GT(std::log2(coarse / fine) / 2, .95);
}

// Contacts do not spread: at most the cell at either side differs.
TEST(RadialLagrangian, ContactsStaySharp) {
  RadialProblem problem;
  problem.cells = 100;
  problem.outflow = true;
  problem.pieces = {{.4, 1, 0, 1}, {1, .1, 0, 1}};
  RadialLagrangian run(problem);
  run.advance_to(1);
  EXPECT_EQ(run.at(.395).density, 1);
  EXPECT_EQ(run.at(.405).density, .1);
}

// An edge that cuts the even cells is where a face starts.
TEST(RadialLagrangian, FacesStandOnEdges) {
  RadialProblem problem;
  problem.cells = 100;
  problem.pieces = {{.404, 1, 0, 1}, {1, .1, 0, 1}};
  const RadialLagrangian run(problem);
  EXPECT_DOUBLE_EQ(run.total_mass(), .404 + .0596);
  EXPECT_EQ(run.at(.396).density, 1);
  EXPECT_EQ(run.at(.408).density, .1);
}

// Energy released within a small radius: Sedov's shock, in all three symmetries.
TEST(RadialLagrangian, DepositsDriveSedovsShock) {
  for (int dimension : {1, 2, 3}) {
    Sedov::Blast blast;
    blast.dimension = dimension;
    // As much as brings the shock to 0.4 at t = 0.5.
    blast.energy = SedovProfile(dimension, 1.4).alpha() * std::pow(.4, dimension + 2) / .25;
    blast.axis = {1, 0, 0};
    const Sedov exact(blast);
    RadialProblem problem;
    problem.dimension = dimension;
    problem.cells = 800;
    problem.high = .5;
    problem.pieces = {{.5, 1, 0, 1e-8}};
    problem.deposit = {blast.energy, .002};
    RadialLagrangian run(problem);
    const double released = (dimension == 1 ? 2 : dimension == 2 ? 2 * M_PI : 4 * M_PI);
    EXPECT_NEAR(run.total_energy() * released, blast.energy, 1e-5) << dimension;
    run.advance_to(.5);
    const double radius = exact.shock_radius(.5), speed = exact.shock_speed(.5);
    const double half = .5 * 2 / 2.4 * speed * speed;
    EXPECT_GT(run.at(radius - .002).pressure, half) << dimension;
    EXPECT_LT(run.at(radius + .002).pressure, half) << dimension;
  }
}

TEST(RadialReference, TimesMayBeAskedInAnyOrder) {
  const RadialReference flow(sod(100, 3), {}, {1, 0, 0});
  const double early = flow.at({.3, .4, 0}, .05).density;
  const double late = flow.at({.3, .4, 0}, .2).density;
  EXPECT_NE(early, late);
  EXPECT_EQ(flow.at({.3, .4, 0}, .05).density, early);
  const RadialReference again(sod(100, 3), {}, {1, 0, 0}), other(sod(120, 3), {}, {1, 0, 0});
  EXPECT_EQ(again.at({.3, .4, 0}, .05).density, early);
  EXPECT_NE(other.at({.3, .4, 0}, .05).density, early);
}

TEST(RadialReference, RefusesProblemsWithoutSense) {
  RadialProblem problem = sod(100, 3);
  problem.deposit.radius = 0;
  EXPECT_THROW(RadialReference(problem, {}, {1, 0, 0}), InputError);
  problem = sod(100, 3);
  problem.deposit.energy = -1;
  EXPECT_THROW(RadialReference(problem, {}, {1, 0, 0}), InputError);
}

}  // namespace
}  // namespace sluice::exact::radial_reference_test
