// What holds bodies, and what they lose: cohesive points, mirrors, rest, lost energy, each alone.
#include <gtest/gtest.h>

#include <cmath>

#include "mpm/step/cohesive_zones.hpp"
#include "mpm/step/energy_books.hpp"
#include "mpm/step/lost_energy.hpp"
#include "mpm/step/mirror_books.hpp"
#include "mpm/step/node_stage.hpp"
#include "mpm/step/particle_temperature.hpp"
#include "mpm/step/resting.hpp"
#include "mpm/test_support/step_arrays.hpp"

namespace sluice::mpm::held_bodies_test {
namespace {

constexpr double round_off = 1e-11;  // measured: 6e-15

SolidDeck block(const std::string& flags) {
  SolidDeck deck;
  deck.flags = "<interpolator>gimp</interpolator><transfer>flip</transfer>" + flags;
  return deck;
}

SolidDeck two_blocks() {
  const auto box = [](const char* low, const char* high, const char* velocity) {
    return std::string("<geom_object><box><min>[") + low + ",0.2,0.2]</min><max>[" + high +
           ",0.6,0.6]</max></box><res>[2,2,2]</res><velocity>[" + velocity +
           ",0,0]</velocity><temperature>300</temperature></geom_object>";
  };
  SolidDeck deck = block("");
  deck.objects = box("0.1", "0.4", "2");
  deck.further = solid_material("second", box("0.4", "0.7", "5"));
  return deck;
}

// First column of what points carry.
std::size_t column_named(const ParticleKind& kind, const std::string& name) {
  std::size_t at = 0;
  for (const ParticleAttribute& a : kind.attributes) {
    if (a.label.name() == name) return at;
    at += static_cast<std::size_t>(a.columns());
  }
  throw std::logic_error("points carry no " + name);
}

// A point pulls both bodies together, and its separation grows by the difference of their ways.
TEST(CohesiveZones, PullBothBodiesAlikeAndOpenAsTheyPart) {
  StepArrays arrays(two_blocks());
  CohesiveZone zone;
  zone.points.push_back({{0.4, 0.41, 0.43}, {1, 0, 0}, {0, 1, 0}, 0.01, 0, 1});
  zone.sig_max = zone.tau_max = 1e4;
  zone.delta_n = zone.delta_t = 0.01;
  zone.delta_n_fail = zone.delta_t_fail = 1;
  arrays.read.solids.cohesive_zones = {zone};
  const ParticleKind kind = cohesive_kind(arrays.solids(), 0);
  ParticleSet points(kind.columns()), next(kind.columns());
  start_cohesive(arrays.solids(), 0, arrays.nodes.level, arrays.nodes.level.domain, points);
  ASSERT_EQ(points.size(), 1u);
  next.make_room(points, kind.advanced_columns());
  const std::size_t force = column_named(kind, "cz.force");
  points.column(force)[0] = 7;
  CohesiveZones zones(arrays.solids(), arrays.method->kinds(), arrays.nodes, arrays.bodies);
  zones.add_points(0, points, next);
  EXPECT_EQ(zones.most_force(0), 7);
  for (Body& body : arrays.bodies) body.most_force = 7;
  arrays.find_units();
  arrays.give({&zones});
  zones.on_sums();
  for (const std::size_t m : {0, 1}) {
    double f = 0;
    arrays.for_each_full(m, arrays.bodies[m].nodes, [&](const std::int64_t* node, IntVec3) {
      f += sum_in(node, 4) / arrays.bodies[m].units.force;
    });
    EXPECT_NEAR(f, m == 0 ? 7 : -7, round_off);
  }
  NodeStage stage(arrays.solids(), arrays.nodes, arrays.bodies, nullptr, nullptr, {});
  stage.move(arrays.scope.step, {}, false);  // no kick
  NodeBooks unused;
  zones.after_nodes({0, 1e-3, {}, 0}, unused);
  const double opened = next.column(column_named(kind, "cz.separation"))[0];
  EXPECT_NEAR(opened, 1e-3 * (5 - 2), round_off);
  // t = sig_max D/delta e^(1 - D/delta)
  const double wanted = 0.01 * 1e4 * 0.3 * std::exp(0.7);
  EXPECT_NEAR(next.column(force)[0], wanted, 1e-9);
  StepReport report(2);
  zones.limit(report);
  EXPECT_GT(report.rate, 0);
  EXPECT_NEAR(report.travel, 1e-3 * 3.5 / 0.1, round_off);  // with the mean of both
}

// A body that leans on a mirror: the particles' momentum along the normal is that of the nodes and
// what the mirror gave.
TEST(MirrorBooks, GiveWhatParticlesBeyondAMirrorGet) {
  SolidDeck deck = block("");
  deck.objects =
      "<geom_object><box><min>[0,0.2,0.2]</min><max>[0.3,0.6,0.6]</max></box><res>[2,2,2]</res>"
      "<velocity>[-2,0,0]</velocity><temperature>300</temperature></geom_object>";
  StepArrays arrays(deck);
  const Columns& c = arrays.columns(0);
  for (std::size_t p = 0; p < arrays.sets[0].size(); ++p)
    arrays.column(0, c.stress)[p] = -1e4;  // it presses on the mirror
  arrays.find_units();
  arrays.give();
  NodeStage stage(arrays.solids(), arrays.nodes, arrays.bodies, nullptr, nullptr, {});
  stage.move(arrays.scope.step, {1e-3, 1e-3, {}, 0}, false);
  // All particles: m sum S dv.
  double got = 0;
  GridAtParticles read;
  Window window(arrays.nodes.shape, 1);
  const Body& body = arrays.bodies[0];
  for (const BlockWork& w : arrays.work) {
    window.load(w.lowest, w.highest, body.table, body.nodes);
    Chunk block = arrays.chunk(0);
    block.work = &w;
    for_each_chunk(block, [&](const Chunk& chunk) {
      read_motion(arrays.solids().basis, body.grid, places_of(*w.set, c), shape_of(*w.set, c),
                  static_cast<int>(chunk.at), chunk.n, window, read);
      for (int q = 0; q < chunk.n; ++q) got += chunk.old(c.mass)[q] * read.dv[0][q];
    });
  }
  const NodeBooks& books = stage.books();
  const double given = books.sums[StepSums::impulse_x].value();
  EXPECT_GT(given, 1);
  EXPECT_NEAR(got, given, 1e-9 * given);
}

// Nothing is lost where all move alike; heat that is due warms by G/(m c).
TEST(LostEnergy, IsNoneOfABodyThatMovesAsAWhole) {
  const SolidDeck deck = block("<lost_energy>heat</lost_energy>");
  StepArrays arrays(deck);
  const Columns& c = arrays.columns(0);
  ASSERT_GE(c.lost_energy, 0);
  arrays.give();
  NodeStage stage(arrays.solids(), arrays.nodes, arrays.bodies, nullptr, nullptr, {});
  stage.move(arrays.scope.step, {1e-3, 1e-3, {}, 0}, false);
  LostEnergy losses(arrays.solids(), arrays.nodes, arrays.bodies, nullptr);
  losses.begin(arrays.scope);
  NodeBooks unused;
  losses.after_nodes({1e-3, 1e-3, {}, 0}, unused);
  for (const BlockWork& w : arrays.work) {
    Chunk block = arrays.chunk(0);
    block.work = &w;
    losses.load(w, 0);
    for_each_chunk(block, [&](const Chunk& chunk) {
      for (int d = 0; d < 3; ++d)
        std::copy_n(chunk.old(c.velocity + d), chunk.n, chunk.made(c.velocity + d));
      std::copy_n(chunk.old(c.energy), chunk.n, chunk.made(c.energy));
      std::fill_n(chunk.made(c.temperature), chunk.n, 300.0);
      for (double* L : chunk.read().L) std::fill_n(L, chunk.n, 0.0);
      losses.moved(chunk);
      losses.to_particles(chunk);
      for (int q = 0; q < chunk.n; ++q) {
        EXPECT_NEAR(chunk.made(c.lost_energy)[q], 0, round_off);
        EXPECT_NEAR(chunk.made(c.lost_heat)[q], 0, round_off);
        chunk.made(c.lost_heat)[q] = 3;  // J
      }
    });
  }
  losses.give_heat(arrays.work, 0, 0.5, 1e-3);
  const double mass = arrays.column(0, c.mass)[0];
  EXPECT_NEAR(arrays.made(0, c.lost_heat)[0], 1.5, round_off);
  EXPECT_NEAR(arrays.made(0, c.temperature)[0], 300 + 1.5 / (mass * 5), 1e-9);
}

// What rests is what it was; bounds stay, and what awakes counts for the length of the next step.
TEST(Resting, KeepsParticlesAndBounds) {
  SolidDeck deck = block("");
  deck.material = "<is_active>false</is_active><activation_time>0.5</activation_time>";
  StepArrays arrays(deck);
  arrays.bodies[0].rates.wave = 100;  // 1/s
  StepScope step;
  step.time = 0.1;
  step.dt = 0.1;
  std::vector<KindRates> rates(1);
  EXPECT_EQ(keep_resting(arrays.nodes.level, arrays.bodies, step, rates), 0);
  EXPECT_EQ(rates[0].mass, arrays.bodies[0].rates.mass);
  step.time = 0.45;
  // c/h + |v|/h of the largest component, 3 m/s in cells of 0.1 m
  EXPECT_NEAR(keep_resting(arrays.nodes.level, arrays.bodies, step, rates), 100 + 30, 1e-9);
}

TEST(SavedHeating, IsTheRateOfTemperature) {
  SolidDeck deck = block("");
  StepArrays arrays(deck);
  EXPECT_FALSE(SavedHeating::possible(arrays.method->carried()));
  std::vector<Carried> carried = arrays.method->carried();
  // Any column that a step makes can hold it.
  carried[0].columns.heating = carried[0].columns.energy;
  EXPECT_TRUE(SavedHeating::possible(carried));
  arrays.bodies[0].carried = carried.data();
  const Chunk chunk = arrays.chunk(0);
  for (int q = 0; q < chunk.n; ++q) chunk.made(chunk.columns().temperature)[q] = 300 + q;
  SavedHeating().to_particles(chunk);
  for (int q = 0; q < chunk.n; ++q)
    EXPECT_NEAR(chunk.made(carried[0].columns.energy)[q], q / arrays.scope.step.dt, 1e-6);
}

// Particles as they were have lost no neighbour; one that is nine times as long has.
TEST(PartedBooks, CountParticlesThatLostTheirNeighbours) {
  StepArrays arrays(block(""));
  const Columns& c = arrays.columns(0);
  ASSERT_TRUE(PartedBooks::possible(arrays.solids(), arrays.method->carried(), arrays.nodes.level));
  PartedBooks books(arrays.solids(), arrays.method->carried(), arrays.nodes.level);
  const Chunk chunk = arrays.chunk(0);
  for (int e = 0; e < 9; ++e)
    for (int q = 0; q < chunk.n; ++q)
      chunk.made(c.F + e)[q] = e % 4 != 0 ? 0 : (e == 0 && q == 1 ? 9 : 1);
  books.to_particles(chunk);
  const BodyEnergySums& sums = arrays.report.books.bodies[0];
  EXPECT_EQ(sums[BodyEnergySums::particles].value(), chunk.n);
  EXPECT_EQ(sums[BodyEnergySums::parted].value(), 1);
}

}  // namespace
}  // namespace sluice::mpm::held_bodies_test
