// Analysis modules of a deck: what is read, and what is said about bad ones.
#include "framework/scene/analysis_settings.hpp"

#include "framework/scene/test_support/deck_text.hpp"

namespace sluice::analysis_settings_test {
namespace {

using testing::HasSubstr;

AnalysisSettings read(const std::string& content, std::string* said = nullptr) {
  const DeckText deck("<DataAnalysis>" + content + "</DataAnalysis>");
  std::vector<Fault> faults;
  AnalysisSettings a = read_analysis_settings(&deck.first(), {"air", "steel"}, faults);
  if (said != nullptr)
    *said = all_faults(faults);
  else
    EXPECT_EQ(all_faults(faults), "");
  return a;
}

TEST(AnalysisSettings, ModulesWithVariablesAndLines) {
  const AnalysisSettings a = read(R"(
    <Module name="lineExtract"><material>steel</material>
      <samplingFrequency>1e10</samplingFrequency><timeStart>0.5</timeStart><timeStop>100</timeStop>
      <Variables><analyze label="press_CC" matl="0"/><analyze label="vel_CC" level="0"/></Variables>
      <lines><line name="axis"><startingPt>[0,0.5,0]</startingPt><endingPt>[1,0.5,0]</endingPt>
        <stepSize>0.1</stepSize></line></lines></Module>
    <Module name="vorticity"><material>air</material></Module>)");
  ASSERT_EQ(a.modules.size(), 2u);
  const AnalysisModule& m = a.modules[0];
  EXPECT_EQ(m.name, "lineExtract");
  EXPECT_EQ(m.material, 1);
  EXPECT_EQ(m.sampling_frequency, 1e10);
  EXPECT_EQ(m.time_start, 0.5);
  EXPECT_EQ(m.time_stop, 100);
  ASSERT_EQ(m.variables.size(), 2u);
  EXPECT_EQ(m.variables[0].material, 0);
  EXPECT_EQ(m.variables[1].material, 1);
  EXPECT_TRUE(m.variables[1].levels.contains(0, 2));
  EXPECT_FALSE(m.variables[1].levels.contains(1, 2));
  ASSERT_EQ(m.lines.size(), 1u);
  EXPECT_EQ(m.lines[0].name, "axis");
  EXPECT_EQ(m.lines[0].end, (Vec3{1, 0.5, 0}));
  EXPECT_EQ(m.lines[0].step, 0.1);
  EXPECT_EQ(a.modules[1].material, 0);
}

TEST(AnalysisSettings, PlanesPointsAndControlVolumes) {
  const AnalysisSettings a = read(R"(
    <Module name="planeAverage"><samplingFrequency>1</samplingFrequency>
      <planeOrientation>XZ</planeOrientation><weight label="mass_adv"/>
      <Variables><analyze label="rho_CC" weighting="mass"/><analyze label="press_CC"/>
      </Variables></Module>
    <Module name="planeExtract"><samplingFrequency>1</samplingFrequency>
      <planes><plane name="p"><startingPt>[1,0.5,0]</startingPt>
      <endingPt>[0,0.5,1]</endingPt></plane></planes></Module>
    <Module name="controlVolFluxes"><samplingFrequency>1</samplingFrequency>
      <controlVolumes><box label="b"><min>[0,0,0]</min>
      <max>[1,2,3]</max></box></controlVolumes></Module>
    <Module name="firstLawThermo"><samplingFrequency>1</samplingFrequency>
      <engy_convt_factor>0.001</engy_convt_factor><controlVolume>
      <Face side="x+" extents="entireFace"/><Face side="z-" extents="partialFace">
      <startPt>[0,1,0]</startPt><endPt>[1,0,0]</endPt></Face></controlVolume></Module>)");
  ASSERT_EQ(a.modules.size(), 4u);
  EXPECT_EQ(a.modules[0].plane_normal, 1);
  EXPECT_EQ(a.modules[0].weight, "mass_adv");
  EXPECT_EQ(a.modules[0].variables[0].weighting, Weighting::mass);
  EXPECT_EQ(a.modules[0].variables[1].weighting, Weighting::none);
  EXPECT_EQ(a.modules[1].planes[0].normal, 1);
  EXPECT_EQ(a.modules[1].planes[0].start, (Vec3{0, 0.5, 0})) << "corners are sorted";
  EXPECT_EQ(a.modules[2].volumes[0].high, (Vec3{1, 2, 3}));
  const ControlVolume& domain = a.modules[3].volumes[0];
  EXPECT_EQ(a.modules[3].energy_factor, 0.001);
  EXPECT_TRUE(domain.whole);
  EXPECT_FALSE(domain.sides[0].counts);
  EXPECT_TRUE(domain.sides[1].counts && domain.sides[1].whole);
  EXPECT_FALSE(domain.sides[4].whole);
  EXPECT_EQ(domain.sides[4].end, (Vec3{1, 1, 0}));
}

TEST(AnalysisSettings, NothingWithoutTheBlock) {
  std::vector<Fault> faults;
  EXPECT_TRUE(read_analysis_settings(nullptr, {}, faults).modules.empty());
  EXPECT_TRUE(faults.empty());
}

TEST(AnalysisSettings, Faults) {
  struct Case {
    std::string content, message;
  };
  const std::string variables = "<Variables><analyze label=\"T\" matl=\"2\"/></Variables>";
  const std::vector<Case> cases = {
      {"<Module name=\"minMax\"><material>stel</material></Module>", "did you mean 'steel'?"},
      {"<Module name=\"minMax\"><materialIndex>7</materialIndex></Module>", "material 7"},
      {"<Module name=\"minMax\">" + variables + "</Module>", "material 2 does not exist"},
      {"<Module name=\"minMax\"><Variables><analyze/></Variables></Module>", "no label"},
      {"<Module name=\"minMax\"><samplingFrequency>-1</samplingFrequency></Module>", "at least 0"},
      {"<Module name=\"lineExtract\"><lines><line><startingPt>[0,0,0]</startingPt>"
       "<endingPt>[0,0,0]</endingPt></line></lines></Module>",
       "no name"},
      {"<Module name=\"lineExtract\"><lines><line name=\"../up\"><startingPt>[0,0,0]</startingPt>"
       "<endingPt>[0,0,0]</endingPt></line></lines></Module>",
       "cannot be a folder's name"},
  };
  for (const Case& c : cases) {
    std::string said;
    read(c.content, &said);
    EXPECT_THAT(said, HasSubstr(c.message)) << c.content;
  }
}

}  // namespace
}  // namespace sluice::analysis_settings_test
