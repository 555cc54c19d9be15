// Two materials that are carried along x, each with a graph of its own where it is alone, and the
// same in plain loops over whole fields, for the tests of kinds of blocks.
//
//   mass of each material, its share of the cell, one momentum; a face label of each material and a
//   cell label of both
// Fronts stay compact: what enters an empty cell and what remains behind is cut below a threshold.
// Uniform states stay.
#pragma once
#include <algorithm>
#include <vector>

#include "framework/run/test_support/all_facets.hpp"
#include "framework/scene/scene.hpp"

namespace sluice::kinds_test {

struct KindsLabels {
  Label mass = declare_label({"kinds.mass", ValueType::real, Centring::cell, "kg/m^3", "state"});
  Label share = declare_label({"kinds.share", ValueType::real, Centring::cell, "1", "state"});
  Label momentum =
      declare_label({"kinds.momentum", ValueType::real, Centring::cell, "kg/(m^2 s)", "state"});
  Label mask = declare_label({"kinds.mask", ValueType::real, Centring::cell, "1", "mask"});
  Label flux = declare_label({"kinds_flux", ValueType::real, Centring::x_face, "1", "mass flux"});
  Label share_of_second =
      declare_label({"kinds_second", ValueType::real, Centring::cell, "1", "share of the second"});
};
inline const KindsLabels& kinds_labels() {
  static const KindsLabels labels;
  return labels;
}

constexpr double least = 0.01;    // a smaller mass is none
constexpr double entering = 0.1;  // a smaller flux does not enter an empty cell

// Rules for one face and one cell, for graphs and plain loops alike.
inline double flux_of(double low, double high, double courant) {
  const double flux = courant * low;
  return high == 0 && flux < entering ? 0 : flux;
}
inline double mass_of(double before, double in, double out) {
  const double after = before + (in - out);
  return after < least ? 0 : after;
}
inline double momentum_of(double before, double mass_before, double mass) {
  return before + 0.125 * (mass - mass_before);
}

class KindsMock final : public run_test::AllFacets {
 public:
  using Start = std::function<double(int material, IntVec3 cell)>;
  double most = 1e300;       // a larger mass is a fault, except where masked
  mutable int declared = 0;  // graphs

  KindsMock(const Level& level, Start start)
      : AllFacets(1, 2), level_(&level), start_(std::move(start)) {
    effects_.add({"flow", true, "always", {}});
    effects_.add({"mixing", true, "two materials", {}});
  }

  std::string name() const override { return "kinds"; }
  const EffectList& effects() const override { return effects_; }
  int material_count() const override { return 2; }
  std::vector<SlotInfo> slots() const override {
    const KindsLabels& l = kinds_labels();
    return {{l.mass, 0, 1, 2},
            {l.share, 0, 1, 2},
            {l.mass, 1, 1, 2},
            {l.share, 1, 1, 2},
            {l.momentum, 0, 2, 2}};
  }
  std::vector<std::vector<Label>> checkpoint_labels() const override { return {}; }
  Label mask_label() const override { return kinds_labels().mask; }
  Label refine_flag() const override { return {}; }
  bool skipping_allowed() const override { return true; }
  double courant_number() const override { return 0.5; }

  int kinds() const override { return 3; }
  int kind_of(const Warehouse& old, int box, const IndexBox& cells) const override {
    const bool first = old.any_nonzero(old.find(kinds_labels().mass, 0), 0, box, cells),
               second = old.any_nonzero(old.find(kinds_labels().mass, 1), 0, box, cells);
    return first == second ? 2 : second ? 1 : 0;
  }
  std::optional<double> absent_value(Label label, int material, int kind) const override {
    if (label == kinds_labels().share) return material == kind ? 1.0 : 0.0;
    return 0.0;
  }

  void initialise(Warehouse& state) const override;
  void fill_boundary(Warehouse& state, double, std::span<const double>,
                     const ThreadTeam&) const override;
  void declare(TaskList& list, const StepVariant& variant) const override;
  void declare_diagnostics(TaskList&, int) const override {}
  void measure_rates(const Warehouse&, Reductions&) const override {}
  StepLimit limit(const std::vector<double>&) const override { return {0.5, "kinds"}; }
  void add_totals(const Warehouse&, const LevelCoverage&, Totals&) const override {}
  StepBalance balance(const std::vector<double>&, const StepStart*, double) const override {
    return {};
  }
  double history_value(Label, const Totals&) const override { return 0; }
  Vec3 history_vector(Label, const Totals&) const override { return {}; }
  std::string describe_fault(int) const override { return "mass"; }

 private:
  void declare_flux(TaskList& list, int material, bool masked, VariableId flux) const;

  const Level* level_;
  Start start_;
  EffectList effects_;
};

inline void KindsMock::initialise(Warehouse& state) const {
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
    for_each_cell(state.local_boxes()[b].cells, [&](IntVec3 c) {
      const double mass[] = {start_(0, c), start_(1, c)};
      const auto set = [&](int slot, int component, double value) {
        double& there = state.view(slot, component, b)(c);
        if (there != value) there = value;
      };
      for (int m = 0; m < 2; ++m) {
        set(2 * m, 0, mass[m]);
        set(2 * m + 1, 0, mass[m] == 0 ? 0 : mass[m] / (mass[0] + mass[1]));
      }
      for (int component = 0; component < 2; ++component) set(4, component, 1 + component);
    });
}

inline void KindsMock::fill_boundary(Warehouse& state, double, std::span<const double>,
                                     const ThreadTeam&) const {
  for (int s = 0; s < 5; ++s)
    for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
      for (int component = 0; component < state.info(s).components; ++component) {
        const RealView v = state.view(s, component, b);
        const IndexBox& domain = level_->domain;
        const IndexBox inside = intersection(v.box, domain);
        for (int k = v.box.lower.z; k < v.box.upper.z; ++k)
          for (int j = v.box.lower.y; j < v.box.upper.y; ++j)
            for (int i = v.box.lower.x; i < v.box.upper.x; ++i) {
              const IntVec3 c{i, j, k};
              if (inside.contains(c)) {
                i = inside.upper.x - 1;  // on to the high side
                continue;
              }
              const IntVec3 from = max(min(c, domain.upper - IntVec3::all(1)), domain.lower);
              if (v.box.contains(from) && v(c) != v(from)) v(c) = v(from);
            }
      }
}

inline void KindsMock::declare_flux(TaskList& list, int material, bool masked,
                                    VariableId flux) const {
  TaskBuilder faces = list.task("faces of " + std::to_string(material), 0);
  const In q =
      faces.read(list.old_state(kinds_labels().mass, material, 1), Stencil::along(0, 1, 0));
  In mask;
  if (masked) mask = faces.read(list.old_state(kinds_labels().mask, 0, 1), Stencil::along(0, 1, 0));
  const Out f = faces.write(flux);
  faces.kernel([=](const Row& row) {
    for (int i = 0; i < row.count(); ++i) {
      const double courant =
          masked ? row.step().dt * row(mask, 0, 0, -1)[i] * row(mask)[i] : row.step().dt;
      row(f)[i] = flux_of(row(q, 0, 0, -1)[i], row(q)[i], courant);
    }
  });
  TaskBuilder store = list.task("store flux of " + std::to_string(material), 0);
  const In from = store.read(flux);
  const Out to = store.write(list.output(kinds_labels().flux, material));
  store.kernel([=](const Row& row) { std::copy_n(row(from), row.count(), row(to)); });
}

inline void KindsMock::declare(TaskList& list, const StepVariant& variant) const {
  ++declared;
  const KindsLabels& l = kinds_labels();
  const bool mixed = variant.kind == 2, masked = variant.masked;
  std::vector<int> present;
  for (int m = 0; m < 2; ++m)
    if (mixed || variant.kind == m) present.push_back(m);
  VariableId flux[2];
  for (const int m : present) {
    flux[m] = list.temporary("flux of " + std::to_string(m), 1, 0);
    declare_flux(list, m, masked, flux[m]);
  }
  TaskBuilder update = list.task("update", mixed ? 1 : 0);
  In old[2], f[2], mask;
  Out now[2], share[2];
  for (const int m : present) {
    old[m] = update.read(list.old_state(l.mass, m, 1));
    f[m] = update.read(flux[m], Stencil::along(0, 0, 1));
    now[m] = update.write(list.new_state(l.mass, m, 1));
    if (mixed) share[m] = update.write(list.new_state(l.share, m, 1));
  }
  if (masked) mask = update.read(list.old_state(l.mask, 0, 1));
  const In momentum = update.read(list.old_state(l.momentum, 0, 2));
  const Out momentum_now = update.write(list.new_state(l.momentum, 0, 2));
  const double limit = most;
  const IndexBox domain = level_->domain;
  update.kernel([=](const Row& row) {
    for (int i = 0; i < row.count(); ++i) {
      double mass[2] = {0, 0}, before[2] = {0, 0};
      for (const int m : present) {
        before[m] = row(old[m])[i];
        mass[m] = mass_of(row(old[m])[i], row(f[m])[i], row(f[m], 0, 0, 1)[i]);
        row(now[m])[i] = mass[m];
        IntVec3 cell = row.cell();
        cell.x += i;
        if (cell.x == domain.lower.x) row.reductions().sum(m).add(row(f[m])[i]);
        if (cell.x == domain.upper.x - 1) row.reductions().sum(m).add(-row(f[m], 0, 0, 1)[i]);
        if (mass[m] > limit && !(masked && row(mask)[i] == 0))
          row.reductions().fault({cell, 0, m, 0, mass[m]});
      }
      if (mixed)
        for (const int m : present)
          row(share[m])[i] = mass[m] == 0 ? 0 : mass[m] / (mass[0] + mass[1]);
      for (int c = 0; c < 2; ++c)
        row(momentum_now, c)[i] =
            momentum_of(row(momentum, c)[i], before[0] + before[1], mass[0] + mass[1]);
      row.reductions().maximum(0, ordered_bits(mass[0] + mass[1]));
    }
  });
  if (variant.kind == 0) return;  // has no second
  TaskBuilder second = list.task("share of the second", 0);
  const In of = second.read(list.old_state(l.share, 1, 1));
  const Out to = second.write(list.output(l.share_of_second, 1));
  second.kernel([=](const Row& row) { std::copy_n(row(of), row.count(), row(to)); });
}

}  // namespace sluice::kinds_test
