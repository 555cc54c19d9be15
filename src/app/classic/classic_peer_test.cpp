// The tools on archives of the public suite, against what its own tools have printed of them.
//
// SLUICE_PEER_ARCHIVES names the folder of shock.uda.000, disks.uda.000 and amr.uda.000 and of
// these outputs; without it the tests are skipped.
#include <gmock/gmock.h>

#include <algorithm>

#include "app/classic/classic_test_support.hpp"
#include "app/command/command_test_support.hpp"
#include "framework/archive/archive.hpp"
#include "framework/base/test_support/environment.hpp"

namespace sluice::classic_peer_test {
namespace {

using namespace classic_test;

class ClassicPeer : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto folder = folder_in_environment("SLUICE_PEER_ARCHIVES");
    if (!folder) GTEST_SKIP() << "SLUICE_PEER_ARCHIVES is not set: no archives of the public suite";
    folder_ = *folder;
  }
  std::string archive(const char* name) const { return (folder_ / name).string(); }
  // Lines of a file of theirs from the one after `head` on, which is a comment; `count` < 0: up to
  // the next comment or the end.
  std::vector<std::string> printed(const char* file, const std::string& head) const {
    std::vector<std::string> lines;
    bool inside = false;
    for (const std::string& line : lines_of(text_of(folder_ / file))) {
      if (line.starts_with("# "))
        inside = line.starts_with("# " + head);
      else if (inside)
        lines.push_back(line);
    }
    EXPECT_FALSE(lines.empty()) << head;
    return lines;
  }
  // As many lines as theirs, of which some files hold the first only.
  static std::vector<std::string> beginning(const Said& said, std::size_t count) {
    std::vector<std::string> lines = lines_of(said.output);
    lines.resize(std::min(lines.size(), count));
    return lines;
  }

  fs::path folder_;
};

TEST_F(ClassicPeer, PudaOfTheDisks) {
  const std::string disks = archive("disks.uda.000");
  EXPECT_EQ(lines_of(call_tool("puda", {"-timesteps", disks}).output),
            printed("disks_puda.txt", "puda -timesteps"));
  EXPECT_EQ(lines_of(call_tool("puda", {"-listvariables", disks}).output),
            printed("disks_puda.txt", "puda -listvariables"));
  const auto grid = printed("disks_puda.txt", "puda -gridstats");
  EXPECT_EQ(beginning(call_tool("puda", {"-gridstats", disks}), grid.size()), grid);
  auto stress = printed("disks_puda.txt", "puda -partvar p.stress");
  // They say for each patch that particles have no numbers.
  std::erase_if(stress, [](const std::string& l) { return l.starts_with("VARIABLE NOT FOUND"); });
  const Said said =
      call_tool("puda", {"-partvar", "p.stress", "-timesteplow", "2", "-timestephigh", "2", disks});
  EXPECT_EQ(beginning(said, stress.size()), stress);
  EXPECT_EQ(lines_of(said.output).size(), 832U);
}

TEST_F(ClassicPeer, LineExtractOfTheShockTube) {
  auto theirs = printed("shock_lineextract.txt", "lineextract");
  // That line was on their standard error.
  std::erase_if(theirs, [](const std::string& l) { return l.starts_with("%outputting"); });
  EXPECT_EQ(lines_of(call_tool("lineextract",
                               {"-v", "rho_CC", "-m", "0", "-timestep", "2", "-istart", "0", "0",
                                "0", "-iend", "99", "0", "0", "-uda", archive("shock.uda.000")})
                         .output),
            theirs);
}

TEST_F(ClassicPeer, TimeExtractAndComparisonOfTheShockTube) {
  EXPECT_EQ(lines_of(call_tool("timeextract", {"-v", "press_CC", "-i", "50", "0", "0", "-uda",
                                               archive("shock.uda.000")})
                         .output),
            printed("shock_timeextract_compare.txt", "timeextract"));
  auto theirs = printed("shock_timeextract_compare.txt", "compare_uda");
  ASSERT_EQ(theirs.back(), "exit 0");
  theirs.pop_back();
  const Said same = call_tool("compare_uda", {archive("shock.uda.000"), archive("shock.uda.000")});
  EXPECT_EQ(same.status, 0);
  EXPECT_EQ(lines_of(same.output), theirs);
}

TEST_F(ClassicPeer, GridOfFiveLevels) {
  auto theirs = lines_of(text_of(folder_ / "amr_lineextract.txt"));
  theirs.erase(theirs.begin(),
               std::find(theirs.begin(), theirs.end(), "__________________________________"));
  ASSERT_GT(theirs.size(), 60U);
  EXPECT_EQ(beginning(call_tool("puda", {"-gridstats", archive("amr.uda.000")}), theirs.size()),
            theirs);
  // No cell of level 1 lies in the plane k = 0.
  const Said outside =
      call_tool("lineextract", {"-v", "rho_CC", "-l", "1", "-timestep", "1", "-iend", "60", "30",
                                "0", "-uda", archive("amr.uda.000")});
  EXPECT_EQ(outside.status, 1);
  EXPECT_NE(outside.error.find("Could not find any patches on Level 1 that contain cells along "
                               "line: [int 0, 0, 0] and [int 60, 30, 0]"),
            std::string::npos);
}

// Every byte of every output and checkpoint, and what their checkpoints hold beyond outputs.
TEST_F(ClassicPeer, AllIsReadAndNumbersAreThoseOfTheFirstCells) {
  for (const char* name : {"shock.uda.000", "disks.uda.000", "amr.uda.000"})
    EXPECT_EQ(call_tool("validateUda", {archive(name)}).status, 0) << name;
  const Archive disks = Archive::open(archive("disks.uda.000"));
  const ArchiveStep step = disks.read_checkpoint(disks.select_checkpoint());
  const auto ids = step.read_particle_integers(*step.find_particles("p.particleID", 0, 0));
  ASSERT_EQ(ids.size(), 832U);
  EXPECT_EQ(ids.front(), 281479271809024);
  EXPECT_GT(step.info().next_delt, 1e-4);
  EXPECT_LT(step.info().next_delt, 2e-4);
}

// A run of their deck: both are read together, and its disks pair with theirs one to one.
TEST_F(ClassicPeer, DisksPairWithThoseOfARun) {
  const TemporaryFolder here;
  const Outcome run = run_sluice({"run", archive("disks.uda.000/disks.ups"), "-o",
                                  here.path().string(), "--progress", "none"});
  ASSERT_EQ(run.status, 0) << run.text;
  const Outcome compared = run_sluice(
      {"compare", archive("disks.uda.000"), (here / "disks.uda").string(), "--vars", "p.x"});
  EXPECT_EQ(compared.status, 1);
  EXPECT_NE(compared.text.find("832 of 832 and 832 paired by place"), std::string::npos)
      << compared.text;
  // After the collision too, places differ by less than a tenth of the distance of particles.
  const Outcome close =
      run_sluice({"compare", archive("disks.uda.000"), (here / "disks.uda").string(), "--vars",
                  "p.x", "--abs", "0.0025"});
  EXPECT_EQ(close.status, 0) << close.text;
}

}  // namespace
}  // namespace sluice::classic_peer_test
