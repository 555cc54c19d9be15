// Scenes drawn at random: any kind of side, gravity, viscosity, order, scheme, one to three
// dimensions; then with levels that follow the flow, any ratio, tile, dilation and threshold.
// Each gives the same bits on other boxes, blocks, threads and with all savings off, and conserves
// what its sides let it keep. The variable SLUICE_SEED draws other scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "app/loading/sluice_schema.hpp"
#include "framework/archive/archive.hpp"
#include "framework/deck/load_deck.hpp"
#include "properties/deck_run.hpp"
#include "properties/random_scene.hpp"

namespace sluice::properties::random_scene_test {
namespace {

constexpr unsigned scenes = 40, quick_scenes = 20;
constexpr int run_steps = 12;
constexpr double allowed_drift = 1e-13;  // of sum |q|, boundary fluxes and sources counted

// Densities and temperatures of all levels are positive.
void expect_admissible(const std::filesystem::path& folder) {
  const Archive archive = Archive::open(folder);
  const ArchiveStep step = archive.read_output(archive.select_output("last"));
  ASSERT_EQ(step.info().step, run_steps);
  for (const FieldInfo& field : step.fields()) {
    if (field.name != "rho_CC" && field.name != "temp_CC") continue;
    const DenseField values = step.read(field);
    for (std::size_t n = 0; n < values.present.size(); ++n)
      if (values.present[n]) {
        ASSERT_GT(values.components[0][n], 0) << field.name << " on level " << field.level;
      }
  }
}

class RandomScene : public testing::TestWithParam<unsigned> {
 protected:
  static unsigned long seed() {
    const char* other = std::getenv("SLUICE_SEED");
    return GetParam() + (other == nullptr ? 0u : std::stoul(other));
  }
  static void expect_same_bits_and_conservation(const SkewCase& c);
};

TEST_P(RandomScene, GivesTheSameBitsAndConserves) {
  expect_same_bits_and_conservation(draw_scene(seed()));
}

class RandomSceneOnLevels : public RandomScene {};

TEST_P(RandomSceneOnLevels, GivesTheSameBitsAndConserves) {
  expect_same_bits_and_conservation(draw_scene_on_levels(seed()));
}

void RandomScene::expect_same_bits_and_conservation(const SkewCase& c) {
  const std::string xml = skew_deck(c, {}, run_steps);
  SCOPED_TRACE(xml);
  // Every fourth asks for steps that are too long: they are redone, the same way everywhere.
  std::vector<std::string> overrides;
  if (GetParam() % 4 == 0) overrides.emplace_back("Time/timestep_multiplier=5");
  const Deck deck = load_deck_text(xml, c.name, overrides, sluice_schema());
  ScratchFolder scratch;
  const RunReport plain = carry_out(deck, scratch / "plain");
  ASSERT_EQ(plain.message, "");
  EXPECT_EQ(plain.steps, run_steps);
  if (!c.internal_energy_form) {  // the classic form balances internal energy only
    EXPECT_LE(std::abs(plain.worst_drift), allowed_drift) << plain.conservation_json;
  }
  expect_admissible(plain.archive.value());
  const RunReport blocks = carry_out(deck, scratch / "blocks", [](RunOptions& o) {
    o.block = {4, 3, 2};
    o.threads = 2;
    o.max_box_cells = 1;
  });
  EXPECT_EQ(difference(plain.archive.value(), blocks.archive.value(), false), "") << "blocks";
  EXPECT_EQ(blocks.conservation_json, plain.conservation_json);
  EXPECT_EQ(blocks.events_json, plain.events_json);
  DeckRun split;
  split.folder = scratch / "all";
  split.split = {3, 2, 2};
  split.force_all = true;
  split.box_cells = 60;
  const RunReport all = carry_out(deck, split);
  EXPECT_EQ(difference(plain.archive.value(), all.archive.value(), false), "") << "boxes";
  EXPECT_EQ(all.conservation_json, plain.conservation_json);
  EXPECT_EQ(all.events_json, plain.events_json);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomScene, testing::Range(1u, quick_scenes + 1));
INSTANTIATE_TEST_SUITE_P(Full, RandomScene, testing::Range(quick_scenes + 1, scenes + 1));

// Those of one to four levels that are done within a second.
const std::vector<unsigned> quick_on_levels = {2,  3,  4,  7,  8,  9,  10, 11,
                                               12, 14, 18, 19, 20, 25, 28, 32};
std::vector<unsigned> others_on_levels() {
  std::vector<unsigned> seeds;
  for (unsigned seed = 1; seed <= scenes; ++seed)
    if (std::find(quick_on_levels.begin(), quick_on_levels.end(), seed) == quick_on_levels.end())
      seeds.push_back(seed);
  return seeds;
}
INSTANTIATE_TEST_SUITE_P(Seeds, RandomSceneOnLevels, testing::ValuesIn(quick_on_levels));
INSTANTIATE_TEST_SUITE_P(Full, RandomSceneOnLevels, testing::ValuesIn(others_on_levels()));

}  // namespace
}  // namespace sluice::properties::random_scene_test
