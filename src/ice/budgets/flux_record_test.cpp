// What a step records at faces and sums over uncovered cells closes the books of a part of a level.
#include <gtest/gtest.h>

#include "framework/grid/box_list.hpp"
#include "framework/refine/coverage.hpp"
#include "framework/refine/face_table.hpp"
#include "framework/task/sweep_executor.hpp"
#include "ice/test_support/classic.hpp"

namespace sluice::ice::flux_record_test {
namespace {

// A gas that moves everywhere, across open sides and under gravity.
GasBox moving_gas(const std::string& scheme) {
  GasBox box;
  box.cells = {24, 20, 1};
  box.periodic = false;
  box.density = "1+0.4*sin(5*x)*cos(4*y)";
  box.pressure = "1+0.3*cos(6*x+2*y)";
  box.velocity[0] = "0.3+0.2*sin(6*y)";
  box.velocity[1] = "-0.2+0.3*cos(5*x)";
  box.viscosity = 0.01;
  box.gravity = "[0.2,-0.5,0]";
  box.scheme = scheme;
  return box;
}

// One step of a level of which `covered` lies under a finer one.
class RecordedStep {
 public:
  RecordedStep(const GasBox& box, const IndexBox& covered) : gas_(box), covered_(covered) {
    Level finer = gas_.level();
    finer.index = 1;
    finer.ratio = {2, 2, 1};
    finer.boxes = {{refine(covered, finer.ratio), 0, 0}};
    coverage_ = LevelCoverage(gas_.level(), &finer, 0);
    axes_ = active_axes(gas_.level());
    as_coarse_ = around_covered();
    as_fine_ = around_covered();
    recorder_ = {&as_coarse_, &as_fine_};
  }

  double run(double dt) {
    TaskList list;
    gas_.ice().step().declare(list, StepVariant{0, false, &recorder_, &coverage_});
    std::vector<VariableId> wanted;
    for (std::size_t n = 0; n < list.variables().size(); ++n)
      if (list.variables()[n].storage == Storage::new_state)
        wanted.push_back({static_cast<int>(n)});
    SweepOptions options;
    options.block = {7, 6, 1};
    options.maxima = gas_.ice().step().reductions().maxima();
    options.sums = StepSlots::sums_with_gravity;
    gas_.solver().fill_ghosts(0);
    next_ = std::make_unique<Warehouse>(gas_.level(), 0);
    for (const SlotInfo& slot : gas_.ice().state().slots()) next_->add(slot);
    SweepExecutor sweep(list, compile(list, gas_.ice().effects(), wanted, axes_), gas_.level(),
                        options);
    sweep.bind(gas_.solver().state(), *next_, nullptr);
    const Reductions& sums = sweep.run({0, dt, gas_.level().spacing, 0});
    EXPECT_EQ(sums.fault_count(), 0);
    for (int s = 0; s < sums.sum_count(); ++s) sums_.push_back(sums.sum(s).value());
    return dt;
  }

  // Quantities: mass, momentum x, momentum y, total energy.
  double gain_of_uncovered(int quantity) {
    double gain = 0;
    for_each_cell(gas_.domain(), [&](IntVec3 cell) {
      if (!covered_.contains(cell))
        gain += value(*next_, quantity, cell) - value(gas_.solver().state(), quantity, cell);
    });
    return gain * gas_.level().cell_volume();
  }
  double flow_into_covered(int quantity) const {
    double flow = 0;
    for (const Part& p : parts_)
      for (std::ptrdiff_t n = p.first; n < p.first + p.count; ++n) {
        EXPECT_EQ(as_coarse_.values(quantity)[n], as_fine_.values(quantity)[n]);
        flow += (p.high ? -1 : 1) * as_coarse_.values(quantity)[n];
      }
    return flow * gas_.level().cell_volume();
  }
  const std::vector<double>& sums() const { return sums_; }
  const FaceTable& table() const { return as_coarse_; }
  const Stepper& gas() const { return gas_; }

 private:
  struct Part {
    std::ptrdiff_t first, count;
    bool high;
  };

  // The faces of the covered cells that do not lie on the side of the domain.
  FaceTable around_covered() {
    FaceTable table(gas_.level().boxes, axes_, 4);
    parts_.clear();
    for (int axis = 0; axis < axes_.count; ++axis)
      for (const bool high : {false, true}) {
        const int d = axes_.direction[axis];
        IndexBox layer = covered_;
        (high ? layer.lower : layer.upper)[d] =
            high ? covered_.upper[d] - 1 : covered_.lower[d] + 1;
        const bool at_side = high ? layer.upper[d] == gas_.domain().upper[d]
                                  : layer.lower[d] == gas_.domain().lower[d];
        if (!at_side) parts_.push_back({table.add(0, axis, high, layer), layer.volume(), high});
      }
    table.seal();
    return table;
  }
  static double value(const Warehouse& state, int quantity, IntVec3 cell) {
    const auto of = [&](Label label, int c) {
      return state.view(state.find(label, 0), c, 0)(cell);
    };
    if (quantity == 0) return of(labels().mass, 0);
    const double mx = of(labels().momentum, 0), my = of(labels().momentum, 1);
    if (quantity < 3) return quantity == 1 ? mx : my;
    return of(labels().energy, 0) + 0.5 * (mx * mx + my * my) / of(labels().mass, 0);
  }

  Stepper gas_;
  IndexBox covered_;
  Axes axes_;
  LevelCoverage coverage_;
  FaceTable as_coarse_, as_fine_;
  FluxRecorder recorder_;
  std::vector<Part> parts_;
  std::unique_ptr<Warehouse> next_;
  std::vector<double> sums_;
};

// A strong shock whose rows move against each other crosses the border of levels.
GasBox sheared_shock() {
  GasBox box;
  box.cells = {24, 20, 1};
  box.periodic = false;
  box.density = "1+0.2*sin(60*y)";
  box.pressure = "(x<0.35) ? 100 : 1";
  box.velocity[0] = "3*cos(60*y)";
  box.velocity[1] = "0.5";
  box.scheme = "conservative";
  return box;
}

class FluxRecord : public testing::TestWithParam<const char*> {};

// Gain of the uncovered cells = through the boundary + by gravity - into the covered cells.
TEST_P(FluxRecord, ClosesTheBooksOfTheUncoveredCells) {
  const std::string scheme = GetParam();
  for (const IndexBox& covered :
       {IndexBox{{6, 4, 0}, {15, 11, 1}}, IndexBox{{0, 3, 0}, {9, 20, 1}}}) {
    RecordedStep step(moving_gas(scheme), covered);
    const double dt = step.run(0.004);
    const StepBalance b = step.gas().ice().budgets().balance(step.sums(), nullptr, dt);
    const double boundary[] = {b.mass[0], b.momentum.x, b.momentum.y, b.energy};
    const double forces[] = {0, b.momentum_of_forces.x, b.momentum_of_forces.y, b.energy_of_forces};
    const bool total_energy = scheme == "conservative";
    for (int q = 0; q < (total_energy ? 4 : 3); ++q) {
      const double into = step.flow_into_covered(q);
      EXPECT_GT(std::fabs(into), 1e-6) << q;
      EXPECT_NEAR(step.gain_of_uncovered(q), boundary[q] + forces[q] - into, 1e-15) << q;
    }
    EXPECT_GT(std::fabs(b.momentum_of_forces.x), 1e-6);
    EXPECT_GT(std::fabs(b.energy_of_forces), 1e-6);
  }
}

TEST(FluxRecord, HoldsTheShearAlongShocks) {
  RecordedStep step(sheared_shock(), {{6, 4, 0}, {15, 11, 1}});
  const double dt = step.run(0.0005);
  const StepBalance b = step.gas().ice().budgets().balance(step.sums(), nullptr, dt);
  const double boundary[] = {b.mass[0], b.momentum.x, b.momentum.y, b.energy};
  for (int q = 0; q < 4; ++q)
    EXPECT_NEAR(step.gain_of_uncovered(q), boundary[q] - step.flow_into_covered(q), 1e-14) << q;
}

INSTANTIATE_TEST_SUITE_P(Ice, FluxRecord, testing::Values("conservative", "classic"));

TEST(FluxRecord, OfTheClassicFormHoldsTheInternalEnergyThatFlows) {
  GasBox box;
  box.cells = {16, 16, 1};
  box.velocity[0] = "2";
  box.scheme = "classic";
  RecordedStep step(box, {{4, 4, 0}, {12, 12, 1}});
  const double dt = step.run(0.005);
  const double flow = 2 * dt * 16;  // in cells
  const double* energy = step.table().values(3);
  EXPECT_DOUBLE_EQ(step.table().values(0)[0], flow);
  EXPECT_DOUBLE_EQ(energy[0], flow / 0.4);
}

}  // namespace
}  // namespace sluice::ice::flux_record_test
