// Scalars where levels meet, and behind the boundary.
#include "ice/levels/scalar_transfer.hpp"

#include <gtest/gtest.h>

#include "ice/test_support/scalars.hpp"
#include "ice/test_support/transfer.hpp"

namespace sluice::ice::scalar_transfer_test {
namespace {

class ScalarLevels : public testing::TestWithParam<TransferCase> {
 protected:
  // The state of a gas with one scalar.
  struct State {
    BoxState gas;
    std::vector<double> values;
    StateViews views;

    State(const IndexBox& box, const TransferCase& c)
        : gas(box, c), values(box.volume(), 0.0), views(gas.views()) {
      views.push_back(views.front());
      views.back().data = values.data();
    }
    double& q(IntVec3 cell) { return views.back()(cell); }
  };

  static scalars::ScalarTransfer transfer(const TransferCase& c) {
    return {std::make_unique<IceTransfer>(c.components, false),
            {0},
            static_cast<std::size_t>(c.components) + 2};
  }
  void SetUp() override {
    fill_wildly(coarse_.gas, 7);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> value(0, 1);
    for_each_cell(coarse_.gas.box(), [&](IntVec3 cell) {
      coarse_.q(cell) = random() % 3 == 0 ? 0.0 : random() % 3 == 0 ? 1.0 : value(random);
    });
  }

  TransferCase case_ = GetParam();
  IndexBox cells_ = coarse_cells(case_, 6);
  IndexBox fine_cells_ = refine(cells_, case_.ratio);
  State coarse_{with_layer(cells_, case_), case_};
  State fine_{fine_cells_, case_};
};

TEST_P(ScalarLevels, KeepTheAmountAndTheBounds) {
  for (const int order : {0, 1, 2}) {
    transfer(case_).prolong(coarse_.views, fine_.views, fine_cells_, case_.geometry(), order);
    for_each_cell(cells_, [&](IntVec3 cell) {
      double amount = 0;
      for_each_cell(children_of(cell, case_), [&](IntVec3 child) {
        amount += fine_.gas.rho(child) * fine_.q(child);
        EXPECT_GE(fine_.q(child), 0.0);
        EXPECT_LE(fine_.q(child), 1.0);
      });
      amount /= static_cast<double>(children_of(cell, case_).volume());
      const double rho = coarse_.gas.rho(cell);
      EXPECT_NEAR(amount, rho * coarse_.q(cell), 1e-14 * rho);
    });
    State back(with_layer(cells_, case_), case_);
    transfer(case_).restrict_to(fine_.views, back.views, cells_, case_.geometry());
    for_each_cell(cells_, [&](IntVec3 cell) { EXPECT_NEAR(back.q(cell), coarse_.q(cell), 1e-14); });
  }
}

// Part of the children of a coarse cell are what they are among all of them.
TEST_P(ScalarLevels, DoNotDependOnWhichFineCellsAreWanted) {
  const scalars::ScalarTransfer t = transfer(case_);
  t.prolong(coarse_.views, fine_.views, fine_cells_, case_.geometry(), 2);
  State part(fine_cells_, case_);
  IndexBox some = fine_cells_;
  for (int d = 0; d < 3; ++d)
    if (case_.active[d]) {
      some.lower[d] += 1;
      some.upper[d] -= 3;
    }
  t.prolong(coarse_.views, part.views, some, case_.geometry(), 2);
  EXPECT_EQ(different(fine_.gas, part.gas, some), 0);
  for_each_cell(some, [&](IntVec3 cell) { EXPECT_EQ(fine_.q(cell), part.q(cell)); });
}

TEST_P(ScalarLevels, KeepUniformValuesToTheBit) {
  for_each_cell(coarse_.gas.box(), [&](IntVec3 cell) { coarse_.q(cell) = 0.3; });
  const scalars::ScalarTransfer t = transfer(case_);
  t.prolong(coarse_.views, fine_.views, fine_cells_, case_.geometry(), 1);
  for_each_cell(fine_cells_, [&](IntVec3 cell) { EXPECT_EQ(fine_.q(cell), 0.3); });
  State back(with_layer(cells_, case_), case_);
  t.restrict_to(fine_.views, back.views, cells_, case_.geometry());
  for_each_cell(cells_, [&](IntVec3 cell) { EXPECT_EQ(back.q(cell), 0.3); });
}

TEST_P(ScalarLevels, CorrectionsAddTheAmountThatPassed) {
  const scalars::ScalarTransfer t = transfer(case_);
  ASSERT_EQ(t.flux_quantities(), case_.components + 3);
  ConservedChange change;
  change.amount.resize(case_.components + 3);
  std::vector<double> wanted;
  for_each_cell(cells_, [&](IntVec3 cell) {
    change.cells.push_back(cell);
    const double rho = coarse_.gas.rho(cell);
    for (auto& amount : change.amount) amount.push_back(0.0);
    change.amount.front().back() = 0.125 * rho;
    change.amount.back().back() = 0.0625 * rho;
    wanted.push_back((coarse_.q(cell) + 0.0625) / 1.125);
  });
  std::vector<double> share(change.cells.size());
  t.correct(coarse_.views, change, share);
  for (std::size_t n = 0; n < change.cells.size(); ++n) {
    if (share[n] == 1.0) {
      EXPECT_NEAR(coarse_.q(change.cells[n]), wanted[n], 1e-15);
    }
  }
}

// Gases of one pressure, temperature and velocity, of any fractions: the fine cells have them too,
// mass times fraction is kept, and no fraction lies beyond those around.
TEST_P(ScalarLevels, KeepPressureAndTemperatureOfAMixture) {
  constexpr double R_A = 1, R_B = 7.25, cv_A = 2.5, cv_B = 10.9, u[3] = {0.5, -2, 3};
  const auto R = [&](double f) { return R_A + f * (R_B - R_A); };
  const auto cv = [&](double f) { return cv_A + f * (cv_B - cv_A); };
  for_each_cell(coarse_.gas.box(), [&](IntVec3 cell) {
    const double f = coarse_.q(cell), rho = 1 / R(f);
    coarse_.gas.fill(rho, u, rho * cv(f), cell);
  });
  const std::size_t view = case_.components + 2;
  const std::vector<std::size_t> by_volume{view};
  const scalars::ScalarTransfer t(
      std::make_unique<IceTransfer>(case_.components, false, true, Fluid{}, by_volume), {0}, view,
      by_volume);
  for (const int order : {1, 2}) {
    t.prolong(coarse_.views, fine_.views, fine_cells_, case_.geometry(), order);
    for_each_cell(cells_, [&](IntVec3 cell) {
      double amount = 0, low = coarse_.q(cell), high = low;
      for (int d = 0; d < 3; ++d)
        for (const int shift : {-1, 1}) {
          IntVec3 other = cell;
          other[d] += case_.active[d] ? shift : 0;
          low = std::min(low, coarse_.q(other));
          high = std::max(high, coarse_.q(other));
        }
      for_each_cell(children_of(cell, case_), [&](IntVec3 child) {
        const double f = fine_.q(child), rho = fine_.gas.rho(child);
        EXPECT_NEAR(rho * R(f), 1, 2e-14);
        EXPECT_NEAR(fine_.gas.energy(child) / (rho * cv(f)), 1, 2e-14);
        EXPECT_GE(f, low);
        EXPECT_LE(f, high);
        amount += rho * f;
      });
      amount /= static_cast<double>(children_of(cell, case_).volume());
      EXPECT_NEAR(amount, coarse_.gas.rho(cell) * coarse_.q(cell), 1e-15);
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Of, ScalarLevels, testing::ValuesIn(transfer_cases()));

TEST(ScalarGhosts, FollowTheConditionsOfTheDeck) {
  using scalars::GhostRule;
  models::TransportedScalar s;
  s.name = "f";
  const auto rule = [&](ConditionKind kind, const char* name, double value) {
    BoundaryRegion region;
    Condition c;
    c.kind = kind;
    c.kind_name = name;
    c.variable = "scalar-f";
    c.value = value;
    region.conditions.push_back(c);
    return scalars::make_rules(region, std::span(&s, 1)).front();
  };
  std::vector<double> values{0, 0.25, 0, 0};
  RealView q;
  q.data = values.data();
  q.box = {{0, 0, 0}, {4, 1, 1}};
  const auto filled = [&](const GhostRule& r, bool mirrored) {
    scalars::fill(r, q, true, {2, 0, 0}, {1, 0, 0}, mirrored, 0.5);
    return values[2];
  };
  const GhostRule fixed = rule(ConditionKind::dirichlet, "Dirichlet", 1.0);
  EXPECT_EQ(filled(fixed, false), 1.0);
  EXPECT_EQ(filled(fixed, true), 1.75);
  EXPECT_EQ(filled(rule(ConditionKind::neumann, "Neumann", 0), false), 0.25);
  EXPECT_EQ(filled(rule(ConditionKind::neumann, "Neumann", 3), false), 0.25 - 1.5);
  EXPECT_EQ(filled(rule(ConditionKind::open_face, "LODI", 0), false), 0.25);
  EXPECT_EQ(filled(rule(ConditionKind::symmetry, "symmetry", 0), true), 0.25);
  EXPECT_THROW(rule(ConditionKind::other, "Sine", 0), InputError);
  scalars::fill(fixed, q, false, {3, 0, 0}, {1, 0, 0}, false, 0.5);
  EXPECT_EQ(values[3], 0.0);  // no mass, no scalar
}

}  // namespace
}  // namespace sluice::ice::scalar_transfer_test
