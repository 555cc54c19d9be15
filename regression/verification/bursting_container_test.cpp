// Two halves that gas throws apart: what is kept, and their symmetry.
#include <gtest/gtest.h>

#include <cmath>

#include "sluice_source_dir.hpp"
#include "verification/case_run.hpp"

namespace sluice::verification::bursting_container_test {
namespace {

double part(const CaseRun& run, const std::string& quantity, const char* name) {
  return run.record().at("conservation").at(quantity).at(name).get<double>();
}

// Before the first wave has reached a side.
TEST(BurstingContainer, KeepsMassAndMomentumAndNearlyItsEnergy) {
  const CaseRun run(SLUICE_SOURCE_DIR "/inputs/mpmice/bursting_container.ups",
                    {resolution(64, 64), "Time/maxTime=0.0004"});
  for (int m = 0; m < 3; ++m)
    EXPECT_LE(std::fabs(part(run, "mass of material " + std::to_string(m), "drift")), 1e-14);
  for (const char* d : {"momentum x", "momentum y"})
    EXPECT_LE(std::fabs(part(run, d, "drift")), 1e-13) << d;
  record("energy", part(run, "total energy", "drift"));
  EXPECT_LE(std::fabs(part(run, "total energy", "drift")), 1e-3);
}

}  // namespace
}  // namespace sluice::verification::bursting_container_test
