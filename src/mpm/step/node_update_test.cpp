// The step on nodes against v* = v + dk (f/M - alpha v + g), with its books; a prescribed motion.
#include "mpm/step/node_update.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mpm/step/node_stage.hpp"
#include "mpm/test_support/step_arrays.hpp"

namespace sluice::mpm::node_update_test {
namespace {

constexpr double round_off = 1e-12;  // measured: 2e-15

const NodeStep step{0.02, 0.02, {0.5, 0, -9.81}, 3};

// Velocities that differ among particles; `free`: sides give nothing.
SolidDeck block() {
  SolidDeck deck;
  deck.flags = "<interpolator>gimp</interpolator>";
  return deck;
}

void spread_velocities(StepArrays& arrays) {
  const Columns& c = arrays.columns(0);
  for (int d = 0; d < 3; ++d)
    for (std::size_t p = 0; p < arrays.sets[0].size(); ++p)
      arrays.column(0, c.velocity + d)[p] = 1 + d + 3 * arrays.sets[0].position(p).x;
  for (int n = 0; n < 6; ++n)
    for (std::size_t p = 0; p < arrays.sets[0].size(); ++p)
      arrays.column(0, c.stress + n)[p] = 1e3 * (n + 1) * arrays.sets[0].position(p).y;
  arrays.find_units();
  arrays.give();
}

TEST(NodeUpdate, MovesNodesByForcesDampingAndGravity) {
  StepArrays arrays(block());
  spread_velocities(arrays);
  const Body before = arrays.bodies[0];
  const NodeUpdate update(arrays.nodes, arrays.bodies, {});
  NodeBooks books;
  books.make_room(1);
  BlockImpulses impulses;
  for (int b = 0; b < before.table.count(); ++b) update.move(step, {0, b}, impulses, books);
  const Body& body = arrays.bodies[0];
  double gain = 0, worst = 0;
  for (int b = 0; b < body.table.count(); ++b)
    for (int n = 0; n < block_lanes; n += lanes) {
      const std::int64_t *sums = before.nodes.sums(b) + n, *node = body.nodes.sums(b) + n;
      const double M = sum_in(sums, 0) / body.units.mass;
      if (sums[count_lane] == 0 || M == 0) continue;
      Vec3 v, after;
      for (int d = 0; d < 3; ++d) {
        v[d] = body.units.reference[d] + sum_in(sums, 1 + d) / body.units.momentum / M;
        const double f = sum_in(sums, 4 + d) / body.units.force;
        after[d] = v[d] + step.kick * (f / M - step.damping * v[d] + step.gravity[d]);
        const double found = as_real(node[d]) + body.units.reference[d];
        worst = std::fmax(worst, std::fabs(found - after[d]) / (1 + std::fabs(after[d])));
        EXPECT_NEAR(as_real(node[4 + d]), after[d] - v[d], round_off * (1 + std::fabs(after[d])));
      }
      EXPECT_NEAR(as_real(node[3]), M, round_off * M);
      gain += 0.5 * M * (dot(after, after) - dot(v, v));
    }
  EXPECT_LT(worst, round_off);
  const double booked = books.body(0)[BodyEnergySums::node_gain].value();
  EXPECT_NEAR(booked, gain, round_off * std::fabs(gain));
}

// The work of forces, of gravity and damping is the gain of kinetic energy.
TEST(NodeStage, BooksWhatItMoves) {
  StepArrays arrays(block());
  spread_velocities(arrays);
  NodeStage stage(arrays.solids(), arrays.nodes, arrays.bodies, nullptr, nullptr, {});
  stage.move(arrays.scope.step, step, false);
  NodeBooks& books = stage.books();
  const double gain = books.body(0)[BodyEnergySums::node_gain].value();
  const double work =
      books.body(0)[BodyEnergySums::node_work].value() + books.sums[StepSums::force_work].value();
  EXPECT_GT(std::fabs(gain), 1);
  EXPECT_NEAR(work, gain, 1e-10 * std::fabs(gain));
}

TEST(NodeUpdate, GivesAPrescribedMotion) {
  StepArrays arrays(block());
  arrays.give();
  const NodeUpdate update(arrays.nodes, arrays.bodies, {});
  const std::array<double, 9> G = {0.1, 0.2, 0, 0, -0.3, 0, 0.4, 0, 0.5};
  Body& body = arrays.bodies[0];
  for (int b = 0; b < body.table.count(); ++b) update.prescribe(G, {0, b});
  arrays.for_each_full(0, body.nodes, [&](const std::int64_t* node, IntVec3 at) {
    const Vec3 x = arrays.nodes.place(at);
    const double wanted[3] = {0.1 * x.x + 0.2 * x.y, -0.3 * x.y, 0.4 * x.x + 0.5 * x.z};
    for (int d = 0; d < 3; ++d) {
      EXPECT_NEAR(as_real(node[d]) + body.units.reference[d], wanted[d], round_off);
      EXPECT_EQ(as_real(node[4 + d]), 0);
    }
  });
}

}  // namespace
}  // namespace sluice::mpm::node_update_test
