// Criteria of refinement on a gas: gradients of any cell variable, estimated errors.
#include "ice/outputs/criteria.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ice/fluid/labels.hpp"
#include "ice/test_support/classic.hpp"

namespace sluice::ice::criteria_test {
namespace {

// A periodic box of waves that are no function of one direction alone.
GasBox waves(int axes) {
  GasBox box;
  box.cells = {12, axes > 1 ? 10 : 1, axes > 2 ? 8 : 1};
  const std::string y = axes > 1 ? "+0.3*cos(2*pi*y)" : "", z = axes > 2 ? "+sin(2*pi*z)/4" : "";
  box.density = "2+sin(2*pi*x)" + y + z;
  box.pressure = "1+0.5*cos(4*pi*x)" + y + z;
  box.velocity[0] = "sin(4*pi*x)" + y + z;
  if (axes > 1) box.velocity[1] = "0.7*cos(2*pi*x)" + y;
  return box;
}

class Criteria : public testing::Test {
 protected:
  // One threshold; errors of the same variable are estimated as well.
  void build(int axes, const std::string& label, double threshold) {
    Schema schema;
    add_framework_tags(schema);
    add_ice_tags(schema);
    deck_ = load_deck_text(deck_text(waves(axes)), "box.ups", {}, schema);
    std::vector<Fault> faults = deck_.faults;
    scene_ = read_scene(deck_, SceneOptions{}, faults);
    IceScene gas = read_ice_scene(deck_, scene_, faults);
    for (const Fault& f : faults) ASSERT_NE(f.severity, Severity::error) << to_string(f);
    gas.criteria = {{label, threshold, 0}};
    scene_.refinement.errors = {{label, 0, 0.1, {}}};
    solver_.reset();
    ice_ = std::make_unique<Ice>(scene_, std::move(gas));
    ASSERT_EQ(ice_->levels().error_estimates().size(), 1u);
    const ErrorEstimate e = ice_->levels().error_estimates().front();
    solver_ = std::make_unique<LevelSolver>(*ice_, level(), world(), SolverOptions{});
    ice_->state().initialise(solver_->state());
    solver_->fill_ghosts(0);
    solver_->compute_diagnostics(0, {ice_->levels().refine_flag(), e.value, e.estimate});
  }
  const Level& level() const { return scene_.grid.levels.front(); }
  double value(Label label, IntVec3 cell, int component = 0) const {
    const Warehouse& outputs = solver_->outputs();
    const IntVec3 n = level().domain.size();
    for (int d = 0; d < 3; ++d) cell[d] = (cell[d] + n[d]) % n[d];
    return outputs.view(outputs.find(label, 0), component, 0)(cell);
  }
  static IntVec3 step(int d) {
    IntVec3 s{};
    s[d] = 1;
    return s;
  }
  double gradient(Label q, IntVec3 cell) const {
    double sum = 0;
    for (int c = 0; c < component_count(q.info().type); ++c)
      for (int d = 0; d < 3; ++d) {
        if (!level().active[d]) continue;
        const double slope =
            (value(q, cell + step(d), c) - value(q, cell - step(d), c)) / (2 * level().spacing[d]);
        sum += slope * slope;
      }
    return std::sqrt(sum);
  }
  double error(Label q, IntVec3 cell) const {
    double largest = 0;
    for (int c = 0; c < component_count(q.info().type); ++c) {
      double sum = 0;
      for (int d = 0; d < 3; ++d)
        sum += std::fabs(value(q, cell + step(d), c) + value(q, cell - step(d), c) -
                         2 * value(q, cell, c)) /
               4;
      largest = std::max(largest, sum);
    }
    return largest;
  }
  double mean_gradient(Label q) const {
    double sum = 0;
    for_each_cell(level().domain, [&](IntVec3 cell) { sum += gradient(q, cell); });
    return sum / static_cast<double>(level().domain.volume());
  }

  Deck deck_;
  Scene scene_;
  std::unique_ptr<Ice> ice_;
  std::unique_ptr<LevelSolver> solver_;
};

TEST_F(Criteria, GradientsOfAnyCellVariableFlagWhatIsAboveTheThreshold) {
  for (int axes = 1; axes <= 3; ++axes)
    for (const char* name :
         {"rho_CC", "press_CC", "temp_CC", "vel_CC", "mach", "mag_grad_rho_CC"}) {
      SCOPED_TRACE(std::string(name) + " on axes " + std::to_string(axes));
      build(axes, name, 1);
      const Label q = *find_label(name);
      const double threshold = mean_gradient(q);
      build(axes, name, threshold);
      int flagged = 0;
      for_each_cell(level().domain, [&](IntVec3 cell) {
        const double flag = value(ice_->levels().refine_flag(), cell);
        EXPECT_EQ(flag, gradient(q, cell) > threshold ? 1 : 0);
        flagged += flag != 0;
      });
      EXPECT_GT(flagged, 0);
      EXPECT_LT(flagged, level().domain.volume());
    }
}

TEST_F(Criteria, ErrorsAreWhatFullWeightingChanges) {
  for (int axes = 1; axes <= 3; ++axes)
    for (const char* name : {"rho_CC", "vel_CC", "mach"}) {
      SCOPED_TRACE(std::string(name) + " on axes " + std::to_string(axes));
      build(axes, name, 1);
      const ErrorEstimate e = ice_->levels().error_estimates().front();
      for_each_cell(level().domain, [&](IntVec3 cell) {
        EXPECT_NEAR(value(e.estimate, cell), error(e.value, cell), 1e-15);
        EXPECT_GE(value(e.estimate, cell), 0);
      });
    }
}

// Of order dx^2 where the flow is smooth: a level finer, a quarter of the estimate.
TEST_F(Criteria, TheEstimateOfASineIsItsSecondDifference) {
  build(1, "rho_CC", 1);
  const ErrorEstimate e = ice_->levels().error_estimates().front();
  const double angle = 2 * M_PI / 12;
  for_each_cell(level().domain, [&](IntVec3 cell) {
    const double centre = std::sin((cell.x + 0.5) * angle);
    EXPECT_NEAR(value(e.estimate, cell), std::fabs(centre) * (1 - std::cos(angle)) / 2, 1e-3);
  });
}

TEST(WantedEstimates, AreOneForEachVariableWithTheSmallestTolerance) {
  const auto wanted =
      wanted_estimates({{"rho_CC", 0, 0.1, {}}, {"press_CC", 0, 0.2, {}}, {"rho_CC", 0, 0.05, {}}});
  ASSERT_EQ(wanted.size(), 2u);
  EXPECT_EQ(wanted[0].value, labels().rho);
  EXPECT_EQ(wanted[0].tolerance, 0.05);
  EXPECT_EQ(wanted[1].tolerance, 0.2);
}

// Decks are checked by the list in fluid/labels.hpp, which knows nothing of tasks.
TEST(StateFunctions, AreThoseThatTasksCompute) {
  SchemeOptions one;
  one.materials.fluids.push_back(one.materials.fluid);
  TaskList list;
  std::vector<std::string> computed, listed;
  for (const DiagnosticQuantity& q : declare_quantities(list, one))
    computed.push_back(q.label.name());
  for (const Label label : state_functions()) listed.push_back(label.name());
  EXPECT_THAT(listed, testing::UnorderedElementsAreArray(computed));
}

}  // namespace
}  // namespace sluice::ice::criteria_test
