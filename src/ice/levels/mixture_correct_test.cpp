// Differences of fluxes added to cells of several materials.
#include "ice/test_support/mixture_levels.hpp"

namespace sluice::ice::mixture_correct_test {
namespace {

constexpr double round_off = 4e-15;

class MixtureCorrection : public testing::Test {
 protected:
  MixtureCorrection() { change_.amount.resize(layout().quantities() + 1); }
  const MixtureLayout& layout() const { return state_.layout(); }

  // A change of every cell by amounts(cell, quantity); share of each afterwards in share_.
  template <class F>
  void correct(F&& amounts) {
    change_.cells.clear();
    for (std::vector<double>& a : change_.amount) a.clear();
    before_.clear();
    for_each_cell(state_.box(), [&](IntVec3 cell) {
      change_.cells.push_back(cell);
      for (std::size_t q = 0; q < change_.amount.size(); ++q)
        change_.amount[q].push_back(amounts(cell, q));
      before_.push_back(mean_of(state_, {cell, cell + IntVec3::all(1)}));
    });
    share_.assign(change_.cells.size(), -1.0);
    MixtureTransfer(fluids_, 2).correct(state_.views(), change_, share_);
  }
  // Largest error of mass, momentum and total energy, as a share of what is there.
  double worst_balance() const {
    double worst = 0;
    for (std::size_t n = 0; n < share_.size(); ++n) {
      Conserved wanted = before_[n];
      const IntVec3 cell = change_.cells[n];
      Conserved now = mean_of(state_, {cell, cell + IntVec3::all(1)});
      for (std::size_t q = 0; q <= layout().quantities(); ++q) {
        const bool conserved = q < layout().energy(0) || q == layout().quantities();
        wanted.value[q] += conserved ? share_[n] * change_.amount[q][n] : 0.0L;
        if (!conserved) wanted.value[q] = now.value[q] = 0;
      }
      worst = std::max(worst, worst_difference(wanted, now));
    }
    return worst;
  }

  std::vector<Fluid> fluids_ = three_fluids();
  TransferCase case_{{true, true, false}, {2, 2, 1}, 2};
  MixtureState state_{{{0, 0, 0}, {17, 15, 1}}, case_, 3};
  ConservedChange change_;
  std::vector<Conserved> before_;
  std::vector<double> share_;
};

TEST_F(MixtureCorrection, KeepsMassesMomentumAndTotalEnergy) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    fill_with_mixtures(state_, fluids_, seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> part(-0.01, 0.01);
    correct([&](IntVec3 cell, std::size_t q) {
      return part(random) * (q < layout().quantities()
                                 ? state_.at(q, cell)
                                 : static_cast<double>(state_.total_energy(cell)));
    });
    EXPECT_LT(worst_balance(), round_off);
    EXPECT_EQ(broken_cells(state_, fluids_, state_.box()), 0);
    const auto whole = std::count(share_.begin(), share_.end(), 1.0);
    EXPECT_GT(whole, static_cast<std::ptrdiff_t>(share_.size() * 3 / 4));
  }
}

// What a shock has crushed since it came as vapour goes back with more volume than is left of it.
TEST_F(MixtureCorrection, CrushedVapourKeepsItsDensity) {
  fill_with_mixtures(state_, fluids_, 4);
  std::vector<double> densities;
  const auto last = [&](IntVec3 cell) {
    std::size_t m = 2;
    while (m > 0 && state_.mass(m, cell) == 0) --m;
    return m;
  };
  correct([&](IntVec3 cell, std::size_t q) {
    const std::size_t m = last(cell);
    if (q == 0) densities.push_back(state_.mass(m, cell) / state_.volume(m, cell));
    const bool shared = state_.volume(m, cell) < 0.5;
    return q == layout().volume(m) && shared ? -2 * state_.volume(m, cell) : 0.0;
  });
  EXPECT_EQ(std::count(share_.begin(), share_.end(), 1.0), std::ssize(share_));
  EXPECT_LT(worst_balance(), round_off);
  EXPECT_EQ(broken_cells(state_, fluids_, state_.box()), 0);
  std::size_t n = 0;
  for_each_cell(state_.box(), [&](IntVec3 cell) {
    const std::size_t m = last(cell);
    EXPECT_NEAR(state_.mass(m, cell) / state_.volume(m, cell) / densities[n++], 1.0, 1e-14);
  });
}

// Other materials take the place of those that are there, at the same pressure and velocity.
TEST_F(MixtureCorrection, UniformFlowStaysUniform) {
  const double u[3] = {30, -7, 0}, p = 2.5;
  fill_with_mixtures(state_, fluids_, 2, u, p);
  const double rho[3] = {0.3, 40, 2};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0, 0.2);
  double volume[3] = {}, mass = 0, energy = 0;
  correct([&](IntVec3 cell, std::size_t q) {
    if (q == 0) {
      // The next material comes instead of a share of the first that is there.
      std::size_t m = 0;
      while (state_.mass(m, cell) == 0) ++m;
      const double V = part(random) * state_.volume(m, cell);
      mass = energy = 0;
      for (std::size_t n = 0; n < 3; ++n) volume[n] = n == m ? -V : n == (m + 1) % 3 ? V : 0.0;
    }
    const auto own = [&](std::size_t m, double now, double otherwise) {
      return state_.volume(m, cell) > 0 ? now / state_.volume(m, cell) : otherwise;
    };
    if (q < 3) {
      const double d = volume[q] * own(q, state_.mass(q, cell), rho[q]);
      mass += d;
      return d;
    }
    if (q < 5) return mass * u[q - 3];
    if (q < 8) {
      const std::size_t m = q - 5;
      const double d = volume[m] * own(m, state_.energy(m, cell),
                                       fluids_[m].energy_from_pressure(rho[m], p, 300));
      energy += d;
      return d;
    }
    if (q < 11) return volume[q - 8];
    return energy + 0.5 * mass * (u[0] * u[0] + u[1] * u[1]);
  });
  EXPECT_LT(worst_balance(), round_off);
  EXPECT_EQ(broken_cells(state_, fluids_, state_.box()), 0);
  double off = 0;
  for_each_cell(state_.box(), [&](IntVec3 cell) {
    for (std::size_t c = 0; c < 2; ++c)
      off = std::max(off, std::fabs(state_.momentum(c, cell) / state_.density(cell) - u[c]) / 30);
    // Round-off of the kinetic energy is heat, by mass.
    const double scale = 1.0 + state_.density(cell) * 500;
    for (std::size_t m = 0; m < 3; ++m)
      if (state_.volume(m, cell) > 1e-3)
        off = std::max(off, std::fabs(state_.pressure(m, fluids_[m], cell) - p) /
                                (p - fluids_[m].lowest_pressure()) / scale);
  });
  EXPECT_LT(off, 2e-14);
  for (const double s : share_) EXPECT_EQ(s, 1.0);
}

TEST_F(MixtureCorrection, ACellOfOneMaterialIsTreatedAsAGas) {
  BoxState gas(state_.box(), case_);
  fill_wildly(gas, 3);
  for_each_cell(state_.box(), [&](IntVec3 cell) {
    state_.mass(2, cell) = gas.rho(cell);
    state_.energy(2, cell) = gas.energy(cell);
    state_.volume(2, cell) = 1;
    for (int c = 0; c < 2; ++c) state_.momentum(c, cell) = gas.momentum(c, cell);
  });
  correct([&](IntVec3 cell, std::size_t q) {
    return 0.3 * (q < layout().quantities() ? state_.at(q, cell)
                                            : static_cast<double>(state_.total_energy(cell)));
  });
  ConservedChange one;
  one.cells = change_.cells;
  one.amount = {change_.amount[2], change_.amount[3], change_.amount[4], change_.amount[11]};
  std::vector<double> share(share_.size());
  IceTransfer(2, false).correct(gas.views(), one, share);
  int changed = 0;
  for_each_cell(state_.box(), [&](IntVec3 cell) {
    changed += !same_bits(state_.mass(2, cell), gas.rho(cell)) ||
               !same_bits(state_.energy(2, cell), gas.energy(cell)) ||
               !same_bits(state_.momentum(1, cell), gas.momentum(1, cell));
  });
  EXPECT_EQ(changed, 0);
  EXPECT_EQ(broken_cells(state_, fluids_, state_.box()), 0);
}

// All of one material goes, to the bit or to the round-off of volumes.
TEST_F(MixtureCorrection, AMaterialThatIsGoneLeavesExactZeros) {
  for (const double left : {0.0, 1e-16, -1e-16}) {
    for_each_cell(state_.box(), [&](IntVec3 cell) {
      state_.put(0, fluids_[0], 0.25, 1.5, 3, cell);
      state_.put(1, fluids_[1], 0.75, 20, 3, cell);
      const double u[] = {1, -2, 0};
      state_.set_velocity(u, cell);
    });
    const IntVec3 any = state_.box().lower;
    const double M = state_.mass(0, any), E = state_.energy(0, any), V = 0.25;
    const double liquid = state_.energy(1, any) / 3, mass = V * 20 - M;
    correct([&](IntVec3 /*cell*/, std::size_t q) {
      const double amounts[] = {left * 1.5 - M,  // the gas
                                V * 20,          // the liquid takes its place
                                0,
                                mass,
                                -2 * mass,
                                -left * E - E,
                                liquid,
                                0,
                                left - V,
                                V,
                                0,
                                liquid - E + 2.5 * mass};
      return amounts[q];
    });
    for (const double s : share_) EXPECT_EQ(s, 1.0);
    EXPECT_EQ(broken_cells(state_, fluids_, state_.box()), 0);
    EXPECT_EQ(state_.mass(0, any), 0.0);
    EXPECT_EQ(state_.volume(0, any), 0.0);
    EXPECT_EQ(state_.energy(0, any), 0.0);
    EXPECT_EQ(state_.volume(1, any), 1.0);
    EXPECT_LT(worst_balance(), round_off);
  }
}

// A volume that comes without mass presses on both gases with the pressure of the cell.
TEST_F(MixtureCorrection, CompressionWorksByVolume) {
  const std::vector<Fluid> gases = {ideal_gas(1.4, 700), ideal_gas(1.4, 200)};
  MixtureState two({{0, 0, 0}, {1, 1, 1}}, case_, 2);
  two.put(0, gases[0], 0.5, 1, 3, {});
  two.put(1, gases[1], 0.5, 1000, 3, {});
  ConservedChange change;
  change.cells = {{0, 0, 0}};
  change.amount.assign(9, {0.0});
  change.amount[6] = change.amount[7] = {0.005};
  change.amount[8] = {0.01 * 3};
  std::vector<double> share(1);
  MixtureTransfer(gases, 2).correct(two.views(), change, share);
  EXPECT_EQ(share[0], 1.0);
  EXPECT_DOUBLE_EQ(two.pressure(0, gases[0], {}), 3 + 0.4 * 0.01 * 3);
  EXPECT_DOUBLE_EQ(two.pressure(1, gases[1], {}), 3 + 0.4 * 0.01 * 3);
}

TEST_F(MixtureCorrection, GivesEachCellTheShareThatItCanBear) {
  fill_with_mixtures(state_, fluids_, 9);
  correct([&](IntVec3 cell, std::size_t q) {
    if (q >= layout().quantities()) return -3.0 * static_cast<double>(state_.total_energy(cell));
    return -3.0 * state_.at(q, cell);
  });
  int borne = 0;
  for (const double s : share_) {
    EXPECT_LE(s, 0.25);
    borne += s == 0.25;
  }
  EXPECT_GT(borne, 0);
  EXPECT_LT(worst_balance(), round_off);
  EXPECT_EQ(broken_cells(state_, fluids_, state_.box()), 0);
}

TEST_F(MixtureCorrection, LeavesACellThatCanBearNothingAsItWas) {
  fill_with_mixtures(state_, fluids_, 9);
  MixtureState kept(state_.box(), case_, 3);
  for_each_cell(state_.box(), [&](IntVec3 cell) {
    for (std::size_t q = 0; q < layout().quantities(); ++q) kept.at(q, cell) = state_.at(q, cell);
  });
  // More of a material than there is, and a change that is not a number.
  for (const double bad : {-1e9, std::nan("")}) {
    correct([&](IntVec3 /*cell*/, std::size_t q) { return q == 1 ? bad : 0.0; });
    for (const double s : share_) EXPECT_EQ(s, 0.0);
    EXPECT_EQ(different(kept, state_, state_.box()), 0);
  }
}

}  // namespace
}  // namespace sluice::ice::mixture_correct_test
