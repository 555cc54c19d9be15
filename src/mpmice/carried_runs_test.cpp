// What goes with a fluid beside solids: scalars and tracers; and bodies over periodic sides.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>

#include "mpmice/test_support/coupled_run.hpp"

namespace sluice::mpmice::carried_runs_test {
namespace {

constexpr int gas = 1;

double farthest(const DenseField& f, double value, int c = 0) {
  double most = 0;
  for (const double q : f.components[c]) most = std::max(most, std::fabs(q - value));
  return most;
}

// Values of a history: the second number of each line.
std::vector<double> history(const CoupledRun& run, const std::string& name) {
  std::ifstream file(std::filesystem::path(*run.report().archive) / (name + ".dat"));
  std::vector<double> values;
  for (double time = 0, value = 0; file >> time >> value;) values.push_back(value);
  return values;
}

// A disk at 107 m/s through gas at rest in a closed box.
class DiskInDye : public testing::Test {
 protected:
  static const CoupledRun& run() {
    static const CoupledRun one("disk_in_dye");
    return one;
  }
};

TEST_F(DiskInDye, KeepsTheAmountOfAScalar) {
  const std::vector<double> sums = history(run(), "totalSum_scalar-dye");
  ASSERT_GT(sums.size(), 20u);
  for (const double sum : sums) EXPECT_LT(std::fabs(sum / sums.front() - 1), 1e-13);
  EXPECT_LT(run().worst_drift_but_energy(), 1e-13);
}

TEST_F(DiskInDye, LeavesAUniformScalarUniform) {
  EXPECT_LT(farthest(run().field("scalar-same", gas), 0.7), 1e-13);
}

TEST_F(DiskInDye, MakesNoExtremaOfAScalar) {
  const DenseField dye = run().field("scalar-dye", gas);
  for (const double q : dye.components[0]) {
    EXPECT_GT(q, -1e-12);
    EXPECT_LT(q, 1 + 1e-12);
  }
}

// Cells more than two deep in the disk keep what they had when it came.
TEST_F(DiskInDye, DecaysEverywhereAlike) {
  const double left = std::exp(-200 * 0.002);
  const DenseField fading = run().field("scalar-fading", gas);
  constexpr int cells = 40;
  constexpr double x0 = 0.4 + 100 * 0.002, y0 = 0.4 - 37.3 * 0.002, inner = 0.15 - 1.5 / cells;
  double most = 0;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      if (std::hypot((i + 0.5) / cells - x0, (j + 0.5) / cells - y0) < inner) continue;
      most = std::max(most, std::fabs(fading.components[0][cells * j + i] - left));
    }
  EXPECT_LT(most, 1e-12);
  EXPECT_EQ(farthest(run().field("scalar-fading_expDecayCoef", gas), 1.5), 0);
}

// Those that appeared later have decayed for a shorter time.
TEST_F(DiskInDye, TracersCarryTheirDecayAndCopiesOfTheCells) {
  const std::vector<double> age = run().particles("p.age", gas).front(),
                            lost = run().particles("p.age_totalDecay", gas).front(),
                            dye = run().particles("p.clone-scalar-dye", gas).front();
  ASSERT_GT(age.size(), 1000u);
  double most = 0;
  for (std::size_t n = 0; n < age.size(); ++n) {
    EXPECT_LT(std::fabs(age[n] - std::exp(-lost[n])), 1e-13);
    most = std::max(most, lost[n]);
    EXPECT_GE(dye[n], -1e-12);
    EXPECT_LE(dye[n], 1 + 1e-12);
  }
  EXPECT_LT(std::fabs(most - 200 * 0.002), 1e-13);
}

TEST_F(DiskInDye, NeitherBoxesNorThreadsShow) {
  const std::vector<std::string> shorter{"Time/maxTime=0.0005"};
  const CoupledRun one("disk_in_dye", shorter), many("disk_in_dye", shorter, 2, {3, 2, 1});
  for (const char* label : {"scalar-dye", "scalar-dye_src", "scalar-fading"})
    EXPECT_EQ(one.field(label, gas).components[0], many.field(label, gas).components[0]) << label;
  const auto by_id = [](const CoupledRun& of, const std::string& label, int material) {
    const auto ids = of.particles("p.particleID", material), all = of.particles(label, material);
    std::map<double, std::vector<double>> found;
    for (std::size_t n = 0; n < ids.front().size(); ++n)
      for (const std::vector<double>& column : all) found[ids.front()[n]].push_back(column[n]);
    return found;
  };
  for (const char* label : {"p.x", "p.age", "p.clone-scalar-dye"})
    EXPECT_EQ(by_id(one, label, gas), by_id(many, label, gas)) << label;
  EXPECT_EQ(by_id(one, "p.x", 0), by_id(many, "p.x", 0));
}

TEST(PeriodicSides, BodyAndGasThatCrossThemTogetherFeelNothing) {
  const CoupledRun run("across_periodic_sides");
  ASSERT_EQ(run.report().status, RunStatus::done);
  EXPECT_LT(farthest(run.field("press_CC", 0), 1e5), 1e-12 * 1e5);
  EXPECT_LT(farthest(run.field("temp_CC", gas), 300), 1e-12 * 300);
  EXPECT_LT(farthest(run.field("vel_CC", gas), 100, 0), 1e-9);
  EXPECT_LT(farthest(run.field("vel_CC", gas), -37.3, 1), 1e-9);
  EXPECT_LT(run.worst_drift_but_energy(), 1e-13);
}

TEST(PeriodicSides, NeitherBoxesNorThreadsShow) {
  const std::vector<std::string> shorter{"Time/maxTime=0.002"};
  const CoupledRun one("across_periodic_sides", shorter),
      many("across_periodic_sides", shorter, 2, {3, 2, 1});
  for (const char* label : {"press_CC", "vel_CC"}) {
    const int material = std::string(label) == "press_CC" ? 0 : gas;
    EXPECT_EQ(one.field(label, material).components[0], many.field(label, material).components[0]);
  }
}

}  // namespace
}  // namespace sluice::mpmice::carried_runs_test
