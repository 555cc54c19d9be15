// A mass on a spring by the leapfrog: what the guard says of steps that are stable and not.
#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/json.hpp"
#include "framework/run/simulation/energy_guard.hpp"

namespace sluice::energy_guard_test {
namespace {

constexpr double spacing = 1;

// m = k = 1: omega = 1. A constant force may act.
class Spring {
 public:
  explicit Spring(double place, double velocity = 0) : x_(place), v_(velocity) {}

  BodyEnergy step(double dt, double force = 0) {
    const double kick = (before_ == 0 ? 0.5 * dt : 0.5 * (before_ + dt)), v = v_;
    v_ += kick * (force - x_);
    const double from = x_;
    x_ += dt * v_;
    before_ = dt;
    BodyEnergy b;
    b.name = "spring";
    b.mass = 1;
    b.kinetic_before = 0.5 * v * v;
    b.kinetic_middle = 0.125 * (v + v_) * (v + v_);
    b.kinetic_after = 0.5 * v_ * v_;
    b.stored_before = 0.5 * from * from;
    b.stored_after = 0.5 * x_ * x_;
    b.work = kick * force * 0.5 * (v + v_);
    b.kick = kick * force * (v_ - v);
    return b;
  }
  double amplitude() const { return std::hypot(x_, v_); }

 private:
  double x_, v_, before_ = 0;
};

double gain_of(const EnergyGuard& guard) {
  return guard.to_json().at("spring").at("numerical_gain_J").get<double>();
}

struct Outcome {
  int refused = 0;  // steps
  int first = 0;
};

template <class Step>
Outcome run(EnergyGuard& guard, Spring& spring, int steps, Step&& length, double force = 0) {
  Outcome o;
  for (int n = 1; n <= steps; ++n) {
    const double dt = length(n);
    const std::vector<BodyEnergy> bodies{spring.step(dt, force)};
    if (guard.judge(bodies, dt, spacing) && o.refused++ == 0) o.first = n;
    guard.accept(bodies, n, dt, spacing);
  }
  return o;
}

TEST(EnergyGuard, LetsStableStepsPassAndFindsThemWithoutGain) {
  for (const double dt : {0.05, 0.2, 0.5, 1.0}) {
    EnergyGuard guard;
    Spring spring(1);
    EXPECT_EQ(run(guard, spring, 1000, [&](int) { return dt; }).refused, 0) << dt;
    EXPECT_NEAR(gain_of(guard), 0, 1e-12) << dt;
    EXPECT_TRUE(guard.crossings().empty()) << dt;
  }
}

TEST(EnergyGuard, FindsAnUnstableStepBeforeItsEnergyHasGrownTenfold) {
  for (const double dt : {2.01, 2.05, 2.2, 3.0}) {
    EnergyGuard guard;
    Spring spring(1e-3);
    const Outcome o = run(guard, spring, 200, [&](int) { return dt; });
    EXPECT_GT(o.refused, 0) << dt;
    EXPECT_LE(o.first, 4) << dt;
  }
}

TEST(EnergyGuard, AStepOfAnotherLengthIsNoGain) {
  for (const double most : {0.1, 0.3}) {
    EnergyGuard guard;
    Spring spring(0.6, 0.8);
    const auto length = [&](int n) {
      return n % 7 == 0 ? most / 256 : n % 11 < 5 ? most / 2 : most;
    };
    EXPECT_EQ(run(guard, spring, 1000, length).refused, 0) << most;
  }
  // The last step of a run is cut: H rises by up to (omega dt)^2/4 of the energy, 4 % here.
  EnergyGuard guard;
  Spring spring(1);
  run(guard, spring, 100, [](int n) { return n < 100 ? 0.4 : 0.01; });
  EXPECT_EQ(gain_of(guard), 0);
  EXPECT_TRUE(guard.crossings().empty());
}

TEST(EnergyGuard, WorkFromOutsideIsNoGain) {
  EnergyGuard guard;
  Spring spring(0);
  EXPECT_EQ(run(
                guard, spring, 1000, [](int) { return 0.2; }, 3.0)
                .refused,
            0);
  EXPECT_NEAR(gain_of(guard), 0, 1e-12);
}

// What appears from nowhere, 1 % of the energy, is refused; so much a step that none is refused is
// told in the end.
TEST(EnergyGuard, RefusesWhatAppearsAndTellsOfWhatAddsUp) {
  EnergyGuard guard;
  Spring spring(1);
  run(guard, spring, 50, [](int) { return 0.1; });
  std::vector<BodyEnergy> bodies{spring.step(0.1)};
  bodies[0].stored_before += 0.01;
  bodies[0].stored_after += 0.01;
  EXPECT_FALSE(guard.judge(bodies, 0.1, spacing));  // it was there before: no gain of this step
  bodies[0].stored_before -= 0.01;
  guard.accept(bodies, 51, 0.1, spacing);
  bodies[0] = spring.step(0.1);
  EXPECT_TRUE(guard.judge(bodies, 0.1, spacing));

  EnergyGuard slow;
  Spring other(1);
  for (int n = 1; n <= 100; ++n) {
    std::vector<BodyEnergy> step{other.step(0.1)};
    step[0].stored_after += 1e-4 * 0.5;
    EXPECT_FALSE(slow.judge(step, 0.1, spacing)) << n;
    slow.accept(step, n, 0.1, spacing);
  }
  ASSERT_EQ(slow.crossings().size(), 1u);
  EXPECT_TRUE(slow.crossings()[0].gains);
  EXPECT_NEAR(slow.crossings()[0].since, 53, 3);  // .5 % at 1e-4 of it a step
  EXPECT_NEAR(gain_of(slow), 98 * 0.5e-4, 1e-6);  // from the second step on
}

TEST(EnergyGuard, StepsStayShorterForAWhileAndNotForEver) {
  EnergyGuard guard;
  Spring spring(1);
  EXPECT_EQ(guard.factor(), 1);
  EXPECT_TRUE(guard.shorten());
  EXPECT_TRUE(guard.shorten());
  EXPECT_EQ(guard.factor(), 0.25);
  run(guard, spring, 1000, [](int) { return 0.1; });
  EXPECT_EQ(guard.factor(), 1);
  for (int n = 0; n < EnergyGuard::max_halvings; ++n) EXPECT_TRUE(guard.shorten()) << n;
  EXPECT_FALSE(guard.shorten());
}

TEST(EnergyGuard, ARestartCarriesTheAccounts) {
  EnergyGuard guard;
  Spring spring(1);
  guard.shorten();
  run(guard, spring, 30, [](int) { return 0.3; });
  EnergyGuard again;
  again.restore(Json::parse(guard.checkpoint().dump()));
  Spring copy = spring;
  run(guard, spring, 60, [](int) { return 0.3; });
  run(again, copy, 60, [](int) { return 0.3; });
  EXPECT_EQ(again.checkpoint(), guard.checkpoint());
  EXPECT_EQ(again.to_json(), guard.to_json());
}

}  // namespace
}  // namespace sluice::energy_guard_test
