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

struct BitsCase {
  const char* deck;
  const char* boxes = "3,2,1";
  const char* changes = "";
};

class CoupledBits : public ArchiveRuns, public testing::WithParamInterface<BitsCase> {};

TEST_P(CoupledBits, AreTheSameOnRanksAndAfterARestart) {
  const std::string end = " --set Time/maxTime=0.0006 --set DataArchiver/outputInterval=0.0003";
  const std::string deck = std::string(SLUICE_SOURCE_DIR) + "/inputs/mpmice/" + GetParam().deck +
                           ".ups" + GetParam().changes + end;
  const fs::path whole = run("whole", deck);
  expect_same(whole, run("ranks", deck + " --boxes " + GetParam().boxes, 2));
  const fs::path first = run("first", deck + " --max-steps 25");
  expect_same(whole, run("second", "--restart " + first.string() + end));
}

// The strand with one pressure of the gas.
constexpr const char* one_pressure =
    " --set MaterialProperties/ICE/material/geom_object[2]/pressure=5e6"
    " --set MaterialProperties/ICE/material/geom_object[2]/density=17.421602787456446";
INSTANTIATE_TEST_SUITE_P(Decks, CoupledBits,
                         testing::Values(BitsCase{"disk_in_dye"}, BitsCase{"across_periodic_sides"},
                                         BitsCase{"light_disk_in_water"},
                                         BitsCase{"unsteady_strand", "3,1,1", one_pressure},
                                         BitsCase{"explosive", "3,1,1"}),
                         [](const auto& of) { return std::string(of.param.deck); });

}  // namespace
}  // namespace sluice::coupled_bits_test
