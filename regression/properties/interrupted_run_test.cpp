// What happens to a run from outside: signals, limits, a second run, a full disk, too many ranks.
//
// Each by the command itself, as a user or a batch system would.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/process/study_process.hpp"
#include "framework/archive/archive.hpp"
#include "properties/deck_run.hpp"
#include "properties/shell_run.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::properties::interrupted_run_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string deck = SLUICE_SOURCE_DIR "/inputs/ice/explosion_2d.ups";

// Long enough to be met in the middle.
const char* const control =
    " --progress none --set DataArchiver/outputTimestepInterval=20"
    " --set DataArchiver/checkpoint/@timestepInterval=20 --set Time/max_Timesteps=240 --set "
    "Time/maxTime=1000";

struct Shell {
  int status = 0;
  std::string said;
};

Shell shell(const fs::path& folder, const std::string& script) {
  ProcessRequest request;
  request.words = {"/bin/sh", "-c", "cd '" + folder.string() + "'\n" + script};
  request.environment = {"OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"};
  request.output = folder / "log";
  Shell s;
  s.status = run_process(request);
  s.said = last_lines(request.output, 30);
  return s;
}

std::string run_command() {
  return std::string(SLUICE_COMMAND) + " run " + deck + control;
}

std::size_t expect_undamaged(const fs::path& folder) {
  const Archive archive = Archive::open(folder);
  std::int64_t values = 0;
  for (const StepEntry& e : archive.outputs())
    EXPECT_THAT(archive.read_output(e).verify(values), IsEmpty());
  for (const StepEntry& e : archive.checkpoints())
    EXPECT_THAT(archive.read_checkpoint(e).verify(values), IsEmpty());
  return archive.outputs().size();
}

class InterruptedRun : public testing::Test {
 protected:
  // The run that nobody disturbs.
  static fs::path whole(const fs::path& folder) {
    const Shell s = shell(folder, run_command());
    EXPECT_EQ(s.status, 0) << s.said;
    return folder / "explosion_2d.uda";
  }
  // Goes on from an archive to the end and compares.
  static void expect_goes_on(const fs::path& folder, const fs::path& cut, const fs::path& reference,
                             const std::string& how = SLUICE_COMMAND) {
    const Shell s = shell(folder, how + " run --restart '" + cut.string() +
                                      "' -o rest --progress none --json rest.json");
    EXPECT_EQ(s.status, 0) << s.said;
    const fs::path rest = folder / "rest" / "explosion_2d.uda";
    EXPECT_EQ(difference(reference, rest, false, true), "");
    EXPECT_EQ(Archive::open(rest).outputs().back().step, 240);
  }
  static const std::string start_and_wait;
  ScratchFolder scratch_;
};

// Starts a run and goes on when its second output is there.
const std::string InterruptedRun::start_and_wait =
    run_command() +
    " --json run.json &\npid=$!\n"
    "until [ -e explosion_2d.uda/t00020/timestep.xml ]; do sleep 0.01; done\n";

TEST_F(InterruptedRun, SigtermEndsWithACheckpointAndARestartGivesTheSameBits) {
  const fs::path reference = whole(scratch_ / "whole");
  const fs::path folder = scratch_ / "cut";
  fs::create_directories(folder / "rest");
  const Shell s = shell(folder, start_and_wait + "kill -TERM $pid; wait $pid");
  EXPECT_EQ(s.status, 4) << s.said;
  const nlohmann::json run = record(folder / "run.json");
  EXPECT_EQ(run["status"], "terminated");
  const int reached = Archive::open(folder / "explosion_2d.uda").checkpoints().back().step;
  EXPECT_EQ(run["steps"], reached);  // a checkpoint of the very last step
  EXPECT_LT(reached, 240);
  expect_undamaged(folder / "explosion_2d.uda");
  expect_goes_on(folder, folder / "explosion_2d.uda", reference);
}

// Open MPI's launcher passes SIGUSR1 on to all ranks and leaves them their time.
TEST_F(InterruptedRun, Sigusr1ToTheLauncherEndsAllRanksWithACheckpoint) {
  const fs::path reference = whole(scratch_ / "whole");
  const fs::path folder = scratch_ / "cut";
  fs::create_directories(folder / "rest");
  const Shell s = shell(folder, SLUICE_MPIEXEC " --oversubscribe -np 2 " + start_and_wait +
                                    "kill -USR1 $pid; wait $pid");
  EXPECT_EQ(s.status, 4) << s.said;
  EXPECT_EQ(record(folder / "run.json")["status"], "terminated");
  expect_undamaged(folder / "explosion_2d.uda");
  expect_goes_on(folder, folder / "explosion_2d.uda", reference);
}

TEST_F(InterruptedRun, TheWallLimitEndsWithACheckpointAndARestartOnTwoRanksGivesTheSameBits) {
  const fs::path reference = whole(scratch_ / "whole");
  const fs::path folder = scratch_ / "cut";
  fs::create_directories(folder / "rest");
  const Shell s = shell(folder, run_command() + " --wall-limit 1e-6 --json run.json");
  EXPECT_EQ(s.status, 4) << s.said;
  const nlohmann::json run = record(folder / "run.json");
  EXPECT_EQ(run["status"], "wall_limit");
  EXPECT_EQ(Archive::open(folder / "explosion_2d.uda").checkpoints().back().step, run["steps"]);
  expect_goes_on(folder, folder / "explosion_2d.uda", reference,
                 SLUICE_MPIEXEC " --oversubscribe -np 2 " SLUICE_COMMAND);
}

TEST_F(InterruptedRun, MaxStepsEndsThere) {
  const fs::path folder = scratch_ / "run";
  const Shell s = shell(folder, run_command() + " --max-steps 7 --json run.json");
  EXPECT_EQ(s.status, 0) << s.said;
  const nlohmann::json run = record(folder / "run.json");
  EXPECT_EQ(run["status"], "max_steps");
  EXPECT_EQ(run["steps"], 7);
}

TEST_F(InterruptedRun, TwoRunsAtOnceInOneFolderGetAnArchiveEach) {
  const fs::path folder = scratch_ / "both";
  const std::string run = run_command() + " --max-steps 40";
  const Shell s = shell(folder, run + " & a=$!\n" + run + " & b=$!\nwait $a && wait $b");
  EXPECT_EQ(s.status, 0) << s.said;
  EXPECT_EQ(difference(folder / "explosion_2d.uda.000", folder / "explosion_2d.uda.001", false),
            "");
  EXPECT_EQ(difference(folder / "explosion_2d.uda.000", folder / "explosion_2d.uda.001", true), "");
  EXPECT_FALSE(fs::exists(folder / "explosion_2d.uda.002"));
}

TEST_F(InterruptedRun, AFullDiskEndsWithStatus3AndAGoodArchive) {
  const fs::path folder = scratch_ / "disk", place = folder / "small";
  fs::create_directories(place);
  if (::mount("tmpfs", place.c_str(), "tmpfs", 0, "size=3m") != 0)
    GTEST_SKIP() << "mounting a memory disk is not permitted here";
  const Shell s = shell(folder, run_command() + " -o small");
  EXPECT_EQ(s.status, 3) << s.said;
  EXPECT_THAT(s.said, HasSubstr("No space left on device"));
  EXPECT_GE(expect_undamaged(place / "explosion_2d.uda"), 1u);
  ::umount2(place.c_str(), MNT_DETACH);
}

TEST_F(InterruptedRun, MoreRanksThanCellsAreRefused) {
  const fs::path folder = scratch_ / "ranks";
  const Shell s = shell(folder, SLUICE_MPIEXEC " --oversubscribe -np 3 " SLUICE_COMMAND " run " +
                                    std::string(SLUICE_SOURCE_DIR "/inputs/ice/riemann_sod.ups") +
                                    " --progress none --set 'Grid/Level/Box/resolution=[2,1,1]'");
  EXPECT_EQ(s.status, 2) << s.said;
  EXPECT_THAT(s.said, testing::AllOf(HasSubstr("3 ranks"), HasSubstr("only 2 boxes")));
}

}  // namespace
}  // namespace sluice::properties::interrupted_run_test
