// When the physics fails: a NaN in the state, steps that are redone, a step that is rejected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/loading/sluice_schema.hpp"
#include "framework/archive/archive.hpp"
#include "framework/deck/load_deck.hpp"
#include "framework/run/levels/level_solver.hpp"
#include "ice/ice.hpp"
#include "properties/deck_run.hpp"

namespace sluice::properties::failure_property_test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double allowed_drift = 1e-13;  // of sum |q|

void expect_undamaged(const fs::path& folder) {
  const Archive archive = Archive::open(folder);
  EXPECT_THAT(archive.damage(), IsEmpty());
  std::int64_t values = 0;
  for (const StepEntry& e : archive.outputs())
    EXPECT_THAT(archive.read_output(e).verify(values), IsEmpty());
  for (const StepEntry& e : archive.checkpoints())
    EXPECT_THAT(archive.read_checkpoint(e).verify(values), IsEmpty());
  EXPECT_GT(values, 0);
}

class PlantedNan : public testing::TestWithParam<const char*> {};

TEST_P(PlantedNan, IsNamedAndTheLastCheckpointStaysGood) {
  ScratchFolder scratch;
  const Deck deck = load_property_deck(GetParam());
  constexpr int kept = 1 + interval, planted = kept + 4;
  const IntVec3 cell{7, 0, 0};
  const RunReport report = carry_out(deck, scratch / "run", [&](RunOptions& o) {
    o.plant_nan = {planted, cell};
    o.block = {5, 3, 2};
  });
  ASSERT_EQ(report.status, RunStatus::failed);
  EXPECT_EQ(report.last_step, planted - 1);
  EXPECT_THAT(report.message,
              AllOf(HasSubstr("step 14"), HasSubstr("cell [7, 0, 0]"), HasSubstr("nan"),
                    HasSubstr("state.mass"), HasSubstr("task 'update'")));
  EXPECT_TRUE(std::isnan(report.worst_drift));  // of a damaged state nothing is conserved
  const fs::path archive = report.archive.value();
  expect_undamaged(archive);
  ASSERT_EQ(Archive::open(archive).checkpoints().back().step, kept);
  // From that checkpoint the run goes on as if nothing had been.
  DeckRun rest;
  rest.deck = GetParam();
  rest.folder = scratch / "rest";
  rest.restart = archive;
  DeckRun whole;
  whole.deck = GetParam();
  whole.folder = scratch / "whole";
  EXPECT_EQ(
      difference(carry_out(whole).archive.value(), carry_out(rest).archive.value(), true, true),
      "");
}

INSTANTIATE_TEST_SUITE_P(Decks, PlantedNan, testing::Values("sod", "explosion", "cube_gravity"),
                         [](const auto& test) { return std::string(test.param); });

// A deck that asks for steps several times too long: they are redone, counted, and conserve.
class RedoneSteps : public testing::TestWithParam<const char*> {
 protected:
  static Deck greedy(const std::string& name) {
    for (PropertyDeck deck : property_decks()) {
      if (deck.name != name) continue;
      deck.overrides.emplace_back("Time/timestep_multiplier=6");
      deck.overrides.emplace_back("Time/delt_max=1e9");
      return load_deck(deck.file, deck.overrides, sluice_schema());
    }
    throw std::logic_error("no deck " + name);
  }
};

TEST_P(RedoneSteps, AreCountedConserveAndDoNotDependOnBoxes) {
  ScratchFolder scratch;
  const Deck deck = greedy(GetParam());
  const RunReport report = carry_out(deck, scratch / "one");
  EXPECT_EQ(report.message, "");
  const auto events = nlohmann::json::parse(report.events_json);
  ASSERT_TRUE(events.contains("step redone with a smaller one")) << report.events_json;
  EXPECT_GT(events["step redone with a smaller one"]["count"].get<int>(), 0);
  EXPECT_GT(events["step redone with first-order faces"]["count"].get<int>(), 0);
  EXPECT_LE(std::abs(report.worst_drift), allowed_drift);
  const RunReport other = carry_out(deck, scratch / "other", [](RunOptions& o) {
    o.threads = 2;
    o.block = {6, 5, 3};
  });
  EXPECT_EQ(other.events_json, report.events_json);
  EXPECT_EQ(difference(report.archive.value(), other.archive.value(), true), "");
}

INSTANTIATE_TEST_SUITE_P(Decks, RedoneSteps,
                         testing::Values("left_blast", "two_blasts", "explosion", "cube",
                                         "amr_shock_tube", "amr_periodic_shocks",
                                         "amr_explosion_lockstep"),
                         [](const auto& test) { return std::string(test.param); });
INSTANTIATE_TEST_SUITE_P(Full, RedoneSteps, testing::Values("amr_explosion", "amr_cube"),
                         [](const auto& test) { return std::string(test.param); });

struct Fields {
  std::vector<double> values;
  explicit Fields(const Warehouse& w) {
    for (int s = 0; s < w.slot_count(); ++s)
      for (int b = 0; b < static_cast<int>(w.local_boxes().size()); ++b)
        for (int c = 0; c < w.info(s).components; ++c) {
          const RealView v = w.view(s, c, b);
          values.insert(values.end(), v.data, v.data + v.box.volume());
        }
  }
};

TEST(RejectedStep, LeavesTheOldStateAndTheNextAttemptAlone) {
  const Deck deck = load_property_deck("explosion");
  std::vector<Fault> faults;
  const Scene scene = read_scene(deck, {}, faults);
  const ice::Ice component(scene, ice::read_ice_scene(deck, scene, faults));
  const RunControl control;
  const auto start = [&](LevelSolver& solver) {
    component.state().initialise(solver.state());
    solver.fill_ghosts(0);
    return component.step().limit(solver.initial_rates()).dt;
  };
  LevelSolver solver(component, scene.grid.levels.front(), world(), {});
  const double dt = start(solver);
  const Fields before(solver.state());
  EXPECT_GT(solver.attempt(0, 50 * dt, {}, &control).faults, 0);
  EXPECT_EQ(Fields(solver.state()).values, before.values);
  EXPECT_GT(solver.mask_faults(), 0);
  EXPECT_GT(solver.attempt(0, 50 * dt, {}, &control).faults, 0);
  LevelSolver fresh(component, scene.grid.levels.front(), world(), {});
  start(fresh);
  LevelSolver again(component, scene.grid.levels.front(), world(), {});
  start(again);
  EXPECT_GT(again.attempt(0, 50 * dt, {}, &control).faults, 0);
  EXPECT_EQ(again.attempt(0, dt, {}, &control).faults, 0);
  EXPECT_EQ(fresh.attempt(0, dt, {}, &control).faults, 0);
  EXPECT_EQ(again.attempt_result().sums, fresh.attempt_result().sums);
  EXPECT_EQ(again.attempt_result().maxima, fresh.attempt_result().maxima);
  fresh.advance();
  again.advance();
  fresh.fill_ghosts(dt);
  again.fill_ghosts(dt);
  EXPECT_EQ(Fields(again.state()).values, Fields(fresh.state()).values);
}

}  // namespace
}  // namespace sluice::properties::failure_property_test
