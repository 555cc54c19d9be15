// Particles that have failed, in a run: with ZeroStress they keep the F with which they did.
#include <gtest/gtest.h>

#include "mpm/test_support/solid_run.hpp"

namespace sluice::mpm::failed_particles_test {
namespace {

TEST(FailedParticles, KeepTheirShapeWithZeroStress) {
  const std::string material = "MaterialProperties/MPM/material/";
  std::vector<std::string> overrides = {
      material + "damage_model/@type=Threshold",
      material + "damage_model/failure_mean=0.01",
      material + "damage_model/failure_distrib=constant",
      material + "damage_model/failure_criteria=MaximumPrincipalStress",
      material + "erosion/@algorithm=ZeroStress",
      "DataArchiver/save[3]/@label=p.localizedMPM",
      "DataArchiver/outputInterval=0.25"};
  for (const char* basis : {"gimp", "linear", "3rdorderBS"}) {
    SCOPED_TRACE(basis);
    std::vector<std::string> with_basis = overrides;
    with_basis.push_back(std::string("MPM/interpolator=") + basis);
    const SolidRun run("colliding_blocks", with_basis);
    ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
    const ParticleTable before = run.particles("#4"), after = run.particles("last");
    const auto& failed = before.find("p.localizedMPM")->components[0];
    const auto &F = before.find("p.deformationMeasure")->components,
               &F_after = after.find("p.deformationMeasure")->components;
    ASSERT_EQ(before.ids, after.ids);
    std::size_t kept = 0, changed = 0;
    for (std::size_t p = 0; p < failed.size(); ++p)
      for (std::size_t e = 0; e < 9; ++e)
        if (failed[p] != 0) (F[e][p] == F_after[e][p] ? kept : changed) += 1;
    EXPECT_GT(kept, 9U * 10);
    EXPECT_EQ(changed, 0U);
  }
}

}  // namespace
}  // namespace sluice::mpm::failed_particles_test
