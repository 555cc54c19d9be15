// Runs of solids whose state is more than places and stresses: corners that particles carry are the
// same bits on several ranks and boxes, and after a restart.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "app/command_test_support.hpp"
#include "framework/base/temporary_folder.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::solid_bits_test {
namespace {

namespace fs = std::filesystem;

class SolidBits : public testing::Test {
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
