// Waves and vortices satisfy the Euler equations (differences at several points), and symmetries.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "exact/smooth/vortices.hpp"
#include "exact/smooth/waves.hpp"
#include "framework/base/error.hpp"

namespace sluice::exact::smooth_flow_test {
namespace {

constexpr double step = 1e-3;

// Fourth-order central difference of f(s) at 0.
template <class F>
double slope(F f) {
  return (8 * (f(step) - f(-step)) - (f(2 * step) - f(-2 * step))) / (12 * step);
}

// Largest residual of mass, momentum (x, y) and pressure equation at (x, t), gravity included.
double residual(const ExactSolution& flow, Vec3 x, double t, Vec3 gravity = {}) {
  const State s = flow.at(x, t);
  const auto value = [&](int k, Vec3 at, double time) {
    const State q = flow.at(at, time);
    const std::array<double, 4> all = {q.density, q.velocity.x, q.velocity.y, q.pressure};
    return all[k];
  };
  std::array<double, 4> dt{}, dx{}, dy{};
  for (int k = 0; k < 4; ++k) {
    dt[k] = slope([&](double h) { return value(k, x, t + h); });
    dx[k] = slope([&](double h) { return value(k, x + Vec3{h, 0, 0}, t); });
    dy[k] = slope([&](double h) { return value(k, x + Vec3{0, h, 0}, t); });
  }
  const auto along = [&](std::size_t k) {
    return dt[k] + s.velocity.x * dx[k] + s.velocity.y * dy[k];
  };
  const double spread = dx[1] + dy[2];
  double worst = std::abs(along(0) + s.density * spread);
  worst = std::max(worst, std::abs(along(1) + dx[3] / s.density - gravity.x));
  worst = std::max(worst, std::abs(along(2) + dy[3] / s.density - gravity.y));
  return std::max(worst, std::abs(along(3) + s.gamma * s.pressure * spread));
}

const std::array<Vec3, 4> places = {Vec3{.11, .23, 0}, Vec3{-.31, .07, 0}, Vec3{.02, -.29, 0},
                                    Vec3{.43, .41, 0}};

TEST(SmoothFlow, WavesSatisfyTheEulerEquations) {
  const State mean{1.2, {.3, -.1, 0}, .9, 1.4};
  const AdvectedWave advected(mean, .3, {1, 1, 0}, {});
  const SimpleWave forward(mean, .1, {1, .5, 0}, 1, {});
  const SimpleWave backward(mean, .1, {1, .5, 0}, -1, {});
  const SoundWave sound(mean, 1e-7, {1, .5, 0}, 1, {});
  for (const Vec3 x : places) {
    EXPECT_LT(residual(advected, x, .2), 1e-7);
    EXPECT_LT(residual(forward, x, .2), 1e-7);
    EXPECT_LT(residual(backward, x, .2), 1e-7);
    EXPECT_LT(residual(sound, x, .2), 1e-12);  // amplitude squared
  }
}

TEST(SmoothFlow, VorticesSatisfyTheEulerEquations) {
  IsentropicVortex::Stream stream;
  stream.velocity = {1, .5, 0};
  const IsentropicVortex vortex(stream);
  const GreshoVortex gresho(.1, 1.4, {});
  for (const Vec3 x : places) {
    EXPECT_LT(residual(vortex, x + Vec3{.8, 0, 0}, .2), 1e-8);
    EXPECT_LT(residual(gresho, x, .2), 1e-6);
  }
}

TEST(SmoothFlow, ColumnIsInBalance) {
  const State base{1.2, {}, .9, 1.4};
  const Vec3 gravity{.4, -.7, 0};
  for (const Vec3 x : places) {
    EXPECT_LT(residual(HydrostaticColumn(base, gravity, true, {}), x, .2, gravity), 1e-9);
    EXPECT_LT(residual(HydrostaticColumn(base, gravity, false, {}), x, .2, gravity), 1e-9);
  }
}

TEST(SmoothFlow, OppositeWavesAreMirrorImages) {
  const State mean{1, {}, 1, 1.4};
  const SimpleWave forward(mean, 1e-6, {1, 0, 0}, 1, {}), backward(mean, 1e-6, {1, 0, 0}, -1, {});
  for (double x : {.05, .2, .45}) {
    const State a = forward.at({x, 0, 0}, .4), b = backward.at({-x, 0, 0}, .4);
    EXPECT_NEAR(a.density, b.density, 3e-16);
    EXPECT_NEAR(a.velocity.x, -b.velocity.x, 3e-16);
    EXPECT_NEAR(a.pressure, b.pressure, 3e-16);
  }
}

TEST(SmoothFlow, LinearAndSimpleWaveAgreeForSmallAmplitude) {
  const State mean{1, {}, 1, 1.4};
  const SimpleWave exact(mean, 1e-6, {1, 0, 0}, 1, {});
  const SoundWave linear(mean, 1e-6, {1, 0, 0}, 1, {});
  for (double x : {.05, .2, .45}) {
    EXPECT_NEAR(exact.at({x, 0, 0}, .4).density, linear.at({x, 0, 0}, .4).density, 1e-11);
  }
}

TEST(SmoothFlow, SimpleWaveRefusesTimesAfterItBreaks) {
  const SimpleWave wave({1, {}, 1, 1.4}, .1, {1, 0, 0}, 1, {});
  // 1 / ((g+1)/2 c0 A 2 pi) to first order in A
  EXPECT_NEAR(wave.breaking_time(), 1 / (1.2 * std::sqrt(1.4) * .1 * 2 * std::numbers::pi), .02);
  EXPECT_THROW(wave.at({0, 0, 0}, wave.breaking_time()), InputError);
}

TEST(SmoothFlow, VortexReturnsAfterAPeriod) {
  IsentropicVortex::Stream stream;
  stream.velocity = {1, 1, 0};
  stream.period = 16;
  const IsentropicVortex vortex(stream);
  const State start = vortex.at({.5, -.75, 0}, 0), later = vortex.at({.5, -.75, 0}, 16);
  EXPECT_EQ(start.density, later.density);
  EXPECT_EQ(start.velocity.y, later.velocity.y);
}

TEST(SmoothFlow, GreshoSwirlIsContinuousAndItsMachNumberIsThatAsked) {
  const GreshoVortex vortex(.01, 1.4, {});
  for (double r : {.2, .4}) {
    const State in = vortex.at({r * (1 - 1e-12), 0, 0}, 0),
                out = vortex.at({r * (1 + 1e-12), 0, 0}, 0);
    EXPECT_NEAR(in.pressure, out.pressure, 1e-8);
    EXPECT_NEAR(in.velocity.y, out.velocity.y, 1e-10);
  }
  const State peak = vortex.at({.2, 0, 0}, 0);
  EXPECT_NEAR(peak.velocity.y / std::sqrt(1.4 * peak.pressure / peak.density), .01, 1e-5);
}

}  // namespace
}  // namespace sluice::exact::smooth_flow_test
