// Particles that leave the domain: what they take along is booked.
#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/json.hpp"
#include "mpm/test_support/text_run.hpp"

namespace sluice::mpm::leaving_test {
namespace {

// A block half of which passes an open side, stressed by the side that the other end has met.
TEST(Leaving, MassMomentumAndEnergyOfParticlesAreBooked) {
  SolidDeck deck;
  deck.flags = "<interpolator>gimp</interpolator>";
  deck.objects =
      "<geom_object><box><min>[0.6,0.3,0.3]</min><max>[0.9,0.6,0.6]</max></box>"
      "<res>[2,2,2]</res><velocity>[20,1,0]</velocity><temperature>300</temperature>"
      "</geom_object>";
  for (const char* side : {"x-", "x+", "y-", "y+", "z-", "z+"})
    deck.faces += fmt::format(
        "<Face side='{}'><BCType id='all' label='Velocity' var='Neumann'><value>[0,0,0]</value>"
        "</BCType></Face>\n",
        side);
  const TextRun run(deck,
                    {{"<maxTime>1<", "<maxTime>0.0125<"},
                     {"<outputInterval>0</outputInterval>", saves({"p.x"})}},
                    "leaving");
  const std::size_t left = run.particles("p.x")[0].size();
  EXPECT_GT(left, 0U);
  EXPECT_LT(left, 216U);
  const Json books = Json::parse(run.report().conservation_json);
  for (const char* name : {"mass of material 0", "momentum x", "momentum y", "momentum z"}) {
    const Json& of = books.at(name);
    EXPECT_LT(std::fabs(of.at("drift").get<double>()), 1e-13) << name;
  }
  // A share of the mass has gone with its energy: what is left of both does not know it.
  const Json &mass = books.at("mass of material 0"), &energy = books.at("total energy");
  const double gone = -mass.at("boundary").get<double>() / mass.at("start").get<double>();
  EXPECT_NEAR(gone, 1 - static_cast<double>(left) / 216, 1e-12);
  EXPECT_NEAR(energy.at("boundary").get<double>() / energy.at("start").get<double>(), -gone, 1e-3);
  EXPECT_LT(std::fabs(energy.at("drift").get<double>()), 1e-3);
}

}  // namespace
}  // namespace sluice::mpm::leaving_test
