// The machine fails: full disk, limited files, read-only folder, a kill in the middle, two runs at
// once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cstdlib>
#include <functional>

#include <random>
#include <set>
#include <thread>

#include "framework/archive/archive_test_support.hpp"
#include "framework/base/error.hpp"

namespace sluice::archive_failure_test {
namespace {

using namespace archive_test;
using ::testing::AnyOf;
using ::testing::HasSubstr;

// A memory disk of a given size; only root may make one.
class TinyDisk {
 public:
  TinyDisk(const fs::path& place, const char* options) : place_(place) {
    fs::create_directories(place);
    mounted_ = ::mount("tmpfs", place.c_str(), "tmpfs", 0, options) == 0;
  }
  ~TinyDisk() {
    if (mounted_) ::umount2(place_.c_str(), MNT_DETACH);
  }
  bool mounted() const { return mounted_; }
  void grow() const {
    EXPECT_EQ(::mount(nullptr, place_.c_str(), nullptr, MS_REMOUNT, "size=4m"), 0);
  }

 private:
  fs::path place_;
  bool mounted_ = false;
};

void write_one(ArchiveWriter& writer, int step, const Grid& grid, Fields& fields) {
  writer.write_output({step, 0.1 * step, 0.1, 0.1, {}}, grid, fields.pieces());
}

std::int64_t count_good(const fs::path& archive) {
  const Archive a = Archive::open(archive);
  std::int64_t values = 0;
  for (const StepEntry& e : a.outputs()) {
    const ArchiveStep step = a.read_output(e);
    EXPECT_EQ(step.info().step, e.step);
    EXPECT_THAT(step.verify(values), ::testing::IsEmpty());
  }
  return static_cast<std::int64_t>(a.outputs().size());
}

// Sizes from "the values do not fit" to "only the structure does not fit".
TEST(ArchiveFailure, ADiskThatIsFullLeavesTheArchiveGood) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({24, 20, 10}, {2, 1, 1});
  for (const int kib : {100, 140, 144, 148, 152, 156, 160, 200, 236, 240, 244, 400}) {
    const TinyDisk disk(folder.path() / std::to_string(kib),
                        ("size=" + std::to_string(kib) + "k").c_str());
    if (!disk.mounted()) GTEST_SKIP() << "mounting a memory disk is not permitted here";
    ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path() / std::to_string(kib)));
    Fields fields;
    fields.add(grid.levels[0], real_label("press_CC"), 0, wavy);
    int step = 0;
    std::string message;
    while (message.empty() && step < 50) {
      try {
        writer.history("TotalMass", -1, step + 1, 0.1, 1.0);
        write_one(writer, step + 1, grid, fields);
        ++step;
      } catch (const SystemError& e) {
        message = e.what();
      }
    }
    EXPECT_THAT(message, HasSubstr("No space left on device")) << kib;
    EXPECT_THAT(message, HasSubstr("37.5 KiB")) << kib;
    EXPECT_THAT(message, HasSubstr("remains valid")) << kib;
    EXPECT_EQ(count_good(writer.folder()), step) << kib;
    EXPECT_FALSE(fs::exists(writer.folder() / (step_folder_name(step + 1) + ".partial")));
    EXPECT_FALSE(fs::exists(writer.folder() / step_folder_name(step + 1)));
    // With room again the run could go on.
    disk.grow();
    EXPECT_NO_THROW(write_one(writer, step + 1, grid, fields)) << kib;
  }
}

// Writes a few steps and ends as a program does, with the clean-up of all libraries.
[[noreturn]] void write_and_exit(const fs::path& parent, bool gzip) {
  try {
    const Grid grid = make_grid({24, 20, 10}, {2, 1, 1});
    Fields fields;
    for (const char* label : {"press_CC", "rho_CC", "temp_CC"})
      fields.add(grid.levels[0], real_label(label), 0, wavy);
    for (FieldPiece& piece : fields.pieces()) piece.gzip = gzip;
    ArchiveWriter writer = ArchiveWriter::create(setup_in(parent));
    for (int step = 1; step <= 3; ++step) write_one(writer, step, grid, fields);
  } catch (const SystemError& e) {
    std::exit(static_cast<int>(e.status()));
  }
  std::exit(0);
}

// 0 or 3: as it wrote all or not; negative: the signal that ended it.
int status_of_writing(const fs::path& parent, bool gzip, rlim_t most_bytes = RLIM_INFINITY) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{most_bytes, most_bytes};
    if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) ::_exit(100);
    write_and_exit(parent, gzip);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

// The disk is full at any byte of a file: in HDF5's structures, in values, in our own files.
TEST(ArchiveFailure, WhereverAFileIsCutTheProgramEndsInOrder) {
  const TemporaryFolder folder;
  for (const bool gzip : {false, true}) {
    std::vector<int> statuses;
    for (int kib = 0; kib < 150; kib += kib < 8 ? 1 : 14)
      statuses.push_back(status_of_writing(folder.path(), gzip, static_cast<rlim_t>(kib * 1024)));
    EXPECT_THAT(statuses, ::testing::Each(AnyOf(3, 0)));
    EXPECT_TRUE(std::is_sorted(statuses.rbegin(), statuses.rend())) << "first all 3, then all 0";
    EXPECT_EQ(statuses.front(), 3);
    EXPECT_EQ(statuses.back(), 0);
  }
}

TEST(ArchiveFailure, WheneverTheDiskIsFullTheProgramEndsInOrder) {
  const TemporaryFolder folder;
  std::vector<int> statuses;
  for (int kib = 12; kib < 500; kib += kib < 60 ? 4 : 36) {
    const fs::path place = folder.path() / std::to_string(kib);
    const TinyDisk disk(place, ("size=" + std::to_string(kib) + "k").c_str());
    if (!disk.mounted()) GTEST_SKIP() << "mounting a memory disk is not permitted here";
    statuses.push_back(status_of_writing(place, kib % 8 != 0));
  }
  EXPECT_THAT(statuses, ::testing::Each(AnyOf(3, 0)));
  EXPECT_EQ(statuses.front(), 3);
  EXPECT_EQ(statuses.back(), 0);
}

// Each takes milliseconds, whatever is written.
TEST(ArchiveFlushes, AreTwoAStep) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({24, 20, 10}, {2, 1, 1});
  Fields fields;
  fields.add(grid.levels[0], real_label("press_CC"), 0, wavy);
  std::int64_t before = flush_count();
  ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
  EXPECT_EQ(flush_count() - before, 1);
  for (int step = 1; step < 5; ++step) {
    for (const char* name : {"TotalMass", "KineticEnergy", "TotalIntEng"})
      writer.history(name, -1, step, 0.1, 1.0);
    before = flush_count();
    write_one(writer, step, grid, fields);
    EXPECT_EQ(flush_count() - before, 2) << step;
    writer.write_checkpoint({step, 0.1 * step, 0.1, 0.1, {}}, grid, fields.pieces());
    EXPECT_EQ(flush_count() - before, 4) << step;
  }
  before = flush_count();
  writer.write_text("run.json", "{}");
  writer.finish();
  EXPECT_LE(flush_count() - before, 3);
}

TEST(ArchiveFailure, ADiskFullFromTheStartIsLeftClean) {
  const TemporaryFolder folder;
  const fs::path place = folder.path() / "disk";
  const TinyDisk disk(place, "size=64k");
  if (!disk.mounted()) GTEST_SKIP() << "mounting a memory disk is not permitted here";
  std::ofstream(place / "filler") << std::string(64 * 1024, 'x');
  EXPECT_THROW(ArchiveWriter::create(setup_in(place)), SystemError);
  EXPECT_EQ(std::distance(fs::directory_iterator(place), fs::directory_iterator()), 1);
}

TEST(ArchiveFailure, FolderThatCannotBeWritten) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "file") << "x";
  auto message_of = [&](const fs::path& parent) {
    try {
      ArchiveWriter::create(setup_in(parent));
    } catch (const SystemError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(message_of(folder.path() / "file" / "below"), HasSubstr("Not a directory"));
  EXPECT_THAT(message_of("/proc/self"), HasSubstr("/proc/self/box.uda.000"));
  const TinyDisk disk(folder.path() / "ro", "size=1m,mode=555");
  if (!disk.mounted() ||
      ::mount(nullptr, (folder.path() / "ro").c_str(), nullptr, MS_REMOUNT | MS_RDONLY, nullptr))
    GTEST_SKIP() << "mounting a memory disk is not permitted here";
  EXPECT_THAT(message_of(folder.path() / "ro"), HasSubstr("Read-only file system"));
  EXPECT_THAT(message_of(folder.path() / "ro"), HasSubstr("-o DIR"));
}

// A run that writes steps 1 and 2 and a checkpoint; then `lose` takes something away.
std::string message_when_gone(const std::function<void(const fs::path& archive)>& lose,
                              const std::function<void(ArchiveWriter&)>& go_on) {
  const TemporaryFolder folder;
  const Grid grid = make_grid({6, 4, 2}, {2, 1, 1});
  Fields fields;
  fields.add(grid.levels[0], real_label("press_CC"), 0, wavy);
  ArchiveSetup setup = setup_in(folder.path());
  setup.other_decks["input_1.xml"] = "<Uintah_specification/>\n";
  ArchiveWriter writer = ArchiveWriter::create(setup);
  for (int step = 1; step <= 2; ++step) write_one(writer, step, grid, fields);
  writer.write_checkpoint({2, 0.2, 0.1, 0.1, {}}, grid, fields.pieces());
  lose(writer.folder());
  try {
    go_on(writer);
  } catch (const SystemError& e) {
    return e.what();
  }
  return "no error";
}

TEST(ArchiveFailure, WhatIsGoneIsNamedAtTheNextStep) {
  const Grid grid = make_grid({6, 4, 2}, {2, 1, 1});
  Fields fields;
  fields.add(grid.levels[0], real_label("press_CC"), 0, wavy);
  const auto output = [&](ArchiveWriter& w) { write_one(w, 3, grid, fields); };
  const auto checkpoint = [&](ArchiveWriter& w) {
    w.write_checkpoint({3, 0.3, 0.1, 0.1, {}}, grid, fields.pieces());
  };
  const auto end = [](ArchiveWriter& w) { w.finish(); };
  for (const std::function<void(ArchiveWriter&)>& go_on :
       {std::function<void(ArchiveWriter&)>(output), {checkpoint}, {end}}) {
    for (const char* name : {"input.xml", "input_1.xml", "t00001", "t00002/timestep.xml",
                             "checkpoints/t00002", "checkpoints"}) {
      const std::string message = message_when_gone(
          [&](const fs::path& archive) { fs::remove_all(archive / name); }, go_on);
      EXPECT_THAT(message, HasSubstr("is gone")) << name;
      EXPECT_THAT(message, HasSubstr(std::string("box.uda.000/") + name)) << name;
    }
    for (const bool replaced : {false, true}) {
      const std::string message = message_when_gone(
          [&](const fs::path& archive) {
            fs::rename(archive, archive.string() + ".moved");
            if (replaced)
              fs::copy(archive.string() + ".moved", archive, fs::copy_options::recursive);
          },
          go_on);
      EXPECT_THAT(message, HasSubstr("box.uda.000 is gone (the folder of the archive)"));
    }
    EXPECT_EQ(message_when_gone([](const fs::path&) {}, go_on), "no error");
  }
}

// As an ordinary user, whom permissions bind, in a folder of somebody else.
TEST(ArchiveFailure, FolderOfSomebodyElse) {
  const TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    if (::getuid() == 0 && ::setuid(65534) != 0) ::_exit(2);
    try {
      ArchiveWriter::create(setup_in(folder.path()));
    } catch (const SystemError& e) {
      const std::string message = e.what();
      const bool good = message.find("Permission denied") != message.npos &&
                        message.find("-o DIR") != message.npos;
      ::_exit(good ? 0 : 1);
    }
    ::_exit(1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  fs::permissions(folder.path(), fs::perms::owner_all);
}

TEST(ArchiveFailure, RunsStartedAtOnceGetTheirOwnFolders) {
  const TemporaryFolder folder;
  constexpr int runs = 12;
  std::vector<fs::path> made(runs);
  std::vector<std::thread> threads;
  for (std::size_t n = 0; n < runs; ++n)
    threads.emplace_back(
        [&, n] { made[n] = ArchiveWriter::create(setup_in(folder.path())).folder(); });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(std::set<fs::path>(made.begin(), made.end()).size(), static_cast<std::size_t>(runs));
  for (const fs::path& path : made) EXPECT_NO_THROW(Archive::open(path));
  EXPECT_NO_THROW(Archive::open(folder.path() / "box.uda"));
}

[[noreturn]] void write_until_killed(const fs::path& parent) {
  const Grid grid = make_grid({20, 10, 5}, {2, 1, 1});
  ArchiveWriter writer = ArchiveWriter::create(setup_in(parent));
  Fields fields;
  fields.add(grid.levels[0], real_label("press_CC"), 0, wavy);
  for (int step = 1;; ++step) {
    writer.history("TotalMass", -1, step, 0.1 * step, 1.0);
    write_one(writer, step, grid, fields);
    writer.write_checkpoint({step, 0.1 * step, 0.1, 0.1, {}}, grid, fields.pieces());
  }
}

void kill_at_random_moments(unsigned seed, int kills) {
  std::mt19937 random(seed);
  for (int kill_number = 0; kill_number < kills; ++kill_number) {
    const TemporaryFolder folder;
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) write_until_killed(folder.path());
    std::this_thread::sleep_for(std::chrono::microseconds(10000 + random() % 150000));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    const fs::path path = folder.path() / "box.uda.000";
    if (!fs::exists(path / "index.xml")) continue;  // killed before there was an archive
    count_good(path);
    const Archive a = Archive::open(path);
    EXPECT_THAT(a.damage(), ::testing::IsEmpty());
    if (a.checkpoints().empty()) continue;
    const int step = a.select_checkpoint().step;
    std::int64_t values = 0;
    EXPECT_THAT(a.read_checkpoint(a.select_checkpoint()).verify(values), ::testing::IsEmpty());
    EXPECT_EQ(values, 1000);
    // And a new archive continues it: its history has a line for every step up to the checkpoint.
    ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
    writer.adopt(path, step, Earlier::refer);
    const std::string text = read_text(writer.folder() / "TotalMass.dat");
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), step);
  }
}

TEST(ArchiveFailure, KilledAtRandomMomentsNothingIndexedIsHarmed) {
  kill_at_random_moments(2, 8);
}
TEST(ArchiveFailure, FullKilledAtRandomMomentsNothingIndexedIsHarmed) {
  kill_at_random_moments(3, 25);
}

}  // namespace
}  // namespace sluice::archive_failure_test
