// Runs of solids whose state is more than places and stresses: corners that particles carry are the
// same bits on several ranks and boxes, and after a restart.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "app/archive_runs_test_support.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::solid_bits_test {
namespace {

namespace fs = std::filesystem;

class SolidBits : public ArchiveRuns {};

// Two disks that collide; corners are saved in checkpoints.
TEST_F(SolidBits, CarriedCornersAreTheSameBitsOnRanksAndAfterARestart) {
  const std::string deck = std::string(SLUICE_SOURCE_DIR) +
                           "/inputs/mpm/colliding_disks.ups --set MPM/interpolator=carried_corners "
                           "--set DataArchiver/checkpoint/@timestepInterval=40 "
                           "--set DataArchiver/checkpoint/@cycle=2 --set Time/maxTime=1.2";
  const fs::path whole = run("whole", deck);
  expect_same(whole, run("ranks", deck + " --boxes 3,2,1", 2));
  const fs::path first = run("first", deck + " --max-steps 60");
  expect_same(whole, run("second", "--restart " + first.string() + " --set Time/maxTime=1.2"));
}

}  // namespace
}  // namespace sluice::solid_bits_test
