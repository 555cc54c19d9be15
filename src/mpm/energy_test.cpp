// Bars and blocks that drift and vibrate: no basis gains energy, whatever the deck's multiplier.
#include <gtest/gtest.h>

#include "framework/base/json.hpp"
#include "mpm/step/stable_step.hpp"
#include "mpm/test_support/text_run.hpp"

namespace sluice::mpm::energy_test {
namespace {

constexpr double most_gain = 0.01;  // of the energy

struct Case {
  const char* basis;
  const char* transfer;
  int per_cell;
  double drift;  // of the speed of sound
  int directions;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.basis << ' ' << c.transfer << ' ' << c.per_cell << " a cell, drift " << c.drift << ", "
       << c.directions << "-D";
}

// Ten cells (six in two directions) of rho 1000, K 1e6, G 5e5: c = 40.8 m/s. Halves of it move with
// 0.01 c against each other.
SolidDeck deck_of(const Case& c) {
  const double speed = std::sqrt((1e6 + 4.0 / 3 * 5e5) / 1000), v = c.drift * speed;
  const int cells = c.directions == 1 ? 10 : 6;
  SolidDeck deck;
  deck.lower = "[0,0,0]";
  deck.upper = c.directions == 1 ? "[40,1,1]" : "[24,24,1]";
  deck.cells = c.directions == 1 ? "[40,1,1]" : "[24,24,1]";
  deck.level = c.directions == 1 ? "<periodic>[1,0,0]</periodic>" : "<periodic>[1,1,0]</periodic>";
  deck.faces = c.directions == 1 ? "" : " ";
  if (c.directions == 2)
    for (const char* side : {"z-", "z+"})
      deck.faces += fmt::format(
          "<Face side='{}'><BCType id='all' label='Symmetric' var='symmetry'/></Face>", side);
  else
    for (const char* side : {"y-", "y+", "z-", "z+"})
      deck.faces += fmt::format(
          "<Face side='{}'><BCType id='all' label='Symmetric' var='symmetry'/></Face>", side);
  deck.flags = fmt::format(
      "<interpolator>{}</interpolator>{}", c.basis,
      c.transfer == std::string_view("musl")
          ? "<musl>true</musl>"
          : fmt::format("<transfer>{}</transfer><xpic_order>2</xpic_order>", c.transfer));
  deck.objects = "";
  for (int half = 0; half < 2; ++half) {
    const double low = 4 + half * 0.5 * cells, high = low + 0.5 * cells;
    deck.objects += fmt::format(
        "<geom_object><box><min>[{},{},-1]</min><max>[{},{},2]</max></box><res>[{},{},1]</res>"
        "<velocity>[{},{},0]</velocity><temperature>300</temperature></geom_object>",
        low, c.directions == 1 ? -1 : 4, high, c.directions == 1 ? 2 : 4 + cells, c.per_cell,
        c.directions == 1 ? 1 : c.per_cell, v + (half == 0 ? 0.01 : -0.01) * speed,
        c.directions == 1 ? 0 : 0.6 * v);
  }
  return deck;
}

class NoGain : public testing::TestWithParam<Case> {};

TEST_P(NoGain, WithAMultiplierOfOne) {
  const TextRun run(deck_of(GetParam()),
                    {{"<timestep_multiplier>0.4<", "<timestep_multiplier>1<"},
                     {"<maxTime>1<", "<maxTime>1.3<"},
                     {"</Time>", "<max_Timesteps>600</max_Timesteps></Time>"}},
                    "no_gain");
  const Json solids = Json::parse(run.report().solids_json).at("block");
  EXPECT_LE(solids.at("numerical_gain_of_scale").get<double>(), most_gain);
  EXPECT_FALSE(Json::parse(run.report().events_json)
                   .contains("step redone: a solid gained energy by numerical error"));
}

INSTANTIATE_TEST_SUITE_P(
    Of, NoGain,
    testing::Values(Case{"gimp", "flip", 1, 0, 1}, Case{"gimp", "flip", 2, 0.1, 1},
                    Case{"gimp", "flip", 3, 0.1, 1}, Case{"gimp", "xpic", 2, 0.1, 1},
                    Case{"cpdi", "flip", 1, 0.1, 1}, Case{"cpdi", "flip", 2, 0, 1},
                    Case{"carried_corners", "flip", 2, 0.1, 1},
                    Case{"3rdorderBS", "flip", 1, 0.1, 1}, Case{"3rdorderBS", "apic", 2, 0, 1},
                    Case{"3rdorderBS", "flip", 3, 1, 1}, Case{"4thorderBS", "flip", 2, 0.1, 1},
                    Case{"linear", "flip", 2, 0.1, 1}, Case{"gimp", "flip", 2, 0.1, 2},
                    Case{"cpdi", "flip", 2, 0.1, 2}, Case{"3rdorderBS", "flip", 2, 0.1, 2},
                    Case{"carried_corners", "flip", 3, 0.1, 2}, Case{"gimp", "midpoint", 2, 0.1, 1},
                    Case{"gimp", "midpoint", 1, 0.1, 2}, Case{"gimp", "midpoint", 2, 0.1, 2},
                    Case{"gimp", "midpoint", 3, 1, 2}, Case{"3rdorderBS", "midpoint", 2, 0.1, 2},
                    Case{"4thorderBS", "midpoint", 2, 0.1, 2}, Case{"gimp", "musl", 1, 0.1, 2},
                    Case{"gimp", "musl", 2, 0.1, 2}, Case{"3rdorderBS", "musl", 3, 0, 2},
                    Case{"4thorderBS", "musl", 2, 0.1, 1}, Case{"cpdi", "musl", 2, 0.1, 2}));

// A step that the deck forces upon a basis that it makes unstable: the run tells, and ends or goes
// on with shorter steps; its energy does not grow tenfold.
TEST(EnergyOfSolids, AForcedStepThatIsUnstableIsShortened) {
  SolidDeck deck = deck_of({"gimp", "flip", 2, 0, 1});
  // .9 of h/c, which delt_max would not forbid: only the guard can.
  const TextRun run(deck,
                    {{"<delt_min>0</delt_min><delt_max>1</delt_max>",
                      "<delt_min>0</delt_min><delt_init>0.022</delt_init>"
                      "<initial_delt_range>100</initial_delt_range><delt_max>0.022</delt_max>"},
                     {"<timestep_multiplier>0.4<", "<timestep_multiplier>1<"},
                     {"</Time>", "<max_Timesteps>600</max_Timesteps></Time>"},
                     {"<maxTime>1<", "<maxTime>13<"}},
                    "forced");
  const Json energy = Json::parse(run.report().conservation_json).at("total energy");
  EXPECT_LE(energy.at("now").get<double>(), 2 * energy.at("start").get<double>());
}

TEST(StableShare, KnowsBasisParticlesAndForm) {
  const auto share = [](const std::string& flags, const char* res) {
    SolidDeck deck;
    deck.flags = flags;
    std::string text = text_of(deck);
    text.replace(text.find("[2,2,2]"), 7, res);
    ReadDeck read;
    read.deck = load_deck_text(text, "share.ups", {}, solid_schema());
    finish_reading(read);
    return stable_share(read.solids, {true, true, true}).share;
  };
  const std::string gimp = "<interpolator>gimp</interpolator>";
  const std::string flip = gimp + "<transfer>flip</transfer>";
  EXPECT_EQ(share(flip, "[1,1,1]"), 0.55);
  EXPECT_EQ(share(flip, "[2,2,2]"), 0.52);
  EXPECT_EQ(share(flip, "[2,4,2]"), 0.5);
  for (const char* res : {"[1,1,1]", "[2,2,2]", "[2,4,2]"}) EXPECT_EQ(share(gimp, res), 0.9);
  EXPECT_EQ(share("", "[2,2,2]"), 0.9);
  EXPECT_EQ(share("<musl>false</musl>", "[2,2,2]"), 0.4);
  EXPECT_EQ(share(gimp + "<total_lagrangian>true</total_lagrangian>", "[2,2,2]"), 0.9);
}

}  // namespace
}  // namespace sluice::mpm::energy_test
