// Rigid bodies that transmit forces; heat of friction; particles of a cell that share their
// dilatation.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "mpm/test_support/text_run.hpp"

namespace sluice::mpm::transmitting_test {
namespace {

std::string block(const char* low, const char* high, const char* velocity) {
  return fmt::format(
      "<geom_object><box><min>[{},0,0]</min><max>[{},1,1]</max></box><res>[2,1,1]</res>"
      "<velocity>[{},0,0]</velocity><temperature>300</temperature></geom_object>",
      low, high, velocity);
}

// A finer level over a part of the domain.
TextRun::Rewrites with_fine_level(const char* low, const char* high, const char* cells,
                                  TextRun::Rewrites further) {
  further.emplace_back("</Level></Grid>",
                       fmt::format("</Level><Level><Box label='2'><lower>{}</lower><upper>{}"
                                   "</upper><resolution>{}</resolution></Box></Level></Grid>",
                                   low, high, cells));
  return further;
}

// A rigid block runs into an elastic one of its mass: what the nodes give to one they take of the
// other, whatever the transfer; and wherever levels end inside the rigid one.
struct RigidCase {
  const char* transfer;
  bool levels;
};
class RigidBlock : public testing::TestWithParam<RigidCase> {};

TEST_P(RigidBlock, GivesWhatItLoses) {
  SolidDeck deck;
  deck.upper = "[1,0.025,0.025]";
  deck.cells = "[40,1,1]";
  const auto [transfer, levels] = GetParam();
  deck.flags = fmt::format("<interpolator>{}</interpolator><transfer>{}</transfer>",
                           levels ? "gimp" : "quadraticBS", transfer);
  deck.objects = block("0.1", "0.3", "1");
  deck.material =
      "<is_rigid>true</is_rigid><is_force_transmitting_material>true"
      "</is_force_transmitting_material>";
  deck.further = solid_material("elastic", block("0.35", "0.55", "0"));
  deck.contacts =
      "<contact><type>specified</type><materials>[0,1]</materials><master_material>0"
      "</master_material><direction>[1,1,1]</direction></contact>";
  TextRun::Rewrites changes = {
      {"<maxTime>1<", "<maxTime>0.2<"},
      {"<outputInterval>0</outputInterval>", saves({"p.velocity", "p.mass"})}};
  if (levels)
    changes = with_fine_level("[0.225,0,0]", "[0.9,0.025,0.025]", "[54,1,1]", std::move(changes));
  const TextRun run(deck, changes, "transmitting");
  const auto v = run.particles("p.velocity", 0), m = run.particles("p.mass", 0);
  const auto w = run.particles("p.velocity", 1), k = run.particles("p.mass", 1);
  double momentum = 0, mass = 0, of_elastic = 0;
  for (std::size_t p = 0; p < v[0].size(); ++p) {
    momentum += m[0][p] * v[0][p];
    mass += m[0][p];
    EXPECT_EQ(v[0][p], v[0][0]);
  }
  for (std::size_t p = 0; p < w[0].size(); ++p) of_elastic += k[0][p] * w[0][p];
  momentum += of_elastic;
  EXPECT_NEAR(momentum / mass, 1, 1e-12);
  EXPECT_GT(of_elastic / mass, 0.3);
  EXPECT_LT(v[0][0], 0.7);
}

INSTANTIATE_TEST_SUITE_P(Of, RigidBlock,
                         testing::Values(RigidCase{"flip", false}, RigidCase{"xpic", false},
                                         RigidCase{"apic", false}, RigidCase{"flip", true}),
                         [](const auto& test) {
                           return std::string(test.param.transfer) +
                                  (test.param.levels ? "_on_levels" : "");
                         });

// A block that slides on a rigid floor until it rests: its heat is the energy that it had; also
// where it comes from a coarse level into a finer one.
struct HeatCase {
  const char* transfer;
  bool levels;
  double share;            // of the start's energy; transfers take the rest, more where levels meet
  double of_contact_loss;  // how near heat is to that; what would cool at a node is left out
};
class FrictionHeat : public testing::TestWithParam<HeatCase> {};

TEST_P(FrictionHeat, IsTheMotionThatFrictionTook) {
  SolidDeck deck;
  deck.upper = "[2,1,0.1]";
  deck.cells = "[20,10,1]";
  deck.flags =
      "<interpolator>gimp</interpolator><do_contact_friction_heating>true"
      "</do_contact_friction_heating><DoExplicitHeatConduction>false"
      "</DoExplicitHeatConduction><transfer>" +
      std::string(GetParam().transfer) + "</transfer>";
  deck.objects =
      "<geom_object><box><min>[0.3,0.2,0]</min><max>[1.1,0.6,0.1]</max></box><res>[2,2,1]</res>"
      "<velocity>[1,0,0]</velocity><temperature>300</temperature></geom_object>";
  deck.further = solid_material(
      "floor",
      "<is_rigid>true</is_rigid><geom_object><box><min>[0,0,0]</min><max>[2,0.2,0.1]</max></box>"
      "<res>[2,2,1]</res><velocity>[0,0,0]</velocity><temperature>300</temperature>"
      "</geom_object>");
  deck.contacts =
      "<contact><type>friction_bard</type><materials>[0,1]</materials><mu>0.3</mu></contact>";
  TextRun::Rewrites changes = {
      {"<gravity>[0,0,0]", "<gravity>[0,-10,0]"},
      {"<maxTime>1<", "<maxTime>0.4<"},
      {"<outputInterval>0</outputInterval>", saves({"p.temperature", "p.mass"})}};
  if (GetParam().levels)
    changes = with_fine_level("[0.8,0,0]", "[1.6,1,0.1]", "[16,20,1]", std::move(changes));
  const TextRun run(deck, changes, "friction_heat");
  const auto T = run.particles("p.temperature")[0], m = run.particles("p.mass")[0];
  double heat = 0, mass = 0;
  for (std::size_t p = 0; p < T.size(); ++p) {
    heat += m[p] * 5 * (T[p] - 300);
    mass += m[p];
  }
  double contact = 0;
  for (const auto& [name, value] : run.report().budget)
    if (name == "contact loss") contact = value;
  RecordProperty("heat", std::to_string(heat / (0.5 * mass)));
  RecordProperty("of_contact_loss", std::to_string(heat / contact));
  EXPECT_NEAR(heat / contact, 1, GetParam().of_contact_loss);
  EXPECT_NEAR(heat / (0.5 * mass), GetParam().share, 0.05);
}

// Of the midpoint transfer the account tells that part of contact's loss on which two ways to
// count it agree.
INSTANTIATE_TEST_SUITE_P(On, FrictionHeat,
                         testing::Values(HeatCase{"flip", false, 0.92, 0.02},
                                         HeatCase{"flip", true, 0.66, 0.02},
                                         HeatCase{"midpoint", false, 0.92, 0.03},
                                         HeatCase{"midpoint", true, 0.78, 0.03}),
                         [](const auto& test) {
                           return std::string(test.param.transfer) +
                                  (test.param.levels ? "_on_two_levels" : "_on_one_level");
                         });

// A block that hardly changes its volume, squeezed between walls of a corner: pressures of the
// particles of a cell are one, and volumes stay those of the cell.
TEST(SharedDilatation, LeavesOnePressureInACell) {
  const auto spread = [](bool shares) {
    SolidDeck deck;
    deck.upper = "[1,1,0.1]";
    deck.cells = "[10,10,1]";
    deck.flags = std::string("<interpolator>gimp</interpolator><DoPressureStabilization>") +
                 (shares ? "true" : "false") + "</DoPressureStabilization>";
    deck.objects =
        "<geom_object><box><min>[0,0,0]</min><max>[0.6,0.6,1]</max></box><res>[2,2,1]</res>"
        "<velocity>[0,-5,0]</velocity><temperature>300</temperature></geom_object>";
    const TextRun run(
        deck,
        {{"<bulk_modulus>1e6", "<bulk_modulus>1e7"},
         {"<shear_modulus>5e5", "<shear_modulus>1e4"},
         {"<maxTime>1<", "<maxTime>0.02<"},
         {"<outputInterval>0</outputInterval>", saves({"p.stress", "p.x", "p.volume"})}},
        "dilatation");
    const auto x = run.particles("p.x"), s = run.particles("p.stress");
    double sum = 0, squares = 0, volume = 0;
    const std::size_t n = x[0].size();
    // Neighbours along x of one cell: pressures alternate between them without a shared J.
    std::map<std::pair<int, int>, std::vector<double>> cells;
    for (std::size_t p = 0; p < n; ++p)
      cells[{static_cast<int>(10 * x[0][p]), static_cast<int>(10 * x[1][p])}].push_back(
          (s[0][p] + s[s.size() == 6 ? 3 : 4][p] + s[s.size() == 6 ? 5 : 8][p]) / 3);
    for (const auto& [cell, pressures] : cells)
      for (const double a : pressures) {
        double mean = 0;
        for (const double b : pressures) mean += b / static_cast<double>(pressures.size());
        squares += (a - mean) * (a - mean);
        sum += mean * mean;
      }
    const auto volumes = run.particles("p.volume");
    for (const double v : volumes[0]) volume += v;
    EXPECT_NEAR(volume, 0.6 * 0.6 * 0.1, 0.05 * 0.036);  // squeezed by 2 %
    return std::sqrt(squares / sum);
  };
  const double alone = spread(false), together = spread(true);
  RecordProperty("alone", std::to_string(alone));
  RecordProperty("together", std::to_string(together));
  EXPECT_LT(together, 0.5 * alone);
}

}  // namespace
}  // namespace sluice::mpm::transmitting_test
