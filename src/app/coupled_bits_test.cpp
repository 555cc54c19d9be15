// Runs of fluid and solids with scalars, tracers, periodic sides, surfaces that remember: the same
// bits on several ranks and boxes, and after a restart.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "app/archive_runs_test_support.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::coupled_bits_test {
namespace {

namespace fs = std::filesystem;

class CoupledBits : public ArchiveRuns, public testing::WithParamInterface<const char*> {};

TEST_P(CoupledBits, AreTheSameOnRanksAndAfterARestart) {
  const std::string end = " --set Time/maxTime=0.0006 --set DataArchiver/outputInterval=0.0003";
  const std::string deck =
      std::string(SLUICE_SOURCE_DIR) + "/inputs/mpmice/" + GetParam() + ".ups" + end;
  const fs::path whole = run("whole", deck);
  expect_same(whole, run("ranks", deck + " --boxes 3,2,1", 2));
  const fs::path first = run("first", deck + " --max-steps 25");
  expect_same(whole, run("second", "--restart " + first.string() + end));
}

INSTANTIATE_TEST_SUITE_P(Decks, CoupledBits,
                         testing::Values("disk_in_dye", "across_periodic_sides",
                                         "unsteady_strand"));

}  // namespace
}  // namespace sluice::coupled_bits_test
