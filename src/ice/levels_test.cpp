// One gas on two levels: start, ghosts, totals and sums of each.
#include <gtest/gtest.h>

#include "framework/grid/box_list.hpp"
#include "ice/step/effect_ids.hpp"
#include "ice/test_support/classic.hpp"
#include "ice/test_support/transfer.hpp"

namespace sluice::ice::levels_test {
namespace {

// 8 x 8 cells between walls, the lower left 4 x 6 of them refined.
class TwoLevels : public testing::Test {
 protected:
  void build(GasBox box) {
    box.cells = {8, 8, 1};
    box.periodic = false;
    box.walls = true;
    Schema schema;
    add_framework_tags(schema);
    add_ice_tags(schema);
    Deck deck = load_deck_text(deck_text(box), "box.ups", {}, schema);
    std::vector<Fault> faults = deck.faults;
    scene_ = read_scene(deck, SceneOptions{}, faults);
    IceScene ice_scene = read_ice_scene(deck, scene_, faults);
    for (const Fault& f : faults) ASSERT_NE(f.severity, Severity::error) << to_string(f);
    Level fine = scene_.grid.levels.front();
    fine.index = 1;
    fine.ratio = {2, 2, 1};
    fine.spacing = {0.5 * fine.spacing.x, 0.5 * fine.spacing.y, fine.spacing.z};
    fine.domain = refine(fine.domain, fine.ratio);
    fine.boxes = {{refine(refined_, fine.ratio), 0, 0}};
    scene_.grid.levels.push_back(fine);
    ice_ = std::make_unique<Ice>(scene_, std::move(ice_scene));
    for (const Level& level : scene_.grid.levels) {
      states_.push_back(std::make_unique<Warehouse>(level, 0));
      for (const SlotInfo& slot : ice_->state().slots()) states_.back()->add(slot);
      ice_->state().initialise(*states_.back());
      ice_->state().fill_boundary(*states_.back(), 0, {}, ThreadTeam());
    }
  }
  double value(int level, Label label, IntVec3 cell, int c = 0) const {
    const Warehouse& state = *states_[level];
    return state.view(state.find(label, 0), c, 0)(cell);
  }
  double pressure(int level, IntVec3 cell) const {
    return gas_.pressure(value(level, labels().mass, cell), value(level, labels().energy, cell));
  }

  IndexBox refined_{{0, 0, 0}, {4, 6, 1}};
  Scene scene_;
  eos::IdealGas gas_;
  std::unique_ptr<Ice> ice_;
  std::vector<std::unique_ptr<Warehouse>> states_;
};

TEST_F(TwoLevels, AtRestUnderGravityHaveOnePressure) {
  GasBox box;
  box.gravity = "[0,-0.3,0]";
  box.pressure = "9";  // the hydrostatic one counts
  build(box);
  for_each_cell(refined_, [&](IntVec3 cell) {
    double mean = 0;
    for_each_cell(refine({cell, cell + IntVec3::all(1)}, {2, 2, 1}),
                  [&](IntVec3 child) { mean += 0.25 * pressure(1, child); });
    EXPECT_NEAR(mean, pressure(0, cell), 1e-14);
  });
  // The ghosts below the wall go on with the weight of fine cells.
  const double weight = -0.3 * scene_.grid.levels[1].spacing.y;
  for (int j = -3; j < 0; ++j)
    EXPECT_NEAR(pressure(1, {2, j, 0}) - pressure(1, {2, 0, 0}), j * weight, 1e-14);
}

TEST_F(TwoLevels, MirrorTheirGhostsAtTheSameWall) {
  GasBox box;
  box.density = "1+x";
  box.velocity[0] = "0.5+y";
  build(box);
  for (int level = 0; level < 2; ++level)
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(value(level, labels().mass, {-1 - i, 4, 0}),
                value(level, labels().mass, {i, 4, 0}));
      EXPECT_EQ(value(level, labels().momentum, {-1 - i, 4, 0}),
                -value(level, labels().momentum, {i, 4, 0}));
    }
  EXPECT_NE(value(0, labels().mass, {0, 4, 0}), value(1, labels().mass, {0, 4, 0}));
}

TEST_F(TwoLevels, CountEveryPlaceOnce) {
  GasBox box;
  box.density = "2";
  box.velocity[1] = "3";
  build(box);
  Totals totals;
  ice_->budgets().add_totals(
      *states_[0], LevelCoverage(scene_.grid.levels[0], &scene_.grid.levels[1], 0), totals);
  EXPECT_DOUBLE_EQ(totals.mass[0].sum.value(), 2.0 * 40 / 64);
  ice_->budgets().add_totals(*states_[1], LevelCoverage(scene_.grid.levels[1], nullptr, 0), totals);
  EXPECT_DOUBLE_EQ(totals.mass[0].sum.value(), 2.0);
  EXPECT_DOUBLE_EQ(totals.momentum[1].sum.value(), 6.0);
  EXPECT_DOUBLE_EQ(totals.kinetic_energy.sum.value(), 9.0);
  EXPECT_EQ(ice_->step().reductions().sums(), StepSlots::sums);
}

TEST_F(TwoLevels, SumWhatGravityDoesOnlyWhereItActs) {
  GasBox box;
  box.gravity = "[0,-0.3,0]";
  build(box);
  EXPECT_EQ(ice_->step().reductions().sums(), StepSlots::sums_with_gravity);
  EXPECT_TRUE(ice_->effects().on(effect_flux_record));
}

}  // namespace
}  // namespace sluice::ice::levels_test
