// Runs of fluid and solids with scalars, tracers and periodic sides: the same bits on several ranks
// and boxes, and after a restart.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "app/command_test_support.hpp"
#include "framework/base/temporary_folder.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::coupled_bits_test {
namespace {

namespace fs = std::filesystem;

class CoupledBits : public testing::TestWithParam<const char*> {
 protected:
  fs::path run(const std::string& name, const std::string& arguments, int ranks = 1) const {
    const fs::path folder = folder_ / name;
    fs::create_directories(folder);
    std::string command =
        std::string(SLUICE_COMMAND) + " run -o " + folder.string() + " " + arguments;
    if (ranks > 1)
      command = std::string(SLUICE_MPIEXEC) + " --allow-run-as-root --oversubscribe -np " +
                std::to_string(ranks) + " " + command;
    const Outcome outcome = run_in_shell(command);
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.is_directory() && !entry.is_symlink()) return entry.path();
    ADD_FAILURE() << "no archive";
    return {};
  }
  static void expect_same(const fs::path& a, const fs::path& b) {
    const Outcome outcome = run_in_shell(std::string(SLUICE_COMMAND) + " compare --common-times " +
                                         a.string() + " " + b.string());
    EXPECT_EQ(outcome.status, 0) << outcome.text;
  }

  TemporaryFolder folder_;
};

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
                         testing::Values("disk_in_dye", "across_periodic_sides"));

}  // namespace
}  // namespace sluice::coupled_bits_test
