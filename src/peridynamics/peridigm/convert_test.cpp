// Decks of Peridigm: both forms, what is written, runs of converted decks, faults with their lines.
#include "peridynamics/peridigm/convert.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "peridynamics/test_support/peri_run.hpp"

namespace sluice::peridynamics::convert_test {
namespace {

using ::testing::HasSubstr;

// Three points in a row, of which the outer ones move to the middle.
const std::string in_yaml = R"(Peridigm:
  Verbose: false
  Discretization:
    Type: "PdQuickGrid"
    TensorProduct3DMeshGenerator:
      Type: "PdQuickGrid"
      X Origin: -1.5
      Y Origin: -0.5
      Z Origin: -0.5
      X Length: 3.0
      Y Length: 1.0
      Z Length: 1.0
      Number Points X: 3
      Number Points Y: 1
      Number Points Z: 1
  Materials:
    Steel:
      Material Model: "Elastic"
      Density: 7800.0
      Bulk Modulus: 130.0e9
      Shear Modulus: 78.0e9
  Blocks:
    All:
      Block Names: "block_1"
      Material: "Steel"
      Horizon: 1.1
  Boundary Conditions:
    Left: "1"
    Right: "3"
    Move left:
      Type: "Initial Velocity"
      Node Set: "Left"
      Coordinate: "x"
      Value: "1.0"
    Move right:
      Type: "Initial Velocity"
      Node Set: "Right"
      Coordinate: "x"
      Value: "-x"
  Solver:
    Initial Time: 0.0
    Final Time: 0.00005
    Verlet:
      Fixed dt: 0.00001
  Output:
    Output Filename: "three"
    Output Frequency: 1
    Output Variables:
      Displacement: true
      Dilatation: true
      Weighted_Volume: true
)";

const std::string in_xml = R"(<ParameterList>
 <ParameterList name="Discretization">
  <Parameter name="Type" type="string" value="PdQuickGrid"/>
  <ParameterList name="TensorProduct3DMeshGenerator">
   <Parameter name="X Origin" type="double" value="-2.0"/>
   <Parameter name="Y Origin" type="double" value="-0.5"/>
   <Parameter name="Z Origin" type="double" value="-0.5"/>
   <Parameter name="X Length" type="double" value="4.0"/>
   <Parameter name="Y Length" type="double" value="1.0"/>
   <Parameter name="Z Length" type="double" value="1.0"/>
   <Parameter name="Number Points X" type="int" value="2"/>
   <Parameter name="Number Points Y" type="int" value="1"/>
   <Parameter name="Number Points Z" type="int" value="1"/>
  </ParameterList>
 </ParameterList>
 <ParameterList name="Materials">
  <ParameterList name="Steel">
   <Parameter name="Material Model" type="string" value="Elastic"/>
   <Parameter name="Density" type="double" value="7800.0"/>
   <Parameter name="Bulk Modulus" type="double" value="130.0e9"/>
   <Parameter name="Shear Modulus" type="double" value="78.0e9"/>
  </ParameterList>
 </ParameterList>
 <ParameterList name="Blocks">
  <ParameterList name="All">
   <Parameter name="Block Names" type="string" value="block_1"/>
   <Parameter name="Material" type="string" value="Steel"/>
   <Parameter name="Horizon" type="double" value="2.0"/>
  </ParameterList>
 </ParameterList>
 <ParameterList name="Boundary Conditions">
  <Parameter name="Left" type="string" value="1"/>
  <Parameter name="Right" type="string" value="2"/>
  <ParameterList name="Push left">
   <Parameter name="Type" type="string" value="Initial Displacement"/>
   <Parameter name="Node Set" type="string" value="Left"/>
   <Parameter name="Coordinate" type="string" value="x"/>
   <Parameter name="Value" type="string" value="1e-5"/>
  </ParameterList>
  <ParameterList name="Push right">
   <Parameter name="Type" type="string" value="Initial Displacement"/>
   <Parameter name="Node Set" type="string" value="Right"/>
   <Parameter name="Coordinate" type="string" value="x"/>
   <Parameter name="Value" type="string" value="-1e-5"/>
  </ParameterList>
 </ParameterList>
 <ParameterList name="Solver">
  <Parameter name="Initial Time" type="double" value="0.0"/>
  <Parameter name="Final Time" type="double" value="0.00005"/>
  <ParameterList name="Verlet">
   <Parameter name="Fixed dt" type="double" value="0.00001"/>
  </ParameterList>
 </ParameterList>
</ParameterList>
)";

ConvertedDeck converted(const std::string& text, bool yaml) {
  return convert_peridigm(read_parameters_text(text, yaml, "deck"), "deck", ".");
}

std::string faults(const ConvertedDeck& deck) {
  std::string text;
  for (const Fault& f : deck.faults) text += to_string(f) + '\n';
  return text;
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  return text;
}

// The archive of the converted deck, whose files lie in a folder of their own.
std::map<std::int64_t, std::vector<double>> run(const ConvertedDeck& deck,
                                                const std::string& label) {
  const TemporaryFolder folder;
  std::string ups = deck.ups;
  for (const auto& [name, text] : deck.files) {
    std::ofstream(folder / name) << text;
    ups.replace(ups.find("<name>" + name), 6 + name.size(), "<name>" + (folder / name).string());
  }
  return PeriRun(ups).last(label);
}

// Peridigm's own test Compression_3x1x1 has 4.56054038e-5 m after five steps; by hand: theta of
// each point is e/r summed, weighted volumes 1, 2, 1.
TEST(Peridigm, YamlBecomesADeckThatRuns) {
  const ConvertedDeck deck = converted(in_yaml, true);
  ASSERT_EQ(faults(deck), "");
  const auto u = run(deck, "p.displacement");
  ASSERT_EQ(u.size(), 3u);
  EXPECT_NEAR(u.begin()->second[0], 4.56054038e-5, 5e-14);
  EXPECT_NEAR(u.begin()->second[0] + u.rbegin()->second[0], 0, 1e-19);
  const auto m = run(deck, "p.weightedVolume");
  EXPECT_EQ(m.begin()->second[0], 1);
  EXPECT_EQ(std::next(m.begin())->second[0], 2);
  EXPECT_THAT(deck.rules, ::testing::Contains("partial_volume: none"));
}

// Two masses on a spring, moved by 1e-5 m each: u(t) = 1e-5 cos(w t), a = -w^2 u with 1500 m/s^2 at
// 1e-5 m (w^2 = 1.5e8); Verlet of five steps of 1e-5 s.
TEST(Peridigm, XmlGivesDisplacementsAtTheStart) {
  const ConvertedDeck deck = converted(in_xml, false);
  ASSERT_EQ(faults(deck), "");
  double u = 1e-5, v = 0;
  const double w2 = 1.5e8, dt = 1e-5;
  for (int n = 0; n < 5; ++n) {
    v -= 0.5 * dt * w2 * u;
    u += dt * v;
    v -= 0.5 * dt * w2 * u;
  }
  EXPECT_NEAR(run(deck, "p.displacement").begin()->second[0], u, 1e-14);
}

TEST(Peridigm, FaultsHaveTheirLines) {
  const std::tuple<std::string, std::string, std::string> rows[] = {
      {"      Horizon: 1.1", "      Horizn: 1.1\n      Horizon: 1.1",
       "deck:26:7: error: parameter 'Horizn' is not known"},
      {"Material Model: \"Elastic\"", "Material Model: \"Pals\"",
       "deck:18:7: error: material model 'Pals' is known to the format, but not supported yet"},
      {"Node Set: \"Left\"", "Node Set: \"Top\"", "deck:32:7: error: there is no node set 'Top'"},
      {"Left: \"1\"", "Left: \"7\"",
       "deck:28:5: error: node set 'Left' names point 7; there are 3"},
      {"Value: \"-x\"", "Value: \"1/(x-x)\"", "'1/(x-x)' is inf at point 3"},
      {"Type: \"Initial Velocity\"", "Type: \"Prescribed Displacement\"",
       "deck:31:7: error: boundary condition 'Prescribed Displacement'"},
      {"Verlet:", "QuasiStatic:", "solver 'QuasiStatic' is known to the format"},
      {"Density: 7800.0", "Density: heavy", "deck:19:7: error: 'Density': 'heavy' is not a number"},
      {"Number Points X: 3", "Number Points X: 0", "are no grid"},
      {"\"block_1\"", "\"block_2\"", "points of block_1 have no material"},
  };
  for (const auto& [from, to, says] : rows) {
    const ConvertedDeck deck = converted(changed(in_yaml, from, to), true);
    EXPECT_FALSE(deck.good());
    EXPECT_THAT(faults(deck), HasSubstr(says));
  }
}

TEST(Peridigm, ATreeCutOffInTheMiddleIsRefused) {
  EXPECT_THROW(converted(in_xml.substr(0, 700), false), InputError);
  EXPECT_THROW(converted("Peridigm:\n  Solver: {a: 1", true), InputError);
  EXPECT_FALSE(converted(in_yaml.substr(0, 500), true).good());
}

}  // namespace
}  // namespace sluice::peridynamics::convert_test
