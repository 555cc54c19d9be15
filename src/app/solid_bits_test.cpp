// Runs of solids whose state is more than places and stresses: corners that particles carry are the
// same bits on several ranks and boxes, and after a restart.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "app/archive_runs_test_support.hpp"
#include "framework/archive/archive.hpp"
#include "framework/base/test_support/environment.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::solid_bits_test {
namespace {

namespace fs = std::filesystem;

class SolidBits : public ArchiveRuns {
 protected:
  // Two disks that collide, with these flags of <MPM>; what particles keep is saved in checkpoints.
  void expect_same_disks(const std::string& flags) const {
    const std::string deck = std::string(SLUICE_SOURCE_DIR) + "/inputs/mpm/colliding_disks.ups " +
                             flags +
                             " --set DataArchiver/checkpoint/@timestepInterval=40 "
                             "--set DataArchiver/checkpoint/@cycle=2 --set Time/maxTime=1.2";
    const fs::path whole = run("whole", deck);
    expect_same(whole, run("ranks", deck + " --boxes 3,2,1", 2));
    const fs::path first = run("first", deck + " --max-steps 60");
    expect_same(whole, run("second", "--restart " + first.string() + " --set Time/maxTime=1.2"));
  }
};

TEST_F(SolidBits, CarriedCornersAreTheSameBitsOnRanksAndAfterARestart) {
  expect_same_disks("--set MPM/interpolator=carried_corners");
}

// What particles have lost, and heat of it: one share for all of a body.
TEST_F(SolidBits, HeatOfLostEnergyIsTheSameBitsOnRanksAndAfterARestart) {
  expect_same_disks(
      "--set MPM/lost_energy=heat --set MPM/artificial_viscosity=true --set MPM/transfer=flip");
}

// Bounds of sums are those of particles, whichever go together in a box.
TEST_F(SolidBits, ArtificialViscosityInContactIsTheSameBitsOnBoxes) {
  const std::string deck = std::string(SLUICE_SOURCE_DIR) +
                           "/inputs/mpm/disk_in_ring.ups --set MPM/artificial_viscosity=true "
                           "--set Time/maxTime=0.01";
  expect_same(run("whole", deck), run("boxes", deck + " --boxes 2,2,1"));
}

// Every rank computes all of an implicit step, in one order.
TEST_F(SolidBits, ImplicitStepsAreTheSameBitsOnRanksAndAfterARestart) {
  const std::string deck = SLUICE_SOURCE_DIR "/inputs/mpm/implicit_bar.ups --set Time/maxTime=1";
  const fs::path whole = run("whole", deck);
  expect_same(whole, run("ranks", deck + " --boxes 3,1,1", 2));
  const fs::path first = run("first", deck + " --max-steps 9");
  expect_same(whole, run("second", "--restart " + first.string() + " --set Time/maxTime=1"));
}

// Bars that collide and split, on three levels that come and go (a deck of the public suite).
TEST_F(SolidBits, PartsOfParticlesAreTheSameBitsOnRanksAndAfterARestart) {
  const auto folder = folder_in_environment("SLUICE_DECKS");
  if (!folder) GTEST_SKIP() << "SLUICE_DECKS is not set: no collection of decks";
  const std::string deck = folder->string() +
                           "/inputs/MPM/Collide_AMR_3L.ups --set Time/max_Timesteps=120 "
                           "--set DataArchiver/checkpoint/@timestepInterval=50";
  const fs::path whole = run("whole", deck);
  const Archive archive = Archive::open(whole);
  const ArchiveStep last = archive.read_output(archive.select_output("last"));
  EXPECT_EQ(last.grid().levels.size(), 3u);
  expect_same(whole, run("ranks", deck + " --boxes 2,1,1", 2));
  const fs::path first = run("first", deck + " --max-steps 95");
  expect_same(whole, run("second", "--restart " + first.string()));
}

}  // namespace
}  // namespace sluice::solid_bits_test
