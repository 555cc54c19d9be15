// Runs with DoGranularMPM: bodies that part and meet, the same bits whoever holds the particles.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "framework/base/temporary_folder.hpp"
#include "mpm/test_support/text_run.hpp"

namespace sluice::mpm::grains_test {
namespace {

// Two blocks of one material, 0.6 cells apart, that part with 1 m/s each; three materials more.
SolidDeck two_blocks(bool granular, double speed, const std::string& gap = "0.56") {
  SolidDeck deck;
  deck.upper = "[1,0.5,0.1]";
  deck.cells = "[10,5,1]";
  deck.flags = std::string("<interpolator>gimp</interpolator><DoGranularMPM>") +
               (granular ? "true" : "false") + "</DoGranularMPM>";
  const auto block = [](const std::string& low, const std::string& high, double v) {
    return "<geom_object><box><min>[" + low + ",0.1,0]</min><max>[" + high +
           ",0.3,1]</max></box><res>[2,2,1]</res><velocity>[" + std::to_string(v) +
           ",0,0]</velocity><temperature>300</temperature></geom_object>";
  };
  deck.objects = block("0.3", "0.5", -speed) +
                 "<geom_object><box><min>[0,0,0]</min><max>[0.2,0.2,0.1]</max></box>"
                 "<affineTransformation_b>[" +
                 gap +
                 ",0.1,0]</affineTransformation_b>"
                 "<res>[2,2,1]</res><velocity>[" +
                 std::to_string(speed) +
                 ",0,0]</velocity><temperature>300</temperature></geom_object>";
  for (const char* name : {"a", "b", "c"}) deck.further += solid_material(name, "");
  deck.contacts = "<contact><type>friction</type><mu>0</mu></contact>";
  return deck;
}

TextRun::Rewrites settings(const std::string& end, const std::string& patches = "[1,1,1]") {
  return {{"<bulk_modulus>1e6", "<bulk_modulus>1e4"},
          {"<shear_modulus>5e5", "<shear_modulus>5e3"},
          {"<bulk_modulus>1e6", "<bulk_modulus>1e4"},
          {"<shear_modulus>5e5", "<shear_modulus>5e3"},
          {"<bulk_modulus>1e6", "<bulk_modulus>1e4"},
          {"<shear_modulus>5e5", "<shear_modulus>5e3"},
          {"<bulk_modulus>1e6", "<bulk_modulus>1e4"},
          {"<shear_modulus>5e5", "<shear_modulus>5e3"},
          {"<maxTime>1<", "<maxTime>" + end + "<"},
          {"<resolution>", "<patches>" + patches + "</patches><resolution>"},
          {"<outputInterval>0</outputInterval>",
           "<outputTimestepInterval>1000000</outputTimestepInterval><outputInitTimestep/>"
           "<outputLastTimestep>true</outputLastTimestep><save label='p.x'/><save label='p.mass'/>"
           "<save label='p.particleID'/><save label='p.velocity'/><save label='p.stress'/>"
           "<save label='p.deformationMeasure'/><save label='TotalMass'/>"
           "<save label='TotalMomentum'/><checkpoint timestepInterval='8' cycle='2'/>"}};
}

struct Grain {
  int material = 0;
  std::vector<double> values;  // what is saved of it
};
using Grains = std::map<double, Grain>;  // by id

Grains grains_of(const Archive& archive) {
  const ArchiveStep step = archive.read_output(archive.select_output("last"));
  Grains grains;
  for (int m = 0; m < 4; ++m) {
    std::vector<double> ids;
    std::vector<std::vector<double>> columns;
    for (const char* label :
         {"p.particleID", "p.x", "p.mass", "p.velocity", "p.stress", "p.deformationMeasure"}) {
      const FieldInfo* info = step.find_particles(label, m, 0);
      if (info == nullptr) continue;
      const auto own = step.read_particles(*info);
      if (label == std::string("p.particleID"))
        ids = own[0];
      else
        columns.insert(columns.end(), own.begin(), own.end());
    }
    for (std::size_t p = 0; p < ids.size(); ++p) {
      Grain& grain = grains[ids[p]];
      grain.material = m;
      for (const auto& column : columns) grain.values.push_back(column[p]);
    }
  }
  return grains;
}

Grains grains_of(const TextRun& run) {
  return grains_of(Archive::open(*run.report().archive));
}

// Momentum of the half that flies to the right, over what it had.
double kept(const Grains& grains, double speed) {
  double momentum = 0, mass = 0;
  for (const auto& [id, g] : grains) {
    if (g.values[4] <= 0) continue;  // x, y, z, mass, velocity
    momentum += g.values[3] * g.values[4];
    mass += g.values[3];
  }
  return momentum / (mass * speed);
}

void expect_same_bits(const Grains& a, const Grains& b) {
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [id, grain] : a) {
    ASSERT_TRUE(b.contains(id));
    EXPECT_EQ(grain.material, b.at(id).material) << id;
    ASSERT_EQ(grain.values, b.at(id).values) << id;
  }
}

// In one field the halves hold each other over the cell between them: with fields of their own
// nothing acts, after the first step.
TEST(Grains, BlocksThatPartDoNotDragEachOther) {
  const TextRun one(two_blocks(false, 1), settings("0.1"), "one_field");
  const TextRun two(two_blocks(true, 1), settings("0.1"), "grains");
  const Grains before = grains_of(one), after = grains_of(two);
  std::set<int> left, right;
  for (const auto& [id, g] : after) (g.values[4] < 0 ? left : right).insert(g.material);
  EXPECT_EQ(left, (std::set<int>{0}));  // equal halves: that with the smallest id stays
  EXPECT_EQ(right, (std::set<int>{1}));
  EXPECT_GT(kept(after, 1), 0.985);
  EXPECT_LT(kept(before, 1), kept(after, 1) - 0.03);
}

// Neither masses nor momentum change when particles change their material, to the last bit.
TEST(Grains, TotalsAreThoseOfBefore) {
  const TextRun run(two_blocks(true, 1), settings("0.1"), "totals");
  const auto mass = run.history("TotalMass");
  ASSERT_GT(mass.size(), 5U);
  for (const auto& row : mass) EXPECT_EQ(row[1], mass.front()[1]);
  EXPECT_LT(run.report().worst_drift, 0.2);
  for (const auto& row : run.history("TotalMomentum")) EXPECT_NEAR(row[1], 0, 1e-13);
}

TEST(Grains, BlocksThatMeetAreOneClusterUntilTheyPart) {
  // Towards each other: the left one has the smallest id.
  const SolidDeck deck = two_blocks(true, -1, "0.62");
  const TextRun meeting(deck, settings("0.07"), "meeting");
  std::set<int> together, after;
  for (const auto& [id, g] : grains_of(meeting)) together.insert(g.material);
  EXPECT_EQ(together.size(), 1U);
  const TextRun parted(deck, settings("0.6"), "parted");
  for (const auto& [id, g] : grains_of(parted)) after.insert(g.material);
  EXPECT_GE(after.size(), 2U);
}

TEST(Grains, NeitherBoxesNorThreadsShow) {
  const SolidDeck deck = two_blocks(true, -1, "0.62");
  const TextRun plain(deck, settings("0.6"), "plain");
  const TextRun other(deck, settings("0.6", "[3,2,1]"), "boxes", 2);
  expect_same_bits(grains_of(plain), grains_of(other));
}

// Stopped while the blocks are one cluster, and gone on from there.
TEST(Grains, RestartsGoOnWithTheSameBits) {
  const SolidDeck deck = two_blocks(true, -1, "0.62");
  const TextRun whole(deck, settings("0.6"), "whole");
  std::string text = text_of(deck);
  for (const auto& [from, to] : settings("0.6")) text.replace(text.find(from), from.size(), to);
  ReadDeck read;
  read.deck = load_deck_text(text, "cut.ups", {}, solid_schema());
  finish_reading(read);
  ASSERT_FALSE(any_error(read.faults)) << read.text;
  const TemporaryFolder folder;
  const Mpm solids(read.scene, read.solids);
  RunOptions options;
  options.parent = folder.path();
  options.progress = ProgressMode::none;
  options.deck_xml = text;
  options.limits.max_steps = whole.report().steps / 2;
  const RunReport first = Simulation(read.scene, solids, world(), options).run();
  options.limits.max_steps = {};
  options.restart = *first.archive;
  const RunReport second = Simulation(read.scene, solids, world(), options).run();
  EXPECT_EQ(second.status, RunStatus::done) << second.message;
  expect_same_bits(grains_of(whole), grains_of(Archive::open(*second.archive)));
}

}  // namespace
}  // namespace sluice::mpm::grains_test
