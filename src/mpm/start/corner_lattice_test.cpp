// Corners of particles at the start: shared to the bit, on the surface, faces outer where they are.
#include "mpm/start/corner_lattice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "mpm/start/seed.hpp"
#include "mpm/test_support/solid_deck.hpp"

namespace sluice::mpm::corner_lattice {
namespace {

constexpr double pi = std::numbers::pi;

std::string object(const std::string& piece, const std::string& res, const std::string& more = "") {
  return fmt::format(
      "<geom_object>{}<res>{}</res><velocity>[0,0,0]</velocity><temperature>300</temperature>{}"
      "</geom_object>",
      piece, res, more);
}

std::string box(const std::string& low, const std::string& high) {
  return fmt::format("<box><min>{}</min><max>{}</max></box>", low, high);
}

SolidDeck deck_of(const std::string& objects, const std::string& cells) {
  SolidDeck deck;
  deck.flags = "<interpolator>carried_corners</interpolator>";
  deck.cells = cells;
  deck.objects = objects;
  if (cells.ends_with(",1]")) deck.upper = "[1,1,0.1]";
  return deck;
}

SeededParticles seeded(const ReadDeck& read, const std::vector<IndexBox>& windows = {}) {
  EXPECT_EQ(read.text, "");
  const Seeder seeder(read.solids, read.scene.grid);
  const Level& level = read.scene.grid.levels.front();
  SeededParticles particles;
  if (windows.empty()) seeder.seed(0, level, level.domain, {}, particles);
  for (const IndexBox& window : windows) seeder.seed(0, level, window, {}, particles);
  return particles;
}

double sum(const std::vector<double>& x) {
  return std::accumulate(x.begin(), x.end(), 0.0);
}

int faces(const SeededParticles& p) {
  int count = 0;
  for (const ParticleCorners& c : p.corners) count += std::popcount(static_cast<unsigned>(c.outer));
  return count;
}

// Every place of a corner, rounded: those that are nearly the same must be the same.
void expect_shared_bits(const SeededParticles& p, int corners) {
  std::map<std::array<long, 3>, Vec3> known;
  for (const ParticleCorners& c : p.corners)
    for (int k = 0; k < corners; ++k) {
      const Vec3 x = c.place[k];
      const std::array<long, 3> key = {std::lround(x.x * 1e9), std::lround(x.y * 1e9),
                                       std::lround(x.z * 1e9)};
      const auto [at, fresh] = known.try_emplace(key, x);
      EXPECT_TRUE(fresh || at->second == x);
    }
}

TEST(CornerLattice, ABoxOnTheLatticeIsExact) {
  const auto read =
      read_solids(deck_of(object(box("[0.2,0.3,0.1]", "[0.6,0.5,0.4]"), "[2,2,2]"), "[10,10,10]"));
  const SeededParticles p = seeded(read);
  ASSERT_EQ(p.count(), 8u * 4 * 2 * 3);
  for (const double volume : p.volume) EXPECT_NEAR(volume, 1.25e-4, 1e-17);
  EXPECT_NEAR(sum(p.volume), 0.4 * 0.2 * 0.3, 1e-15);
  EXPECT_NEAR(sum(p.mass), 24, 1e-11);
  EXPECT_EQ(faces(p), 2 * (8 * 4 + 4 * 6 + 8 * 6));
  expect_shared_bits(p, 8);
}

// Faces between places of the lattice, in three, two directions and one.
TEST(CornerLattice, ABoxBesideTheLatticeIsExact) {
  for (const char* cells : {"[10,10,10]", "[10,10,1]", "[10,1,1]"}) {
    const std::string text = cells;
    const bool flat = text.ends_with(",1]"), line = text.ends_with(",1,1]");
    const std::string res = line ? "[2,1,1]" : flat ? "[2,2,1]" : "[2,2,2]";
    const std::string low = line   ? "[0.213,-1,-1]"
                            : flat ? "[0.213,0.337,-1]"
                                   : "[0.213,0.337,0.111]";
    const std::string high = line ? "[0.62,2,2]" : flat ? "[0.62,0.52,2]" : "[0.62,0.52,0.39]";
    const SeededParticles p = seeded(read_solids(deck_of(object(box(low, high), res), cells)));
    const double wanted = 0.407 * (line ? 0.1 : flat ? 0.183 * 0.1 : 0.183 * 0.279);
    EXPECT_NEAR(sum(p.volume), wanted, 1e-14) << cells;
    expect_shared_bits(p, line ? 2 : flat ? 4 : 8);
  }
}

double disk_error(int cells, double& least, double radius = 0.3137) {
  const std::string n = std::to_string(cells);
  const auto read = read_solids(
      deck_of(object(fmt::format("<cylinder><bottom>[0.5,0.5,-1]</bottom><top>[0.5,0.5,1]</top>"
                                 "<radius>{}</radius></cylinder>",
                                 radius),
                     "[2,2,1]"),
              "[" + n + "," + n + ",1]"));
  const SeededParticles p = seeded(read);
  const double part = 0.1 / (4.0 * cells * cells);
  least = *std::min_element(p.volume.begin(), p.volume.end()) / part;
  expect_shared_bits(p, 4);
  return 1 - sum(p.volume) / (pi * radius * radius * 0.1);
}

// Areas of polygons whose corners lie on a circle: less than the circle's by the second order.
TEST(CornerLattice, ADiskHasItsAreaToTheSecondOrder) {
  double least = 0;
  const double e20 = disk_error(20, least), e40 = disk_error(40, least),
               e80 = disk_error(80, least);
  RecordProperty("errors", fmt::format("{:.2e} {:.2e} {:.2e}", e20, e40, e80));
  EXPECT_GT(e80, 0);
  EXPECT_LT(e20, 3e-3);
  EXPECT_LT(e40, 7e-4);
  EXPECT_LT(e80, 2e-4);
}

// All corners of outer faces lie on the circle, and no particle is left with hardly any area.
TEST(CornerLattice, OuterCornersOfDisksLieOnTheCircle) {
  double least = 1, own = 0;
  for (int n = 0; n < 40; ++n) {
    disk_error(20, own, 0.2 + 0.005 * n);
    least = std::min(least, own);
  }
  RecordProperty("least", fmt::format("{:.3f}", least));
  EXPECT_GT(least, 0.2);
}

TEST(CornerLattice, ABallHasItsVolumeToTheSecondOrder) {
  double error[2];
  for (const int n : {0, 1}) {
    const std::string cells = n == 0 ? "[10,10,10]" : "[20,20,20]";
    const SeededParticles p = seeded(read_solids(deck_of(
        object("<sphere><origin>[0.5,0.5,0.5]</origin><radius>0.31</radius></sphere>", "[2,2,2]"),
        cells)));
    const double part = 1e-3 / (n == 0 ? 8 : 64);
    error[n] = 1 - sum(p.volume) / (4 * pi / 3 * 0.31 * 0.31 * 0.31);
    RecordProperty(cells, fmt::format("{:.2e} {:.3f}", error[n],
                                      *std::min_element(p.volume.begin(), p.volume.end()) / part));
    expect_shared_bits(p, 8);
  }
  EXPECT_LT(error[0], 2e-2);
  EXPECT_LT(error[1], 5e-3);
}

TEST(CornerLattice, WindowsChangeNoBit) {
  const auto read = read_solids(deck_of(
      object("<sphere><origin>[0.47,0.5,0.52]</origin><radius>0.31</radius></sphere>", "[2,2,2]"),
      "[10,10,10]"));
  const SeededParticles whole = seeded(read);
  const SeededParticles parts =
      seeded(read, {{{0, 0, 0}, {5, 10, 10}}, {{5, 0, 0}, {10, 4, 10}}, {{5, 4, 0}, {10, 10, 10}}});
  ASSERT_EQ(whole.count(), parts.count());
  std::map<std::int64_t, std::size_t> rows;
  for (std::size_t n = 0; n < parts.count(); ++n) rows[parts.id[n]] = n;
  for (std::size_t n = 0; n < whole.count(); ++n) {
    const std::size_t m = rows.at(whole.id[n]);
    EXPECT_EQ(whole.corners[n].place, parts.corners[m].place);
    EXPECT_EQ(whole.corners[n].outer, parts.corners[m].outer);
    EXPECT_EQ(whole.volume[n], parts.volume[m]);
    EXPECT_EQ(whole.x[n], parts.x[m]);
  }
}

// A bar across a periodic direction has no ends; against a side that is not periodic it has one.
TEST(CornerLattice, FacesAreOuterWhereNoParticleSharesThem) {
  for (const bool periodic : {false, true}) {
    SolidDeck deck = deck_of(object(box("[0,0.2,-1]", "[1,0.4,1]"), "[2,2,1]"), "[10,10,1]");
    if (periodic) {
      deck.level = "<periodic>[1,0,0]</periodic>";
      for (const char* side : {"y-", "y+", "z-", "z+"})
        deck.faces += fmt::format(
            "<Face side='{}'><BCType id='all' label='Symmetric' var='symmetry'/></Face>\n", side);
    }
    const SeededParticles p = seeded(read_solids(deck));
    ASSERT_EQ(p.count(), 80u);
    EXPECT_EQ(faces(p), 2 * 20 + (periodic ? 0 : 8));
    EXPECT_NEAR(sum(p.volume), 0.02, 1e-15);
  }
}

// Two objects of a material, each with a surface of its own.
TEST(CornerLattice, ObjectsHaveSurfacesOfTheirOwn) {
  const SeededParticles p =
      seeded(read_solids(deck_of(object(box("[0.2,0.2,-1]", "[0.4,0.4,1]"), "[2,2,1]") +
                                     object(box("[0.4,0.2,-1]", "[0.6,0.4,1]"), "[2,2,1]"),
                                 "[10,10,1]")));
  EXPECT_EQ(faces(p), 32);
  EXPECT_NEAR(sum(p.volume), 0.008, 1e-15);
}

// A map takes corners along: a square turned and stretched.
TEST(CornerLattice, MapsTakeCornersAlong) {
  const SeededParticles p = seeded(
      read_solids(deck_of(object(box("[0.2,0.2,-1]", "[0.6,0.6,1]"), "[2,2,1]",
                                 "<affineTransformation_A0>[0.8,-0.5,0]</affineTransformation_A0>"
                                 "<affineTransformation_A1>[0.5,0.9,0]</affineTransformation_A1>"
                                 "<affineTransformation_A2>[0,0,1]</affineTransformation_A2>"
                                 "<affineTransformation_b>[0.3,-0.1,0]</affineTransformation_b>"),
                          "[10,10,1]")));
  ASSERT_EQ(p.count(), 64u);
  EXPECT_NEAR(sum(p.volume), 0.016 * (0.8 * 0.9 + 0.25), 1e-15);
  EXPECT_EQ(faces(p), 32);
  expect_shared_bits(p, 4);
}

}  // namespace
}  // namespace sluice::mpm::corner_lattice
