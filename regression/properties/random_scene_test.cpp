// Scenes drawn at random: any kind of side, gravity, viscosity, order, scheme, one to three
// dimensions. Each gives the same bits on other boxes, blocks, threads and with all savings off,
// and conserves what its sides let it keep. The variable SLUICE_SEED draws other scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <random>

#include "app/sluice_schema.hpp"
#include "framework/deck/load_deck.hpp"
#include "properties/deck_run.hpp"
#include "properties/skew_deck.hpp"

namespace sluice::properties {
namespace {

constexpr int scenes = 40, run_steps = 12;
constexpr double allowed_drift = 1e-13;  // of sum |q|, boundary fluxes and sources counted

SkewCase draw(unsigned long seed) {
  std::mt19937 random(static_cast<unsigned>(seed));
  const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  SkewCase c;
  c.name = "scene" + std::to_string(seed);
  const int dimensions = 1 + pick(3);
  c.cells = IntVec3::all(1);
  const int first = pick(3);
  for (int n = 0; n < dimensions; ++n) {
    const int most = dimensions == 1 ? 60 : dimensions == 2 ? 20 : 9;
    c.cells[(first + n) % 3] = 5 + pick(most);
  }
  c.cross_flow = pick(3) == 0;
  for (int d = 0; d < 3; ++d) {
    const auto low = static_cast<std::size_t>(2 * d);
    if (c.cells[d] == 1) {
      c.sides[low] = c.sides[low + 1] = c.cross_flow ? SideKind::open : SideKind::symmetry;
    } else if (pick(4) == 0) {
      c.sides[low] = c.sides[low + 1] = SideKind::periodic;
    } else {
      c.sides[low] = static_cast<SideKind>(pick(5));
      c.sides[low + 1] = static_cast<SideKind>(pick(5));
    }
  }
  // A moving wall drags the gas along an inactive direction: between symmetric faces that would be
  // a cavity whose pressure on the faces, not its momentum, sets the round-off.
  for (int d = 0; d < 3; ++d)
    if (std::count(c.sides.begin(), c.sides.end(), SideKind::moving_wall) > 0 && c.cells[d] == 1)
      c.sides[static_cast<std::size_t>(2 * d)] = c.sides[static_cast<std::size_t>(2 * d + 1)] =
          SideKind::open;
  if (pick(3) == 0) c.gravity = {0.01 * pick(4), -0.01 * pick(4), 0.01 * pick(4)};
  if (pick(3) == 0) c.viscosity = 0.001 * (1 + pick(9));
  c.second_order = pick(4) != 0;
  c.classic = pick(4) == 0;
  return c;
}

class RandomScene : public testing::TestWithParam<unsigned> {};

TEST_P(RandomScene, GivesTheSameBitsAndConserves) {
  const char* other = std::getenv("SLUICE_SEED");
  const SkewCase c = draw(GetParam() + (other == nullptr ? 0u : std::stoul(other)));
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
  if (!c.classic) {  // the classic form balances internal energy only
    EXPECT_LE(std::abs(plain.worst_drift), allowed_drift) << plain.conservation_json;
  }
  const RunReport blocks = carry_out(deck, scratch / "blocks", [](RunOptions& o) {
    o.block = {4, 3, 2};
    o.threads = 2;
  });
  EXPECT_EQ(difference(plain.archive.value(), blocks.archive.value(), false), "") << "blocks";
  EXPECT_EQ(blocks.conservation_json, plain.conservation_json);
  EXPECT_EQ(blocks.events_json, plain.events_json);
  DeckRun split;
  split.folder = scratch / "all";
  split.split = {3, 2, 2};
  split.force_all = true;
  const RunReport all = carry_out(deck, split);
  EXPECT_EQ(difference(plain.archive.value(), all.archive.value(), false), "") << "boxes";
  EXPECT_EQ(all.conservation_json, plain.conservation_json);
  EXPECT_EQ(all.events_json, plain.events_json);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomScene, testing::Range(1u, scenes + 1u));

}  // namespace
}  // namespace sluice::properties
