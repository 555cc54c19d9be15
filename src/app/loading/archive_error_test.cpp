// Errors of a run of two materials: mixtures of what the archive holds against the exact flow.
#include "app/loading/archive_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>

#include "exact/exact_solutions.hpp"
#include "framework/archive/archive_test_support.hpp"
#include "framework/archive/archive_writer.hpp"
#include "framework/base/error.hpp"
#include "framework/base/temporary_folder.hpp"

namespace sluice::archive_error_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* deck = R"(<Uintah_specification><Meta><exact_solution type="two_materials">
    <left>[1000, 0, 1e9]</left> <eos_left>StiffenedGas gamma=4.4 pinf=6e8</eos_left>
    <right>[50, 0, 1e5]</right> <eos_right>ideal_gas gamma=1.4</eos_right>
    <position>-0.5</position></exact_solution></Meta></Uintah_specification>)";

// Cells at the start; the cell left of the interface is half full of each. Both move at 3 and 9.
class MixtureErrors : public ::testing::Test {
 protected:
  static double share(IntVec3 c) { return c.x < 4 ? 1.0 : c.x == 4 ? 0.5 : 0.0; }

  void SetUp() override {
    ArchiveSetup setup = archive_test::setup_in(folder_.path());
    setup.deck_xml = deck;
    const Grid grid = archive_test::make_grid({10, 1, 1}, {1, 1, 1});
    archive_test::Fields fields;
    const auto rho = archive_test::real_label("rho_CC");
    const auto velocity = archive_test::vector_label("vel_CC");
    const Level& level = grid.levels[0];
    fields.add(level, rho, 0, [](IntVec3 c, int) { return 1000 * share(c); });
    fields.add(level, rho, 1, [](IntVec3 c, int) { return 50 * (1 - share(c)); });
    const double none = std::nan("");  // of a material that is not there
    fields.add(level, velocity, 0, [&](IntVec3 c, int) { return share(c) > 0 ? 3.0 : none; });
    fields.add(level, velocity, 1, [&](IntVec3 c, int) { return share(c) < 1 ? 9.0 : none; });
    fields.add(level, archive_test::real_label("press_CC"), 0,
               [](IntVec3 c, int) { return 1e9 * share(c) + 1e5 * (1 - share(c)); });
    const auto fraction = archive_test::real_label("vol_frac_CC");
    fields.add(level, fraction, 0, [](IntVec3 c, int) { return share(c); });
    fields.add(level, fraction, 1, [](IntVec3 c, int) { return 1 - share(c); });
    ArchiveWriter writer = ArchiveWriter::create(setup);
    StepInfo info;
    writer.write_output(info, grid, fields.pieces());
    writer.finish();
  }

  exact::ErrorNorms error(const std::string& variable, int material = 0) const {
    const Archive archive = Archive::open(folder_.path() / "box.uda");
    const ArchiveStep step = archive.read_output(archive.select_output("last"));
    return archive_error(step, *reference_of_archive(archive), variable, 0, material);
  }

  TemporaryFolder folder_;
};

TEST_F(MixtureErrors, DensityIsTheSumAndVelocityTheMeanByMass) {
  // The interface lies on a face: the mean of a cell near it is integrated to a part of the error.
  const double density = .1 * (1000 - 525), known = 1e-4;
  EXPECT_NEAR(error("rho_CC").l1, density, known * density);
  const double mixed = (500 * 3 + 25 * 9) / 525.0;
  const double velocity = .1 * (4 * 3 + mixed + 5 * 9);
  EXPECT_NEAR(error("vel_CC").l1, velocity, known * velocity);
  EXPECT_EQ(error("rho_CC", 1).l1, error("rho_CC", 0).l1);
}

TEST_F(MixtureErrors, PressureIsCommonAndFractionsAreOfTheMaterial) {
  const double pressure = .1 * .5 * (1e9 - 1e5), known = 1e-4;
  EXPECT_NEAR(error("press_CC").l1, pressure, known * pressure);
  EXPECT_NEAR(error("vol_frac_CC", 0).l1, .05, known * .05);
  EXPECT_NEAR(error("vol_frac_CC", 1).l1, .05, known * .05);
  EXPECT_THROW(error("temp_CC"), InputError);
}

// An interface in the middle of the fifth cell, whose halves are what the archive holds there.
TEST_F(MixtureErrors, AreThoseFromTheMeanOverACell) {
  const Archive archive = Archive::open(folder_.path() / "box.uda");
  const ArchiveStep step = archive.read_output(archive.select_output("last"));
  DeckReference reference;
  reference.solution = exact::make_exact_solution({"two_materials",
                                                   {{"left", "[1000, 0, 1e9]"},
                                                    {"eos_left", "StiffenedGas gamma=4.4 pinf=6e8"},
                                                    {"right", "[50, 0, 1e5]"},
                                                    {"eos_right", "ideal_gas gamma=1.4"},
                                                    {"position", "-0.55"}}});
  for (const char* variable : {"rho_CC", "press_CC", "vol_frac_CC"})
    EXPECT_LE(archive_error(step, reference, variable, 0, 0).relative_l1, 1e-5) << variable;
}

// A state of n cells along x, 2 along y, in the same box, at a time.
ArchiveStep state(const fs::path& folder, int n, double time,
                  const std::function<double(IntVec3)>& value) {
  Grid grid = archive_test::make_grid({n, 2, 1}, {1, 1, 1});
  grid.levels[0].spacing = {1.0 / n, 0.5, 1};
  archive_test::Fields fields;
  fields.add(grid.levels[0], archive_test::real_label("press_CC"), 0,
             [&](IntVec3 c, int) { return value(c); });
  ArchiveWriter writer = ArchiveWriter::create(archive_test::setup_in(folder));
  StepInfo info;
  info.time = time;
  writer.write_output(info, grid, fields.pieces());
  writer.finish();
  const Archive archive = Archive::open(writer.folder());
  return archive.read_output(archive.select_output("last"));
}

TEST(ErrorsAgainstAFormula, AreThoseOfItsMeanOverEachCell) {
  const TemporaryFolder folder;
  const ArchiveStep step = state(folder.path(), 4, 0.5, [](IntVec3) { return 0.0; });
  // Over the first cell, of the sixth power of the distance from its low end: (1/4)^6/7.
  const auto power = [](Vec3 x) { return std::pow(x.x + 1, 6); };
  const exact::ErrorNorms e =
      archive_error(step, power, "press_CC", 0, 0, std::pair{Vec3{-1, 0, 0}, Vec3{-.8, 2, 9}});
  EXPECT_EQ(e.points, 2u);
  EXPECT_NEAR(e.l1, std::pow(.25, 6) / 7, 1e-18);
  const exact::ErrorNorms about_one = archive_error(
      step, [](Vec3) { return 3.0; }, "press_CC", 0, 0, std::nullopt, 1.0);
  EXPECT_DOUBLE_EQ(about_one.relative_l1, 1.5);
}

TEST(ErrorsAgainstAFinerRun, AreThoseFromItsMeanOverEachCell) {
  const TemporaryFolder folder;
  const auto coarse_value = [](IntVec3 c) { return 10.0 * c.x + c.y; };
  const ArchiveStep coarse = state(folder.path(), 4, 0.5, coarse_value);
  const ArchiveStep fine = state(folder.path(), 12, 0.5, [&](IntVec3 f) {
    // Three within a cell: 2 less, 1 more, 7 more; their mean is 2 more.
    const double more[] = {-2, 1, 7};
    return coarse_value({f.x / 3, f.y, 0}) + more[f.x % 3];
  });
  const exact::ErrorNorms e = archive_error(coarse, fine, "press_CC", 0, 0);
  EXPECT_DOUBLE_EQ(e.l1, 2);
  EXPECT_DOUBLE_EQ(e.linf, 2);
  EXPECT_EQ(e.points, 8u);
}

TEST(ErrorsAgainstAFinerRun, NeedItsTimeAndCellsThatDivide) {
  const TemporaryFolder folder;
  const auto zero = [](IntVec3) { return 0.0; };
  const ArchiveStep coarse = state(folder.path(), 4, 0.5, zero);
  const auto refusal = [&](const ArchiveStep& reference) -> std::string {
    try {
      archive_error(coarse, reference, "press_CC", 0, 0);
    } catch (const InputError& fault) {
      return fault.what();
    }
    return "";
  };
  EXPECT_THAT(refusal(state(folder.path(), 6, 0.5, zero)), testing::HasSubstr("whole number"));
  EXPECT_THAT(refusal(state(folder.path(), 8, 0.6, zero)), testing::HasSubstr("is at time 0.6"));
}

}  // namespace
}  // namespace sluice::archive_error_test
