// Mirrored decks give mirrored bits; permuted axes equal bits in 1-D and 2-D, 1e-12 in 3-D.
//
// Domains are centred at 0 with spacings that are powers of two, so that the start is symmetric to
// the bit. The deck is the explosion, moved off the middle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verification/case_run.hpp"

namespace sluice::verification::symmetry_test {
namespace {

constexpr double allowed_3d = 1e-12;  // of the largest value
const char* const formula = "CFD/ICE/customInitialization/formula/";

std::vector<std::string> start(const std::string& x, const std::string& y, const std::string& z) {
  const std::string inside =
      "(" + x + " - 0.21)^2 + (" + y + " + 0.13)^2 + (" + z + " - 0.05)^2 < 0.16 ? ";
  return {std::string(formula) + "density=" + inside + "1 : 0.125",
          std::string(formula) + "pressure=" + inside + "1 : 0.1", "Time/maxTime=0.1",
          "DataArchiver/outputInterval=0.1"};
}

std::vector<std::string> square(const std::string& x, const std::string& y) {
  auto set = start(x, y, "0.05");
  set.push_back(resolution(64, 64));
  return set;
}

TEST(Symmetry, MirroredSquareGivesMirroredBits) {
  const CaseRun plain("explosion_2d", square("x", "y")),
      mirrored("explosion_2d", square("-x", "y"));
  const CellValues a = plain.field("rho_CC"), b = mirrored.field("rho_CC");
  const CellValues u = plain.field("vel_CC", 0), v = mirrored.field("vel_CC", 0);
  const CellValues s = plain.field("vel_CC", 1), t = mirrored.field("vel_CC", 1);
  for (int j = 0; j < 64; ++j) {
    for (int i = 0; i < 64; ++i) {
      ASSERT_EQ(a.at(i, j), b.at(63 - i, j)) << i << ' ' << j;
      ASSERT_EQ(u.at(i, j), -v.at(63 - i, j)) << i << ' ' << j;
      ASSERT_EQ(s.at(i, j), t.at(63 - i, j)) << i << ' ' << j;
    }
  }
  EXPECT_NE(a.at(10, 20), a.at(53, 20));  // the start itself is not symmetric
}

TEST(Symmetry, TransposedSquareGivesTransposedBits) {
  const CaseRun plain("explosion_2d", square("x", "y")), turned("explosion_2d", square("y", "x"));
  const CellValues a = plain.field("rho_CC"), b = turned.field("rho_CC");
  const CellValues u = plain.field("vel_CC", 0), v = turned.field("vel_CC", 1);
  const CellValues p = plain.field("press_CC"), q = turned.field("press_CC");
  for (int j = 0; j < 64; ++j) {
    for (int i = 0; i < 64; ++i) {
      ASSERT_EQ(a.at(i, j), b.at(j, i)) << i << ' ' << j;
      ASSERT_EQ(u.at(i, j), v.at(j, i)) << i << ' ' << j;
      ASSERT_EQ(p.at(i, j), q.at(j, i)) << i << ' ' << j;
    }
  }
}

// A tube along each axis.
TEST(Symmetry, TubesAlongEveryAxisAgreeToTheBit) {
  const auto tube = [](int direction) {
    const char axis = static_cast<char>('x' + direction);
    std::string low = "Grid/Level/Box/lower=[", high = "Grid/Level/Box/upper=[";
    IntVec3 cells{1, 1, 1};
    cells[direction] = 256;
    for (int d = 0; d < 3; ++d) {
      low += d == direction ? "-1" : "0";
      high += d == direction ? "1" : "0.0078125";
      low += d < 2 ? "," : "]";
      high += d < 2 ? "," : "]";
    }
    return std::vector<std::string>{low,
                                    high,
                                    resolution(cells.x, cells.y, cells.z),
                                    std::string(formula) + "density=" + axis + " < 0 ? 1 : 0.125",
                                    std::string(formula) + "pressure=" + axis + " < 0 ? 1 : 0.1",
                                    "Time/maxTime=0.2",
                                    "DataArchiver/outputInterval=0.2"};
  };
  const CaseRun along_x("explosion_2d", tube(0));
  const CellValues rho = along_x.field("rho_CC"), u = along_x.field("vel_CC", 0);
  EXPECT_GT(highest(u), .9);
  for (const int direction : {1, 2}) {
    const CaseRun run("explosion_2d", tube(direction));
    EXPECT_EQ(run.steps(), along_x.steps());
    EXPECT_EQ(run.field("rho_CC").values, rho.values);
    EXPECT_EQ(run.field("vel_CC", direction).values, u.values);
  }
}

TEST(Symmetry, CubesWithPermutedAxesAgree) {
  const auto cube = [](const std::string& x, const std::string& y, const std::string& z) {
    auto set = start(x, y, z);
    set.insert(set.end(), {resolution(32, 32, 32), "Grid/Level/Box/lower=[-1,-1,-1]",
                           "Grid/Level/Box/upper=[1,1,1]"});
    return set;
  };
  const int n = 32;
  const CaseRun plain("explosion_2d", cube("x", "y", "z"));
  const CaseRun turned("explosion_2d", cube("y", "z", "x"));  // new axes (x, y, z) were (z, x, y)
  const CaseRun mirrored("explosion_2d", cube("x", "y", "-z"));
  const CellValues a = plain.field("rho_CC"), b = turned.field("rho_CC");
  const CellValues c = mirrored.field("rho_CC");
  double worst = 0;
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        worst = std::max(worst, std::abs(a.at(i, j, k) - b.at(k, i, j)));
        ASSERT_EQ(a.at(i, j, k), c.at(i, j, n - 1 - k)) << i << ' ' << j << ' ' << k;
      }
    }
  }
  record("worst", worst);
  EXPECT_LE(worst, allowed_3d * highest(a));
}

}  // namespace
}  // namespace sluice::verification::symmetry_test
