// Drag against its differential equation, in both limits, and in what it keeps.
#include "ice/closure/drag.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

#include "ice/test_support/exchange.hpp"

namespace sluice::ice::mixture::drag_test {
namespace {

DragCell cell_of(std::initializer_list<double> M, std::initializer_list<double> V) {
  DragCell cell;
  for (const double mass : M) {
    cell.index[cell.count] = cell.count;
    cell.M[cell.count] = mass;
    cell.V[cell.count] = V.begin()[cell.count];
    cell.bind[cell.count] = 0;
    cell.total += mass;
    ++cell.count;
  }
  return cell;
}
PairCoefficients all_pairs(int n, double K) {
  PairCoefficients k(n);
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) k.set(i, j, K * (1 + i + 2 * j));
  return k;
}
double momentum(const DragCell& cell, const double* w) {
  double sum = 0, size = 0;
  for (int n = 0; n < cell.count; ++n) {
    sum += cell.M[n] * w[n];
    size += std::fabs(cell.M[n] * w[n]);
  }
  return size > 0 ? std::fabs(sum) / size : 0.0;
}

TEST(Drag, OfTwoIsTheExponential) {
  const DragCell cell = cell_of({300, .7}, {.3, .7});
  const double dt = 1e-4, rate = 1 / 300. + 1 / .7;
  for (const double K : {0., 1., 1e3, 1e5, 1e7, 1e9, 1e20}) {
    PairCoefficients k(2);
    k.set(0, 1, K);
    const Drag drag(k);
    double w[] = {.7 * 60 / 300.7, -300 * 60 / 300.7}, pushed[2];
    drag.decay(cell, dt, 1, w);
    const double z = dt * K * .21 * rate;
    EXPECT_NEAR(w[0] - w[1], 60 * std::exp(-z), 1e-13 * 60 * std::exp(-z)) << K;
    EXPECT_LE(momentum(cell, w), 1e-15);
    const double push[] = {1e-3, -1e-3};
    drag.respond(cell, dt, 1, push, pushed);
    const double share = z > 0 ? -std::expm1(-z) / z : 1.0;
    EXPECT_NEAR(pushed[0] - pushed[1], 1e-3 * rate * share, 1e-14) << K;
    EXPECT_LE(momentum(cell, pushed), 1e-15);
  }
}

// linearVariation: r^2 between 1e5 and 1e12, r the ratio of the masses, where the coefficient
// is 1e5; in proportion elsewhere.
TEST(Drag, MayGrowWithTheRatioOfMasses) {
  struct {
    double a, b, growth;
  } const pairs[] = {{300, .7, 300 * 300 / .49 / 1e5}, {2, 3, 1}, {1e-9, 1.2, 1e7}};
  for (const auto& p : pairs)
    for (const double K : {0., 1e-3, 1., 1e5, 1e10, 1e20}) {
      PairCoefficients k(2);
      k.set(0, 1, K);
      k.vary_with_mass();
      const DragCell cell = cell_of({p.a, p.b}, {.3, .7});
      const double rate = K * p.growth * .21 * (1 / p.a + 1 / p.b), dt = K > 0 ? 1 / rate : 1;
      double w[] = {p.b * 60 / (p.a + p.b), -p.a * 60 / (p.a + p.b)};
      Drag(k).decay(cell, dt, 1, w);
      EXPECT_NEAR(w[0] - w[1], K > 0 ? 60 * std::exp(-1.0) : 60, 1e-12) << p.a << " " << K;
      EXPECT_LE(momentum(cell, w), 1e-15);
    }
}

// The push of the larger is a difference of two numbers close to one.
TEST(Drag, PressureDoesNotThrowNextToNothing) {
  const DragCell cell = cell_of({32, 9e-50}, {1, 5e-50});
  double momentum[2];
  Drag::push(cell, 1e-2, momentum);
  EXPECT_LT(std::fabs(momentum[1] / cell.M[1]), 1e-2);
  EXPECT_EQ(momentum[0], -momentum[1]);
}

// Five materials, pushed all the time: order two, and exact where nothing or everything holds.
TEST(Drag, OfFiveIsOfSecondOrder) {
  const DragCell cell = cell_of({300, .7, 20, 4, .01}, {.3, .5, .1, .05, .05});
  const double start[] = {1, -30, 5, -58.25, 40};
  const double push[] = {2e-2, -1e-2, 5e-3, -1e-2, -5e-3}, time = 1e-3;
  const auto after = [&](double K, int steps, double* w) {
    const Drag drag(all_pairs(5, K));
    double mean = 0;
    for (int m = 0; m < 5; ++m) mean += cell.M[m] * start[m] / cell.total;
    for (int m = 0; m < 5; ++m) w[m] = start[m] - mean;
    for (int s = 0; s < steps; ++s) {
      double R[5], part[5];
      for (int m = 0; m < 5; ++m) part[m] = push[m] / steps;
      drag.respond(cell, time / steps, 1, part, R);
      drag.decay(cell, time / steps, 1, w);
      for (int m = 0; m < 5; ++m) w[m] += R[m];
      EXPECT_LE(momentum(cell, w), 1e-14);
    }
  };
  // M dw/dt = sum K V V (w' - w) + push, over the whole time.
  const auto exact = [&](double K) {
    const PairCoefficients all = all_pairs(5, K);
    Numbers masses, velocities, pushes;
    Matrix rates(5, Numbers(5, 0.0));
    for (std::size_t m = 0; m < 5; ++m) {
      masses.push_back(cell.M[m]);
      velocities.push_back(start[m]);
      pushes.push_back(push[m]);
      for (std::size_t n = 0; n < 5; ++n)
        if (m != n)
          rates[m][n] =
              time * all(static_cast<int>(m), static_cast<int>(n)) * cell.V[m] * cell.V[n];
    }
    Numbers w = exchanged(masses, rates, velocities, pushes);
    double mean = 0;
    for (std::size_t m = 0; m < 5; ++m) mean += masses[m] * w[m] / cell.total;
    for (double& one : w) one -= mean;
    return w;
  };
  for (const double K : {1., 30., 300.}) {
    const auto error = [&](int steps) {
      Numbers w(5);
      after(K, steps, w.data());
      return farthest(w, exact(K));
    };
    const double order = std::log2(error(16) / error(32));
    RecordProperty("order_" + std::to_string(static_cast<int>(K)), std::to_string(order));
    EXPECT_GT(order, 1.9) << K;
  }
  double free[5], bound[5];
  after(0, 1, free);
  for (int m = 1; m < 5; ++m)
    EXPECT_NEAR(free[m] - free[0], start[m] - start[0] + push[m] / cell.M[m] - push[0] / cell.M[0],
                1e-13);
  after(1e20, 1, bound);
  for (const double w : bound) EXPECT_LT(std::fabs(w), 1e-13);
}

// Beside its own share of the force (none worth speaking of) a drop in a gas feels half of that on
// the gas in its place; a bubble in a liquid is moved three times as fast as the liquid; what
// is pushed sums to zero.
TEST(Drag, PressureKnowsVirtualMass) {
  const double dp = 2;
  const auto change = [&](const DragCell& cell, int m) {
    double push[max_materials], sum = 0;
    Drag::push(cell, dp, push);
    for (int n = 0; n < cell.count; ++n) sum += push[n];
    EXPECT_LE(std::fabs(sum), 1e-15 * std::fabs(push[m]));
    return -dp / cell.total + push[m] / cell.M[m];
  };
  const double little = 1e-4;
  const DragCell drop = cell_of({1000 * little, 1.2 * (1 - little)}, {little, 1 - little});
  EXPECT_NEAR(change(drop, 0), -1.5 * dp / 1000, 2e-3 * dp / 1000);
  const DragCell bubble = cell_of({1.2 * little, 1000 * (1 - little)}, {little, 1 - little});
  EXPECT_NEAR(change(bubble, 0), -3 * dp / 1000, 1e-2 * dp / 1000);
  const DragCell three = cell_of({300, 10, .1}, {.3, .5, .2});
  double push[max_materials];
  Drag::push(three, dp, push);
  EXPECT_NEAR(push[0] + push[1] + push[2], 0, 1e-16);
  EXPECT_LT(push[2], 0);  // the lightest runs ahead, down the pressure
}

TEST(Drag, BindsLightTracesOnly) {
  const DragCell cell = cell_of({1e-3, 1.2}, {1e-6, 1 - 1e-6});
  EXPECT_EQ(binding(cell, 0, 1), 0.0);  // fine dust
  EXPECT_GT(binding(cell_of({1e-6, 1000}, {1e-6, 1 - 1e-6}), 0, 1e-3), 0.5);
  EXPECT_EQ(binding(cell_of({1.2 * .05, 950}, {.05, .95}), 0, 1), 0.0);  // bubbles
  EXPECT_GT(binding(cell_of({1e-7, 1.2}, {1e-10, 1}), 0, 0), 1e11);
}

}  // namespace
}  // namespace sluice::ice::mixture::drag_test
