// Errors of a run of two materials: mixtures of what the archive holds against the exact flow.
#include "app/archive_error.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/archive/archive_test_support.hpp"
#include "framework/archive/archive_writer.hpp"
#include "framework/base/error.hpp"
#include "framework/base/temporary_folder.hpp"

namespace sluice::archive_error_test {
namespace {

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
  EXPECT_DOUBLE_EQ(error("rho_CC").l1, .1 * (1000 - 525));
  const double mixed = (500 * 3 + 25 * 9) / 525.0;
  EXPECT_DOUBLE_EQ(error("vel_CC").l1, .1 * (4 * 3 + mixed + 5 * 9));
  EXPECT_EQ(error("rho_CC", 1).l1, error("rho_CC", 0).l1);
}

TEST_F(MixtureErrors, PressureIsCommonAndFractionsAreOfTheMaterial) {
  EXPECT_NEAR(error("press_CC").l1, .1 * .5 * (1e9 - 1e5), 1e-3);
  EXPECT_DOUBLE_EQ(error("vol_frac_CC", 0).l1, .05);
  EXPECT_DOUBLE_EQ(error("vol_frac_CC", 1).l1, .05);
  EXPECT_THROW(error("temp_CC"), InputError);
}

}  // namespace
}  // namespace sluice::archive_error_test
