// The states of a level over substeps of a coarse step, and slope masks upon them.
#include "framework/run/levels/level_states.hpp"

#include <gtest/gtest.h>

#include "framework/run/levels/slope_masks.hpp"
#include "framework/run/test_support/mock_component.hpp"

namespace sluice::run_test {
namespace {

double& first(Warehouse& state) {
  return state.view(0, 0, 0)({0, 0, 0});
}

class LevelStatesTest : public testing::Test {
 protected:
  Scene scene_ = tube();
  MockComponent component_{scene_.grid.levels.front()};
  const Level& level_ = scene_.grid.levels.front();

  // An attempt that ends with this value in the first cell, and is accepted.
  static void substep(LevelStates& states, double value) {
    states.store_start_state();
    first(states.next()) = value;
    states.advance();
  }
};

TEST_F(LevelStatesTest, OfARejectedCoarseStepIsTheStart) {
  for (const int taken : {0, 1, 2, 3}) {
    LevelStates states(component_, level_, 0, 4);
    first(states.present()) = 7;
    for (int n = 1; n <= taken; ++n) {
      substep(states, 10.0 * n);
      EXPECT_EQ(first(states.present()), 10.0 * n);
      EXPECT_EQ(states.start().view(0, 0, 0)({0, 0, 0}), 7) << taken;
      EXPECT_EQ(states.previous().view(0, 0, 0)({0, 0, 0}), n == 1 ? 7 : 10.0 * (n - 1));
    }
    EXPECT_EQ(states.reject(), taken > 0);
    EXPECT_EQ(first(states.present()), 7) << taken;
  }
}

TEST_F(LevelStatesTest, OfAnAcceptedStepBeginTheNextOne) {
  LevelStates states(component_, level_, 0, 2);
  first(states.present()) = 1;
  substep(states, 2);
  substep(states, 3);
  states.accept();
  EXPECT_FALSE(states.reject()) << "nothing was taken since";
  EXPECT_EQ(first(states.present()), 3);
  substep(states, 4);
  EXPECT_EQ(states.start().view(0, 0, 0)({0, 0, 0}), 3);
}

TEST_F(LevelStatesTest, OnOtherBoxesHaveTheSameSlots) {
  LevelStates states(component_, level_, 0, 1);
  first(states.present()) = 5;
  Scene halves = tube(2);
  const Warehouse before = states.lay_out(halves.grid.levels.front().boxes);
  EXPECT_EQ(before.view(0, 0, 0)({0, 0, 0}), 5);
  EXPECT_EQ(states.present().local_boxes().size(), 2U);
  EXPECT_EQ(states.present().slot_count(), before.slot_count());
}

// Faults of a first attempt are masked; where they come again in masked cells, their neighbours
// are; of a third attempt nothing is left but further neighbours.
TEST_F(LevelStatesTest, MasksWidenWhereAllFaultsAreMasked) {
  LevelStates states(component_, level_, 0, 1);
  auto team = std::make_shared<const ThreadTeam>(1);
  LevelGhosts ghosts(component_, states, world(), team);
  SlopeMasks masks(mock_labels().mask, states, ghosts, world());
  const CellFault fault{{5, 0, 0}, 0, 0, 0, 0.0};
  EXPECT_EQ(masks.add(std::span(&fault, 1), 1), 1);
  EXPECT_TRUE(masks.any());
  const auto masked = [&] {
    const RealView v = states.present().view(states.present().find(mock_labels().mask, 0), 0, 0);
    int count = 0;
    for (int i = 0; i < 40; ++i) count += v({i, 0, 0}) == 0;
    return count;
  };
  EXPECT_EQ(masked(), 1);
  EXPECT_EQ(masks.add(std::span(&fault, 1), 1), 2);
  EXPECT_EQ(masked(), 3);
  EXPECT_EQ(masks.add(std::span(&fault, 1), 1), 2);
  EXPECT_EQ(masked(), 5);
  masks.clear();
  EXPECT_EQ(masks.add(std::span(&fault, 1), 1), 1) << "of another step";
  EXPECT_EQ(masked(), 1);
}

}  // namespace
}  // namespace sluice::run_test
