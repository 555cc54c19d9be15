// The fluid as a part among others: wherever its numbers begin, the same bits.
#include "ice/ice.hpp"

#include <gtest/gtest.h>

#include "framework/task/graph.hpp"
#include "framework/task/sweep_executor.hpp"
#include "ice/test_support/classic.hpp"

namespace sluice::ice::fluid_part_test {
namespace {

// A closed box of gas that flies apart under gravity, so that all sums and maxima are at work.
GasBox stirred() {
  GasBox box;
  box.cells = {12, 9, 1};
  box.periodic = false;
  box.walls = true;
  box.scheme = "conservative";
  box.gravity = "[0.1,-0.1,0]";
  box.density = "2+sin(5*x)";
  box.pressure = "4+0.5*cos(4*y)";
  box.velocity[0] = "0.3*sin(4*x)";
  return box;
}

struct Outcome {
  std::vector<double> state;  // all slots, cell by cell
  std::vector<double> maxima, sums;
  std::vector<CellFault> faults;
  std::vector<int> effects;  // of the tasks, counted from the part's first
};

// Where the numbers of the fluid begin: those of another part come before them.
struct Begin {
  IndexOffsets places;
  int maxima = 0, sums = 0;
};

std::shared_ptr<ReductionLayout> layout_of(const Begin& begin) {
  auto layout = std::make_shared<ReductionLayout>();
  layout->add_maxima(begin.maxima);
  layout->add_sums(begin.sums);
  return layout;
}

// One step of the fluid.
Outcome step(const DeckScene& deck, const Begin& begin, double dt) {
  std::vector<Fault> none;
  const IndexOffsets& places = begin.places;
  const Ice ice(deck.scene, read_ice_scene(deck.deck, deck.scene, none), places, layout_of(begin));
  const FluidPart& part = ice.part();
  const Level& level = deck.scene.grid.levels.front();
  Warehouse old_state(level, 0), next(level, 0);
  for (const SlotInfo& slot : ice.state().slots()) {
    old_state.add(slot);
    next.add(slot);
  }
  ice.state().initialise(old_state);
  part.boundary(0).fill(old_state, ThreadTeam(1));
  TaskList list;
  ice.step().declare(list, {});
  EffectList effects;
  for (int n = 0; n < places.effect; ++n) effects.add({"of another part", true, "", {}});
  for (int n = 0; n < part.effects().size(); ++n) effects.add(part.effects()[n]);
  std::vector<VariableId> wanted;
  for (std::size_t n = 0; n < list.variables().size(); ++n)
    if (list.variables()[n].storage == Storage::new_state) wanted.push_back({static_cast<int>(n)});
  SweepOptions options;
  options.maxima = part.reductions().maxima();
  options.sums = part.reductions().sums();
  SweepExecutor sweep(list, compile(list, effects, wanted, active_axes(level)), level, options);
  sweep.bind(old_state, next, nullptr);
  const Reductions& r = sweep.run({0, dt, level.spacing, 0});
  Outcome out;
  for (std::size_t s = 0; s < ice.state().slots().size(); ++s)
    for (int c = 0; c < ice.state().slots()[s].components; ++c)
      for_each_cell(level.domain, [&](IntVec3 cell) {
        out.state.push_back(next.view(static_cast<int>(s), c, 0)(cell));
      });
  for (int n = 0; n < begin.maxima; ++n) EXPECT_EQ(r.maximum(n), 0) << "of another part";
  for (int n = 0; n < begin.sums; ++n) EXPECT_EQ(r.sum(n).value(), 0) << "of another part";
  for (int n = 0; n < part.maxima().count(); ++n)
    out.maxima.push_back(r.maximum(part.maxima().first() + n));
  for (int n = 0; n < part.sums().count(); ++n)
    out.sums.push_back(r.sum(part.sums().first() + n).value());
  out.faults = r.faults();
  for (const Task& t : list.tasks()) out.effects.push_back(t.effect - places.effect);
  return out;
}

IndexOffsets places_elsewhere() {
  IndexOffsets places;
  places.effect = 7;
  places.fault = 100;
  places.material = {4};
  return places;
}
const Begin elsewhere{places_elsewhere(), 3, 5};

TEST(FluidPart, IsTheSameWhereverItStands) {
  const DeckScene deck(deck_text(stirred()));
  const Outcome alone = step(deck, {}, 0.01), beside = step(deck, elsewhere, 0.01);
  EXPECT_EQ(alone.state, beside.state);
  EXPECT_EQ(alone.maxima, beside.maxima);
  EXPECT_EQ(alone.sums, beside.sums);
  EXPECT_EQ(alone.effects, beside.effects);
  EXPECT_GT(alone.maxima.front(), 0);
  EXPECT_NE(alone.sums[StepSlots::pressure_impulse], 0) << "walls press";
  EXPECT_TRUE(alone.faults.empty());
}

TEST(FluidPart, ItsFaultsNameTheScenesMaterial) {
  const DeckScene deck(deck_text(stirred()));
  const Outcome alone = step(deck, {}, 3.0), beside = step(deck, elsewhere, 3.0);
  ASSERT_FALSE(alone.faults.empty()) << "a step so long that cells are emptied";
  ASSERT_EQ(alone.faults.size(), beside.faults.size());
  for (std::size_t n = 0; n < alone.faults.size(); ++n) {
    EXPECT_EQ(beside.faults[n].kind, alone.faults[n].kind + elsewhere.places.fault);
    EXPECT_EQ(alone.faults[n].material, 0);
    EXPECT_EQ(beside.faults[n].material, 4);
    EXPECT_EQ(beside.faults[n].cell, alone.faults[n].cell);
  }
}

TEST(FluidPart, StoresUnderTheScenesNumbers) {
  const DeckScene deck(deck_text(stirred()));
  std::vector<Fault> none;
  const Ice ice(deck.scene, read_ice_scene(deck.deck, deck.scene, none), elsewhere.places,
                layout_of(elsewhere));
  for (const SlotInfo& slot : ice.state().slots()) EXPECT_EQ(slot.material, 4);
}

}  // namespace
}  // namespace sluice::ice::fluid_part_test
