// The tasks of the mock on levels, and what they do on one level.
#include "framework/run/test_support/hierarchy_mock.hpp"

#include <algorithm>

#include "framework/run/test_support/hierarchy_test_run.hpp"

namespace sluice::hierarchy_test {

struct HierarchyMock::Variables {
  VariableId a, b, s, mask;                    // old
  std::vector<VariableId> fluxes[quantities];  // of a, b, s by axis: amount a volume of the cell
  Axes axes;
  bool with_b = true;
  std::vector<std::size_t> present() const {
    return with_b ? std::vector<std::size_t>{0, 1, 2} : std::vector<std::size_t>{0, 2};
  }
};

void HierarchyMock::initialise(Warehouse& state) const {
  const auto slots = slots_of(state);
  for (int n = 0; n < static_cast<int>(state.local_boxes().size()); ++n)
    for_each_cell(state.local_boxes()[n].cells, [&](IntVec3 c) {
      const Values v = wishes_->start(state.level().centre(c));
      for (std::size_t q = 0; q < quantities; ++q) state.view(slots[q], 0, n)(c) = v[q];
    });
}

void HierarchyMock::fill_boundary(Warehouse& state, double time, std::span<const double> /*sums*/,
                                  const ThreadTeam&) const {
  const Level& level = state.level();
  const auto slots = slots_of(state);
  boundary_fills.push_back({level.index, time, 0, false});
  const auto outside = [&](IntVec3 c) {
    for (int d = 0; d < 3; ++d)
      if (!level.periodic[d] && (c[d] < level.domain.lower[d] || c[d] >= level.domain.upper[d]))
        return true;
    return false;
  };
  for (int n = 0; n < static_cast<int>(state.local_boxes().size()); ++n)
    for (std::size_t q = 0; q < quantities; ++q) {
      const RealView v = state.view(slots[q], 0, n);
      for_each_cell(v.box, [&](IntVec3 c) {
        if (outside(c)) v(c) = wishes_->outside(level.centre(c), time)[q];
      });
    }
}

double HierarchyMock::rate_on(int level) const {
  if (wishes_->rate) return wishes_->rate(level);
  const Level& l = scene_->grid.levels[level];
  double rate = 0;
  for (int d = 0; d < 3; ++d)
    rate += std::max(std::fabs(wishes_->velocity_a[d]), std::fabs(wishes_->velocity_b[d])) /
            l.spacing[d];
  return rate;
}

void HierarchyMock::measure_rates(const Warehouse& state, Reductions& rates) const {
  rates.maximum(0, ordered_bits(rate_on(state.level().index)));
}

void HierarchyMock::add_totals(const Warehouse& state, const LevelCoverage& coverage,
                               Totals& totals) const {
  totals.mass.resize(quantities);
  const auto slots = slots_of(state);
  const double volume = state.level().cell_volume();
  const auto parts_of = [&](int n) {
    const IndexBox& whole = state.local_boxes()[n].cells;
    return coverage.any() ? coverage.uncovered(n) : std::vector<IndexBox>{whole};
  };
  for (int n = 0; n < static_cast<int>(state.local_boxes().size()); ++n)
    for (const IndexBox& part : parts_of(n))
      for (std::size_t q = 0; q < quantities; ++q) {
        const RealView v = state.view(slots[q], 0, n);
        for_each_cell(part, [&](IntVec3 c) { totals.mass[q].add(v(c) * volume); });
      }
}

void HierarchyMock::declare(TaskList& list, const StepVariant& variant) const {
  const MockLabels& l = mock_labels();
  Variables v;
  v.with_b = variant.kind == kinds() - 1;
  v.a = list.old_state(l.a, 0, 1);
  if (v.with_b) v.b = list.old_state(l.b, 1, 1);
  v.s = list.old_state(l.s, 0, 1);
  if (variant.masked) v.mask = list.old_state(l.mask, 0, 1);
  v.axes = active_axes(scene_->grid.levels[variant.level]);
  for (int axis = 0; axis < v.axes.count; ++axis) {
    declare_faces(list, v, variant, axis);
    if (variant.recorder != nullptr) declare_record(list, v, variant, axis);
  }
  declare_update(list, v, variant);
  TaskBuilder stamp = list.task("stamp", 0);
  const Out to = stamp.write(list.output(l.stamp, 0));
  stamp.kernel([=](const Row& row) { std::fill_n(row(to), row.count(), row.step().time); });
}

void HierarchyMock::declare_faces(TaskList& list, Variables& v, const StepVariant& variant,
                                  int axis) const {
  const int d = v.axes.direction[axis];
  const Wishes* w = wishes_;
  TaskBuilder faces = list.task("faces of axis " + std::to_string(axis), 0);
  const In a = faces.read(v.a, Stencil::along(d, 2, 1)),
           s = faces.read(v.s, Stencil::along(d, 1, 0));
  In b, mask;
  if (v.with_b) b = faces.read(v.b, Stencil::along(d, 1, 0));
  if (variant.masked) mask = faces.read(v.mask, Stencil::along(d, 1, 0));
  Out out[quantities];
  for (const std::size_t q : v.present()) {
    v.fluxes[q].push_back(
        list.temporary("flux " + std::to_string(q) + " of axis " + std::to_string(axis), 1, d));
    out[q] = faces.write(v.fluxes[q].back());
  }
  const bool masked = variant.masked, with_b = v.with_b;
  // Velocities are not negative: the upwind cell is the lower one.
  faces.kernel([=](const Row& row) {
    const double spacing = row.step().spacing[d], dt = row.step().dt;
    const double courant_a = w->velocity_a[d] * dt / spacing,
                 courant_b = w->velocity_b[d] * dt / spacing,
                 diffusive = w->diffusion * dt / (spacing * spacing);
    for (int i = 0; i < row.count(); ++i) {
      const double low = row(a, 0, axis, -1)[i];
      double slope = minmod(low - row(a, 0, axis, -2)[i], row(a)[i] - low);
      if (masked) slope *= row(mask, 0, axis, -1)[i];
      const double flux = courant_a * (low + 0.5 * (1 - courant_a) * slope + 0.5 * dt * w->source);
      const double carried = row(s, 0, axis, -1)[i];
      row(out[0])[i] = flux;
      if (with_b) row(out[1])[i] = courant_b * row(b, 0, axis, -1)[i];
      row(out[2])[i] = (low > 0 ? flux * carried / low : 0) + diffusive * (carried - row(s)[i]);
    }
  });
}

void HierarchyMock::log_sweep(const Row& row, bool masked) const {
  const Call call{row.step().level, row.step().time, row.step().dt, masked};
  if (sweeps.empty() || !(sweeps.back() == call)) sweeps.push_back(call);
}

void HierarchyMock::declare_update(TaskList& list, const Variables& v,
                                   const StepVariant& variant) const {
  const MockLabels& l = mock_labels();
  TaskBuilder update = list.task("update", 0);
  const std::vector<std::size_t> present = v.present();
  In old[] = {update.read(v.a), {}, update.read(v.s)};
  if (v.with_b) old[1] = update.read(v.b);
  std::vector<In> fluxes[quantities];
  for (int axis = 0; axis < v.axes.count; ++axis)
    for (const std::size_t q : present)
      fluxes[q].push_back(
          update.read(v.fluxes[q][axis], Stencil::along(v.axes.direction[axis], 0, 1)));
  Out now[] = {
      update.write(list.new_state(l.a, 0, 1)), {}, update.write(list.new_state(l.s, 0, 1))};
  if (v.with_b) now[1] = update.write(list.new_state(l.b, 1, 1));
  const LevelCoverage* coverage = variant.coverage;
  const bool masked = variant.masked;
  const int along = v.axes.direction[0];
  update.kernel([=, this](const Row& row) {
    log_sweep(row, masked);
    if (wishes_->labour) wishes_->labour(row.cell());
    const StepConstants& step = row.step();
    const double gain = step.dt * wishes_->source;
    for (const std::size_t q : present)
      for (int i = 0; i < row.count(); ++i) {
        double change = q == 0 ? gain : 0;
        for (int axis = 0; axis < static_cast<int>(fluxes[q].size()); ++axis) {
          const In f = fluxes[q][axis];
          change += row(f)[i] - row(f, 0, axis, 1)[i];
        }
        row(now[q])[i] = row(old[q])[i] + change;
      }
    for (int i = 0; i < row.count(); ++i) {
      IntVec3 cell = row.cell();
      cell[along] += i;
      const Sweeping here{step.level, step.time, step.dt, cell, masked};
      if (!std::isfinite(row(now[0])[i]) || (wishes_->inadmissible && wishes_->inadmissible(here)))
        row.reductions().fault({cell, step.level, 0, 0, row(now[0])[i]});
      const double volume = step.spacing.x * step.spacing.y * step.spacing.z;
      if (coverage == nullptr || !coverage->is_covered(row.box(), cell))
        row.reductions().sum(0).add(gain * volume);
    }
    if (step.rates) row.reductions().maximum(0, ordered_bits(rate_on(step.level)));
  });
}

void HierarchyMock::declare_record(TaskList& list, const Variables& v, const StepVariant& variant,
                                   int axis) {
  TaskBuilder task = list.task("flux record of axis " + std::to_string(axis), 0);
  const std::vector<std::size_t> present = v.present();
  In fluxes[quantities];
  for (const std::size_t q : present)
    fluxes[q] = task.read(v.fluxes[q][axis], Stencil::along(v.axes.direction[axis], 0, 1));
  const FluxRecorder* recorder = variant.recorder;
  const int along = v.axes.direction[0];
  task.always().kernel([=](const Row& row) {
    for (FaceTable* table : {recorder->as_coarse, recorder->as_fine}) {
      if (table == nullptr || table->empty()) continue;
      for (const FaceTable::Segment& segment : table->segments(row.box(), axis, row.cell()))
        for (int n = 0; n < segment.count; ++n) {
          const int i = segment.first + n - row.cell()[along];
          if (i < 0 || i >= row.count()) continue;
          for (int q = 0; q < quantities; ++q) table->values(q)[segment.slot + n] = 0;
          for (const std::size_t q : present)
            table->values(static_cast<int>(q))[segment.slot + n] =
                row(fluxes[q], 0, axis, segment.high ? 1 : 0)[i];
        }
    }
  });
}

void HierarchyMock::declare_diagnostics(TaskList& list, int level) const {
  TaskBuilder task = list.task("flag", 1);
  const Out flag = task.write(list.output(mock_labels().flag, 0));
  const Level* l = &scene_->grid.levels[level];
  const int along = active_axes(*l).direction[0];
  task.kernel([=, this](const Row& row) {
    for (int i = 0; i < row.count(); ++i) {
      IntVec3 cell = row.cell();
      cell[along] += i;
      row(flag)[i] = wishes_->flagged && wishes_->flagged(l->centre(cell), row.step().time) ? 1 : 0;
    }
  });
}

}  // namespace sluice::hierarchy_test

namespace sluice::hierarchy_mock_test {
namespace {

using namespace hierarchy_test;

class MockOnOneLevel : public OnLevels {};

TEST_F(MockOnOneLevel, MovesWhatIsLinearExactly) {
  Shape shape;
  shape.ratios = {};
  shape.periodic = false;
  Wishes w;
  w.velocity_a = {1, 0, 0};
  w.source = 2;
  w.outside = [](Vec3 x, double t) { return Values{8 + x.x + t, 1, 1}; };
  w.start = [&](Vec3 x) { return w.outside(x, 0); };
  LevelRun run(scene_of(shape), w);
  for (int n = 0; n < 4; ++n) ASSERT_TRUE(run.attempt(0.25));
  for (const CellState& s : run.states())
    EXPECT_EQ(s.values[0], 8 + s.cell.x + 0.5 + 1) << s.cell.x;
}

TEST_F(MockOnOneLevel, CarriesAndSpreadsTheScalar) {
  Shape shape;
  shape.ratios = {};
  shape.cells.x = 32;  // what spreads does not come around
  Wishes w;
  w.velocity_a = {0.5, 0.25, 0};
  w.diffusion = 0.125;
  w.start = [](Vec3 x) { return Values{1, 0, x.x == 9.5 ? 1.0 : 0.0}; };
  LevelRun run(scene_of(shape), w);
  const Values before = run.totals();
  for (int n = 0; n < 8; ++n) ASSERT_TRUE(run.attempt(0.5));
  const Values after = run.totals();
  EXPECT_EQ(after[0], before[0]);  // uniform
  EXPECT_NEAR(after[2], before[2], 1e-14 * before[2]);
  double centre = 0;
  for (const CellState& s : run.states()) centre += s.values[2] * (s.cell.x + 0.5) / before[2];
  EXPECT_NEAR(centre, 9.5 + 8 * 0.5 * 0.5, 1e-13);
}

}  // namespace
}  // namespace sluice::hierarchy_mock_test
