// The mirror image of every deck gives the mirror image of its states, bit for bit.
#include <gtest/gtest.h>

#include <algorithm>

#include "app/loading/sluice_schema.hpp"
#include "framework/archive/archive.hpp"
#include "framework/deck/load_deck.hpp"
#include "ice/fluid/labels.hpp"
#include "properties/deck_run.hpp"
#include "properties/mirrored_deck.hpp"
#include "properties/mirrored_state.hpp"

namespace sluice::properties::mirror_property_test {
namespace {

// Decks without a mirror image along an axis, and why. A deck that has one is not to stand here:
// its test fails.
struct Unmirrored {
  const char* deck;
  const char* axes;
  const char* why;
};
const Unmirrored unmirrored[] = {
    {"manufactured_vortices", "xy",
     "the start mms_1 and its sides MMS_1 know one solution: it travels with (1, 1)"},
};

class MirrorImageOfDecks : public testing::TestWithParam<PropertyDeck> {
 protected:
  void SetUp() override {
    if (!GetParam().here()) GTEST_SKIP() << "SLUICE_DECKS is not set: no collection of decks";
  }
  static bool is_left_out(int axis) {
    return std::any_of(std::begin(unmirrored), std::end(unmirrored), [&](const Unmirrored& u) {
      return GetParam().name == u.deck &&
             std::string(u.axes).find("xyz"[axis]) != std::string::npos;
    });
  }
  // With a pressure solve the image of a state is what the tolerance of the linear solver says
  // of it:
  // no solver keeps its order of cells in a mirror.
  static double allowed(const Deck& deck) {
    constexpr double tolerances = 100;
    const DeckNode* solve = deck.root->find("CFD/ICE/ImplicitSolver");
    if (solve == nullptr) return 0;
    const DeckNode* tolerance = solve->find("Parameters/tolerance");
    return tolerances * (tolerance == nullptr ? 1e-6 : std::stod(tolerance->text));
  }
  RunReport run(const Deck& deck, const std::string& folder) const {
    const RunReport report = carry_out(deck, scratch_ / folder);
    EXPECT_EQ(report.message, "");
    return report;
  }
  ScratchFolder scratch_;
};

TEST_P(MirrorImageOfDecks, GivesTheImageOfTheStates) {
  const std::string& name = GetParam().name;
  const Deck deck =
      load_deck_text(centred_deck(load_property_deck(name)), name, {}, sluice_schema());
  const RunReport plain = run(deck, "plain");
  EXPECT_EQ(plain.steps, steps);
  const Archive archive = Archive::open(plain.archive.value());
  const ArchiveStep state = archive.read_checkpoint(archive.select_checkpoint());
  int images = 0;
  for (int axis = 0; axis < 3; ++axis) {
    // Nothing moves along an axis that the run does not have.
    if (state.find(ice::labels().momentum_component[axis].name(), 0, 0) == nullptr) continue;
    ++images;
    const std::string folder = std::string("image along ") + "xyz"[axis];
    const Deck image = load_deck_text(mirrored_deck(deck, axis), name, {}, sluice_schema());
    const RunReport turned = run(image, folder);
    const std::string words =
        mirror_difference(plain.archive.value(), turned.archive.value(), axis, allowed(deck));
    if (is_left_out(axis)) {
      EXPECT_NE(words, "") << folder << ": take the deck off the list";
    } else {
      EXPECT_EQ(words, "") << folder;
    }
  }
  EXPECT_GE(images, 1);
}

const auto name_of_deck = [](const auto& test) { return test.param.name; };
// Levels mirror by the same code whatever flows on them: three kinds stand for the others.
std::vector<PropertyDeck> kinds(bool quick) {
  const char* const levels[] = {"amr_explosion_ratio_4", "amr_dyed_water_free",
                                "amr_water_cylinder_slip"};
  std::vector<PropertyDeck> decks = decks_of_kinds();
  std::erase_if(decks, [&](const PropertyDeck& d) {
    const bool stands = std::find(std::begin(levels), std::end(levels), d.name) != std::end(levels);
    return (!d.on_levels() || stands) != quick;
  });
  return decks;
}
INSTANTIATE_TEST_SUITE_P(Kinds, MirrorImageOfDecks, testing::ValuesIn(kinds(true)), name_of_deck);
INSTANTIATE_TEST_SUITE_P(FullKinds, MirrorImageOfDecks, testing::ValuesIn(kinds(false)),
                         name_of_deck);
INSTANTIATE_TEST_SUITE_P(Full, MirrorImageOfDecks, testing::ValuesIn(other_decks()), name_of_deck);

TEST(MirrorImage, LeavesOutNamedDecksOnly) {
  const auto& decks = property_decks();
  for (const Unmirrored& u : unmirrored)
    EXPECT_TRUE(std::any_of(decks.begin(), decks.end(), [&](const PropertyDeck& d) {
      return d.name == u.deck;
    })) << u.deck;
}

}  // namespace
}  // namespace sluice::properties::mirror_property_test
