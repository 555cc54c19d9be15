// Blocks that a cohesive zone holds together, in runs: the motion of rigid blocks under the closed
// form of the traction, momentum, energy, and the same bits on boxes and threads.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "mpm/test_support/solid_run.hpp"

namespace sluice::mpm::cohesive_test {
namespace {

constexpr double most_motion = 0.005;    // of D, and of the first speed for it; measured .0013
constexpr double most_way_back = 0.005;  // of delta_n; measured .0016
constexpr double most_energy = 2e-4;     // of the kinetic energy at the start; measured 7e-5
constexpr double most_momentum = 1e-12;  // of sum m |v|; measured 0

// Of the deck cohesive_blocks.
constexpr double sig_max = 0.02, delta_n = 0.03, area = 0.5 * 0.125, mass = 0.25 * 0.5 * 0.125;
constexpr double start_speed = 0.2;

double traction(double d) {
  return sig_max * d / delta_n * std::exp(1 - d / delta_n);
}

// Separation and speed of rigid blocks after a time: m/2 D'' = -A t(D), by Runge and Kutta.
std::pair<double, double> rigid_blocks(double time, double v = start_speed) {
  const int steps = 4000;
  const double dt = time / steps;
  const auto pull = [](double d) { return -area * traction(d) / (0.5 * mass); };
  double d = 0;
  for (int n = 0; n < steps; ++n) {
    const double v1 = v, a1 = pull(d), v2 = v + 0.5 * dt * a1, a2 = pull(d + 0.5 * dt * v1);
    const double v3 = v + 0.5 * dt * a2, a3 = pull(d + 0.5 * dt * v2), v4 = v + dt * a3,
                 a4 = pull(d + dt * v3);
    d += dt / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    v += dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return {d, v};
}

const std::vector<double>& column(const ParticleTable& t, const char* name, int component = 0) {
  return t.find(name)->components[component];
}

double momentum(const ParticleTable& t) {
  double sum = 0;
  for (std::size_t p = 0; p < t.size(); ++p)
    sum += column(t, "p.mass")[p] * column(t, "p.velocity")[p];
  return sum;
}

TEST(CohesiveZones, PullBlocksBackAsTheLawSays) {
  const SolidRun run("cohesive_blocks");
  for (const char* output : {"#3", "#6", "last"}) {
    const ParticleTable points = run.particles(output, 2);
    ASSERT_EQ(points.size(), 8u);
    const Archive archive = run.archive();
    const auto [d, v] = rigid_blocks(archive.select_output(output).time);
    double mean = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
      const double opening = column(points, "cz.separation")[p];
      mean += opening / 8;
      // What stands in the archive is the closed form.
      EXPECT_NEAR(column(points, "cz.force")[p], column(points, "cz.area")[p] * traction(opening),
                  1e-12 * sig_max * area);
      EXPECT_EQ(column(points, "cz.failed")[p], 0);
    }
    EXPECT_NEAR(mean, d, most_motion * d) << output;
    const double left = momentum(run.particles(output, 0)),
                 right = momentum(run.particles(output, 1));
    EXPECT_NEAR((right - left) / mass, v, most_motion * start_speed) << output;
    EXPECT_NEAR(right + left, 0, most_momentum * mass * start_speed) << output;
  }
}

// Of these blocks the zone can take e sig_max delta_n A: slow ones come back.
TEST(CohesiveZones, HoldWhatIsSlow) {
  const double speed = 0.1;
  const std::string velocity = "MaterialProperties/MPM/material[";
  const SolidRun run("cohesive_blocks", {velocity + "1]/geom_object/velocity=[-0.05,0,0]",
                                         velocity + "2]/geom_object/velocity=[0.05,0,0]"});
  const Archive archive = run.archive();
  bool back = false;
  for (const char* output : {"#2", "#4", "#6", "#8", "last"}) {
    const ParticleTable points = run.particles(output, 2);
    const auto [d, v] = rigid_blocks(archive.select_output(output).time, speed);
    back |= v < 0;
    for (const double opening : column(points, "cz.separation"))
      EXPECT_NEAR(opening, d, most_way_back * delta_n) << output;
  }
  EXPECT_TRUE(back);
}

TEST(CohesiveZones, KeepTheEnergyThatOpeningThemTakes) {
  const SolidRun run("cohesive_blocks");
  const ParticleTable points = run.particles("last", 2);
  double held = 0, exact = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double n = column(points, "cz.separation")[p] / delta_n;
    held += column(points, "cz.energy")[p];
    exact += column(points, "cz.area")[p] * std::numbers::e * sig_max * delta_n *
             (1 - std::exp(-n) * (1 + n));
  }
  EXPECT_NEAR(held, exact, 1e-3 * exact);
  const auto json = nlohmann::json::parse(run.report().conservation_json);
  const double kinetic = 2 * 0.5 * mass * 0.25 * start_speed * start_speed;
  EXPECT_LE(std::fabs(json.at("total energy").at("defect").get<double>()), most_energy * kinetic);
}

TEST(CohesiveZones, GiveTheSameBitsOnBoxesAndThreads) {
  const SolidRun plain("cohesive_blocks");
  const SolidRun split("cohesive_blocks", {}, 2, {4, 2, 1});
  for (int material = 0; material < 3; ++material) {
    const ParticleTable a = plain.particles("last", material),
                        b = split.particles("last", material);
    ASSERT_EQ(a.ids, b.ids);
    for (std::size_t c = 0; c < a.columns.size(); ++c)
      EXPECT_EQ(a.columns[c].components, b.columns[c].components) << a.columns[c].info.name;
  }
}

// A failed point loses a thousandth of its traction in each step that opens it.
TEST(CohesiveZones, LoseTheirTractionOnceTheyFail) {
  const SolidRun run("cohesive_blocks", {"MaterialProperties/MPM/cohesive_zone/delta_n_fail=0.01"});
  const ParticleTable points = run.particles("last", 2);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double failed = column(points, "cz.failed")[p];
    EXPECT_GT(failed, 1);
    EXPECT_NEAR(column(points, "cz.force")[p],
                (1 - failed / 1000) * column(points, "cz.area")[p] *
                    traction(column(points, "cz.separation")[p]),
                1e-12 * sig_max * area);
  }
}

}  // namespace
}  // namespace sluice::mpm::cohesive_test
