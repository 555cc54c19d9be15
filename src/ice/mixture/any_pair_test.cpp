// Two materials of any pair of equations of state, in equilibrium and moving together: pressure,
// temperature and velocity stay uniform, from sharp edges to traces of 1e-12 of a cell.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "eos/eos_test_support.hpp"
#include "ice/test_support/mixture.hpp"

namespace sluice::ice::any_pair_test {
namespace {

constexpr double pressure = 1e7, temperature = 300;  // where every law has a state; Pa, K
constexpr double velocity = 300;                     // m/s
constexpr double allowed = 1e-10;                    // relative
constexpr int cells = 24, steps = 150;

std::vector<Fluid> one_of_each() {
  std::vector<Fluid> all;
  for (const eos::EquationOfState& law : eos::one_of_each())
    all.push_back({law, std::nullopt, 1.4, 1000});
  return all;
}

// Shares of the second material in a slab and around it.
struct Shares {
  const char* name;
  double inside, around;
};

std::function<MixtureCell(Vec3)> slab(const Fluid& a, const Fluid& b, const Shares& of_b) {
  const std::vector<double> densities = {a.density(pressure, temperature),
                                         b.density(pressure, temperature)};
  return [=](Vec3 x) {
    const double share = x.x > .3 && x.x < .7 ? of_b.inside : of_b.around;
    MixtureCell c;
    c.volume = {1 - share, share};
    c.density = densities;
    c.pressure = {pressure, pressure};
    c.velocity[0] = velocity;
    return c;
  };
}

struct Distances {
  double p = 0, u = 0, T = 0;  // the largest, relative
};

void keep_larger(double& largest, double value, double wanted) {
  const double distance = std::fabs(value / wanted - 1);
  if (!(distance <= largest)) largest = distance;  // a NaN stays
}

Distances distances(const MixtureBox& run, const Fluid* fluids) {
  Distances d;
  for_each_cell(run.domain(), [&](IntVec3 c) {
    keep_larger(d.p, run.pressure(c), pressure);
    for (int m = 0; m < 2; ++m) {
      if (run.mass(m, c) == 0) continue;
      const double V = run.volume(m, c);
      const double u = run.is_multi_velocity() ? run.velocity_of(m, c) : run.velocity(c);
      keep_larger(d.T, fluids[m].temperature(run.mass(m, c) / V, run.energy(m, c) / V),
                  temperature);
      keep_larger(d.u, u, velocity);
    }
  });
  return d;
}

struct Pairs {
  double drag;
  std::size_t every;  // of how many pairs one
};
class AnyPair : public testing::TestWithParam<Pairs> {};

TEST_P(AnyPair, StaysInEquilibriumOnItsWay) {
  constexpr Shares starts[] = {{"sharp", 1, 0},
                               {"traces in each other", 1 - 1e-12, 1e-12},
                               {"a trace alone", 1e-12, 0},
                               {"a trace of the first alone", 1 - 1e-12, 1},
                               {"mixed", .7, 1e-4}};
  const std::vector<Fluid> laws = one_of_each();
  GasBox box;
  box.cells = {cells, 1, 1};
  box.scheme = "conservative";
  Distances worst;
  for (std::size_t a = 0; a < laws.size(); ++a)
    for (std::size_t b = a + 1; b < laws.size(); ++b)
      for (const Shares& start : starts) {
        if ((a + b) % GetParam().every != 0) continue;
        SCOPED_TRACE(testing::Message() << "laws " << a << " and " << b << ", " << start.name);
        const Fluid pair[] = {laws[a], laws[b]};
        MixtureBox run(box, {laws[a], laws[b]}, slab(laws[a], laws[b], start), {}, {}, {},
                       GetParam().drag);
        run.steps(steps);
        const Distances d = distances(run, pair);
        EXPECT_LE(d.p, allowed);
        EXPECT_LE(d.u, allowed);
        EXPECT_LE(d.T, allowed);
        EXPECT_EQ(run.rejected(), 0);
        worst = {std::fmax(worst.p, d.p), std::fmax(worst.u, d.u), std::fmax(worst.T, d.T)};
      }
  for (const auto& [name, value] :
       {std::pair("pressure", worst.p), {"velocity", worst.u}, {"temperature", worst.T}}) {
    std::ostringstream text;
    text << value;
    RecordProperty(name, text.str());
  }
}

INSTANTIATE_TEST_SUITE_P(Some, AnyPair,
                         testing::Values(Pairs{0, 4}, Pairs{one_velocity_coefficient, 4}));
INSTANTIATE_TEST_SUITE_P(Full, AnyPair,
                         testing::Values(Pairs{0, 1}, Pairs{one_velocity_coefficient, 1}));

}  // namespace
}  // namespace sluice::ice::any_pair_test
