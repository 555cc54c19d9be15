// Passes 2 to 4 of the graph compiler: what they refuse and in which words, what they prune, order.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "framework/task/graph.hpp"

namespace sluice::graph_check_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const RowKernel nothing = [](const Row&) {};

Label mass_label() {
  return declare_label({"test_mass", ValueType::real, Centring::cell, "kg", "for tests"});
}
Label saved_label() {
  return declare_label({"test_saved", ValueType::real, Centring::cell, "1", "for tests"});
}

EffectList two_effects() {
  EffectList effects;
  effects.add({"flow", true, "always", {}});
  effects.add({"friction", true, "viscosity is not zero", {"tube.ups", 41, 7}});
  return effects;
}

std::string refusal(const TaskList& list) {
  try {
    check(list, two_effects());
  } catch (const std::logic_error& e) {
    return e.what();
  }
  return "accepted";
}

TEST(GraphCheck, AcceptsAChainFromOldToNewState) {
  TaskList list;
  const VariableId old = list.old_state(mass_label(), 0, 1),
                   now = list.new_state(mass_label(), 0, 1);
  const VariableId middle = list.temporary("middle");
  TaskBuilder first = list.task("first", 0);
  first.read(old);
  first.write(middle);
  first.kernel(nothing);
  TaskBuilder second = list.task("second", 0);
  second.read(middle);
  second.write(now);
  second.kernel(nothing);
  EXPECT_EQ(refusal(list), "accepted");
}

TEST(GraphCheck, RefusesATaskForPartsOfBlocksThatWrites) {
  TaskList list;
  TaskBuilder task = list.task("account", 0);
  task.write(list.temporary("sum"));
  task.kernel(nothing);
  task.only_in([](int, const IndexBox& block) { return block; });
  EXPECT_THAT(refusal(list), AllOf(HasSubstr("task 'account'"), HasSubstr("parts of blocks only")));
}

TEST(GraphCheck, NamesTaskVariableEffectAndDeckLineOfAReadWithoutWriter) {
  TaskList list;
  const VariableId stress = list.temporary("stress");
  TaskBuilder task = list.task("Lagrangian phase", 1);
  task.read(stress);
  task.kernel(nothing);
  EXPECT_THAT(
      refusal(list),
      AllOf(HasSubstr("task 'Lagrangian phase'"), HasSubstr("'stress', which no task writes"),
            HasSubstr("effect 'friction'"), HasSubstr("called for at tube.ups:41:7")));
}

TEST(GraphCheck, RefusesTwoWritersAndNamesBoth) {
  TaskList list;
  const VariableId p = list.temporary("pressure");
  for (const char* name : {"closure", "solver"}) {
    TaskBuilder task = list.task(name, 0);
    task.write(p);
    task.kernel(nothing);
  }
  EXPECT_THAT(refusal(list), AllOf(HasSubstr("task 'solver' of effect 'flow' writes 'pressure'"),
                                   HasSubstr("task 'closure' of effect 'flow' writes already")));
}

TEST(GraphCheck, RefusesToWriteOldState) {
  TaskList list;
  TaskBuilder task = list.task("update", 0);
  task.write(list.old_state(mass_label(), 0, 1));
  task.kernel(nothing);
  EXPECT_THAT(refusal(list), AllOf(HasSubstr("'test_mass (old)'"), HasSubstr("read only")));
}

TEST(GraphCheck, RefusesToReadOutputs) {
  TaskList list;
  const VariableId saved = list.output(saved_label(), 0);
  TaskBuilder writer = list.task("store", 0);
  writer.write(saved);
  writer.kernel(nothing);
  TaskBuilder reader = list.task("peek", 0);
  reader.read(saved);
  reader.kernel(nothing);
  EXPECT_THAT(refusal(list), AllOf(HasSubstr("task 'peek'"), HasSubstr("the output 'test_saved'"),
                                   HasSubstr("for archives only")));
}

TEST(GraphCheck, RefusesATaskWithoutKernel) {
  TaskList list;
  list.task("forgotten", 0);
  EXPECT_THAT(refusal(list), AllOf(HasSubstr("task 'forgotten'"), HasSubstr("no kernel")));
}

TEST(GraphCheck, NamesTheTasksOfACircle) {
  TaskList list;
  const VariableId a = list.temporary("a"), b = list.temporary("b"), c = list.temporary("c");
  TaskBuilder outside = list.task("outside", 0);
  outside.write(c);
  outside.kernel(nothing);
  TaskBuilder first = list.task("chicken", 0);
  first.read(b);
  first.write(a);
  first.kernel(nothing);
  TaskBuilder second = list.task("egg", 0);
  second.read(a);
  second.write(b);
  second.kernel(nothing);
  EXPECT_THAT(refusal(list), AllOf(HasSubstr("circle"), HasSubstr("'chicken', 'egg'"),
                                   testing::Not(HasSubstr("outside"))));
}

// Six tasks: two feed the new state, one feeds a saved label, one is wanted for its reductions, one
// feeds that one, one feeds nothing.
struct Tree {
  TaskList list;
  VariableId now, saved;
  Tree() {
    const VariableId old = list.old_state(mass_label(), 0, 1);
    now = list.new_state(mass_label(), 0, 1);
    saved = list.output(saved_label(), 0);
    const VariableId a = list.temporary("a"), b = list.temporary("b"), c = list.temporary("c");
    add("flux", old, a);
    add("update", a, now);
    add("store", a, saved);
    add("account input", old, b);
    TaskBuilder budget = list.task("account", 0);
    budget.read(b);
    budget.kernel(nothing).always();
    add("useless", a, c);
  }
  void add(const char* name, VariableId in, VariableId out) {
    TaskBuilder task = list.task(name, 0);
    task.read(in);
    task.write(out);
    task.kernel(nothing);
  }
};

TEST(GraphPrune, KeepsWhatIsWantedAndWhatFeedsIt) {
  const Tree tree;
  EXPECT_THAT(prune(tree.list, {tree.now}), ElementsAre(true, true, false, true, true, false));
  EXPECT_THAT(prune(tree.list, {tree.now, tree.saved}),
              ElementsAre(true, true, true, true, true, false));
  EXPECT_THAT(prune(tree.list, {}), ElementsAre(false, false, false, true, true, false));
}

TEST(GraphOrder, ProducersComeFirstAndDeclarationBreaksTies) {
  TaskList list;
  const VariableId a = list.temporary("a"), b = list.temporary("b"), c = list.temporary("c");
  const auto add = [&](const char* name, std::vector<VariableId> in, VariableId out) {
    TaskBuilder task = list.task(name, 0);
    for (VariableId v : in) task.read(v);
    task.write(out);
    task.kernel(nothing);
  };
  add("0 reads all", {a, b, c}, list.temporary("end"));
  add("1 needs b", {b}, c);
  add("2 free", {}, a);
  add("3 free", {}, b);
  EXPECT_THAT(order(list, {true, true, true, true}), ElementsAre(2, 3, 1, 0));
  EXPECT_THAT(order(list, {false, true, false, true}), ElementsAre(3, 1));
}

TEST(GraphDot, ShowsWhatStaysWithItsVariables) {
  const Tree tree;
  Axes axes;
  const std::string dot =
      to_dot(tree.list, two_effects(), compile(tree.list, two_effects(), {tree.now}, axes));
  EXPECT_THAT(dot, AllOf(HasSubstr("digraph"), HasSubstr("\"a\" -> \"update\""),
                         HasSubstr("\"update\" -> \"test_mass (new)\"")));
  EXPECT_THAT(dot, testing::Not(HasSubstr("useless")));
}

}  // namespace
}  // namespace sluice::graph_check_test
