// Contacts of materials at a face: two layers in series, areas, bounds, mirror images.
#include "ice/closure/contacts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sluice::ice::mixture::contacts_test {
namespace {

constexpr double unbounded = 1e300;

struct Cell {
  std::vector<double> share, temperature, bound, density;
  double jump = 0;
};

Cell cell(std::vector<double> share, std::vector<double> temperature) {
  const std::size_t n = share.size();
  return {share, temperature, std::vector<double>(n, unbounded), std::vector<double>(n, 1.0)};
}

PairCoefficients exchange(int materials, double H) {
  PairCoefficients all(materials);
  for (int a = 0; a < materials; ++a)
    for (int b = a + 1; b < materials; ++b) all.set(a, b, H);
  return all;
}

struct Heat {
  std::vector<double> given, taken;
};
struct Contacts {
  std::vector<double> k;  // of each material
  PairCoefficients H;
  std::optional<MultiVelocityExchange> slip{};
  std::optional<ConvectiveExchange> convective{};
};
Heat through(const Contacts& c, const Cell& low, const Cell& high, double dx) {
  Heat q{std::vector<double>(low.share.size()), std::vector<double>(low.share.size())};
  const auto side = [&](const Cell& x) {
    return ContactSide{x.share.data(), x.temperature.data(), x.bound.data(),
                       c.k.data(),     x.density.data(),     x.jump};
  };
  const HeatContacts contacts(static_cast<int>(c.k.size()), c.H, c.slip, c.convective);
  contacts.conduct(side(low), side(high), dx, q.given.data(), q.taken.data());
  return q;
}

// Fourier's law through two half cells in series; the interface as a resistance of its own.
TEST(HeatContacts, TwoMaterialsConductInSeries) {
  const double dx = .01, k_a = 2, k_b = 50, H = 4e6;
  const Cell hot = cell({1, 0}, {400, 0}), cold = cell({0, 1}, {0, 300});
  const double perfect = 100 / (.5 * dx / k_a + .5 * dx / k_b);
  const Heat q = through({{k_a, k_b}, exchange(2, 1e15)}, hot, cold, dx);
  EXPECT_NEAR(q.given[0], perfect, 1e-6 * perfect);
  EXPECT_EQ(q.given[0], q.taken[1]);
  EXPECT_EQ(q.given[1], 0);
  EXPECT_EQ(q.taken[0], 0);
  // As much as H V_a V_b (T_b - T_a) in a cell of that length that is half full of each.
  const double resistance = .5 * dx / k_a + .5 * dx / k_b + 1 / (H * .25 * dx);
  EXPECT_NEAR(through({{k_a, k_b}, exchange(2, H)}, hot, cold, dx).given[0], 100 / resistance,
              1e-12 * perfect);
  EXPECT_EQ(through({{k_a, k_b}, exchange(2, 0)}, hot, cold, dx).given[0], 0);
}

// A coefficient that varies is that of halves of the two cells, with densities 1 and 1000.
TEST(HeatContacts, ACoefficientMayGrowWithTheRatioOfMasses) {
  const double dx = .01, k = 50, H = 1e5;
  PairCoefficients varying = exchange(2, H);
  varying.vary_with_mass();
  Cell hot = cell({1, 0}, {400, 0}), cold = cell({0, 1}, {0, 300});
  hot.density[0] = 1000;
  const auto through_interface = [&](double coefficient) {
    return 100 / (dx / k + 4 / (coefficient * dx));
  };
  EXPECT_NEAR(through({{k, k}, varying}, hot, cold, dx).given[0] / through_interface(1e6), 1,
              1e-14);
  EXPECT_NEAR(through({{k, k}, varying}, cold, hot, dx).given[1] / through_interface(1e6), -1,
              1e-14);
  hot.density[0] = 2;  // alike: the coefficient itself
  EXPECT_NEAR(through({{k, k}, varying}, hot, cold, dx).given[0] / through_interface(1e5), 1,
              1e-14);
}

// The jump of temperature of a rarefied gas is a layer of its own, h (T_gas - T_wall) = q.
TEST(HeatContacts, TemperatureJumpsAtASurface) {
  const double dx = .01, k_gas = 2, k_wall = 50, h = 30;
  MultiVelocityExchange slip;
  slip.fluid = 1;
  slip.solid = 0;
  Cell gas = cell({0, 1}, {0, 400}), wall = cell({1, 0}, {300, 0});
  gas.jump = h;
  const Contacts contacts{{k_wall, k_gas}, exchange(2, 1e15), slip};
  const double exact = 100 / (.5 * dx / k_gas + 1 / h + .5 * dx / k_wall);
  EXPECT_NEAR(through(contacts, gas, wall, dx).given[1] / exact, 1, 1e-9);
  EXPECT_NEAR(through(contacts, wall, gas, dx).given[0] / exact, -1, 1e-9);
  EXPECT_NEAR(through(contacts, gas, wall, dx).given[1], through(contacts, gas, wall, dx).taken[0],
              0);
  // Of a cell that both share half and half all of the surface belongs to the cell.
  const Cell both = cell({.5, .5}, {300, 400});
  const Heat q = through(contacts, both, wall, dx);
  EXPECT_NEAR(q.given[1], 0, 1e-13);
}

// Beside a surface the coefficient acts between whole cells, whether they conduct or not.
TEST(HeatContacts, ConvectiveExchangeIsThatOfTheTwoCells) {
  const double dx = .01, H = 1e5;
  ConvectiveExchange film;
  film.fluid = 1;
  film.solid = 0;
  const Cell gas = cell({0, 1}, {0, 400}), wall = cell({1, 0}, {300, 0});
  const auto heat = [&](double k_wall) {
    return through({{k_wall, 0}, exchange(2, H), {}, film}, gas, wall, dx).given[1];
  };
  EXPECT_NEAR(heat(0), H * dx * 100, 1e-9 * H);
  EXPECT_NEAR(heat(3), 100 / (.5 * dx / 3 + 1 / (H * dx)), 1e-9 * H);
  EXPECT_EQ(through({{0, 0}, exchange(2, H)}, gas, wall, dx).given[1], 0);
}

// Like fluids at the same temperature are one fluid, whatever their shares are.
TEST(HeatContacts, LikeFluidsConductAsOne) {
  const double dx = .1, k = 3;
  const Contacts contacts{{k, k, k}, exchange(3, 1e18)};
  const Cell low = cell({.2, .5, .3}, {310, 310, 310}), high = cell({.6, 0, .4}, {290, 0, 290});
  const Heat q = through(contacts, low, high, dx);
  double given = 0, taken = 0;
  for (std::size_t m = 0; m < 3; ++m) {
    given += q.given[m];
    taken += q.taken[m];
  }
  EXPECT_NEAR(given, k * 20 / dx, 1e-13 * given);
  EXPECT_NEAR(taken, given, 1e-15 * given);
}

// What one gives others take; the mirror image is the same with both sides exchanged, to the bit.
TEST(HeatContacts, BalanceAndMirror) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  const Contacts contacts{{1, 20, .1, 4}, exchange(4, 1e3)};
  const auto draw = [&] {
    Cell c = cell(std::vector<double>(4), std::vector<double>(4));
    double sum = 0;
    for (double& s : c.share) sum += s = unit(random) < .3 ? 0.0 : unit(random) + 1e-3;
    for (std::size_t m = 0; m < 4; ++m) {
      c.share[m] /= sum;
      c.temperature[m] = 300 * unit(random) + 1;
      c.bound[m] = 2 * unit(random);
    }
    return c;
  };
  for (int n = 0; n < 200; ++n) {
    const Cell a = draw(), b = draw();
    if (!(a.share[0] >= 0 && b.share[0] >= 0)) continue;  // all absent: 0/0
    const Heat q = through(contacts, a, b, .3), image = through(contacts, b, a, .3);
    double balance = 0, size = 0;
    for (std::size_t m = 0; m < 4; ++m) {
      EXPECT_EQ(q.given[m], -image.taken[m]);
      EXPECT_EQ(q.taken[m], -image.given[m]);
      balance += q.given[m] - q.taken[m];
      size += std::fabs(q.given[m]);
    }
    EXPECT_LE(std::fabs(balance), 1e-14 * size + 1e-300);
  }
}

// With the bound of a step no temperature leaves the range of its neighbours, however small the
// share.
TEST(HeatContacts, TracesStayBetweenTheirNeighbours) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  const Contacts contacts{{1e3, 1e3}, exchange(2, 1e15)};
  const double dx = 1e-3, dt = 1;
  for (int n = 0; n < 1000; ++n) {
    Cell three[3];
    double capacity[3][2];
    double least = 1e300, most = 0;
    for (int i = 0; i < 3; ++i) {
      const double trace = std::pow(10., -12 * unit(random));
      three[i] = cell({trace, 1 - trace}, {1000 * unit(random) + 1, 1000 * unit(random) + 1});
      for (std::size_t m = 0; m < 2; ++m) {
        const double rho_cv = std::pow(10., 6 * unit(random) - 3);
        three[i].bound[m] = rho_cv * dx * dx / (2 * dt);
        capacity[i][m] = three[i].share[m] * rho_cv;
        least = std::fmin(least, three[i].temperature[m]);
        most = std::fmax(most, three[i].temperature[m]);
      }
    }
    const Heat in = through(contacts, three[0], three[1], dx);
    const Heat out = through(contacts, three[1], three[2], dx);
    for (std::size_t m = 0; m < 2; ++m) {
      const double T =
          three[1].temperature[m] + dt / dx * (in.taken[m] - out.given[m]) / capacity[1][m];
      EXPECT_GE(T, least * (1 - 1e-12));
      EXPECT_LE(T, most * (1 + 1e-12));
    }
  }
}

}  // namespace
}  // namespace sluice::ice::mixture::contacts_test
