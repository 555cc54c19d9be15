// sluice plot as a user meets it: pictures of a small archive, and its answers to what is missing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "app/command/command_test_support.hpp"
#include "framework/archive/archive_test_support.hpp"

namespace sluice::plot_command_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

// A tube of ten cells at t = 0.2 whose deck names Sod's exact solution.
class Plot : public ::testing::Test {
 protected:
  void SetUp() override {
    ArchiveSetup setup = archive_test::setup_in(folder_.path());
    setup.deck_xml = R"(<Uintah_specification><Meta><title>A small tube</title>
        <exact_solution type="riemann"><left>[1, 0, 1]</left><right>[0.125, 0, 0.1]</right>
        <position>0.5</position><gamma>1.4</gamma></exact_solution></Meta></Uintah_specification>)";
    const Grid grid = archive_test::make_grid({10, 1, 1}, {2, 1, 1});
    archive_test::Fields fields;
    const auto wavy = [](IntVec3 c, int component) { return archive_test::wavy(c, component); };
    fields.add(grid.levels[0], archive_test::real_label("rho_CC"), 0, wavy);
    fields.add(grid.levels[0], archive_test::vector_label("vel_CC"), 0, wavy);
    ArchiveWriter writer = ArchiveWriter::create(setup);
    StepInfo info;
    info.step = 5;
    info.time = 0.2;
    writer.write_output(info, grid, fields.pieces());
    writer.finish();
  }

  Outcome plot(const std::string& options) {
    return run_in_shell(std::string(SLUICE_COMMAND) + " plot " +
                        (folder_.path() / "box.uda").string() + " " + options);
  }

  // A memory folder may refuse to run programs.
  TemporaryFolder folder_{TemporaryFolder::Place::disk};
};

TEST_F(Plot, DrawsTheUsualVariablesOverTheExactSolution) {
  const fs::path picture = folder_.path() / "a.svg";
  const Outcome outcome = plot("-o " + picture.string());
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("picture: "));
  const std::string drawn = text_of(picture);
  for (const char* word : {"A small tube", "t = 0.2", "density", "velocity", "exact", "10 cells"})
    EXPECT_THAT(drawn, HasSubstr(word));
}

TEST_F(Plot, NoExactSolutionWhenNotWanted) {
  const fs::path picture = folder_.path() / "a.svg";
  ASSERT_EQ(plot("--exact none --var rho_CC -o " + picture.string()).status, 0);
  EXPECT_THAT(text_of(picture), Not(HasSubstr("exact")));
}

TEST_F(Plot, SeveralArchivesAreDrawnOverEachOtherWithTheOptionsThatAreGiven) {
  const fs::path picture = folder_.path() / "a.svg";
  const std::string again = (folder_.path() / "box.uda").string();
  const Outcome outcome = plot(again + " --names one,two --difference --var rho_CC --size 7x3 " +
                               "--range rho_CC=-3:3 -o " + picture.string());
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  const std::string drawn = text_of(picture);
  for (const char* word : {"one", "two", "two - one", "width=\"504pt\""})
    EXPECT_THAT(drawn, HasSubstr(word));
  EXPECT_THAT(drawn, Not(HasSubstr("exact")));
}

TEST_F(Plot, AMovieIsAGifWithoutAnyOtherProgram) {
  const fs::path movie = folder_.path() / "a.gif";
  const Outcome outcome =
      run_in_shell(std::string(SLUICE_COMMAND) + " movie " + (folder_.path() / "box.uda").string() +
                   " --dpi 50 -o " + movie.string());
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("1 frame"));
  EXPECT_EQ(text_of(movie).substr(0, 4), "GIF8");
}

TEST_F(Plot, WrongNamesAndTimesAreBadInput) {
  const Outcome variable = plot("--var nosuch -o " + (folder_.path() / "a.png").string());
  EXPECT_EQ(variable.status, 2);
  EXPECT_THAT(variable.text, HasSubstr("there are: rho_CC, vel_CC"));
  EXPECT_EQ(plot("--time 7").status, 2);
  EXPECT_EQ(plot("-o picture.doc").status, 2);
  EXPECT_EQ(run_in_shell(std::string(SLUICE_COMMAND) + " plot nosuch.uda").status, 2);
}

TEST_F(Plot, MissingToolsAreASystemFailureThatSaysWhereTheyShouldBe) {
  const fs::path lonely = folder_.path() / "bin" / "sluice";
  fs::create_directories(lonely.parent_path());
  fs::copy_file(SLUICE_COMMAND, lonely);
  const Outcome outcome =
      run_in_shell(lonely.string() + " plot " + (folder_.path() / "box.uda").string());
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.text, HasSubstr("Python tools are not installed with this executable"));
}

}  // namespace
}  // namespace sluice::plot_command_test
