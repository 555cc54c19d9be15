// Substeps that cannot be had, planted on every level: the whole coarse step is taken back to the
// bit and redone, or the substep is redone on its level with masked slopes.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/deck/load_deck.hpp"
#include "framework/run/levels/hierarchy.hpp"
#include "properties/deck_run.hpp"
#include "properties/planted_fault.hpp"

namespace sluice::properties::amr_rejection_test {
namespace {

constexpr double allowed_drift = 1e-13;  // of sum |q|

// A deck and a point where levels meet a wave at the start.
struct Place {
  const char* deck;
  Vec3 point;
};
std::ostream& operator<<(std::ostream& out, const Place& p) {
  return out << p.deck;
}

IntVec3 nearest_cell(const Level& level, Vec3 point) {
  IntVec3 cell;
  for (int d = 0; d < 3; ++d) {
    const double n = (point[d] - level.anchor[d]) / level.spacing[d];
    cell[d] = std::min(std::max(static_cast<int>(std::floor(n)), level.domain.lower[d]),
                       level.domain.upper[d] - 1);
  }
  return cell;
}

// Interior cells of all levels.
std::vector<double> values_of(const Hierarchy& hierarchy) {
  std::vector<double> values;
  for (int l = 0; l < hierarchy.level_count(); ++l) {
    const LevelSolver& solver = hierarchy.level(l);
    const Warehouse& w = solver.state();
    for (const int s : solver.state_slots())
      for (int b = 0; b < static_cast<int>(w.local_boxes().size()); ++b)
        for (int c = 0; c < w.info(s).components; ++c)
          for_each_cell(w.local_boxes()[static_cast<std::size_t>(b)].cells,
                        [&](IntVec3 cell) { values.push_back(w.view(s, c, b)(cell)); });
  }
  return values;
}

class RejectedSubstep : public testing::TestWithParam<Place> {};

// Two runs side by side, a regrid after every step: one is told that a substep failed (another
// level, another substep each time) and must halve its step, the other takes half the step at once.
TEST_P(RejectedSubstep, LeavesNoTrace) {
  const Deck deck = load_property_deck(GetParam().deck);
  const FaultyDeck faulty(deck), sound(deck);
  const RunControl control;
  EventLedger ledger, other_ledger;
  Hierarchy a(faulty.scene, *faulty.component, world(), {});
  Hierarchy b(sound.scene, *sound.component, world(), {});
  a.initialise();
  b.initialise();
  const int levels = a.level_count();
  ASSERT_EQ(levels, faulty.scene.refinement.max_levels);
  const std::vector<LevelCost> costs = a.costs();
  int step = 0, planted = 0;
  double time = 0;
  for (int level = 0; level < levels; ++level) {
    const int substeps = costs[static_cast<std::size_t>(level)].substeps;
    for (int substep = 0; substep<substeps; substep += substeps> 8 ? 3 : 1) {
      ++step;
      ASSERT_GT(a.level_count(), level);
      const double dt = a.rates().limit().dt, own = dt / substeps;
      ASSERT_EQ(dt, b.rates().limit().dt);
      const std::vector<double> before = values_of(a);
      PlantedFault& fault = faulty.component->fault;
      fault = {level,
               nearest_cell(a.level(level).level(), GetParam().point),
               time + (substep - 0.5) * own,
               time + (substep + 0.5) * own,
               0.75 * own,
               false};
      const CycleResult& failed = a.attempt(step, time, dt, {}, control, ledger);
      ASSERT_FALSE(failed.good) << "level " << level << " substep " << substep;
      EXPECT_EQ(failed.first_fault.level, level);
      EXPECT_EQ(failed.first_fault.cell, fault.cell);
      EXPECT_EQ(failed.faults, 1);
      ++planted;
      a.reject();
      ledger.reject_step();
      ASSERT_TRUE(values_of(a) == before) << "level " << level << " substep " << substep;
      const std::vector<double> sums = a.attempt(step, time, dt / 2, {}, control, ledger).sums;
      const CycleResult& plain = b.attempt(step, time, dt / 2, {}, control, other_ledger);
      ASSERT_TRUE(plain.good);
      EXPECT_EQ(sums, plain.sums);
      a.accept();
      b.accept();
      ASSERT_TRUE(values_of(a) == values_of(b)) << "level " << level << " substep " << substep;
      EXPECT_FALSE(values_of(a) == before);
      time += dt / 2;
      EXPECT_EQ(a.regrid(step), b.regrid(step));
      ASSERT_TRUE(values_of(a) == values_of(b)) << "after the regrid of step " << step;
    }
  }
  EXPECT_GE(planted, levels);
}

const Place places[] = {{"amr_shock_tube", {0.5, 0, 0}},
                        {"amr_shock_tube_lockstep", {0.5, 0, 0}},
                        {"amr_shock_tube_classic", {0.5, 0, 0}},
                        {"amr_periodic_shocks", {0.25, 0, 0}},
                        {"amr_explosion", {0.4, 0, 0}},
                        {"amr_explosion_ratio_4", {0, -0.4, 0}},
                        {"amr_explosion_lockstep", {0.4, 0, 0}},
                        {"amr_explosion_viscous", {0.4, 0, 0}},
                        {"amr_vortex", {0, 1, 0}},
                        {"amr_water_cylinder", {0.39, 0.51, 0}},
                        {"amr_water_cylinder_lockstep", {0.39, 0.51, 0}},
                        {"amr_cube", {0.125, 0, 0}}};
INSTANTIATE_TEST_SUITE_P(Decks, RejectedSubstep, testing::ValuesIn(places),
                         [](const auto& test) { return std::string(test.param.deck); });

// Whole runs with a fault on one level.
class FaultOnALevel : public testing::TestWithParam<int> {
 protected:
  static constexpr Vec3 point{0.4, 0, 0};

  static RunReport run(const std::filesystem::path& folder, const PlantedFault& planted,
                       IntVec3 boxes = {}, int threads = 1) {
    const Deck deck = load_property_deck("amr_explosion");
    const FaultyDeck loaded(deck, boxes);
    loaded.component->fault = planted;
    loaded.component->fault.cell =
        nearest_cell(loaded.scene.grid.levels[static_cast<std::size_t>(planted.level)], point);
    RunOptions o;
    o.parent = folder;
    o.progress = ProgressMode::none;
    o.program = "properties";
    o.deck_xml = to_xml(*deck.root);
    o.threads = threads;
    if (threads > 1) o.block = {5, 3, 2};
    if (threads > 1) o.max_box_cells = 100;
    Simulation simulation(loaded.scene, *loaded.component, world(), o);
    return simulation.run();
  }
  static void expect_same(const RunReport& a, const RunReport& b) {
    EXPECT_EQ(b.message, "");
    EXPECT_EQ(a.events_json, b.events_json);
    EXPECT_EQ(a.conservation_json, b.conservation_json);
    EXPECT_EQ(difference(a.archive.value(), b.archive.value(), false), "");
    EXPECT_EQ(difference(a.archive.value(), b.archive.value(), true), "");
  }
};

TEST_P(FaultOnALevel, IsMaskedThereAlone) {
  ScratchFolder scratch;
  PlantedFault fault;
  fault.level = GetParam();
  fault.from = 0.05;
  fault.to = 0.2;
  fault.excused = true;
  const RunReport one = run(scratch / "one", fault);
  ASSERT_EQ(one.message, "");
  const auto events = nlohmann::json::parse(one.events_json);
  ASSERT_EQ(events.size(), 1u) << one.events_json;
  const auto& redone = events.at("step redone with first-order faces");
  EXPECT_GT(redone.at("count").get<int>(), 0);
  EXPECT_EQ(redone.at("first").at("level"), GetParam());
  EXPECT_EQ(redone.at("last").at("level"), GetParam());
  EXPECT_LE(std::abs(one.worst_drift), allowed_drift);
  expect_same(one, run(scratch / "other", fault, {3, 2, 1}, 2));
  if (GetParam() < 2) return;  // a mask in a cell that is covered leaves no trace
  fault.to = 0;                // never
  EXPECT_NE(difference(one.archive.value(), run(scratch / "sound", fault).archive.value(), true),
            "");
}

TEST_P(FaultOnALevel, HalvesTheCoarseStep) {
  ScratchFolder scratch;
  PlantedFault fault;
  fault.level = GetParam();
  fault.from = 0.05;
  fault.to = 0.1;
  fault.longest = 3e-3;
  const RunReport one = run(scratch / "one", fault);
  ASSERT_EQ(one.message, "");
  const auto events = nlohmann::json::parse(one.events_json);
  EXPECT_GT(events.at("step redone with a smaller one").at("count").get<int>(), 0);
  EXPECT_LE(std::abs(one.worst_drift), allowed_drift);
  expect_same(one, run(scratch / "other", fault, {3, 2, 1}, 2));
}

TEST_P(FaultOnALevel, ThatStaysEndsTheRunWithAGoodCheckpoint) {
  ScratchFolder scratch;
  PlantedFault fault;
  fault.level = GetParam();
  fault.from = 0.02;
  fault.to = 1e9;
  const RunReport one = run(scratch / "one", fault);
  EXPECT_EQ(one.status, RunStatus::failed);
  EXPECT_NE(one.message.find("of level " + std::to_string(GetParam())), std::string::npos)
      << one.message;
  const RunReport other = run(scratch / "other", fault, {3, 2, 1}, 2);
  EXPECT_EQ(other.message, one.message);
  EXPECT_EQ(difference(one.archive.value(), other.archive.value(), true), "");
}

INSTANTIATE_TEST_SUITE_P(Levels, FaultOnALevel, testing::Values(2));
INSTANTIATE_TEST_SUITE_P(Full, FaultOnALevel, testing::Range(0, 2));

}  // namespace
}  // namespace sluice::properties::amr_rejection_test
