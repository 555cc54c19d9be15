// Runs of particles that carry their corners: what moves as a whole keeps its shape, neighbours
// stay neighbours, volumes are those of corners.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "mpm/test_support/text_run.hpp"

namespace sluice::mpm::carried_corners {
namespace {

constexpr double young = 9 * 0.6 * 0.3 / (3 * 0.6 + 0.3);
constexpr double most_flight_stress = 1e-12;  // of Young's modulus; measured 0
constexpr double round_off = 1e-12;           // measured 2e-13
constexpr double most_momentum = 1e-12;       // of sum m |v|; measured 1e-15

using Columns = std::vector<std::vector<double>>;

std::string disk(const std::string& centre, double radius, const std::string& velocity) {
  return fmt::format(
      "<geom_object><cylinder><bottom>[{},-1]</bottom><top>[{},1]</top><radius>{}</radius>"
      "</cylinder><res>[2,2,1]</res><velocity>[{},0]</velocity><temperature>300</temperature>"
      "</geom_object>",
      centre, centre, radius, velocity);
}

SolidDeck flat_deck(const std::string& objects) {
  SolidDeck deck;
  deck.flags =
      "<interpolator>carried_corners</interpolator>"
      "<DoExplicitHeatConduction>false</DoExplicitHeatConduction>";
  deck.upper = "[1,1,0.1]";
  deck.cells = "[20,20,1]";
  deck.objects = objects;
  return deck;
}

TextRun::Rewrites rewrites(double end) {
  std::string saves;
  for (const char* label :
       {"p.x", "p.velocity", "p.mass", "p.stress", "p.deformationMeasure", "p.volume", "p.volume_0",
        "p.corner1", "p.corner2", "p.corner3", "p.corner4", "p.outerFaces", "KineticEnergy"})
    saves += fmt::format("<save label='{}'/>", label);
  return {{"<maxTime>1<", fmt::format("<maxTime>{}<", end)},
          {"<density>1000<", "<density>1<"},
          {"<bulk_modulus>1e6<", "<bulk_modulus>0.6<"},
          {"<shear_modulus>5e5<", "<shear_modulus>0.3<"},
          {"<outputInterval>0</outputInterval>",
           "<outputInterval>100</outputInterval><outputInitTimestep/><outputLastTimestep>true"
           "</outputLastTimestep>" +
               saves}};
}

std::string corner_label(int k) {
  return "p.corner" + std::to_string(k + 1);
}

// By id: components of a label, for orders may differ between outputs.
std::map<double, std::vector<double>> by_id(const TextRun& run, const std::string& name,
                                            const std::string& which) {
  const Columns ids = run.particles("p.particleID", 0, which), all = run.particles(name, 0, which);
  std::map<double, std::vector<double>> to;
  for (std::size_t n = 0; n < ids[0].size(); ++n)
    for (const auto& component : all) to[ids[0][n]].push_back(component[n]);
  return to;
}

double largest(const Columns& columns) {
  double most = 0;
  for (const auto& c : columns)
    for (const double x : c) most = std::fmax(most, std::fabs(x));
  return most;
}

class Carried : public testing::TestWithParam<std::string> {
 protected:
  void choose(SolidDeck& deck) const { deck.flags += "<transfer>" + GetParam() + "</transfer>"; }
  std::string named(const std::string& name) const { return name + '_' + GetParam(); }
};

INSTANTIATE_TEST_SUITE_P(With, Carried, testing::Values("flip", "midpoint"),
                         [](const auto& of) { return of.param; });

// A disk across 100 cells and periodic ends at the speed of sound: no stress, to the bit.
TEST_P(Carried, AFlyingDiskKeepsItsShapeToTheBit) {
  SolidDeck deck = flat_deck(disk("0.47,0.53", 0.21, "1,0.5"));
  deck.level = "<periodic>[1,1,1]</periodic>";
  deck.faces = " ";
  choose(deck);
  const TextRun run(deck, rewrites(5), named("flying_disk"));
  EXPECT_GT(run.report().steps, 400);
  const double stress = largest(run.particles("p.stress")) / young;
  RecordProperty("stress", fmt::format("{:.1e}", stress));
  EXPECT_LE(stress, most_flight_stress);
  const auto v = run.particles("p.velocity");
  for (std::size_t n = 0; n < v[0].size(); ++n) {
    EXPECT_NEAR(v[0][n], 1, 1e-12);
    EXPECT_NEAR(v[1][n], 0.5, 1e-12);
  }
}

// What holds at the end of any run in a plane: corners that were one place still are, volumes are
// areas of corners and V_0 det F, places are middles.
void expect_whole(const TextRun& run, double thickness) {
  std::vector<std::map<double, std::vector<double>>> start, end;
  for (int k = 0; k < 4; ++k) {
    start.push_back(by_id(run, corner_label(k), "#0"));
    end.push_back(by_id(run, corner_label(k), "last"));
  }
  std::map<std::vector<double>, std::vector<double>> went;
  int shared = 0;
  for (std::size_t k = 0; k < 4; ++k)
    for (const auto& [id, place] : start[k]) {
      const auto [at, fresh] = went.try_emplace(place, end[k].at(id));
      if (fresh) continue;
      ++shared;
      EXPECT_EQ(at->second, end[k].at(id)) << id;
    }
  EXPECT_GT(shared, static_cast<int>(2 * start[0].size()));
  const auto volume = by_id(run, "p.volume", "last"), volume_0 = by_id(run, "p.volume_0", "last");
  const auto F = by_id(run, "p.deformationMeasure", "last"), x = by_id(run, "p.x", "last");
  double worst = 0;
  for (const auto& [id, v] : volume) {
    const auto corner = [&](std::size_t k, std::size_t d) { return end[k].at(id)[d]; };
    double area = 0;  // shoelace
    const std::size_t turn[4] = {0, 1, 3, 2};
    for (std::size_t n = 0; n < 4; ++n) {
      const std::size_t a = turn[n], b = turn[(n + 1) % 4];
      area += 0.5 * (corner(a, 0) * corner(b, 1) - corner(b, 0) * corner(a, 1));
    }
    const std::vector<double>& f = F.at(id);
    const double J = f[0] * f[4] - f[1] * f[3];
    worst = std::fmax(worst, std::fabs(area * thickness / v[0] - 1));
    worst = std::fmax(worst, std::fabs(J * volume_0.at(id)[0] / v[0] - 1));
    for (std::size_t d = 0; d < 2; ++d)
      EXPECT_NEAR(x.at(id)[d], 0.25 * (corner(0, d) + corner(1, d) + corner(2, d) + corner(3, d)),
                  1e-15);
  }
  testing::Test::RecordProperty("volume", fmt::format("{:.1e}", worst));
  EXPECT_LE(worst, round_off);
}

// Two disks meet, flatten, turn around each other and part.
TEST_P(Carried, DisksThatCollideStayWholeOverAThousandSteps) {
  SolidDeck deck = flat_deck(disk("0.3,0.33", 0.2, "0.1,0.1") + disk("0.7,0.67", 0.2, "-0.1,-0.1"));
  choose(deck);
  const TextRun run(deck, rewrites(18), named("whole_disks"));
  EXPECT_GE(run.report().steps, 1000);
  expect_whole(run, 0.1);
  const auto kinetic = run.history("KineticEnergy");
  double least = 1e300;
  for (const auto& row : kinetic) least = std::min(least, row[1]);
  RecordProperty("kinetic_least", fmt::format("{:.3f}", least / kinetic.front()[1]));
  RecordProperty("kinetic_end", fmt::format("{:.3f}", kinetic.back()[1] / kinetic.front()[1]));
  EXPECT_LT(least, 0.4 * kinetic.front()[1]);
}

TEST(CarriedCorners, ACollisionKeepsMomentum) {
  const SolidDeck deck =
      flat_deck(disk("0.35,0.4", 0.14, "0.2,0.1") + disk("0.65,0.6", 0.14, "-0.1,-0.1"));
  const TextRun run(deck, rewrites(1.5), "momentum_of_disks");
  for (std::size_t d = 0; d < 2; ++d) {
    double sum[2] = {}, size = 0;
    for (const int when : {0, 1}) {
      const std::string which = when == 0 ? "#0" : "last";
      const auto v = run.particles("p.velocity", 0, which), m = run.particles("p.mass", 0, which);
      for (std::size_t n = 0; n < m[0].size(); ++n) {
        sum[when] += m[0][n] * v[d][n];
        if (when == 0) size += m[0][n] * std::fabs(v[d][n]);
      }
    }
    EXPECT_NEAR(sum[0], sum[1], most_momentum * size);
  }
}

// A block that turns and rings: areas follow.
TEST(CarriedCorners, AreasOfATurningBlockAreThoseOfItsDeformation) {
  SolidDeck deck = flat_deck(
      "<geom_object><box><min>[0.35,0.3,-1]</min><max>[0.65,0.7,1]</max></box><res>[2,2,1]</res>"
      "<velocity>[0,0,0]</velocity><temperature>300</temperature></geom_object>");
  deck.flags += "<affine_damping>0</affine_damping><transfer>affine</transfer>";
  auto changes = rewrites(1);
  changes.emplace_back("<gravity>[0,0,0]<", "<gravity>[0.1,0.2,0]<");
  const TextRun run(deck, changes, "turning_areas");
  expect_whole(run, 0.1);
}

// A bar that is torn: the run ends, and says which particle, why and what to do.
TEST(CarriedCorners, ATornBodyEndsTheRunCleanly) {
  SolidDeck deck = flat_deck(
      "<geom_object><box><min>[0.3,0.4,-1]</min><max>[0.5,0.6,1]</max></box><res>[2,2,1]</res>"
      "<velocity>[-1,0,0]</velocity><temperature>300</temperature></geom_object>"
      "<geom_object><box><min>[0.5,0.4,-1]</min><max>[0.7,0.6,1]</max></box><res>[2,2,1]</res>"
      "<velocity>[8,0,0]</velocity><temperature>300</temperature></geom_object>");
  try {
    const TextRun run(deck, rewrites(1), "torn");
    ADD_FAILURE() << "the run went on";
  } catch (const std::runtime_error& e) {
    const std::string said = e.what();
    EXPECT_NE(said.find("particle"), std::string::npos) << said;
    EXPECT_NE(said.find("a corner lies over 1.5 cells from its middle"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace sluice::mpm::carried_corners
