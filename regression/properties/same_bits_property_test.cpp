// Same bits on threads, boxes, blocks and ranks, with all savings off, with other saves, after a
// restart: outputs and checkpoints (the whole conserved state) of every deck are equal bit for bit.
// Totals are kept.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/loading/sluice_schema.hpp"
#include "framework/deck/load_deck.hpp"
#include "properties/deck_run.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::properties::same_bits_property_test {
namespace {

namespace fs = std::filesystem;

constexpr double allowed_share = 1e-14;  // of a total; measured 1.4e-15

// The largest share of a total that was lost, what passed the boundary and sources counted;
// momentum by the scale of its whole vector or, at rest, by that of sound. The classic form keeps
// no energy.
double worst_share_lost(const std::string& conservation_json, bool internal_energy_form) {
  const auto totals = nlohmann::json::parse(conservation_json);
  double mass = 0, momentum = 0;
  for (const auto& [name, total] : totals.items()) {
    const double scale = total.at("scale");
    if (name.starts_with("mass")) mass += scale;
    if (name.starts_with("momentum")) momentum = std::max(momentum, scale);
  }
  momentum =
      std::max(momentum, std::sqrt(mass * totals.at("total energy").at("scale").get<double>()));
  double worst = 0;
  for (const auto& [name, total] : totals.items()) {
    if (internal_energy_form && name == "total energy") continue;
    const double lost = std::abs(total.at("defect").get<double>());
    const double scale = name.starts_with("momentum") ? momentum : total.at("scale").get<double>();
    const double share = scale > 0 ? lost / scale : lost;
    if (!(share <= worst)) worst = share;  // a NaN stays
  }
  return worst;
}

class SameBitsOfDecks : public testing::TestWithParam<PropertyDeck> {
 protected:
  void SetUp() override {
    if (!GetParam().here()) GTEST_SKIP() << "SLUICE_DECKS is not set: no collection of decks";
  }
  DeckRun run_into(const std::string& folder) const {
    DeckRun run;
    run.deck = GetParam().name;
    run.folder = scratch_ / folder;
    return run;
  }
  static fs::path archive_of(const RunReport& report) { return report.archive.value(); }
  static void expect_equal(const fs::path& a, const fs::path& b) {
    EXPECT_EQ(difference(a, b, false), "") << "in the outputs";
    EXPECT_EQ(difference(a, b, true), "") << "in the checkpoints";
  }
  ScratchFolder scratch_;
};

TEST_P(SameBitsOfDecks, HoweverTheyAreRun) {
  const RunReport plain = carry_out(run_into("plain"));
  ASSERT_EQ(plain.message, "");
  ASSERT_EQ(plain.steps, steps);
  const bool internal_energy_form = GetParam().name.ends_with("_classic");
  EXPECT_LE(worst_share_lost(plain.conservation_json, internal_energy_form), allowed_share)
      << plain.conservation_json;
  DeckRun run = run_into("all of it");
  run.force_all = true;
  run.split = {2, 3, 1};
  run.box_cells = 150;
  run.threads = 2;
  run.block = {16, 1, 2};
  expect_equal(archive_of(plain), archive_of(carry_out(run)));
}

class RestartOfDecks : public SameBitsOfDecks {};

TEST_P(RestartOfDecks, GivesTheSameBits) {
  const fs::path reference = archive_of(carry_out(run_into("whole")));
  DeckRun first = run_into("first half");
  const int kept = 1 + interval;
  first.max_steps = kept + 4;  // steps after the checkpoint are lost
  const RunReport half = carry_out(first);
  ASSERT_EQ(half.last_step, kept + 4);
  DeckRun second = run_into("second half");
  second.restart = archive_of(half);
  second.restart_step = kept;
  second.split = {3, 2, 2};
  second.box_cells = 100;
  second.threads = 2;
  const RunReport rest = carry_out(second);
  EXPECT_EQ(rest.steps, steps - kept);
  EXPECT_EQ(rest.last_step, steps);
  EXPECT_EQ(difference(reference, archive_of(rest), false, true), "") << "in the outputs";
  EXPECT_EQ(difference(reference, archive_of(rest), true, true), "") << "in the checkpoints";
}

const auto name_of_deck = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Kinds, SameBitsOfDecks, testing::ValuesIn(decks_of_kinds()), name_of_deck);
INSTANTIATE_TEST_SUITE_P(Full, SameBitsOfDecks, testing::ValuesIn(other_decks()), name_of_deck);

// Kinds restart on two ranks as well (KindsOnTwoRanks).
std::vector<PropertyDeck> decks_to_restart(bool quick) {
  const char* const on_levels[] = {"amr_tracers_lockstep", "amr_vortex_leaving",
                                   "amr_shock_tube_classic", "amr_dyed_water_free"};
  std::vector<PropertyDeck> decks, others = other_decks();
  for (const PropertyDeck& d : decks_of_kinds()) {
    const bool is_quick = !d.on_levels() || std::find(std::begin(on_levels), std::end(on_levels),
                                                      d.name) != std::end(on_levels);
    (is_quick ? decks : others).push_back(d);
  }
  return quick ? decks : others;
}
INSTANTIATE_TEST_SUITE_P(Kinds, RestartOfDecks, testing::ValuesIn(decks_to_restart(true)),
                         name_of_deck);
INSTANTIATE_TEST_SUITE_P(Full, RestartOfDecks, testing::ValuesIn(decks_to_restart(false)),
                         name_of_deck);

// Each way by itself, which says what a difference comes from; and saves that the deck does not ask
// for.
class EachWayOfDecks : public SameBitsOfDecks {};

TEST_P(EachWayOfDecks, GivesTheSameBits) {
  const fs::path reference = archive_of(carry_out(run_into("plain")));
  DeckRun run = run_into("boxes");
  run.split = {5, 3, 2};
  run.box_cells = 1;
  expect_equal(reference, archive_of(carry_out(run)));
  run = run_into("blocks and threads");
  run.block = {7, 3, 5};
  run.threads = 2;
  expect_equal(reference, archive_of(carry_out(run)));
  run = run_into("more saves");
  run.more_saves = true;
  EXPECT_EQ(difference(reference, archive_of(carry_out(run)), true), "") << "with more saves";
}

INSTANTIATE_TEST_SUITE_P(Full, EachWayOfDecks, testing::ValuesIn(property_decks()), name_of_deck);

// No deck of several materials is left out.
TEST(PropertyDecks, HoldEveryDeckOfSeveralMaterials) {
  int several = 0;
  for (const auto& entry : fs::directory_iterator(SLUICE_SOURCE_DIR "/inputs/ice")) {
    if (entry.path().extension() != ".ups") continue;
    const Deck deck = load_deck(entry.path().string(), {}, sluice_schema());
    const DeckNode* fluid = deck.root->find("MaterialProperties/ICE");
    ASSERT_NE(fluid, nullptr) << entry.path();
    if (fluid->all("material").size() < 2) continue;
    ++several;
    const auto& decks = property_decks();
    EXPECT_TRUE(std::any_of(decks.begin(), decks.end(), [&](const PropertyDeck& d) {
      return d.file == entry.path();
    })) << entry.path();
  }
  EXPECT_GE(several, 34);
}

// Leaving a direction out is exact to round-off against sweeping it. Both at the same fixed step:
// a direction that is not there has no part in the time step either.
struct FixedStep {
  const char* deck;
  const char* step;  // shorter than any that a swept direction allows
};

class Directions : public testing::TestWithParam<FixedStep> {};

TEST_P(Directions, AgreeWithTheForcedSweep) {
  constexpr double allowed = 1e-12;
  ScratchFolder scratch;
  Deck deck;
  for (PropertyDeck d : property_decks()) {
    if (d.name != GetParam().deck) continue;
    d.overrides.emplace_back(std::string("Time/delt_max=") + GetParam().step);
    deck = load_deck(d.file, d.overrides, sluice_schema());
  }
  DeckRun run;
  run.folder = scratch / "plain";
  const RunReport plain = carry_out(deck, run);
  run.folder = scratch / "forced";
  run.force_directions = true;
  const RunReport forced = carry_out(deck, run);
  EXPECT_EQ(forced.time, plain.time);
  // More momentum components are kept: the sweep was indeed forced.
  const auto bytes = [](const RunReport& report) {
    double sum = 0;
    for (const EffectCost& e : report.effects) sum += e.bytes_per_cell;
    return sum;
  };
  EXPECT_GT(bytes(forced), bytes(plain));
  EXPECT_EQ(difference(plain.archive.value(), forced.archive.value(), false, false, allowed), "");
}

INSTANTIATE_TEST_SUITE_P(
    Decks, Directions,
    testing::Values(FixedStep{"sod", "4e-4"}, FixedStep{"rarefactions", "4e-4"},
                    FixedStep{"periodic_shocks", "4e-4"}, FixedStep{"explosion", "4e-4"},
                    FixedStep{"explosion_viscous", "4e-4"}, FixedStep{"vortex", "4e-4"},
                    FixedStep{"two_gases", "4e-4"}, FixedStep{"helium_bubble", "2e-7"},
                    FixedStep{"mixed_gases", "1e-4"}, FixedStep{"amr_shock_tube", "1e-4"},
                    FixedStep{"amr_explosion", "4e-4"}, FixedStep{"amr_explosion_viscous", "4e-4"},
                    FixedStep{"amr_water_cylinder", "1e-6"}),
    [](const auto& test) { return std::string(test.param.deck); });

// Decks by processes that are started once for each number of ranks.
void expect_equal_on_ranks(int ranks, const std::vector<PropertyDeck>& decks);

std::vector<PropertyDeck> those(std::vector<PropertyDeck> decks, bool on_levels) {
  std::erase_if(decks, [&](const PropertyDeck& d) { return d.on_levels() != on_levels; });
  return decks;
}

// Half of them, a third of these in a case: together they take more than a case may.
class KindsOnTwoRanks : public testing::TestWithParam<std::size_t> {
 protected:
  static std::vector<PropertyDeck> third(bool on_levels) {
    const std::vector<PropertyDeck> all = those(decks_of_kinds(), on_levels);
    std::vector<PropertyDeck> decks;
    for (std::size_t n = GetParam(); n < all.size(); n += 6) decks.push_back(all[n]);
    return decks;
  }
};

TEST_P(KindsOnTwoRanks, WholeRunsAndRestartsOfARunOnOneRank) {
  expect_equal_on_ranks(2, third(false));
}

TEST_P(KindsOnTwoRanks, RunsAndRestartsOnLevels) {
  expect_equal_on_ranks(2, third(true));
}

INSTANTIATE_TEST_SUITE_P(Thirds, KindsOnTwoRanks, testing::Values(0U, 1U, 2U));

class SameBitsOnRanks : public testing::TestWithParam<int> {};

TEST_P(SameBitsOnRanks, WholeRunsAndRestartsOfARunOnOneRank) {
  expect_equal_on_ranks(GetParam(), those(property_decks(), false));
}

TEST_P(SameBitsOnRanks, RunsAndRestartsOnLevels) {
  expect_equal_on_ranks(GetParam(), those(property_decks(), true));
}

void expect_equal_on_ranks(int ranks, const std::vector<PropertyDeck>& decks) {
  ScratchFolder scratch;
  std::vector<DeckRun> runs;
  std::vector<std::pair<std::string, fs::path>> references;
  for (const PropertyDeck& deck : decks) {
    if (!deck.here()) continue;
    DeckRun run;
    run.deck = deck.name;
    run.folder = scratch / ("one rank " + deck.name);
    const fs::path reference = carry_out(run).archive.value();
    references.emplace_back(deck.name, reference);
    run.folder = scratch / ("ranks " + deck.name);
    if (deck.on_levels()) run.max_steps = 1 + interval;  // the restart does the last third
    runs.push_back(run);
    run.max_steps = 0;
    run.folder = scratch / ("restart " + deck.name);
    run.restart = reference;
    run.restart_step = 1 + 2 * interval;
    runs.push_back(run);
  }
  ASSERT_EQ(carry_out_on_ranks(runs, ranks), "");
  for (const auto& [name, reference] : references) {
    for (const char* kind : {"ranks ", "restart "}) {
      fs::path archive;
      for (const auto& entry : fs::directory_iterator(scratch / (kind + name)))
        if (entry.is_symlink()) archive = entry.path();
      ASSERT_FALSE(archive.empty()) << kind << name;
      EXPECT_EQ(difference(reference, archive, false, true), "") << kind << name;
      EXPECT_EQ(difference(reference, archive, true, true), "") << kind << name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Full, SameBitsOnRanks, testing::Values(2, 4),
                         [](const auto& test) { return "on_" + std::to_string(test.param); });

}  // namespace
}  // namespace sluice::properties::same_bits_property_test
