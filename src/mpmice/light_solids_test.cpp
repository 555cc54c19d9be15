// Solids that are light beside the fluid around them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "mpmice/test_support/coupled_run.hpp"

namespace sluice::mpmice::light_solids_test {
namespace {

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values) most = std::max(most, std::fabs(v));
  return most;
}

double fastest(const CoupledRun& run) {
  double most = 0;
  for (const std::size_t d : {0u, 1u}) {
    most = std::max(most, largest(run.particles("p.velocity")[d]));
    most = std::max(most, largest(run.field("vel_CC", 1).components[d]));
  }
  return most;
}

// A disk at rest in water that flows with 1 m/s. An impact sets it in motion with the water; with
// the water's whole pressure on a mass that gives way to it, velocities grew threefold in a step.
// Water alone takes 9 steps; at 1 kg/m^3 sound in the disk is 2.5 times as fast as in the water.
TEST(LightSolids, ADiskInWaterIsCarriedAlong) {
  for (const auto& [density, steps] : {std::pair{"100", 10}, {"10", 10}, {"1", 14}}) {
    const CoupledRun run("light_disk_in_water",
                         {"Time/maxTime=0.00004",
                          std::string("MaterialProperties/MPM/material/density=") + density});
    ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
    EXPECT_LT(fastest(run), 3) << density;
    EXPECT_LE(run.report().steps, steps) << density;
    EXPECT_LT(run.worst_drift_but_energy(), 1e-12) << density;
    EXPECT_LT(std::fabs(run.drift("total energy")), 1e-8) << density;
  }
}

TEST(LightSolids, SameBitsOnBoxesAndThreads) {
  const std::vector<std::string> shorter = {"Time/maxTime=0.00003"};
  const CoupledRun one("light_disk_in_water", shorter);
  const CoupledRun many("light_disk_in_water", shorter, 2, {3, 2, 1});
  for (const auto& [label, material] : {std::pair{"press_CC", 0}, {"temp_CC", 1}, {"vel_CC", 1}})
    EXPECT_EQ(one.field(label, material).components, many.field(label, material).components)
        << label;
}

}  // namespace
}  // namespace sluice::mpmice::light_solids_test
