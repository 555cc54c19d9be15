// Two static levels in a mock: upwind advection, the fine level subcycled inside the coarse step,
// with ghost values interpolated in time, matched fluxes, and a fine substep that is rejected.
//
//   coarse: cells 0..31 (spacing 1, periodic); fine: cells 16..47 (spacing 1/2), over coarse 8..23
//   q_i' = q_i - dt/dx (q_i - q_{i-1})
#include <gtest/gtest.h>

#include "framework/task/schedule.hpp"
#include "framework/task/sweep_test_support.hpp"

namespace sluice::level_cycle_mock_test {
namespace {

// A compiled sweep as a node: inadmissible cells reject the step.
Sweep sweep_node(std::string name, const Level& level, SweepExecutor& executor,
                 Communicator& ranks) {
  return {std::move(name), level.index,
          [&level, &executor, &ranks](const StepScope& scope, StepJournal&) {
            const Reductions& r = executor.run({scope.time, scope.dt, level.spacing, level.index});
            return agree(r.fault_count() > 0 ? Verdict::reject : Verdict::good, ranks);
          }};
}

// An exchange of ghost cells as a node.
GhostExchange ghost_exchange_node(std::string name, const Level& level, int width,
                                  HaloExchange& exchange, Warehouse& warehouse,
                                  std::vector<int> slots) {
  return {std::move(name), level.index, width,
          [&exchange, &warehouse, slots = std::move(slots)](const StepScope&, StepJournal&) {
            exchange.run(warehouse, slots);
            return Verdict::good;
          }};
}

using namespace sweep_test;

constexpr int ghosts = 1, ratio = 2, fine_low = 16, fine_high = 48;
constexpr double too_long = 0.3;  // a fine substep that does not start the step must be shorter

// One level's fields at several times and the sweeps between them.
struct MockLevel {
  Level level;
  TaskList list;
  std::vector<Warehouse> fields;  // 0: start of the coarse step, then one a substep
  std::vector<std::unique_ptr<SweepExecutor>> sweeps;
  std::unique_ptr<HaloExchange> halo;
  int slot = 0;

  MockLevel(Level l, int substeps) : level(std::move(l)) {
    const VariableId old = list.old_state(test_label(1), 0, 1);
    const VariableId now = list.new_state(test_label(1), 0, 1);
    TaskBuilder task = list.task("upwind", 0);
    const In q = task.read(old, Stencil::along(0, 1, 0));
    const Out next = task.write(now);
    task.kernel([=](const Row& row) {
      const double courant = row.step().dt / row.step().spacing.x;
      const double *c = row(q), *m = row(q, 0, 0, -1);
      for (int i = 0; i < row.count(); ++i) row(next)[i] = c[i] - courant * (c[i] - m[i]);
      if (row.step().level > 0 && row.step().time > 0 && row.step().dt > too_long)
        row.reductions().fault({row.cell(), row.step().level, 0, 0, row.step().dt});
    });
    for (int n = 0; n <= substeps; ++n) {
      fields.emplace_back(level, 0);
      slot = fields.back().add({test_label(1), 0, 1, ghosts});
    }
    for (int n = 0; n < substeps; ++n) {
      sweeps.push_back(std::make_unique<SweepExecutor>(list, plan_sweep(list, {0}, axes_of(level)),
                                                       level, SweepOptions{}));
      sweeps.back()->bind(fields[n], fields[n + 1], nullptr);
    }
    halo = std::make_unique<HaloExchange>(level, ghosts, 0);
  }

  double& at(int time, int i) const {
    const Warehouse& w = fields[time];
    for (int b = 0; b < static_cast<int>(w.local_boxes().size()); ++b)
      if (w.local_boxes()[b].cells.contains(IntVec3{i, 0, 0})) return w.view(slot, 0, b)(i, 0, 0);
    throw std::logic_error("no such cell");
  }
  std::vector<double> values(int time = 0) const {
    std::vector<double> all;
    for (int i = level.domain.lower.x; i < level.domain.upper.x; ++i) all.push_back(at(time, i));
    return all;
  }
};

Level coarse_level(int boxes) {
  Level level = level_of({32, 1, 1}, {boxes, 1, 1});
  level.periodic[0] = true;
  return level;
}
Level fine_level(int boxes) {
  Level level = level_of({fine_high - fine_low, 1, 1}, {boxes, 1, 1}, {fine_low, 0, 0});
  level.index = 1;
  level.spacing.x = 0.5;
  return level;
}

struct TwoLevels {
  MockLevel coarse, fine;
  double accepted_dt = 0;
  int attempts = 0, flux_corrections = 0;
  std::vector<double> fine_starts;

  explicit TwoLevels(int coarse_boxes = 1, int fine_boxes = 1)
      : coarse(coarse_level(coarse_boxes), 1), fine(fine_level(fine_boxes), ratio) {
    for (int i = 0; i < 32; ++i) coarse.at(0, i) = 1 + 0.01 * ((i * 37) % 11);
    for (int i = fine_low; i < fine_high; ++i) fine.at(0, i) = 1 + 0.01 * ((i * 17) % 13);
    coarsen();
  }

  // Mean of the fine cells over each coarse one.
  void coarsen() {
    for (int i = fine_low / ratio; i < fine_high / ratio; ++i)
      coarse.at(0, i) = 0.5 * (fine.at(0, 2 * i) + fine.at(0, 2 * i + 1));
  }

  // The coarse value left of the fine level, at the start of this substep.
  double inflow(const StepScope& s) const {
    const int i = fine_low / ratio - 1;
    return coarse.at(0, i) + s.start_share() * (coarse.at(1, i) - coarse.at(0, i));
  }

  Verdict fill_fine_ghosts(const StepScope& s, StepJournal&) {
    fine_starts.push_back(s.time);
    Warehouse& w = fine.fields[s.substep];
    fine.halo->run(w, {fine.slot});
    for (int b = 0; b < static_cast<int>(w.local_boxes().size()); ++b)
      if (w.local_boxes()[b].cells.lower.x == fine_low)
        w.view(fine.slot, 0, b)(fine_low - 1, 0, 0) = inflow(s);
    return Verdict::good;
  }

  // What fine fluxes bring in place of the coarse ones goes to the coarse cells beside the fine
  // level, but only once the step is accepted.
  Verdict match_fluxes(const StepScope& s, StepJournal& journal) {
    const double coarse_in = s.dt * coarse.at(0, fine_low / ratio - 1), fine_in = s.dt * inflow(s);
    const double coarse_out = s.dt * coarse.at(0, fine_high / ratio - 1);
    const double fine_out = s.dt * fine.at(s.substep, fine_high - 1);
    journal.at_acceptance([=, this] {
      coarse.at(0, fine_low / ratio - 1) += coarse_in - fine_in;
      coarse.at(0, fine_high / ratio) += fine_out - coarse_out;
      ++flux_corrections;
    });
    return Verdict::good;
  }

  Schedule schedule(int most_retries) {
    Communicator& ranks = world();
    const Schedule fine_step = {
        {GhostExchange{
            "fine ghosts", 1, ghosts,
            [this](const StepScope& s, StepJournal& j) { return fill_fine_ghosts(s, j); }}},
        {Sweep{"fine upwind", 1,
               [this, &ranks](const StepScope& s, StepJournal& j) {
                 const std::size_t n = s.substep;
                 return sweep_node("", fine.level, *fine.sweeps[n], ranks).run(s, j);
               }}},
        {Sweep{"match fluxes", 1,
               [this](const StepScope& s, StepJournal& j) { return match_fluxes(s, j); }}}};
    const Schedule step = {{ghost_exchange_node("coarse ghosts", coarse.level, ghosts, *coarse.halo,
                                                coarse.fields[0], {coarse.slot})},
                           {sweep_node("coarse upwind", coarse.level, *coarse.sweeps[0], ranks)},
                           {LevelCycle{"fine level", 1, ratio, fine_step}}};
    const auto accept = [this](const StepScope& s, int n) {
      coarse.fields[0].swap(coarse.fields[1]);
      fine.fields[0].swap(fine.fields[ratio]);
      coarsen();
      accepted_dt = s.dt;
      attempts = n;
    };
    return {{Retry{"step", step, most_retries, 0.5, accept}}};
  }

  double total() const {
    double sum = 0;
    for (int i = 0; i < 32; ++i)
      if (i < fine_low / ratio || i >= fine_high / ratio) sum += coarse.at(0, i);
    for (int i = fine_low; i < fine_high; ++i) sum += 0.5 * fine.at(0, i);
    return sum;
  }
};

TEST(LevelCycleMock, ARejectedSubstepLeavesBothLevelsAsTheyWere) {
  TwoLevels mock;
  const auto coarse = mock.coarse.values(), fine = mock.fine.values();
  const Schedule schedule = mock.schedule(0);
  check(schedule);
  StepJournal journal;
  // The second fine substep is too long: the first one and the coarse sweep were good.
  EXPECT_EQ(run(schedule, {0, 0, 1.0}, journal), Verdict::reject);
  EXPECT_EQ(mock.fine_starts, (std::vector<double>{0, 0.5}));
  EXPECT_EQ(mock.coarse.values(), coarse);
  EXPECT_EQ(mock.fine.values(), fine);
  EXPECT_EQ(mock.flux_corrections, 0);
  EXPECT_EQ(journal.size(), 0u);
}

TEST(LevelCycleMock, TheWholeCycleIsRedoneAndEqualsASmallerStepFromTheStart) {
  TwoLevels redone, direct;
  StepJournal journal;
  EXPECT_EQ(run(redone.schedule(5), {0, 0, 1.0}, journal), Verdict::good);
  EXPECT_EQ(redone.accepted_dt, 0.5);
  EXPECT_EQ(redone.attempts, 2);
  EXPECT_EQ(redone.fine_starts, (std::vector<double>{0, 0.5, 0, 0.25}));
  EXPECT_EQ(run(direct.schedule(0), {0, 0, 0.5}, journal), Verdict::good);
  EXPECT_EQ(redone.coarse.values(), direct.coarse.values());
  EXPECT_EQ(redone.fine.values(), direct.fine.values());
  EXPECT_EQ(redone.flux_corrections, ratio);  // of the accepted attempt only
}

TEST(LevelCycleMock, TotalsAreKeptAndBoxesChangeNothing) {
  TwoLevels one, many(4, 3);
  const double before = one.total();
  const auto start = one.fine.values();
  for (TwoLevels* mock : {&one, &many}) {
    const Schedule schedule = mock->schedule(5);
    StepJournal journal;
    for (int n = 0; n < 20; ++n)
      ASSERT_EQ(run(schedule, {0, 0.5 * n, 0.5}, journal), Verdict::good);
  }
  EXPECT_NEAR(one.total(), before, 1e-13 * before);
  EXPECT_NE(one.fine.values(), start);
  EXPECT_EQ(one.coarse.values(), many.coarse.values());
  EXPECT_EQ(one.fine.values(), many.fine.values());
}

TEST(LevelCycleMock, ThePlanShowsTheShapeOfTheStep) {
  EXPECT_EQ(describe(TwoLevels().schedule(5)),
            "step step, redone when rejected\n"
            "  ghost exchange coarse ghosts, width 1\n"
            "  sweep coarse upwind\n"
            "  level 1 fine level, 2 substeps\n"
            "    ghost exchange fine ghosts, width 1\n"
            "    sweep fine upwind\n"
            "    sweep match fluxes\n");
}

}  // namespace
}  // namespace sluice::level_cycle_mock_test
