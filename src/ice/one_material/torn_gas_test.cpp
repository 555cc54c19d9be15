// Gas that is torn apart faster than it can follow: a vacuum opens, and nothing becomes hot.
#include <gtest/gtest.h>

#include <cmath>

#include "ice/test_support/mixture.hpp"

namespace sluice::ice::torn_gas_test {
namespace {

constexpr double c = 1.1832159566199232;  // sound speed of gamma 1.4, density 1, pressure 1

// The largest temperatures, of that at the start, where the density is above .01.
struct Hottest {
  double ever = 0, at_end = 0;
};
Hottest is_cavitating(double mach, int cells) {
  GasBox box;
  box.cells = {cells, 1, 1};
  box.scheme = "conservative";
  box.periodic = false;
  MixtureBox run(box, {ideal_gas(1.4, 1)}, [&](Vec3 x) {
    MixtureCell cell;
    cell.volume = {1};
    cell.density = {1};
    cell.pressure = {1};
    cell.velocity[0] = x.x < 0.5 ? -mach * c : mach * c;
    return cell;
  });
  Hottest h;
  double time = 0;
  for (const double end = 0.35 / ((mach + 1) * c); time < end;) {
    const double dt = std::fmin(run.limit().dt, end - time);
    run.step(dt);
    time += dt;
    h.at_end = 0;
    for_each_cell(run.domain(), [&](IntVec3 at) {
      if (run.density(at) < 1e-2) return;
      h.at_end = std::fmax(h.at_end, run.pressure(at) / run.density(at));
    });
    h.ever = std::fmax(h.ever, h.at_end);
  }
  return h;
}

// Measured: 1 at the end; 1.11, 1.46 on the way (8.5 at Mach 8.64 where faces pull).
TEST(TornGas, StaysCold) {
  for (const double mach : {5.5, 8.64}) {
    const Hottest h = is_cavitating(mach, 200);
    EXPECT_LE(h.at_end, 1.05) << mach;
    EXPECT_LE(h.ever, 1.5) << mach;
  }
}

}  // namespace
}  // namespace sluice::ice::torn_gas_test
