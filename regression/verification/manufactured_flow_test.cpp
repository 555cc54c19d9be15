// Decaying vortices that a flow carries through an open square: the exact flow beyond its sides.
#include <gtest/gtest.h>

#include <cmath>

#include "verification/case_run.hpp"

namespace sluice::verification::manufactured_flow_test {
namespace {

constexpr double lowest_order = 1.9;    // measured 2.6, 2.9 from 32 to 64 cells
constexpr double largest_error = 1e-3;  // of the vortices' velocity, mean; measured 3.4e-4

double mean_error(int n) {
  const CaseRun run("manufactured_vortices", {resolution(n, n)});
  EXPECT_EQ(run.events(), 0);
  const CellValues u = run.field("vel_CC", 0), v = run.field("vel_CC", 1);
  const double speed = 0.2 * std::exp(-2 * 0.02 * u.time);
  double sum = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double x = u.centre(i, j).x - u.time, y = u.centre(i, j).y - u.time;
      sum += std::fabs(u.at(i, j) - (1 - speed * std::cos(x) * std::sin(y)));
      sum += std::fabs(v.at(i, j) - (1 + speed * std::sin(x) * std::cos(y)));
    }
  return sum / (2 * n * n) / 0.2;
}

TEST(ManufacturedFlow, VorticesPassOpenSidesAtSecondOrder) {
  const double coarse = mean_error(16), fine = mean_error(32);
  record("manufactured vortices: order", std::log2(coarse / fine));
  record("manufactured vortices: mean error at 32", fine);
  EXPECT_GE(std::log2(coarse / fine), lowest_order) << coarse << " " << fine;
  EXPECT_LE(fine, largest_error);
}

// rho S^2 (3/32 + L_z^2/(32 n^2 L_y^2)) per volume: sums over cells of sines are those integrals.
TEST(VortexPairs, HaveTheEnergyOfTheirFormulaAndGoOnTurning) {
  const CaseRun run("vortex_pairs");
  const auto energy = [&](const char* when) {
    const CellValues v = run.field("vel_CC", 1, when), w = run.field("vel_CC", 2, when);
    double sum = 0, across = 0;
    for (std::size_t n = 0; n < v.values.size(); ++n) {
      sum += 0.5 * (v.values[n] * v.values[n] + w.values[n] * w.values[n]);
      across += v.values[n];
    }
    EXPECT_NEAR(across, 0, 1e-10) << when;
    int turns = 0;
    for (int k = 0; k < v.size.z; ++k)
      turns += v.at(0, v.size.y / 2, k) * v.at(0, v.size.y / 2, (k + 1) % v.size.z) < 0;
    EXPECT_EQ(turns, 4) << when;
    return sum / static_cast<double>(v.values.size());
  };
  const double start = energy("first"), left = energy("last") / start;
  EXPECT_NEAR(start, 0.01 / 8, 1e-15);
  record("energy_left", left);
  EXPECT_LT(left, 1);
  EXPECT_GT(left, 0.8);  // viscosity takes a tenth
  EXPECT_EQ(run.events(), 0);
}

}  // namespace
}  // namespace sluice::verification::manufactured_flow_test
