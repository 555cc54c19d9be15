// Particles to nodes and back: sums against those of particles, and fields that each stage keeps.
#include <gtest/gtest.h>

#include <cmath>

#include "mpm/step/mean_on_nodes.hpp"
#include "mpm/step/midpoint_books.hpp"
#include "mpm/step/node_stage.hpp"
#include "mpm/step/nodes_to_particles.hpp"
#include "mpm/step/xpic_filter.hpp"
#include "mpm/test_support/step_arrays.hpp"

namespace sluice::mpm::transfer_stages_test {
namespace {

constexpr double round_off = 1e-10;  // measured: 4e-13

SolidDeck block(const std::string& flags) {
  SolidDeck deck;
  deck.flags = flags;
  if (flags.find("<transfer>") == std::string::npos) deck.flags += "<transfer>flip</transfer>";
  // Free sides.
  for (const char* side : {"x-", "x+", "y-", "y+", "z-", "z+"})
    deck.faces += std::string("<Face side='") + side +
                  "'><BCType id='all' label='Velocity' var='Neumann'><value>[0,0,0]</value>"
                  "</BCType></Face>\n";
  return deck;
}

// Velocity v = v_0 + G x of all particles.
constexpr double slope = 7;
void shear(StepArrays& arrays) {
  double* v = arrays.column(0, arrays.columns(0).velocity);
  for (std::size_t p = 0; p < arrays.sets[0].size(); ++p)
    v[p] = 1 + slope * arrays.sets[0].position(p).y;
  arrays.find_units();
}

void move_nodes(StepArrays& arrays) {
  NodeStage stage(arrays.solids(), arrays.nodes, arrays.bodies, nullptr, nullptr, {});
  stage.move(arrays.scope.step, {1e-3, 1e-3, {}, 0}, false);
}

// act(chunk) for all chunks of the particles of the body.
template <class Act>
void for_all(StepArrays& arrays, Act&& act) {
  for (const BlockWork& w : arrays.work) {
    Chunk block = arrays.chunk(0);
    block.work = &w;
    for_each_chunk(block, act);
  }
}

TEST(ParticlesToNodes, KeepMassAndMomentumAndBalanceForces) {
  for (const char* basis : {"linear", "gimp", "cpdi"}) {
    StepArrays arrays(block(std::string("<interpolator>") + basis + "</interpolator>"));
    shear(arrays);
    const Columns& c = arrays.columns(0);
    double mass = 0, momentum = 0;
    for (std::size_t p = 0; p < arrays.sets[0].size(); ++p) {
      for (int n = 0; n < 6; ++n) arrays.column(0, c.stress + n)[p] = 1e4 * (n + 1);
      mass += arrays.column(0, c.mass)[p];
      momentum += arrays.column(0, c.mass)[p] * arrays.column(0, c.velocity)[p];
    }
    arrays.find_units();
    arrays.give();
    const Body& body = arrays.bodies[0];
    double M = 0, P = 0, size = 0;
    Vec3 f{};
    arrays.for_each_full(0, body.nodes, [&](const std::int64_t* node, IntVec3) {
      M += sum_in(node, 0) / body.units.mass;
      P += sum_in(node, 1) / body.units.momentum +
           sum_in(node, 0) / body.units.mass * body.units.reference.x;
      for (int d = 0; d < 3; ++d) {
        f[d] += sum_in(node, 4 + d) / body.units.force;
        size += std::fabs(sum_in(node, 4 + d) / body.units.force);
      }
    });
    EXPECT_NEAR(M, mass, round_off * mass) << basis;
    EXPECT_NEAR(P, momentum, round_off * std::fabs(momentum)) << basis;
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(f[d], 0, round_off * size) << basis;
  }
}

// A body of one velocity: nodes have it, mapped back and filtered too.
TEST(MappedBack, KeepsOneVelocity) {
  StepArrays arrays(block("<interpolator>gimp</interpolator><musl>true</musl>"));
  arrays.give();
  move_nodes(arrays);
  const Columns& c = arrays.columns(0);
  for (int d = 0; d < 3; ++d)
    std::fill_n(arrays.nexts[0].column(static_cast<std::size_t>(c.velocity + d)),
                arrays.sets[0].size(), 2.0 * d - 1);
  MappedBack mapped(arrays.solids(), arrays.nodes, arrays.bodies, nullptr);
  KindRates bounds;
  bounds.up = {-1, 1, 3};
  bounds.down = {1, -1, -3};
  const Vec3 spacing = arrays.nodes.level.spacing;
  mapped.sum(arrays.work, {spacing, spacing}, std::span(&bounds, 1));
  mapped.finish();
  int full = 0;
  arrays.for_each_full(0, arrays.bodies[0].nodes, [&](const std::int64_t*, IntVec3 at) {
    const BlockShape& shape = arrays.nodes.shape;
    const int block = arrays.bodies[0].table.find(shape.block_of(at));
    const std::int64_t* node = mapped.of(0).sums(block) + shape.place(at) * lanes;
    ++full;
    for (int d = 0; d < 3; ++d)
      EXPECT_NEAR(as_real(node[d]) + mapped.units(0).reference[d], 2.0 * d - 1, round_off);
  });
  EXPECT_GT(full, 100);
}

TEST(XpicFilter, AVelocityThatNodesCanHoldPassesUnchanged) {
  StepArrays arrays(block("<interpolator>gimp</interpolator>"));
  arrays.give();
  move_nodes(arrays);
  XpicFilter filter(arrays.solids(), arrays.nodes, arrays.bodies);
  const std::vector<double> most = filter.take_velocities();
  // All move alike: relative to v_ref nothing does, but for rounding.
  EXPECT_LT(most[0], round_off);
  filter.begin(most);
  filter.sum(arrays.work, true);
  filter.finish();
  arrays.for_each_full(0, arrays.bodies[0].nodes, [&](const std::int64_t*, IntVec3 at) {
    const BlockShape& shape = arrays.nodes.shape;
    const int block = arrays.bodies[0].table.find(shape.block_of(at));
    const std::int64_t* v = filter.velocities(0).sums(block) + shape.place(at) * lanes;
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(as_real(v[d]), 0, round_off);
  });
}

// Linear hats hold v = v_0 + G x in a body without sides: L is G, and particles go with v.
TEST(OnePassMotion, ReadsAUniformGradient) {
  StepArrays arrays(block("<interpolator>linear</interpolator>"));
  arrays.give();
  move_nodes(arrays);
  Body& body = arrays.bodies[0];
  for (int b = 0; b < body.table.count(); ++b)  // the nodes' own field
    for_each_node(arrays.nodes.shape, arrays.nodes.lower(body.table, b), [&](int n, IntVec3 at) {
      std::int64_t* node = body.nodes.sums(b) + n * lanes;
      const double wanted[3] = {1 + slope * arrays.nodes.place(at).y, 0, 0};
      for (int d = 0; d < 3; ++d) {
        node[d] = as_bits(wanted[d] - body.units.reference[d]);
        node[4 + d] = as_bits(0.0);
      }
    });
  const OnePassMotion motion(arrays.solids(), arrays.nodes.level);
  const double dt = arrays.scope.step.dt;
  for (const BlockWork& w : arrays.work) {
    Chunk block = arrays.chunk(0);
    block.work = &w;
    motion.load(w, body, arrays.buffers);
    for_each_chunk(block, [&](const Chunk& chunk) {
      motion.last(chunk);
      for (int q = 0; q < chunk.n; ++q) {
        const std::size_t p = chunk.at + static_cast<std::size_t>(q);
        const Vec3 x = w.set->position(p);
        for (int e = 0; e < 9; ++e)
          EXPECT_NEAR(chunk.read().L[e][q], e == 1 ? slope : 0.0, round_off);
        EXPECT_NEAR(w.next->position(p).x, x.x + dt * (1 + slope * x.y), round_off);
      }
    });
  }
  EXPECT_NEAR(arrays.report.travel, dt * (1 + slope * 0.575) / arrays.nodes.level.spacing.x, 1e-9);
  EXPECT_FALSE(arrays.report.left);
}

TEST(RigidMotion, GoesWithItsOwnVelocity) {
  StepArrays arrays(block("<interpolator>linear</interpolator>"));
  arrays.bodies[0].units.reference = {};  // as that of rigid bodies
  const OutsideForces outside(arrays.solids(), arrays.nodes.level, arrays.method->carried());
  const TransmittedForces none(arrays.solids(), arrays.method->carried(), arrays.work, outside,
                               nullptr);
  const RigidMotion motion(arrays.solids(), arrays.nodes.level, nullptr, none);
  for_all(arrays, [&](const Chunk& chunk) {
    motion.first(chunk);
    for (int q = 0; q < chunk.n; ++q) {
      const std::size_t p = chunk.at + static_cast<std::size_t>(q);
      const Vec3 way = chunk.work->next->position(p) - chunk.work->set->position(p);
      for (int d = 0; d < 3; ++d) EXPECT_NEAR(way[d], arrays.scope.step.dt * (d + 1), 1e-15);
    }
  });
}

// (I + dt L') of what to_end_of_step() leaves turns without strain, whatever the angle.
TEST(MidpointMotion, EndsAStepThatTurnsWithoutStrain) {
  GridAtParticles read;
  const double rate = 50, dt = 0.01;
  for (double* L : read.L) std::fill_n(L, chunk_size, 0.0);
  read.L[1][0] = -rate;
  read.L[3][0] = rate;
  to_end_of_step(dt, 1, read);
  const double a = 1 + dt * read.L[0][0], b = dt * read.L[1][0], c = dt * read.L[3][0],
               d = 1 + dt * read.L[4][0];
  EXPECT_NEAR(a * a + c * c, 1, 1e-14);
  EXPECT_NEAR(a * b + c * d, 0, 1e-14);
  EXPECT_NEAR(std::atan2(c, a), 2 * std::atan(0.5 * rate * dt), 1e-14);
}

TEST(MidpointMotion, KicksParticlesToTheMiddleOfTheStep) {
  StepArrays arrays(
      block("<interpolator>gimp</interpolator><transfer>midpoint"
            "</transfer>"));
  arrays.give();
  NodeStage stage(arrays.solids(), arrays.nodes, arrays.bodies, nullptr, nullptr, {});
  stage.move(arrays.scope.step, {0.01, 0.01, {0, 0, -10}, 0}, false);
  const OutsideForces outside(arrays.solids(), arrays.nodes.level, arrays.method->carried());
  const MappedBack mapped(arrays.solids(), arrays.nodes, arrays.bodies, nullptr);
  const MidpointMotion motion(arrays.solids(), arrays.nodes, outside, mapped);
  const double dt = arrays.scope.step.dt;
  for (BlockWork& w : arrays.work) {
    Chunk block = arrays.chunk(0);
    block.work = &w;
    motion.load_first(w, arrays.bodies[0], arrays.buffers);
    for_each_chunk(block, [&](const Chunk& chunk) {
      motion.first(chunk);
      for (int q = 0; q < chunk.n; ++q) {
        const std::size_t p = chunk.at + static_cast<std::size_t>(q);
        const double v = 3 - 0.1;  // v_z, and g over the kick
        EXPECT_NEAR(chunk.made(chunk.columns().velocity + 2)[q], v, round_off);
        EXPECT_NEAR(w.next->position(p).z, w.set->position(p).z + 0.5 * dt * v, round_off);
        for (int k = 0; k < 3; ++k)
          EXPECT_NEAR(chunk.made(chunk.columns().spin + k)[q], 0, round_off);
      }
    });
    motion.end_first(w, block);
    for (int d = 0; d < 3; ++d) EXPECT_LE(w.middle_lowest[d], w.middle_highest[d]);
  }
}

// A body of one velocity stays what it is, and is where it goes.
TEST(NodesToParticles, ABodyThatMovesAsAWholeKeepsItsState) {
  for (const bool musl : {false, true}) {
    StepArrays arrays(block(std::string("<interpolator>gimp</interpolator><musl>") +
                            (musl ? "true" : "false") + "</musl>"));
    arrays.give();
    move_nodes(arrays);
    std::unique_ptr<MappedBack> mapped;
    if (arrays.solids().maps_back())
      mapped = std::make_unique<MappedBack>(arrays.solids(), arrays.nodes, arrays.bodies, nullptr);
    const SolidParts parts{&arrays.read.scene, &arrays.solids(), &arrays.method->carried(),
                           &arrays.method->kinds()};
    const SolidEffects effects(parts, arrays.nodes, arrays.bodies, arrays.work, nullptr,
                               mapped.get());
    for (SolidEffect* effect : effects.all()) effect->begin(arrays.scope);
    NodesToParticles stage(arrays.solids(), arrays.nodes, arrays.bodies, effects, nullptr,
                           mapped.get());
    if (mapped != nullptr) {
      std::string fault;
      const std::vector<KindRates> bounds = stage.first_pass(arrays.scope, arrays.work, fault);
      EXPECT_EQ(fault, "");
      const Vec3 h = arrays.nodes.level.spacing;
      mapped->sum(arrays.work, {h, h}, bounds);
      mapped->finish();
    }
    const StepReport all = stage.last_pass(arrays.scope, arrays.work);
    EXPECT_EQ(all.fault, "");
    EXPECT_GT(all.rate, 0);
    const Columns& c = arrays.columns(0);
    for (std::size_t p = 0; p < arrays.sets[0].size(); ++p)
      for (int d = 0; d < 3; ++d) {
        EXPECT_NEAR(arrays.made(0, c.F + 4 * d)[p], 1, round_off);
        EXPECT_NEAR(arrays.made(0, c.stress + d)[p], 0, 1e6 * round_off);
        EXPECT_NEAR(arrays.made(0, c.velocity + d)[p], 1.0 + d, round_off);
        EXPECT_NEAR(arrays.nexts[0].position(p)[d],
                    arrays.sets[0].position(p)[d] + arrays.scope.step.dt * (d + 1), round_off);
      }
  }
}

// Particles of one cell get the ratio of their volumes together.
TEST(SharedDilatation, IsOneForAllParticlesOfACell) {
  StepArrays arrays(block("<interpolator>gimp</interpolator>"));
  arrays.give();
  move_nodes(arrays);
  const Columns& c = arrays.columns(0);
  for (std::size_t p = 0; p < arrays.sets[0].size(); p += 2)  // every other one is stretched by 4 %
    arrays.column(0, c.F)[p] = 1.04;
  const OnePassMotion motion(arrays.solids(), arrays.nodes.level);
  const SharedDilatation dilatation(arrays.solids(), arrays.nodes);
  std::vector<double> shared;
  for (const BlockWork& w : arrays.work) {
    Chunk block = arrays.chunk(0);
    block.work = &w;
    block.at = w.run.begin;
    motion.load(w, arrays.bodies[0], arrays.buffers);
    dilatation.find(motion, block, shared);
    ASSERT_EQ(shared.size(), w.run.end - w.run.begin);
    for (const double J : shared) EXPECT_NEAR(J, 1.02, 1e-9);
  }
}

TEST(MeanOnNodes, OfALinearFieldIsTheFieldWhereABodyIsWhole) {
  StepArrays arrays(block("<interpolator>linear</interpolator>"));
  double* T = arrays.column(0, arrays.columns(0).temperature);
  for (std::size_t p = 0; p < arrays.sets[0].size(); ++p)
    T[p] = 300 + 100 * arrays.sets[0].position(p).x;
  arrays.give();
  const Columns& c = arrays.columns(0);
  const std::vector<NodeMean> means =
      mean_on_nodes(arrays.solids(), arrays.nodes, arrays.bodies[0], 0, arrays.work, world(),
                    {c.mass, c.temperature, 1});
  int inside = 0;
  for (const NodeMean& m : means) {
    bool whole = true;
    for (int d = 0; d < 3; ++d) whole = whole && m.node[d] > 2 && m.node[d] < 6;
    if (!whole) continue;
    ++inside;
    EXPECT_NEAR(m.mean[0], 300 + 100 * arrays.nodes.place(m.node).x, 1e-9);
  }
  EXPECT_EQ(inside, 27);
}

}  // namespace
}  // namespace sluice::mpm::transfer_stages_test
