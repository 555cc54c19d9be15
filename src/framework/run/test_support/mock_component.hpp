// A component small enough to know by heart, for the tests of the run loop: upwind advection of one
// quantity along x with speed 1, faults where a step is too long, inflow booked exactly.
#pragma once
#include <cmath>
#include <vector>

#include "framework/run/test_support/all_facets.hpp"
#include "framework/scene/scene.hpp"

namespace sluice::run_test {

struct MockLabels {
  Label q = declare_label({"mock.q", ValueType::real, Centring::cell, "kg/m^3", "state"});
  Label mask = declare_label({"mock.mask", ValueType::real, Centring::cell, "1", "mask"});
  Label flux = declare_label({"mock_flux", ValueType::real, Centring::x_face, "kg/(m^2 s)", "q u"});
  Label square = declare_label({"mock_square", ValueType::real, Centring::cell, "1", "q^2"});
  Label total = declare_label({"MockTotal", ValueType::real, Centring::reduction, "kg", "sum q V"});
};
inline const MockLabels& mock_labels() {
  static const MockLabels labels;
  return labels;
}

class MockComponent : public AllFacets {
 public:
  double greed = 0.5;          // the step as a share of dx: above 1 a step must be redone
  double most = 1e300;         // a larger q is a fault, except where slopes are masked
  double fails_after = 1e300;  // from this time on every step is a fault

  MockComponent(const Level& level) : AllFacets(1, 1), level_(&level) {
    effects_.add({"flow", true, "always", {}});
    effects_.add({"diagnostics", true, "saved", {}});
  }

  std::string name() const override { return "mock"; }
  const EffectList& effects() const override { return effects_; }
  int material_count() const override { return 1; }
  std::vector<SlotInfo> slots() const override { return {{mock_labels().q, 0, 1, 1}}; }
  std::vector<std::vector<Label>> checkpoint_labels() const override { return {{mock_labels().q}}; }
  Label mask_label() const override { return mock_labels().mask; }
  Label refine_flag() const override { return mock_labels().square; }
  bool skipping_allowed() const override { return true; }
  double courant_number() const override { return greed; }

  static double start(int i) { return 1 + 0.125 * ((i * 5) % 7); }
  void initialise(Warehouse& state) const override {
    for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
      for_each_cell(state.local_boxes()[b].cells,
                    [&](IntVec3 c) { state.view(0, 0, b)(c) = start(c.x); });
  }
  void fill_boundary(Warehouse& state, double, std::span<const double>,
                     const ThreadTeam&) const override {
    for (int s = 0; s < state.slot_count(); ++s)
      for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
        const RealView v = state.view(s, 0, b);
        for_each_cell(v.box, [&](IntVec3 c) {
          if (level_->domain.contains(c)) return;
          IntVec3 inside =
              max(min(c, level_->domain.upper - IntVec3::all(1)), level_->domain.lower);
          if (v.box.contains(inside)) v(c) = v(inside);
        });
      }
  }

  void declare(TaskList& list, const StepVariant& variant) const override {
    const bool masked = variant.masked;
    const MockLabels& l = mock_labels();
    const VariableId q = list.old_state(l.q, 0, 1), next = list.new_state(l.q, 0, 1);
    const VariableId flux = list.temporary("flux", 1, 0);
    TaskBuilder faces = list.task("faces", 0);
    const In qf = faces.read(q, Stencil::along(0, 1, 0));
    const Out f = faces.write(flux);
    faces.kernel([=](const Row& row) {
      for (int i = 0; i < row.count(); ++i) row(f)[i] = row(qf, 0, 0, -1)[i];
    });
    declare_update(list, q, next, flux, masked);
    TaskBuilder store = list.task("store flux", 0);
    const In from = store.read(flux);
    const Out to = store.write(list.output(l.flux, 0));
    store.kernel([=](const Row& row) {
      for (int i = 0; i < row.count(); ++i) row(to)[i] = row(from)[i];
    });
  }

  void declare_diagnostics(TaskList& list, int /*level*/) const override {
    TaskBuilder task = list.task("square", 1);
    const In q = task.read(list.old_state(mock_labels().q, 0, 1));
    const Out square = task.write(list.output(mock_labels().square, 0));
    task.kernel([=](const Row& row) {
      for (int i = 0; i < row.count(); ++i) row(square)[i] = row(q)[i] * row(q)[i];
    });
  }

  void measure_rates(const Warehouse&, Reductions& rates) const override {
    rates.maximum(0, ordered_bits(1 / level_->spacing.x));
  }
  StepLimit limit(const std::vector<double>& maxima) const override {
    return {greed / maxima[0], "mock: greed dx"};
  }
  void add_totals(const Warehouse& state, const LevelCoverage& /*coverage*/,
                  Totals& totals) const override {
    totals.mass.resize(1);
    for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
      for_each_cell(state.local_boxes()[b].cells, [&](IntVec3 c) {
        totals.mass[0].add(state.view(0, 0, b)(c) * level_->cell_volume());
      });
  }
  StepBalance balance(const std::vector<double>& sums, const StepStart*, double) const override {
    StepBalance b;
    b.mass = sums;
    return b;
  }
  double history_value(Label, const Totals& t) const override { return t.mass[0].sum.value(); }
  Vec3 history_vector(Label, const Totals&) const override { return {}; }
  std::string describe_fault(int) const override { return "courant number (must be at most 1)"; }

 private:
  void declare_update(TaskList& list, VariableId q, VariableId next, VariableId flux,
                      bool masked) const {
    TaskBuilder update = list.task("update", 0);
    const In old = update.read(q), f = update.read(flux, Stencil::along(0, 0, 1));
    In mask;
    if (masked) mask = update.read(list.old_state(mock_labels().mask, 0, 1));
    const Out now = update.write(next);
    const Level* level = level_;
    const double limit = most, end = fails_after;
    update.kernel([=](const Row& row) {
      const double courant = row.step().dt / row.step().spacing.x;
      for (int i = 0; i < row.count(); ++i) {
        row(now)[i] = row(old)[i] + courant * (row(f)[i] - row(f, 0, 0, 1)[i]);
        IntVec3 cell = row.cell();
        cell.x += i;
        const bool excused = masked && row(mask)[i] == 0;
        if (!(courant <= 1) || row.step().time >= end || std::isnan(row(now)[i]) ||
            (row(now)[i] > limit && !excused))
          row.reductions().fault({cell, 0, 0, 0, courant});
        const double volume = level->cell_volume();
        if (cell.x == level->domain.lower.x)
          row.reductions().sum(0).add(courant * volume * row(f)[i]);
        if (cell.x == level->domain.upper.x - 1)
          row.reductions().sum(0).add(-courant * volume * row(f, 0, 0, 1)[i]);
      }
      row.reductions().maximum(0, ordered_bits(1 / row.step().spacing.x));
    });
  }

  const Level* level_;
  EffectList effects_;
};

// A tube of 40 cells of length 1/8, cut into boxes.
inline Scene tube(int boxes = 1) {
  Scene scene;
  Level level;
  level.spacing = {0.125, 1, 1};
  level.domain = {{0, 0, 0}, {40, 1, 1}};
  level.active = {true, false, false};
  for (const IndexBox& b : split(level.domain, {boxes, 1, 1}))
    level.boxes.push_back({b, 0, static_cast<int>(level.boxes.size())});
  scene.grid.levels.push_back(level);
  scene.time.max_time = 1;
  scene.time.end_at_max_time_exactly = true;
  return scene;
}

}  // namespace sluice::run_test
