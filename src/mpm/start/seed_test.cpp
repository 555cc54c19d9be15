// Particles at the start: exact volumes, ids and bits that no box changes, sizes, maps, lists.
#include "mpm/start/seed.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <tuple>

#include "framework/base/temporary_folder.hpp"
#include "mpm/start/seed_faults.hpp"
#include "mpm/test_support/solid_deck.hpp"

namespace sluice::mpm::seed_test {
namespace {

using testing::HasSubstr;

std::string object(const std::string& piece, const std::string& res = "[2,2,2]",
                   const std::string& more = "") {
  return fmt::format(
      "<geom_object>{}<res>{}</res><velocity>[1,2,3]</velocity><temperature>300</temperature>"
      "{}</geom_object>",
      piece, res, more);
}

SolidDeck deck_of(const std::string& objects) {
  SolidDeck deck;
  deck.objects = objects;
  return deck;
}

SeededParticles seed_in(const ReadDeck& read, const std::vector<IndexBox>& windows,
                        std::span<const IndexBox> covered = {}) {
  const Seeder seeder(read.solids, read.scene.grid);
  SeededParticles particles;
  for (const IndexBox& window : windows)
    seeder.seed(0, read.scene.grid.levels.front(), window, covered, particles);
  return particles;
}

SeededParticles seeded(const ReadDeck& read) {
  EXPECT_EQ(read.text, "");
  return seed_in(read, {read.scene.grid.levels.front().domain});
}

double sum(const std::vector<double>& x) {
  return std::accumulate(x.begin(), x.end(), 0.0);
}

// Everything of each particle, by id.
using Rows = std::map<std::int64_t, std::vector<double>>;
Rows rows_of(const SeededParticles& p) {
  Rows rows;
  for (std::size_t n = 0; n < p.count(); ++n) {
    std::vector<double> row = {p.x[n],
                               p.y[n],
                               p.z[n],
                               p.velocity[0][n],
                               p.velocity[1][n],
                               p.velocity[2][n],
                               p.mass[n],
                               p.volume[n],
                               p.temperature[n],
                               p.colour[n],
                               1.0 * p.surface[n]};
    for (const auto& edge : p.edges) row.push_back(edge[n]);
    EXPECT_TRUE(rows.emplace(p.id[n], row).second) << "id " << p.id[n] << " twice";
  }
  return rows;
}

const std::string ball = "<sphere><origin>[0.5,0.5,0.5]</origin><radius>0.31</radius></sphere>";

TEST(Seed, ABoxHasItsVolumeAndEveryParticleItsPart) {
  const SeededParticles p = seeded(read_solids({}));
  ASSERT_EQ(p.count(), 4u * 4 * 4 * 8);
  EXPECT_NEAR(sum(p.volume), 0.4 * 0.4 * 0.4, 1e-15);
  EXPECT_NEAR(sum(p.mass), 64.0, 1e-11);
  for (std::size_t n = 0; n < p.count(); ++n) {
    EXPECT_DOUBLE_EQ(p.volume[n], 1e-3 / 8);
    EXPECT_EQ(p.edges[0][n], 0.5);
    EXPECT_EQ(p.edges[1][n], 0);
    EXPECT_EQ(p.edges[8][n], 0.5);
    EXPECT_EQ(p.velocity[2][n], 3);
    EXPECT_EQ(p.temperature[n], 300);
  }
  EXPECT_DOUBLE_EQ(p.x[0], 0.225);
  EXPECT_DOUBLE_EQ(p.z[0], 0.225);
}

// The particles with a neighbouring place outside are the outermost layer.
TEST(Seed, TheSurfaceOfABoxIsItsOutermostLayer) {
  const SeededParticles p = seeded(read_solids({}));
  const auto at_surface = std::count(p.surface.begin(), p.surface.end(), 1);
  EXPECT_EQ(at_surface, 8 * 8 * 8 - 6 * 6 * 6);
}

TEST(Seed, VolumeFractionTakesMassAndNoVolume) {
  const SeededParticles p = seeded(
      read_solids(deck_of(object(ball, "[2,2,2]", "<volumeFraction>0.25</volumeFraction>"))));
  EXPECT_NEAR(sum(p.mass), 250 * sum(p.volume), 1e-10);
}

class Windows : public testing::TestWithParam<const char*> {};

// Bit for bit, whatever the windows; cuts at odd places.
TEST_P(Windows, GiveTheSameParticles) {
  const std::map<std::string, std::string> ways = {
      {"plain", ""},
      {"cut", "<cut_cells>true</cut_cells>"},
      {"filled", "<numLevelsParticleFilling>3</numLevelsParticleFilling>"},
      {"mapped",
       "<affineTransformation_A0>[0.8,-0.6,0]</affineTransformation_A0>"
       "<affineTransformation_A1>[0.6,0.8,0]</affineTransformation_A1>"
       "<affineTransformation_b>[0.4,-0.2,0.03]</affineTransformation_b>"}};
  const std::string hollow =
      "<difference>" + ball +
      "<box><min>[0.4,0.4,0]</min><max>[0.6,0.62,1]</max></box></difference>";
  const ReadDeck read =
      read_solids(deck_of(object(hollow, "[2,3,1]", ways.at(GetParam())) + object(ball)));
  const IndexBox whole = read.scene.grid.levels.front().domain;
  const Rows once = rows_of(seed_in(read, {whole}));
  ASSERT_GT(once.size(), 1000u);
  std::vector<IndexBox> windows;
  const int cuts[] = {0, 3, 4, 10};
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        windows.push_back({{cuts[i], cuts[j], cuts[k]}, {cuts[i + 1], cuts[j + 1], cuts[k + 1]}});
  EXPECT_EQ(rows_of(seed_in(read, windows)), once);
}

INSTANTIATE_TEST_SUITE_P(Of, Windows, testing::Values("plain", "cut", "filled", "mapped"),
                         [](const auto& way) { return std::string(way.param); });

TEST(Seed, CellsUnderFinerOnesStayEmpty) {
  const ReadDeck read = read_solids({});
  const IndexBox covered[] = {{{4, 0, 0}, {10, 10, 10}}};
  const SeededParticles p = seed_in(read, {read.scene.grid.levels.front().domain}, covered);
  ASSERT_EQ(p.count(), 2u * 4 * 4 * 8);
  EXPECT_LT(*std::max_element(p.x.begin(), p.x.end()), 0.4);
}

// A turn by atan(3/4) and a stretch: det A = 2.
TEST(Seed, AMapTurnsPlacesEdgesAndVolumes) {
  const ReadDeck read = read_solids(
      deck_of(object("<box><min>[0.2,0.2,0.2]</min><max>[0.4,0.4,0.4]</max></box>", "[2,2,2]",
                     "<affineTransformation_A0>[1.6,-0.6,0]</affineTransformation_A0>"
                     "<affineTransformation_A1>[1.2,0.8,0]</affineTransformation_A1>"
                     "<affineTransformation_b>[0.1,0,0]</affineTransformation_b>")));
  const SeededParticles p = seeded(read);
  ASSERT_EQ(p.count(), 64u);
  EXPECT_NEAR(sum(p.volume), 2 * 0.008, 1e-15);
  EXPECT_DOUBLE_EQ(p.edges[0][0], 0.8);
  EXPECT_DOUBLE_EQ(p.edges[1][0], -0.3);
  EXPECT_DOUBLE_EQ(p.edges[3][0], 0.6);
  EXPECT_DOUBLE_EQ(p.x[0], 1.6 * 0.225 - 0.6 * 0.225 + 0.1);
}

// One radian of a tube: (b^2 - a^2)/2 l.
TEST(Seed, AxisymmetricVolumesAreThoseOfARadian) {
  SolidDeck deck =
      deck_of(object("<box><min>[0.2,0.2,0]</min><max>[0.6,0.7,1]</max></box>", "[2,2,1]"));
  deck.cells = "[10,10,1]";
  deck.flags = "<axisymmetric>true</axisymmetric>";
  const SeededParticles p = seeded(read_solids(deck));
  EXPECT_NEAR(sum(p.volume), 0.5 * (0.36 - 0.04) * 0.5, 1e-15);
  EXPECT_EQ(p.edges[8][0], 1);
}

// Volume and centroid of a half ball by cut cells: 2/3 pi r^3, 3/8 r from its plane.
TEST(CutCells, GiveVolumeAndCentroid) {
  const double r = 0.31;
  const std::string half =
      "<intersection>" + ball + "<box><min>[0.5,0,0]</min><max>[1,1,1]</max></box></intersection>";
  const SeededParticles whole = seeded(read_solids(deck_of(object(half))));
  const SeededParticles p =
      seeded(read_solids(deck_of(object(half, "[2,2,2]", "<cut_cells>true</cut_cells>"))));
  const double exact = 2.0 / 3 * std::numbers::pi * r * r * r;
  double moment = 0, spanned = 0;
  for (std::size_t n = 0; n < p.count(); ++n) {
    moment += p.volume[n] * p.x[n];
    spanned += 1e-3 * p.edges[0][n] * p.edges[4][n] * p.edges[8][n];
  }
  // Measured: 3e-5 and 1e-5; whole parts: 4e-3.
  EXPECT_NEAR(sum(p.volume) / exact, 1, 2e-4);
  EXPECT_NEAR(moment / sum(p.volume), 0.5 + 3.0 / 8 * r, 1e-4);
  EXPECT_NEAR(spanned, sum(p.volume), 1e-14);
  EXPECT_GT(p.count(), whole.count());
}

// Of a plane that cuts each cell of a row at the same oblique angle.
TEST(CutCells, AnObliquePlaneIsExactToAThousandth) {
  const std::string wedge =
      "<parallelepiped><p1>[0.1,0.1,-1]</p1><p2>[0.9,0.4,-1]</p2><p3>[0.1,0.6,-1]</p3>"
      "<p4>[0.1,0.1,3]</p4></parallelepiped>";
  SolidDeck deck = deck_of(object(wedge, "[2,2,1]", "<cut_cells>true</cut_cells>"));
  deck.cells = "[10,10,1]";
  const SeededParticles p = seeded(read_solids(deck));
  EXPECT_NEAR(sum(p.volume), 0.8 * 0.5, 0.4 * 1e-4);  // measured: 5e-6
}

// Half sizes fill what the large ones leave, and never overlap them.
TEST(FillingLevels, ComeNearerToTheVolume) {
  const double exact = 4.0 / 3 * std::numbers::pi * 0.31 * 0.31 * 0.31;
  double before = 1;
  for (const int levels : {-1, -2, -3, -4}) {
    const SeededParticles p = seeded(read_solids(deck_of(
        object(ball, "[2,2,2]",
               fmt::format("<numLevelsParticleFilling>{}</numLevelsParticleFilling>", levels)))));
    const double missing = 1 - sum(p.volume) / exact;
    EXPECT_LT(std::abs(missing), before) << levels;
    before = std::abs(missing);
    rows_of(p);
  }
  EXPECT_LT(before, 0.03);
}

TEST(SmoothCylinder, FillsItsVolumeExactly) {
  for (const char* scheme : {"pie_slices", "constant_particle_volumes"}) {
    SolidDeck deck = deck_of(object(fmt::format(
        "<smoothcyl><discretization_scheme>{}</discretization_scheme><bottom>[0.5,0.5,0.2]</bottom>"
        "<top>[0.5,0.5,0.7]</top><inner_radius>0.1</inner_radius><outer_radius>0.4</outer_radius>"
        "<num_radial>6</num_radial><num_axial>5</num_axial><num_angular>24</num_angular>"
        "<arc_start_angle>0</arc_start_angle><arc_angle>360</arc_angle></smoothcyl>",
        scheme)));
    const ReadDeck read = read_solids(deck);
    const SeededParticles p = seeded(read);
    EXPECT_NEAR(sum(p.volume), std::numbers::pi * (0.16 - 0.01) * 0.5, 1e-13) << scheme;
    const auto [least, most] = std::minmax_element(p.volume.begin(), p.volume.end());
    if (std::string(scheme) == "pie_slices") {
      EXPECT_EQ(p.count(), 6u * 5 * 24);
    } else {
      EXPECT_NEAR(*least, *most, 1e-15);
    }
    for (std::size_t n = 0; n < p.count(); ++n)
      EXPECT_TRUE(read.solids.materials[0].objects[0].piece->inside({p.x[n], p.y[n], p.z[n]}));
  }
}

class Files : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder / name, std::ios::binary) << text;
    return (folder / name).string();
  }
  std::string pack(const std::string& name, const std::string& text) {
    const std::string file = (folder / name).string();
    gzFile out = gzopen(file.c_str(), "wb");
    gzwrite(out, text.data(), static_cast<unsigned>(text.size()));
    gzclose(out);
    return file;
  }
  static std::string piece(const std::string& file, const std::string& variables = "") {
    return "<file><name>" + file + "</name>" + variables + "</file>";
  }
  TemporaryFolder folder;
};

const std::string two_points = "0.25 0.25 0.25 1e-4 7\n0.75 0.3 0.2 2e-4 8\n";
const std::string two_variables = "<var>p.volume</var><var>p.color</var>";

TEST_F(Files, GiveTheirParticlesOneByOne) {
  const SeededParticles p =
      seeded(read_solids(deck_of(object(piece(write("a.pts", two_points), two_variables)))));
  EXPECT_THAT(p.x, testing::ElementsAre(0.25, 0.75));
  EXPECT_THAT(p.volume, testing::ElementsAre(1e-4, 2e-4));
  EXPECT_THAT(p.colour, testing::ElementsAre(7, 8));
  EXPECT_THAT(p.mass, testing::ElementsAre(0.1, 0.2));
  EXPECT_THAT(p.id, testing::ElementsAre(0, 1));
}

TEST_F(Files, MayBePacked) {
  const std::string plain = write("a.pts", two_points), packed = pack("b.pts.gz", two_points);
  const auto rows = [&](const std::string& file) {
    return rows_of(seeded(read_solids(deck_of(object(piece(file, two_variables))))));
  };
  EXPECT_EQ(rows(packed), rows(plain));
}

// A name without .gz finds the packed file, with a warning.
TEST_F(Files, ArePackedUnderTheNameOfTheDeck) {
  pack("c.pts.gz", two_points);
  const ReadDeck read = read_solids(deck_of(object(piece("inputs/elsewhere/c.pts", two_variables))),
                                    (folder / "deck.ups").string());
  EXPECT_THAT(read.text, HasSubstr("c.pts.gz' is used"));
  EXPECT_EQ(seed_in(read, {read.scene.grid.levels.front().domain}).count(), 2u);
}

TEST_F(Files, ThatAreCutShortAreRefused) {
  std::string numbers;
  for (int n = 0; n < 3000; ++n) numbers += fmt::format("0.5 0.5 {:.12f}\n", std::sqrt(n) / 100);
  const std::string file = pack("d.pts.gz", numbers);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  const ReadDeck read = read_solids(deck_of(object(piece(file))));
  EXPECT_THAT(read.text, HasSubstr("ends before it is unpacked completely"));
}

// Edges in files are lengths; four corners hold a sixth of what they span.
TEST_F(Files, EdgesAreLengths) {
  const std::string file = write("e.pts", "0.5 0.5 0.5 0.06 0 0 0 0.03 0 0 0 0.02\n");
  const std::string edges = "<var>p.rvec1</var><var>p.rvec2</var><var>p.rvec3</var>";
  SolidDeck deck = deck_of(object(piece(file, edges), "[1,1,1]"));
  SeededParticles p = seeded(read_solids(deck));
  EXPECT_NEAR(p.volume[0], 3.6e-5, 1e-19);
  EXPECT_NEAR(p.edges[0][0], 0.6, 1e-15);
  deck.flags = "<interpolator>cpti</interpolator>";
  p = seeded(read_solids(deck));
  EXPECT_NEAR(p.volume[0], 0.6e-5, 1e-19);
}

TEST(Ids, AreBelowTwoToThe53AndRefusedBeyond) {
  const std::string wide = "<box><min>[0,0,0]</min><max>[1,1,1]</max></box>";
  std::string objects;
  for (int n = 0; n < 10; ++n) objects += object(wide, "[1000,1000,1000]");
  SolidDeck deck = deck_of(objects);
  deck.cells = "[100,100,100]";
  const ReadDeck read = read_solids(deck);
  ASSERT_EQ(read.text, "");
  EXPECT_THAT([&] { Seeder(read.solids, read.scene.grid); },
              testing::ThrowsMessage<InputError>(HasSubstr("more than 2^53 positions")));
}

std::string seed_faults(const SolidDeck& deck) {
  ReadDeck read = read_solids(deck);
  std::vector<Fault> faults;
  check_seeds(read.solids, read.scene.grid, faults);
  for (const Fault& fault : faults) read.text += to_string(fault) + '\n';
  return read.text;
}

TEST(SeedFaults, BodiesThatOverlapAreCounted) {
  const std::string low = "<box><min>[0.2,0.2,0.2]</min><max>[0.5,0.5,0.5]</max></box>";
  const std::string high = "<box><min>[0.4,0.4,0.4]</min><max>[0.8,0.8,0.8]</max></box>";
  EXPECT_THAT(seed_faults(deck_of(object(low) + object(high))),
              HasSubstr("8 particles of this <geom_object> are inside the one at"));
  const std::string apart = "<box><min>[0.5,0.2,0.2]</min><max>[0.8,0.5,0.5]</max></box>";
  EXPECT_EQ(seed_faults(deck_of(object(low) + object(apart))), "");
}

// Ten cells along each axis, two particles in each: parts are 0.05 wide.
TEST(SeedFaults, BodiesOfOneMaterialThatLieCloserThanACellAreTold) {
  const auto slab = [](double low, double high) {
    return fmt::format("<box><min>[{},0.2,0.2]</min><max>[{},0.8,0.8]</max></box>", low, high);
  };
  const auto told = [&](const std::string& objects) { return seed_faults(deck_of(objects)); };
  EXPECT_THAT(told(object(slab(0.1, 0.4)) + object(slab(0.45, 0.8))),
              HasSubstr("warning: this body is 0.5 of a cell away from the one at"));
  EXPECT_EQ(told(object(slab(0.1, 0.4)) + object(slab(0.5, 0.8))), "");
  EXPECT_EQ(told(object(slab(0.1, 0.4)) + object(slab(0.4, 0.8))), "");
  // Balls 0.08 apart, whose parts are a whole cell apart; and two that touch in a point.
  const auto sphere = [](double x, double radius) {
    return fmt::format("<sphere><origin>[{},0.5,0.5]</origin><radius>{}</radius></sphere>", x,
                       radius);
  };
  EXPECT_THAT(told(object(sphere(0.26, 0.2)) + object(sphere(0.74, 0.2))), HasSubstr("is 0.8"));
  EXPECT_EQ(told(object(sphere(0.3, 0.2)) + object(sphere(0.7, 0.2))), "");
  // In one object, and held together by a third body.
  const std::string both = slab(0.1, 0.4) + slab(0.45, 0.8);
  EXPECT_THAT(told(object("<union>" + both + "</union>")), HasSubstr("0.5 of a cell"));
  const std::string bridge = "<box><min>[0.1,0.2,0.8]</min><max>[0.8,0.8,0.9]</max></box>";
  EXPECT_EQ(told(object("<union>" + both + bridge + "</union>")), "");
}

TEST(SeedFaults, BodiesOutsideOrTooThinAreTold) {
  const std::string outside = "<box><min>[2,2,2]</min><max>[3,3,3]</max></box>";
  const std::string thin = "<box><min>[0.2,0.2,0.2]</min><max>[0.5,0.5,0.21]</max></box>";
  EXPECT_THAT(seed_faults(deck_of(object(ball) + object(outside))),
              HasSubstr("is outside of the domain: it has no particle"));
  EXPECT_THAT(seed_faults(deck_of(object(ball) + object(thin))),
              HasSubstr("no particle position is inside"));
  EXPECT_THAT(seed_faults(deck_of(object(outside))),
              HasSubstr("error: no <geom_object> has a particle"));
}

std::string load_deck_faults(const std::string& lower, const std::string& upper) {
  SolidDeck deck;  // a block from 0.2 to 0.6
  deck.flags = "<use_load_curves>true</use_load_curves>";
  deck.blocks = fmt::format(
      "<PhysicalBC><MPM><pressure><geom_object><box label='face'><min>{}</min><max>{}</max></box>"
      "</geom_object><load_curve><id>1</id><time_point><time>0</time><load>-1</load></time_point>"
      "<time_point><time>1</time><load>-1</load></time_point></load_curve></pressure></MPM>"
      "</PhysicalBC>",
      lower, upper);
  return seed_faults(deck);
}

TEST(LoadFaults, LoadsThatMeetNoSurfaceAreTold) {
  EXPECT_EQ(load_deck_faults("[0.2,0.599,0.2]", "[0.6,0.601,0.6]"), "");
  EXPECT_THAT(load_deck_faults("[0.2,0.799,0.2]", "[0.6,0.801,0.6]"),
              HasSubstr("<pressure> acts on nothing: no particle at the surface of a body is in "
                        "its <box>"));
  EXPECT_THAT(load_deck_faults("[0.39,0.399,0.39]", "[0.41,0.401,0.41]"),
              HasSubstr("acts on nothing"));  // inside of the block
  EXPECT_THAT(load_deck_faults("[0.2,0.2,0.2]", "[0.6,0.6,0.6]"), HasSubstr("the box is not thin"));
}

}  // namespace
}  // namespace sluice::mpm::seed_test
