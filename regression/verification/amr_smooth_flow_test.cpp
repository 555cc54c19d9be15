// Smooth waves through interfaces that stand and interfaces that move: second order.
#include <gtest/gtest.h>

#include <cmath>

#include "verification/amr_case.hpp"

namespace sluice::verification::amr_smooth_flow_test {
namespace {

constexpr double lowest_order = 1.9;  // sound 2.195, 2.184, 2.129; vortex 2.422, 2.406
// Of an amplitude of 1e-6, 64 cells on the coarse level. 4.6e-9, 4.3e-9, 6.8e-9
constexpr double sound_rms = 2e-8;

double order(double coarse, double fine) {
  return std::log2(coarse / fine);
}

void expect_second_order(const CaseRun& coarse, const CaseRun& fine) {
  const double observed = order(coarse.error("rho_CC").l1, fine.error("rho_CC").l1);
  record("order", observed);
  EXPECT_GE(observed, lowest_order);
  EXPECT_EQ(coarse.events() + fine.events(), 0);
}

TEST(AmrSmoothFlow, SoundPassesAFixedRegion) {
  const CaseRun coarse("amr_sound_wave");
  const CaseRun fine("amr_sound_wave", {level_resolution(1, 128), level_resolution(2, 128)});
  record("rms", coarse.error("rho_CC").l2);
  EXPECT_LE(coarse.error("rho_CC").l2, sound_rms);
  expect_second_order(coarse, fine);
}

TEST(AmrSmoothFlow, SoundPassesAFixedRegionOfRatio4) {
  const CaseRun coarse("amr_sound_wave", {level_resolution(2, 128)});
  const CaseRun fine("amr_sound_wave", {level_resolution(1, 128), level_resolution(2, 256)});
  record("rms", coarse.error("rho_CC").l2);
  EXPECT_LE(coarse.error("rho_CC").l2, sound_rms);
  expect_second_order(coarse, fine);
}

TEST(AmrSmoothFlow, SoundTakesItsLevelAlong) {
  const CaseRun coarse("amr_sound_wave_followed");
  const CaseRun fine("amr_sound_wave_followed",
                     {resolution(128), "AMR/Regridder/min_patch_size=[[16,1,1]]"});
  record("rms", coarse.error("rho_CC").l2);
  EXPECT_LE(coarse.error("rho_CC").l2, sound_rms);
  EXPECT_GE(regrids(coarse), 20);
  expect_second_order(coarse, fine);
}

TEST(FullAmrSmoothFlow, VortexLeavesAFixedRegion) {
  const CaseRun coarse("amr_vortex");
  const CaseRun fine("amr_vortex", {level_resolution(1, 128, 128), level_resolution(2, 128, 128)},
                     {"--threads", "2"});
  expect_second_order(coarse, fine);
}

TEST(AmrSmoothFlow, VortexTakesItsLevelAlong) {
  const CaseRun coarse("amr_vortex_followed");
  const CaseRun fine("amr_vortex_followed", {resolution(128, 128)}, {"--threads", "2"});
  EXPECT_GE(regrids(coarse), 10);
  expect_second_order(coarse, fine);
  // Not only of second order: as good as a grid that is fine everywhere.
  constexpr double allowed_loss = 1.05;  // 0.97
  const CaseRun uniform("vortex", {resolution(128, 128), "Time/maxTime=4"});
  const double loss = coarse.error("rho_CC").l1 / uniform.error("rho_CC").l1;
  record("by_uniform", loss);
  EXPECT_LE(loss, allowed_loss);
}

}  // namespace
}  // namespace sluice::verification::amr_smooth_flow_test
