// What sources put into the graph of a step: nothing where there are none.
#include "ice/sources/source_tasks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/load_deck.hpp"
#include "ice/deck/schema.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/ice.hpp"
#include "ice/step/effect_ids.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::ice::source_tasks_test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

// A scene of one of the decks of inputs/ice.
struct DeckScene {
  explicit DeckScene(const std::string& name, const std::vector<std::string>& overrides = {}) {
    Schema schema;
    add_framework_tags(schema);
    add_ice_tags(schema);
    deck =
        load_deck(std::string(SLUICE_SOURCE_DIR "/inputs/ice/") + name + ".ups", overrides, schema);
    std::vector<Fault> faults = deck.faults;
    scene = read_scene(deck, {}, faults);
    IceScene ice_scene = read_ice_scene(deck, scene, faults);
    for (const Fault& f : faults) EXPECT_NE(f.severity, Severity::error) << to_string(f);
    ice = std::make_unique<Ice>(scene, std::move(ice_scene));
  }

  // Names of the tasks and temporaries of one kind of graph that have to do with sources.
  std::vector<std::string> of_sources(int kind) const {
    TaskList list;
    StepVariant variant;
    variant.kind = kind;
    ice->step().declare(list, variant);
    std::vector<std::string> names;
    for (const Task& task : list.tasks())
      if (task.name.find("source account") != std::string::npos || task.effect == effect_sources ||
          task.effect == effect_driving_force)
        names.push_back(task.name);
    for (const Variable& v : list.variables())
      if (v.storage == Storage::temporary && v.name.find("sources") != std::string::npos)
        names.push_back(v.name);
    return names;
  }

  Deck deck;
  Scene scene;
  std::unique_ptr<Ice> ice;
};

TEST(SourceTasks, AreNoneWithoutSources) {
  for (const char* deck : {"mixed_gases", "amr_water_square", "blast_3d"}) {
    const DeckScene s(deck);
    EXPECT_FALSE(s.ice->effects().on(effect_sources));
    EXPECT_FALSE(s.ice->effects().on(effect_driving_force));
    EXPECT_THAT(s.ice->budgets().tracked_names(), ::testing::IsEmpty());
    for (int kind = 0; kind < s.ice->blocks().kinds(); ++kind)
      EXPECT_THAT(s.of_sources(kind), ::testing::IsEmpty()) << deck << " kind " << kind;
  }
}

// Effects that are written but do nothing are off.
TEST(SourceTasks, AreNoneWhereNothingIsAdded) {
  const DeckScene s("amr_mass_exchange",
                    {"Models/Model/Test/rate=0", "CFD/ICE/fixedPressureGradient/x_dir=0"});
  EXPECT_FALSE(s.ice->effects().on(effect_sources));
  EXPECT_THAT(s.ice->effects()[effect_sources].reason,
              HasSubstr("reactant becomes product at 0/s"));
  EXPECT_FALSE(s.ice->effects().on(effect_driving_force));
  for (int kind = 0; kind < s.ice->blocks().kinds(); ++kind)
    EXPECT_THAT(s.of_sources(kind), ::testing::IsEmpty());
}

TEST(SourceTasks, AreThereWhereTheDeckCallsForThem) {
  const DeckScene s("amr_mass_exchange");
  EXPECT_TRUE(s.ice->effects().on(effect_sources));
  EXPECT_EQ(s.ice->effects()[effect_sources].reason,
            "reactant becomes product at 20/s, in the update");
  for (int kind = 0; kind < s.ice->blocks().kinds(); ++kind)
    EXPECT_THAT(s.of_sources(kind), Contains("source account"));
  const DeckScene driven("blast_3d", {"CFD/ICE/fixedPressureGradient/x_dir=2"});
  EXPECT_THAT(driven.of_sources(0), Contains("gravity account"));
  EXPECT_THAT(driven.of_sources(0), Not(Contains("source account")));
  EXPECT_FALSE(driven.ice->blocks().skipping_allowed());
  EXPECT_FALSE(s.ice->blocks().skipping_allowed());
}

// A block of the reactant alone needs the graph where others may come in.
TEST(SourceTasks, BlocksOfAReactantRunTheGeneralGraph) {
  const DeckScene s("amr_mass_exchange");
  Warehouse state(s.scene.grid.levels.front(), 0);
  for (const SlotInfo& slot : s.ice->state().slots()) state.add(slot);
  const IndexBox cells = state.local_boxes().front().cells;
  const auto fill = [&](int material, double mass) {
    const RealView view = state.view(state.find(labels().mass, material), 0, 0);
    for_each_cell(cells, [&](IntVec3 c) { view(c) = mass; });
  };
  fill(0, 1);
  EXPECT_EQ(s.ice->blocks().kind_of(state, 0, cells), 0);
  fill(0, 0);
  fill(1, 1);
  EXPECT_EQ(s.ice->blocks().kind_of(state, 0, cells), 2);
}

}  // namespace
}  // namespace sluice::ice::source_tasks_test
