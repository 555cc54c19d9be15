// Continuing archives: dropped steps, cut histories, adopted outputs, kept checkpoints, locks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/archive/archive_test_support.hpp"
#include "framework/archive/posix_file.hpp"
#include "framework/base/error.hpp"

namespace sluice::archive_restart_test {
namespace {

using namespace archive_test;
using ::testing::ElementsAre;

std::vector<int> steps_of(const std::vector<StepEntry>& entries) {
  std::vector<int> steps;
  for (const StepEntry& e : entries) steps.push_back(e.step);
  return steps;
}

// Writes steps first to last: an output each, a checkpoint at every even step.
void write_steps(ArchiveWriter& writer, int first, int last) {
  const Grid grid = make_grid({4, 3, 1}, {1, 1, 1});
  for (int step = first; step <= last; ++step) {
    Fields fields;
    fields.add(grid.levels[0], real_label("press_CC"), 0,
               [&](IntVec3 c, int) { return step + 0.1 * c.x; });
    writer.history("TotalMass", -1, step, 0.1 * step, 1.0 / step);
    writer.history("Momentum", 2, step, 0.1 * step, Vec3{1, 2.5, -step / 3.0});
    const StepInfo info{step, 0.1 * step, 0.1, 0.1, {}};
    writer.write_output(info, grid, fields.pieces());
    if (step % 2 == 0) writer.write_checkpoint(info, grid, fields.pieces());
  }
  writer.finish();
}

std::string dat(const ArchiveWriter& writer) {
  return read_text(writer.folder() / "TotalMass.dat");
}

TEST(ArchiveRestart, NumbersAndLink) {
  const TemporaryFolder folder;
  for (int n = 0; n < 3; ++n)
    EXPECT_EQ(ArchiveWriter::create(setup_in(folder.path())).folder().filename(),
              "box.uda.00" + std::to_string(n));
  EXPECT_EQ(fs::read_symlink(folder.path() / "box.uda"), "box.uda.002");
  fs::remove_all(folder.path() / "box.uda.001");
  EXPECT_EQ(ArchiveWriter::create(setup_in(folder.path())).folder().filename(), "box.uda.001");
  EXPECT_EQ(fs::read_symlink(folder.path() / "box.uda"), "box.uda.001");
  // What stands in the link's place and is no link is kept; that is said.
  fs::remove(folder.path() / "box.uda");
  std::ofstream(folder.path() / "box.uda") << "notes";
  const ArchiveWriter beside_file = ArchiveWriter::create(setup_in(folder.path()));
  ASSERT_EQ(beside_file.warnings().size(), 1u);
  EXPECT_THAT(beside_file.warnings()[0], ::testing::HasSubstr("box.uda is a file and is kept"));
  EXPECT_EQ(read_text(folder.path() / "box.uda"), "notes");
  fs::remove(folder.path() / "box.uda");
  fs::create_directory(folder.path() / "box.uda");
  const ArchiveWriter beside_folder = ArchiveWriter::create(setup_in(folder.path()));
  EXPECT_EQ(beside_folder.warnings().size(), 1u);
  EXPECT_TRUE(fs::is_directory(folder.path() / "box.uda"));
}

TEST(ArchiveRestart, FilesOfTheDeckAreKept) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "a.tab") << "1 2\n";
  ArchiveSetup setup = setup_in(folder.path());
  setup.kept_files = {{"input_files/a.tab", folder.path() / "a.tab"}};
  const ArchiveWriter writer = ArchiveWriter::create(setup);
  EXPECT_EQ(read_text(writer.folder() / "input_files/a.tab"), "1 2\n");
  // Nothing is left of an archive whose files have gone.
  setup.kept_files = {{"input_files/b.tab", folder.path() / "b.tab"}};
  EXPECT_THROW(ArchiveWriter::create(setup), SystemError);
  EXPECT_FALSE(fs::exists(folder.path() / "box.uda.001"));
}

TEST(ArchiveRestart, AStepOfAnArchiveThatIsMissingNamesIt) {
  const TemporaryFolder folder;
  const StepEntry step{4, 0.4, 0.1, "../box.uda.000/t00004/timestep.xml"};
  const fs::path archive = folder.path() / "box.uda.001";
  try {
    require_referenced_archive(step, archive);
    ADD_FAILURE() << "nothing is thrown";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("step 4 is in the archive " +
                                               (folder.path() / "box.uda.000").string()));
  }
  fs::create_directory(folder.path() / "box.uda.000");
  std::ofstream(folder.path() / "box.uda.000/index.xml") << "there";
  EXPECT_NO_THROW(require_referenced_archive(step, archive));
  EXPECT_NO_THROW(require_referenced_archive({4, 0.4, 0.1, "t00004/timestep.xml"}, archive));
}

TEST(ArchiveRestart, CheckpointCycleKeepsTheNewest) {
  const TemporaryFolder folder;
  ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
  write_steps(writer, 1, 9);
  EXPECT_THAT(steps_of(Archive::open(writer.folder()).checkpoints()), ElementsAre(6, 8));
  EXPECT_FALSE(fs::exists(writer.folder() / "checkpoints" / "t00004"));
  ArchiveSetup all = setup_in(folder.path());
  all.checkpoint_cycle = 0;
  ArchiveWriter keeper = ArchiveWriter::create(all);
  write_steps(keeper, 1, 9);
  EXPECT_THAT(steps_of(Archive::open(keeper.folder()).checkpoints()), ElementsAre(2, 4, 6, 8));
}

TEST(ArchiveRestart, NewArchiveAdoptsTheEarlierOutputs) {
  const TemporaryFolder folder;
  fs::path old_path;
  {
    ArchiveWriter old = ArchiveWriter::create(setup_in(folder.path()));
    write_steps(old, 1, 5);
    old_path = old.folder();
  }
  for (const Earlier mode : {Earlier::stamp_only, Earlier::refer, Earlier::copy}) {
    ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
    writer.adopt(old_path, 4, mode);
    write_steps(writer, 5, 6);
    const Archive a = Archive::open(writer.folder());
    ASSERT_EQ(a.index().restarts.size(), 1u);
    EXPECT_EQ(a.index().restarts[0].from, old_path.filename());
    if (mode == Earlier::stamp_only) {
      EXPECT_THAT(steps_of(a.outputs()), ElementsAre(5, 6));
      continue;
    }
    ASSERT_THAT(steps_of(a.outputs()), ElementsAre(1, 2, 3, 4, 5, 6));
    EXPECT_EQ(fs::exists(writer.folder() / "t00001"), mode == Earlier::copy);
    for (int n = 0; n < 6; ++n) {
      const ArchiveStep step = a.read_output(a.outputs()[n]);
      EXPECT_EQ(step.read(*step.find("press_CC", 0, 0)).at({2, 1, 0}), n + 1 + 0.2);
    }
    const std::string text = dat(writer);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 6);
  }
}

// Killed after a checkpoint and before the next output: only the checkpoints' index names them.
TEST(ArchiveRestart, HistoriesGoOnAfterAKillBetweenCheckpointAndOutput) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({4, 3, 1}, {1, 1, 1});
  fs::path old_path;
  {
    ArchiveWriter old = ArchiveWriter::create(setup_in(folder.path()));
    old.write_output({0, 0, 0.1, 0.1, {}}, grid, {});
    const std::string index = read_text(old.folder() / "index.xml");
    old.history("TotalMass", -1, 1, 0.1, 1.0);
    old.write_checkpoint({1, 0.1, 0.1, 0.1, {}}, grid, {});
    EXPECT_EQ(read_text(old.folder() / "index.xml"), index);
    old_path = old.folder();
  }
  ASSERT_TRUE(Archive::open(old_path).index().histories.empty());
  ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
  writer.adopt(old_path, 1, Earlier::refer);
  write_steps(writer, 2, 3);
  const std::string text = dat(writer);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
}

TEST(ArchiveRestart, OneWriterAtATime) {
  const TemporaryFolder folder;
  ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
  write_steps(writer, 1, 2);
  try {
    const FolderLock second(writer.folder());
    FAIL();
  } catch (const SystemError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("another run is writing"));
  }
}

TEST(ArchiveRestart, AStepWrittenAgainReplacesItself) {
  const TemporaryFolder folder;
  ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
  write_steps(writer, 1, 2);
  write_steps(writer, 2, 2);
  EXPECT_THAT(steps_of(Archive::open(writer.folder()).outputs()), ElementsAre(1, 2));
}

}  // namespace
}  // namespace sluice::archive_restart_test
