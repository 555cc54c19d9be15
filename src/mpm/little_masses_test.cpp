// Nodes that hardly any mass reaches, at free surfaces and at walls: no basis gives what is there a
// velocity without bound.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/base/json.hpp"
#include "mpm/test_support/text_run.hpp"

namespace sluice::mpm::little_masses_test {
namespace {

// Cells of 1 m, c = 1 m/s. A block of six cells, its halves against each other with .04 c, flies
// slantwise past nodes or into a wall; its particles start `beyond` nodes.
SolidDeck flying_block(const char* basis, double beyond, bool at_wall) {
  SolidDeck deck;
  deck.upper = "[20,20,1]";
  deck.cells = "[20,20,1]";
  deck.flags = fmt::format(
      "<interpolator>{}</interpolator><DoExplicitHeatConduction>false</DoExplicitHeatConduction>",
      basis);
  deck.objects = "";
  const double x = at_wall ? beyond : 5 + beyond, drift = at_wall ? -0.05 : 0.07;
  for (const int half : {0, 1})
    deck.objects += fmt::format(
        "<geom_object><box><min>[{:.15g},{:.15g},-1]</min><max>[{:.15g},{:.15g},2]</max></box>"
        "<res>[2,2,1]</res><velocity>[{},0.03,0]</velocity><temperature>300</temperature>"
        "</geom_object>",
        x + 3 * half, 5 + beyond, x + 3 * half + 3, 11 + beyond,
        drift + (half == 0 ? 0.02 : -0.02));
  return deck;
}

class LittleMasses : public testing::TestWithParam<const char*> {};

TEST_P(LittleMasses, GiveNoVelocityWithoutBound) {
  // Places within half a cell: particles beside nodes by nothing, by little, and in the middle.
  for (const double beyond : {0.0, 1e-12, 1e-3, 0.25, 0.25 + 1e-12, 0.25 + 1e-6, 0.5})
    for (const bool at_wall : {false, true}) {
      SCOPED_TRACE(fmt::format("{} beyond nodes, {}", beyond, at_wall ? "at a wall" : "free"));
      const TextRun run(flying_block(GetParam(), beyond, at_wall),
                        {{"<density>1000<", "<density>1<"},
                         {"<bulk_modulus>1e6<", "<bulk_modulus>0.6<"},
                         {"<shear_modulus>5e5<", "<shear_modulus>0.3<"},
                         {"<maxTime>1<", "<maxTime>30<"},
                         {"<delt_max>1<", "<delt_max>100<"},
                         {"<timestep_multiplier>0.4<", "<timestep_multiplier>0.8<"},
                         {"<outputInterval>0</outputInterval>", saves({"p.velocity"})}},
                        "little_masses");
      for (const std::vector<double>& component : run.particles("p.velocity"))
        EXPECT_THAT(component,
                    testing::Each(testing::AllOf(testing::Ge(-0.15), testing::Le(0.15))));
      // Points whose gradients jump where they cross nodes gain energy, and steps are redone.
      if (std::string_view(GetParam()) == "linear") continue;
      const Json solids = Json::parse(run.report().solids_json).at("block");
      EXPECT_LE(solids.at("numerical_gain_of_scale").get<double>(), 0.005);
      EXPECT_FALSE(Json::parse(run.report().events_json)
                       .contains("step redone: a solid gained energy by numerical error"));
    }
}

INSTANTIATE_TEST_SUITE_P(Of, LittleMasses,
                         testing::Values("linear", "gimp", "cpgimp", "3rdorderBS", "4thorderBS",
                                         "cpdi", "fast_cpdi", "carried_corners"));

}  // namespace
}  // namespace sluice::mpm::little_masses_test
