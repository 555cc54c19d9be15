// Which labels are sampled on which levels, and when.
#include "framework/run/analysis/analysis_recorder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/archive/posix_file.hpp"
#include "framework/base/temporary_folder.hpp"
#include "framework/run/test_support/mock_component.hpp"

namespace sluice::analysis_recorder_test {
namespace {

using namespace run_test;
namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;

// The tube of 40 cells of 1/8, and cells 16 to 36 of a level of cells of 1/16.
Scene tube_of_two_levels() {
  Scene scene = tube(2);
  Level fine = scene.grid.levels.front();
  fine.index = 1;
  fine.ratio = {2, 1, 1};
  fine.spacing.x *= 0.5;
  fine.domain.upper.x *= 2;
  fine.boxes = {{{{16, 0, 0}, {28, 1, 1}}, 0, 0}, {{{28, 0, 0}, {36, 1, 1}}, 0, 1}};
  scene.grid.levels.push_back(fine);
  mock_labels();
  return scene;
}

AnalysedVariable variable(const char* label, const char* levels = "") {
  AnalysedVariable v;
  v.label = label;
  v.levels = read_index_set(levels);
  return v;
}

AnalysisModule module_of(const char* name, std::vector<AnalysedVariable> variables) {
  AnalysisModule m;
  m.name = name;
  m.time_stop = 100;
  m.variables = std::move(variables);
  return m;
}

AnalysedLine line(const char* name, double from, double to) {
  AnalysedLine l;
  l.name = name;
  l.start = {from, 0.5, 0.5};
  l.end = {to, 0.5, 0.5};
  return l;
}

class Recorded : public testing::Test {
 protected:
  Recorded()
      : scene_(tube_of_two_levels()),
        component_(scene_.grid.levels.front()),
        hierarchy_(scene_, component_, world(), {}) {
    for (int l = 0; l < 2; ++l) component_.state().initialise(hierarchy_.level(l).state());
  }
  AnalysisRecorder recorder() {
    AnalysisRecorder r(scene_, hierarchy_, world());
    r.open(folder_.path());
    return r;
  }
  bool exists(const char* name) const { return fs::exists(folder_ / name); }
  std::string text(const char* name) const { return read_text(folder_ / name); }

  Scene scene_;
  MockComponent component_;
  Hierarchy hierarchy_;
  TemporaryFolder folder_;
};

TEST_F(Recorded, EveryLevelHasItsOwnFiles) {
  scene_.analysis.modules = {module_of("minMax", {variable("mock_square")})};
  AnalysisModule lines = module_of("lineExtract", {variable("mock_square")});
  lines.lines = {line("all", 0, 5)};
  scene_.analysis.modules.push_back(lines);
  AnalysisRecorder r = recorder();
  EXPECT_TRUE(r.sample(3, 0.5));
  r.flush();
  for (const char* name :
       {"MinMax/L-0/mock_square_0", "MinMax/L-1/mock_square_0", "all/L-0/i0_j0_k0",
        "all/L-0/i39_j0_k0", "all/L-1/i16_j0_k0", "all/L-1/i35_j0_k0"})
    EXPECT_TRUE(exists(name)) << name;
  EXPECT_FALSE(exists("all/L-1/i15_j0_k0"));
  EXPECT_FALSE(exists("all/L-1/i36_j0_k0"));
  // Cell 30 of level 1: centre 30.5 / 16, value (1 + 3 / 8)^2.
  EXPECT_THAT(text("all/L-1/i30_j0_k0"), HasSubstr("\n1.90625 0.5 0.5 3 0.5 1.890625\n"));
  EXPECT_THAT(text("MinMax/L-1/mock_square_0"), HasSubstr("\n0.5 1 3.0625\n"));
}

TEST_F(Recorded, AVariableComesFromTheLevelsItAsksFor) {
  scene_.analysis.modules = {
      module_of("minMax", {variable("mock_square", "0"), variable("mock_flux", "-1")})};
  AnalysisModule lines =
      module_of("lineExtract", {variable("mock_square"), variable("mock_flux", "0")});
  lines.lines = {line("part", 2, 2.5)};
  scene_.analysis.modules.push_back(lines);
  scene_.analysis.modules.push_back(module_of("minMax", {variable("mock_square", "5")}));
  AnalysisRecorder r = recorder();
  EXPECT_THAT(r.step_labels(0.5), ElementsAre(mock_labels().flux));
  for (int l = 0; l < 2; ++l) {
    hierarchy_.fill_ghosts(0);
    hierarchy_.level(l).attempt(0, 0.03125, r.step_labels(0.5), nullptr);
  }
  r.sample(1, 0.5);
  r.flush();
  EXPECT_TRUE(exists("MinMax/L-0/mock_square_0"));
  EXPECT_FALSE(exists("MinMax/L-1/mock_square_0"));
  EXPECT_FALSE(exists("MinMax/L-0/mock_flux_0"));
  EXPECT_TRUE(exists("MinMax/L-1/mock_flux_0"));
  EXPECT_THAT(text("part/L-0/i16_j0_k0"), HasSubstr("Time mock_square_0 mock_flux_0\n"));
  EXPECT_THAT(text("part/L-1/i32_j0_k0"), HasSubstr("Time mock_square_0\n"));
}

TEST_F(Recorded, ALevelThatDoesNotExistHasNoLine) {
  scene_.analysis.modules = {module_of("minMax", {variable("mock_square")})};
  scene_.grid.levels.back().boxes.clear();  // one that a regridder may make
  Hierarchy coarse(scene_, component_, world(), {});
  component_.state().initialise(coarse.level(0).state());
  AnalysisRecorder r(scene_, coarse, world());
  r.open(folder_.path());
  r.sample(1, 0.5);
  r.flush();
  EXPECT_TRUE(exists("MinMax/L-0/mock_square_0"));
  EXPECT_FALSE(exists("MinMax/L-1/mock_square_0"));
}

TEST_F(Recorded, ALineOutsideTheDomainIsToldOnceForAllLevels) {
  AnalysisModule lines = module_of("lineExtract", {variable("mock_square")});
  lines.lines = {line("over", 4, 6), line("away", 7, 8), line("inside", 1, 2)};
  scene_.analysis.modules = {lines};
  AnalysisRecorder r = recorder();
  EXPECT_THAT(
      r.warnings(),
      ElementsAre(Field(&Fault::message, HasSubstr("line 'over' extends beyond the domain")),
                  Field(&Fault::message, HasSubstr("line 'away' is outside the domain"))));
  r.sample(1, 0.5);
  r.flush();
  EXPECT_TRUE(exists("over/L-0/i39_j0_k0"));
  EXPECT_FALSE(exists("over/L-1")) << "level 1 ends before";
  EXPECT_FALSE(exists("away"));
}

TEST_F(Recorded, PlanesAreClippedAndNeedNamesOfTheirOwn) {
  AnalysisModule planes = module_of("planeExtract", {variable("mock_square")});
  AnalysedPlane plane;
  plane.name = "wall";
  plane.start = {4, 0, 0.5};
  plane.end = {6, 1, 0.5};
  planes.planes = {plane};
  scene_.analysis.modules = {planes};
  AnalysisRecorder r = recorder();
  EXPECT_THAT(
      r.warnings(),
      ElementsAre(Field(&Fault::message, HasSubstr("plane 'wall' extends beyond the domain"))));
  r.sample(7, 0.5);
  r.flush();
  EXPECT_THAT(text("wall/t00007/L-0/mock_square_0.dat"), HasSubstr("\n4.0625 0.5 0.5 "));
  EXPECT_FALSE(exists("wall/t00007/L-1")) << "level 1 ends before";
  for (const char* taken : {"planeAverage", "t00010", "MinMax"}) {
    scene_.analysis.modules[0].planes[0].name = taken;
    EXPECT_THROW(recorder(), InputError) << taken;
  }
}

TEST_F(Recorded, UnknownLabelsAreRefusedOnWhateverLevel) {
  scene_.analysis.modules = {module_of("minMax", {variable("mock_squar", "1")})};
  try {
    recorder();
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("did you mean 'mock_square'"));
  }
}

TEST_F(Recorded, AFieldOfAnotherMaterialIsRefused) {
  scene_.analysis.modules = {module_of("minMax", {variable("mock_square")})};
  scene_.analysis.modules[0].variables[0].material = 1;
  try {
    recorder();
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("it does not exist for material 1, but for 0"));
  }
}

TEST_F(Recorded, TimesOfSamplesOutliveARestart) {
  scene_.analysis.modules = {module_of("minMax", {variable("mock_square", "1")}),
                             module_of("minMax", {variable("mock_square", "0")})};
  for (AnalysisModule& m : scene_.analysis.modules) m.sampling_frequency = 4;
  scene_.analysis.modules.back().time_start = 2;
  AnalysisRecorder before = recorder();
  before.sample(1, 1.0);
  AnalysisRecorder after = recorder();
  after.restore(before.state());
  EXPECT_FALSE(after.sample(2, 1.125)) << "a quarter after the last one";
  EXPECT_TRUE(after.sample(3, 1.25));
  EXPECT_EQ(after.state(), "[1.25,null]");
}

}  // namespace
}  // namespace sluice::analysis_recorder_test
