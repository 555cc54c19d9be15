// Where levels meet, with velocities of their own: momentum of each material, total energy, traces.
#include "ice/test_support/mixture_levels.hpp"

namespace sluice::ice::slip_transfer_test {
namespace {

constexpr double round_off = 1e-14;
constexpr double fastest = 4;  // speed of the mixture and beside it
const std::vector<Fluid> fluids = three_fluids();

// Slips of each cell's materials that sum to zero.
void slip_apart(const MixtureState& state, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> speed(1 - fastest, fastest - 1);
  for_each_cell(state.box(), [&](IntVec3 cell) {
    for (std::size_t c = 0; c < state.layout().components; ++c) {
      double sum = 0;
      for (std::size_t m = 0; m < 3; ++m)
        sum += state.slip(m, c, cell) = state.mass(m, cell) * speed(random);
      for (std::size_t m = 0; m < 3; ++m) {
        const double M = state.mass(m, cell), rho = state.density(cell);
        state.slip(m, c, cell) = M == rho ? 0.0 : state.slip(m, c, cell) - M / rho * sum;
      }
    }
  });
}

// Sums over cells: masses, momentum of each material, total energy; and what they are measured by,
// momentum by the speeds of the cells.
struct Sums {
  std::vector<long double> value, size;
  void add(long double x, long double scale) {
    value.push_back(x);
    size.push_back(scale);
  }
};
Sums sums_of(const MixtureState& s, const IndexBox& cells) {
  Sums total;
  for_each_cell(cells, [&](IntVec3 cell) {
    Sums one;
    for (std::size_t m = 0; m < 3; ++m) {
      const long double M = s.mass(m, cell);
      one.add(M, M);
      for (std::size_t c = 0; c < s.layout().components; ++c)
        one.add(s.momentum(c, cell) * M / s.density(cell) + s.slip(m, c, cell), fastest * M);
    }
    one.add(s.total_energy(cell), s.total_energy(cell));
    if (total.value.empty()) total.value = total.size = std::vector<long double>(one.value.size());
    for (std::size_t n = 0; n < one.value.size(); ++n) {
      total.value[n] += one.value[n] / static_cast<long double>(cells.volume());
      total.size[n] += one.size[n] / static_cast<long double>(cells.volume());
    }
  });
  return total;
}
double distance(const Sums& a, const Sums& b) {
  long double worst = 0;
  for (std::size_t n = 0; n < a.value.size(); ++n)
    if (a.size[n] > 0) worst = std::max(worst, std::fabs(a.value[n] - b.value[n]) / a.size[n]);
  return static_cast<double>(worst);
}

class SlipLevels : public testing::TestWithParam<TransferCase> {};

TEST_P(SlipLevels, MeansKeepTheMomentumOfEachMaterialAndTheEnergy) {
  const TransferCase& c = GetParam();
  const MixtureTransfer transfer(fluids, c.components, true, true);
  const IndexBox parents = coarse_cells(c, 5);
  for (unsigned seed = 1; seed <= 3; ++seed) {
    MixtureState fine(refine(parents, c.ratio), c, 3, true), coarse(parents, c, 3, true);
    fill_with_mixtures(fine, fluids, seed);
    slip_apart(fine, seed);
    transfer.restrict_to(fine.views(), coarse.views(), parents, c.geometry());
    double worst = 0, unbalanced = 0;
    for_each_cell(parents, [&](IntVec3 cell) {
      const IndexBox one{cell, cell + IntVec3::all(1)};
      worst = std::max(worst, distance(sums_of(fine, children_of(cell, c)), sums_of(coarse, one)));
      double sum = 0, size = 0;
      for (std::size_t m = 0; m < 3; ++m) {
        sum += coarse.slip(m, 0, cell);
        size += std::fabs(coarse.slip(m, 0, cell));
      }
      if (size > 0) unbalanced = std::max(unbalanced, std::fabs(sum) / coarse.density(cell));
    });
    EXPECT_LT(worst, round_off);
    EXPECT_LT(unbalanced, round_off);
  }
}

INSTANTIATE_TEST_SUITE_P(Ice, SlipLevels, testing::ValuesIn(transfer_cases()));

// One change of one cell of two components.
struct Change {
  explicit Change(const MixtureLayout& l) : layout(l) {
    all.cells = {{0, 0, 0}};
    all.amount.assign(layout.quantities() + 1, {0.0});
  }
  double& of(std::size_t q) { return all.amount[q][0]; }
  // Matter that comes with a velocity of its own.
  void bring(std::size_t m, double M, double V, double E, double u) {
    of(layout.mass(m)) += M;
    of(layout.volume(m)) += V;
    of(layout.energy(m)) += E;
    of(layout.momentum(0)) += M * u;
    of(layout.material_momentum(m, 0)) += M * u;
    of(layout.total_energy()) += E + 0.5 * M * u * u;
  }
  MixtureLayout layout;
  ConservedChange all;
};

class SlipCorrection : public testing::Test {
 protected:
  SlipCorrection() { start(); }
  void start() {
    for (std::size_t q = 0; q < cell_.layout().quantities(); ++q) cell_.at(q, at) = 0;
    cell_.put(0, fluids[0], 0.3, 2, 3, at);
    cell_.put(1, fluids[1], 0.7, 20, 3, at);
    const double u[] = {5, 0};
    cell_.set_velocity(u, at);
  }
  // Velocity of a material.
  double velocity(std::size_t m) const {
    return cell_.momentum(0, at) / cell_.density(at) + cell_.slip(m, 0, at) / cell_.mass(m, at);
  }
  double correct(const Change& change) {
    const long double energy = cell_.total_energy(at);
    const double momentum = cell_.momentum(0, at);
    std::vector<double> share(1);
    MixtureTransfer(fluids, 2, true, true).correct(cell_.views(), change.all, share);
    const long double gained = share[0] * change.all.amount[change.layout.total_energy()][0];
    EXPECT_NEAR(static_cast<double>(cell_.total_energy(at) - energy - gained), 0,
                round_off * static_cast<double>(energy));
    EXPECT_NEAR(cell_.momentum(0, at),
                momentum + share[0] * change.all.amount[change.layout.momentum(0)][0], 1e-13);
    return share[0];
  }
  static constexpr IntVec3 at{0, 0, 0};
  TransferCase case_{{true, true, false}, {2, 2, 1}, 2};
  MixtureState cell_{{{0, 0, 0}, {1, 1, 1}}, case_, 3, true};
};

TEST_F(SlipCorrection, EachMaterialTakesItsOwnMomentum) {
  Change change(cell_.layout());
  change.bring(0, 0.06, 0.03, 0.03 * fluids[0].energy_from_pressure(2, 3, 300), 25);
  EXPECT_EQ(correct(change), 1.0);
  EXPECT_NEAR(velocity(0), (0.6 * 5 + 0.06 * 25) / 0.66, 1e-13);
  EXPECT_NEAR(velocity(1), 5, 1e-13);
}

TEST_F(SlipCorrection, WhatComesNewBringsItsVelocity) {
  Change change(cell_.layout());
  change.bring(2, 0.1, 0.05, 0.05 * fluids[2].energy_from_pressure(2, 3, 300), 6);
  EXPECT_EQ(correct(change), 1.0);
  EXPECT_NEAR(velocity(2), 6, 1e-13);
  EXPECT_NEAR(velocity(0), 5, 1e-13);
}

// All but next to nothing leaves, and what left was faster: no velocity is made of the difference.
TEST_F(SlipCorrection, WhatIsLeftKeepsItsVelocityAndState) {
  for (const double left : {1e-3, 1e-6, 1e-9}) {
    start();
    Change change(cell_.layout());
    const double E = cell_.energy(0, at);
    change.bring(0, -0.6 * (1 - left), -0.3 * (1 - 0.5 * left), -E * (1 + left), 5.5);
    const double liquid = cell_.energy(1, at) / cell_.volume(1, at);
    change.bring(1, 6, 0.3, 0.3 * liquid, 5);
    EXPECT_EQ(correct(change), 1.0) << left;
    // Twice the difference at most, less what the mixture itself changes; by mass it were 0.5/left.
    EXPECT_LT(std::fabs(velocity(0) - 5), 2 * 0.5 + 0.02) << left;
    EXPECT_NEAR(cell_.mass(0, at), 0.6 * left, 1e-15);
    EXPECT_NEAR(cell_.pressure(0, fluids[0], at), 3, 1.5) << left;
  }
}

// Traces move with the mixture, and what numbers cannot hold is gone.
TEST_F(SlipCorrection, TracesMoveWithTheMixture) {
  for (const double V : {1e-9, 1e-305}) {
    start();
    Change change(cell_.layout());
    change.bring(2, 2 * V, V, V * fluids[2].energy_from_pressure(2, 3, 300), 400);
    EXPECT_EQ(correct(change), 1.0);
    EXPECT_EQ(cell_.mass(2, at) > 0, V > 1e-100);
    if (V > 1e-100) {
      EXPECT_NEAR(velocity(2), 5, 1e-6);
    }
  }
}

}  // namespace
}  // namespace sluice::ice::slip_transfer_test
