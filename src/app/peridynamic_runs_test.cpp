// Decks of peridynamic solids: known values; the same bits on several ranks and boxes, and after a
// restart, also where bonds have broken before it.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "app/archive_runs_test_support.hpp"
#include "framework/archive/archive.hpp"
#include "framework/archive/selection.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::peridynamic_runs_test {
namespace {

namespace fs = std::filesystem;
const std::string decks = SLUICE_SOURCE_DIR "/inputs/peridynamics/";

class PeridynamicRuns : public ArchiveRuns {
 protected:
  // All components of a label at an output, in the order of ids.
  static std::vector<std::vector<double>> values(const fs::path& folder, const std::string& label,
                                                 const std::string& time) {
    const Archive archive = Archive::open(folder);
    const ArchiveStep step = archive.read_output(archive.select_output(time));
    return step.read_particles(*step.find_particles(label, 0, 0));
  }
};

// By hand: u of five steps of a spring of two masses; e is of second order in u.
TEST_F(PeridynamicRuns, TwoPointsMoveAsByHand) {
  const fs::path folder = run("two", decks + "two_points.ups");
  const auto u = values(folder, "p.displacement", "last");
  ASSERT_EQ(u[0].size(), 2u);
  EXPECT_NEAR(std::fabs(u[0][0]), 4.70469805e-5, 5e-14);
  EXPECT_EQ(u[0][0], -u[0][1]);
  EXPECT_EQ(u[1][0], 0);
  const auto m = values(folder, "p.weightedVolume", "last");
  EXPECT_EQ(m[0][0], 8);
}

TEST_F(PeridynamicRuns, ABarIsTheSameBitsOnRanksAndAfterARestart) {
  const std::string deck = decks +
                           "wave_in_bar.ups --set Grid/Level/Box/resolution=[60,8,8] "
                           "--set DataArchiver/checkpoint/@timestepInterval=10";
  const fs::path whole = run("whole", deck);
  expect_same(whole, run("ranks", deck + " --boxes 3,2,1", 2));
  const fs::path first = run("first", deck + " --max-steps 17");
  expect_same(whole, run("second", "--restart " + first.string()));
}

TEST_F(PeridynamicRuns, ACrackIsTheSameBitsOnRanksAndAfterARestart) {
  const std::string deck = decks +
                           "cracked_plate.ups --set Grid/Level/Box/resolution=[120,80,1] "
                           "--set DataArchiver/checkpoint/@timestepInterval=20";
  const fs::path whole = run("whole", deck);
  const auto damage = values(whole, "p.damage", "last");
  EXPECT_GT(*std::max_element(damage[0].begin(), damage[0].end()), 0.3);
  expect_same(whole, run("ranks", deck + " --boxes 3,2,1", 3));
  for (const char* steps : {"41", "83"}) {
    const fs::path first = run("first" + std::string(steps), deck + " --max-steps " + steps);
    expect_same(whole, run("second" + std::string(steps), "--restart " + first.string()));
  }
}

}  // namespace
}  // namespace sluice::peridynamic_runs_test
