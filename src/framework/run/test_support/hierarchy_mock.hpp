// A component with two materials and a scalar on levels, for the tests of the hierarchy.
//
//   a  flows with limited slopes (two ghost layers), gains `source` everywhere
//   b  flows with first-order faces (one ghost layer); may be absent from most of the domain
//   s  is carried by a and diffuses
// What a test wants of it is in Wishes, which may change while the mock runs; what was done is
// logged.
#pragma once
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "framework/grid/box_list.hpp"
#include "framework/refine/face_table.hpp"
#include "framework/run/test_support/all_facets.hpp"
#include "framework/scene/scene.hpp"

namespace sluice::hierarchy_test {

constexpr int quantities = 3;
using Values = std::array<double, quantities>;  // a, b, s
// Where they are in the state, which begins with the slot of fewest ghost layers.
constexpr std::size_t place[quantities] = {1, 0, 2};

struct MockLabels {
  Label a = declare_label({"levels.a", ValueType::real, Centring::cell, "kg/m^3", "first"});
  Label b = declare_label({"levels.b", ValueType::real, Centring::cell, "kg/m^3", "second"});
  Label s = declare_label({"levels.s", ValueType::real, Centring::cell, "kg/m^3", "scalar"});
  Label mask = declare_label({"levels.mask", ValueType::real, Centring::cell, "1", "mask"});
  Label flag = declare_label({"levels.flag", ValueType::real, Centring::cell, "1", "refine"});
  Label stamp = declare_label({"levels_stamp", ValueType::real, Centring::cell, "s", "start"});
  Label total = declare_label({"LevelsTotal", ValueType::real, Centring::reduction, "kg", "a"});
};
inline const MockLabels& mock_labels() {
  static const MockLabels labels;
  return labels;
}

struct Sweeping {  // one cell of one sweep
  int level = 0;
  double time = 0, dt = 0;
  IntVec3 cell{};
  bool masked = false;
};

struct Wishes {
  Vec3 velocity_a{}, velocity_b{};
  double source = 0;     // of a, kg/(m^3 s)
  double diffusion = 0;  // of s, m^2/s
  double cfl = 0.25;
  std::function<Values(Vec3)> start = [](Vec3) { return Values{1, 1, 1}; };
  std::function<Values(Vec3, double)> outside = [](Vec3, double) { return Values{1, 1, 1}; };
  std::function<bool(Vec3, double)> flagged;          // at the centre of a cell, at a time
  std::function<bool(const Sweeping&)> inadmissible;  // new value of a cell
  std::function<double(int level)> rate;              // in place of the Courant rate
  std::function<Schedule(LevelSolver&)> before;       // nodes before the ghost cells
  std::function<void(IntVec3 cell)> labour;           // once a row
  bool kinds = false;                                 // blocks without b have a graph without it
};

// A sweep or a boundary fill of one level.
struct Call {
  int level = 0;
  double time = 0, dt = 0;
  bool masked = false;
  friend bool operator==(const Call&, const Call&) = default;
};

inline double minmod(double a, double b) {
  if (a * b <= 0) return 0;
  return std::fabs(a) < std::fabs(b) ? a : b;
}

// Conserved amounts as they are: limited linear, mean, the largest share that leaves no deficit.
class MockTransfer final : public TransferOperators {
 public:
  void prolong(const StateViews& coarse, const StateViews& fine, const IndexBox& cells,
               const TransferGeometry& g, int order) const override {
    for (std::size_t q = 0; q < fine.size(); ++q)
      for_each_cell(cells, [&](IntVec3 c) {
        const IntVec3 below = coarsen(c, g.ratio);
        double value = coarse[q](below);
        for (int d = 0; d < 3 && order > 0; ++d) {
          if (!g.active[d]) continue;
          IntVec3 step{};
          step[d] = 1;
          const double slope = minmod(coarse[q](below) - coarse[q](below - step),
                                      coarse[q](below + step) - coarse[q](below));
          value +=
              slope * (2 * (c[d] - below[d] * g.ratio[d]) + 1 - g.ratio[d]) / (2.0 * g.ratio[d]);
        }
        fine[q](c) = value;
      });
  }
  void restrict_to(const StateViews& fine, const StateViews& coarse, const IndexBox& coarse_cells,
                   const TransferGeometry& g) const override {
    for (std::size_t q = 0; q < fine.size(); ++q)
      for_each_cell(coarse_cells, [&](IntVec3 c) {
        double sum = 0;
        const IndexBox above = refine(IndexBox{c, c + IntVec3::all(1)}, g.ratio);
        for_each_cell(above, [&](IntVec3 f) { sum += fine[q](f); });
        coarse[q](c) = sum / static_cast<double>(above.volume());
      });
  }
  int flux_quantities() const override { return quantities; }
  void correct(const StateViews& state, const ConservedChange& change,
               std::span<double> share) const override {
    for (std::size_t n = 0; n < change.cells.size(); ++n) {
      const IntVec3 cell = change.cells[n];
      share[n] = 1;
      const auto bears = [&] {
        for (std::size_t q = 0; q < quantities; ++q)
          if (state[place[q]](cell) + share[n] * change.amount[q][n] < 0) return false;
        return true;
      };
      while (share[n] > 0 && !bears()) share[n] = share[n] > 0.125 ? share[n] / 2 : 0;
      for (std::size_t q = 0; q < quantities; ++q)
        state[place[q]](cell) += share[n] * change.amount[q][n];
    }
  }
};

class HierarchyMock final : public run_test::AllFacets {
 public:
  HierarchyMock(const Scene& scene, const Wishes& wishes)
      : AllFacets(1, 1), scene_(&scene), wishes_(&wishes) {
    effects_.add({"flow", true, "always", {}});
    effects_.add({"flags", true, "saved", {}});
  }
  mutable std::vector<Call> sweeps, boundary_fills;  // one thread only

  std::string name() const override { return "mock on levels"; }
  const EffectList& effects() const override { return effects_; }
  int material_count() const override { return quantities; }  // totals count s as one
  std::vector<SlotInfo> slots() const override {
    const MockLabels& l = mock_labels();
    return {{l.b, 1, 1, 1}, {l.a, 0, 1, 2}, {l.s, 0, 1, 2}};
  }
  std::vector<std::vector<Label>> checkpoint_labels() const override {
    return {{mock_labels().b}, {mock_labels().a}, {mock_labels().s}};
  }
  void initialise(Warehouse& state) const override;
  void fill_boundary(Warehouse& state, double time, std::span<const double> sums,
                     const ThreadTeam& team) const override;
  void declare(TaskList& list, const StepVariant& variant) const override;
  int kinds() const override { return wishes_->kinds ? 2 : 1; }
  int kind_of(const Warehouse& old, int box, const IndexBox& cells) const override {
    return old.any_nonzero(slots_of(old)[1], 0, box, cells) ? 1 : 0;
  }
  Schedule before_sweep(LevelSolver& level) const override {
    return wishes_->before ? wishes_->before(level) : Schedule{};
  }
  void declare_diagnostics(TaskList& list, int level) const override;
  const TransferOperators& transfer() const override { return transfer_; }
  Label refine_flag() const override { return mock_labels().flag; }
  Label mask_label() const override { return mock_labels().mask; }
  bool skipping_allowed() const override { return false; }
  double courant_number() const override { return 0; }  // flags are widened as the scene says
  void measure_rates(const Warehouse& state, Reductions& rates) const override;
  StepLimit limit(const std::vector<double>& maxima) const override {
    return {wishes_->cfl / maxima[0], "mock rate"};
  }
  // Masses of a, b and s.
  void add_totals(const Warehouse& state, const LevelCoverage& coverage,
                  Totals& totals) const override;
  StepBalance balance(const std::vector<double>& sums, const StepStart*, double) const override {
    return {{sums[0], 0, 0}, {}, {}, 0, 0};
  }
  double history_value(Label, const Totals& t) const override { return t.mass[0].sum.value(); }
  Vec3 history_vector(Label, const Totals&) const override { return {}; }
  std::string describe_fault(int) const override { return "mock value (none is allowed)"; }

  // Slots of a, b and s, in this order.
  static std::array<int, quantities> slots_of(const Warehouse& state) {
    const MockLabels& l = mock_labels();
    return {state.find(l.a, 0), state.find(l.b, 1), state.find(l.s, 0)};
  }

 private:
  struct Variables;
  double rate_on(int level) const;
  void declare_faces(TaskList& list, Variables& v, const StepVariant& variant, int axis) const;
  void declare_update(TaskList& list, const Variables& v, const StepVariant& variant) const;
  static void declare_record(TaskList& list, const Variables& v, const StepVariant& variant,
                             int axis);
  void log_sweep(const Row& row, bool masked) const;

  const Scene* scene_;
  const Wishes* wishes_;
  EffectList effects_;
  MockTransfer transfer_;
};

}  // namespace sluice::hierarchy_test
