// A flame to start from, read from a file.
#include "models/gases/flame_start.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "framework/base/error.hpp"
#include "framework/base/temporary_folder.hpp"
#include "kinetics/hydrogen_burke.hpp"

namespace sluice::models {
namespace {

const kinetics::SpeciesGas& hydrogen() {
  static const kinetics::SpeciesGas gas(kinetics::burke_hydrogen(), 8);
  return gas;
}

FlameProfile flame(const std::string& text) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "flame.dat").string();
  std::ofstream(file) << text;
  return read_flame(file, 1, hydrogen());
}

std::string refusal(const std::string& text) {
  try {
    flame(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

TEST(FlameStart, IsLinearBetweenItsPointsAndConstantBeyond) {
  const FlameProfile f = flame(
      "# x[m] T[K] u[m/s] rho[kg/m3] press[Pa] Y_H2 Y_O2 Y_N2\n"
      "0 300 2 0.9 1e5 0.02 0.2 0.78\n"
      "\n"
      "0.5 2300 10 0.1 1e5 0 0.1 0.9\n");
  EXPECT_DOUBLE_EQ(f.state.temperature.at({9, 0.25, 9}), 1300);  // along y
  EXPECT_DOUBLE_EQ(f.state.velocity.at({0, -1, 0}), 2);
  EXPECT_DOUBLE_EQ(f.state.density.at({0, 2, 0}), 0.1);
  for (std::size_t k = 0; k < hydrogen().carried(); ++k) {
    const std::string& name = hydrogen().name_of(k);
    const double expected = name == "H2" ? 0.01 : name == "O2" ? 0.15 : 0.0;
    EXPECT_NEAR(f.fractions[k].at({0, 0.25, 0}), expected, 1e-15) << name;
  }
}

TEST(FlameStart, MayLeaveOutTheClosureNamedLast) {
  const FlameProfile f = flame("# x T u rho p Y_H2 Y_N2\n0 300 2 0.9 1e5 0.02\n");
  EXPECT_EQ(f.fractions[1].at({}), 0.02);
  const FlameProfile in_order = flame("0 300 2 0.9 1e5 0.01 0.02 0 0 0 0 0 0\n");
  EXPECT_EQ(in_order.fractions[0].at({}), 0.01);
}

TEST(FlameStart, SaysWhatIsWrongInWhichLine) {
  using ::testing::HasSubstr;
  EXPECT_THAT(refusal("# x T u rho p Y_H2 Y_He\n"),
              HasSubstr("flame.dat:1:1: the mechanism has no species 'He'"));
  const std::string names = "# x T u rho p Y_H2 Y_O2\n";
  EXPECT_THAT(refusal(names + "0 300 2 0.9 1e5 0.02\n"), HasSubstr("flame.dat:2:21: 6 numbers"));
  EXPECT_THAT(refusal(names + "0 300 2 0.9 1e5 0.02 x\n"),
              HasSubstr("flame.dat:2:22: 'x' is not a number; expected a number (Y_O2)"));
  EXPECT_THAT(refusal(names + "0 300 2 0.9 1e5 0.02 0 m/s\n"),
              HasSubstr("flame.dat:2:24: 'm/s' is not a number; expected a number (no column)"));
  EXPECT_THAT(refusal(names + "1 300 2 0.9 1e5 0 0\n1 300 2 0.9 1e5 0 0\n"),
              HasSubstr("flame.dat:3:1: x = 1 is not above the previous x"));
  EXPECT_THAT(refusal(names + "0 -3 2 0.9 1e5 0 0\n"), HasSubstr("must be above 0"));
  EXPECT_THAT(refusal("# nothing\n"), HasSubstr("has no lines"));
}

}  // namespace
}  // namespace sluice::models
