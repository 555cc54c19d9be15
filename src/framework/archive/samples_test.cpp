// Histories and samples of an archive: found, named, read with their columns.
#include "framework/archive/samples.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "framework/archive/archive_test_support.hpp"
#include "framework/base/error.hpp"

namespace sluice::samples_test {
namespace {

namespace fs = std::filesystem;
using namespace archive_test;
using ::testing::ElementsAre;

class Samples : public ::testing::Test {
 protected:
  Samples() {
    declare_label({"TotalMass", ValueType::real, Centring::reduction, "kg", "Mass."});
    const Grid grid = make_grid({6, 4, 1}, {2, 1, 1});
    ArchiveWriter writer = ArchiveWriter::create(setup_in(folder_.path()));
    Fields fields;
    fields.add(grid.levels[0], real_label("press_CC"), 0,
               [&](IntVec3 c, int m) { return wavy(c, m); });
    writer.history("TotalMass", -1, 0, 0.0, 1);
    writer.history("TotalMass", 1, 0, 0.0, 2);
    writer.history("Momentum", -1, 0, 0.0, Vec3{1, 2, 3});
    writer.write_output({0, 0.0, 0.01, 0.01, {}}, grid, fields.pieces());
    writer.finish();
    root_ = writer.folder();
    put("MinMax/L-0/vel_CC_0",
        "# time[s] minimum maximum of vel_CC [m/s], material 0\n"
        "0.1 [1 2 3] [4 5 6]\n0.2 [1 2 3] [4 5 7]\n");
    put("points/ahead", "# at 1 1 0\n# Timestep Time Level press_CC_0\n3 0.1 0 7\n6 0.2 1 8\n");
    put("mid/t00003/L-0/press_CC_0.dat", "# Simulation time: 0.1\n# X Y Z press_CC_0\n0 0 0 1\n");
    put("mid/t00006/L-0/press_CC_0.dat", "# Simulation time: 0.2\n# X Y Z press_CC_0\n0 0 0 5\n");
    put("across/L-0/i1_j1_k0", "# X Y Z Timestep Time T_0\n1 0 0 3 0.1 5\n1 0 0 6 0.2 7\n");
    put("across/L-0/i0_j1_k0", "# X Y Z Timestep Time T_0\n0 0 0 3 0.1 1\n0 0 0 6 0.2 3\n");
    put("1stLawThermo.dat", "# energies\n#Time a b\n0.5 1 2\n");
    put("run.json", R"({"effects": [{"name": "flow", "on": true, "seconds": 0.25}]})");
    put("levels.txt", "# step\ttime\tlevel 0\tlevel 1\n0\t0\t24\t8\n");
  }

  void put(const std::string& name, const std::string& text) const {
    fs::create_directories((root_ / name).parent_path());
    std::ofstream(root_ / name) << text;
  }

  Sample sample(const std::string& name) const {
    for (Sample& s : find_samples(Archive::open(root_)))
      if (s.name == name) return std::move(s);
    throw std::out_of_range(name);
  }

  TemporaryFolder folder_;
  fs::path root_;
};

TEST_F(Samples, AreFoundOnceEachWithTheirKinds) {
  std::vector<std::string> found;
  for (const Sample& s : find_samples(Archive::open(root_))) found.push_back(s.kind + " " + s.name);
  EXPECT_THAT(found, ElementsAre("history TotalMass", "history TotalMass_1", "history Momentum",
                                 "budget 1stLawThermo", "extremes MinMax/L-0/vel_CC_0",
                                 "line across/L-0", "plane mid/L-0/press_CC_0",
                                 "probe points/ahead", "levels levels", "effects effects"));
  EXPECT_EQ(sample("TotalMass").unit, "kg");
}

TEST_F(Samples, HaveNamedColumns) {
  EXPECT_THAT(read_sample(sample("TotalMass")).columns, ElementsAre("Time", "value"));
  EXPECT_THAT(read_sample(sample("Momentum")).columns, ElementsAre("Time", "x", "y", "z"));
  const SampleTable extremes = read_sample(sample("MinMax/L-0/vel_CC_0"));
  EXPECT_THAT(extremes.columns, ElementsAre("Time", "minimum.x", "minimum.y", "minimum.z",
                                            "maximum.x", "maximum.y", "maximum.z"));
  EXPECT_THAT(extremes.rows.back(), ElementsAre("0.2", "1", "2", "3", "4", "5", "7"));
  EXPECT_THAT(read_sample(sample("points/ahead")).columns,
              ElementsAre("Timestep", "Time", "Level", "press_CC_0"));
  EXPECT_THAT(read_sample(sample("1stLawThermo")).columns, ElementsAre("Time", "a", "b"));
  EXPECT_THAT(read_sample(sample("levels")).columns,
              ElementsAre("Timestep", "Time", "level 0", "level 1"));
  EXPECT_THAT(read_sample(sample("effects")).rows.front(), ElementsAre("flow", "1", "0.25"));
}

TEST_F(Samples, OfSnapshotsAndLinesComeByTimeAndPlace) {
  const SampleTable plane = read_sample(sample("mid/L-0/press_CC_0"));
  EXPECT_THAT(plane.columns, ElementsAre("Time", "X", "Y", "Z", "press_CC_0"));
  EXPECT_EQ(plane.rows.size(), 2U);
  const SampleTable line = read_sample(sample("across/L-0"));
  std::vector<std::string> values;
  for (const auto& row : line.rows) values.push_back(row.back());
  EXPECT_THAT(values, ElementsAre("1", "5", "3", "7"));
}

TEST_F(Samples, AreCutToTheNearestTime) {
  EXPECT_EQ(read_sample(sample("mid/L-0/press_CC_0"), 0.14).rows.size(), 1U);
  EXPECT_THAT(read_sample(sample("points/ahead"), 9).rows.front(),
              ElementsAre("6", "0.2", "1", "8"));
  EXPECT_THROW(read_sample(sample("effects"), 1.0).rows.at(1), std::out_of_range);
}

TEST_F(Samples, ThatAreWrongAreTold) {
  put("points/ahead", "# Timestep Time Level p\n1 2 x 4\n");
  EXPECT_THROW(read_sample(sample("points/ahead")), InputError);
  put("points/ahead", "# Timestep Time Level p\n1 2 3 4\n1 2 3\n");
  EXPECT_THROW(read_sample(sample("points/ahead")), InputError);
  put("run.json", "{}");
  EXPECT_THROW(read_sample(sample("effects")), InputError);
}

}  // namespace
}  // namespace sluice::samples_test
