// A scene has the effects that it asks for; each effect of a step alone, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <typeinfo>

#include "mpm/step/artificial_viscosity.hpp"
#include "mpm/step/energy_books.hpp"
#include "mpm/step/heat.hpp"
#include "mpm/step/jumps.hpp"
#include "mpm/step/loads_on_particles.hpp"
#include "mpm/step/node_stage.hpp"
#include "mpm/step/particle_temperature.hpp"
#include "mpm/step/pore_water.hpp"
#include "mpm/step/solid_effects.hpp"
#include "mpm/step/step_outcome.hpp"
#include "mpm/test_support/step_arrays.hpp"

namespace sluice::mpm::effects_of_scene_test {
namespace {

constexpr double round_off = 1e-11;  // measured: 2e-13

SolidDeck block(const std::string& flags) {
  SolidDeck deck;
  deck.flags = "<interpolator>gimp</interpolator><transfer>flip</transfer>" + flags;
  return deck;
}

struct Made {
  explicit Made(const SolidDeck& deck)
      : arrays(deck),
        effects({&arrays.read.scene, &arrays.solids(), &arrays.method->carried(),
                 &arrays.method->kinds()},
                arrays.nodes, arrays.bodies, arrays.work, nullptr, nullptr) {}
  template <class Kind>
  int count() const {
    int n = 0;
    for (SolidEffect* effect : effects.all()) n += typeid(*effect) == typeid(Kind) ? 1 : 0;
    return n;
  }
  StepArrays arrays;
  SolidEffects effects;
};

const char* const no_heat = "<DoExplicitHeatConduction>false</DoExplicitHeatConduction>";

TEST(SolidEffects, AreThoseThatASceneAsksFor) {
  const Made plain(block(no_heat));
  // Forces on corners, bodies that transmit forces, heat of the law, books: without arrays of
  // nodes or particles.
  EXPECT_EQ(plain.count<CornerForces>() + plain.count<TransmittedForces>() +
                plain.count<HeatOfLaw>() + plain.count<EnergyBooks>() + plain.count<PartedBooks>(),
            static_cast<int>(plain.effects.all().size()));
  EXPECT_FALSE(plain.effects.pushes());
  EXPECT_EQ(plain.effects.friction(), nullptr);
  EXPECT_EQ(plain.effects.losses(), nullptr);
  EXPECT_EQ(Made(block("")).count<Heat>(), 1);
  EXPECT_EQ(Made(block(std::string(no_heat) + "<artificial_viscosity>true</artificial_viscosity>"))
                .count<ArtificialViscosity>(),
            1);
  EXPECT_EQ(Made(block(std::string(no_heat) + "<RunMMSProblem>AxisAligned</RunMMSProblem>"))
                .count<LoadsOnParticles>(),
            1);
}

// The force goes to nodes as it is, with its work: dk f . (v + v*)/2, here with v = v* = v_0.
TEST(CornerForces, GiveNodesForceAndWork) {
  StepArrays arrays(block(no_heat));
  const OutsideForces outside(arrays.solids(), arrays.nodes.level, arrays.method->carried());
  CornerForces corners(arrays.solids(), arrays.nodes, arrays.bodies, arrays.work, outside, nullptr);
  corners.begin(arrays.scope);
  const CornerForce force{{0.43, 0.37, 0.52}, {3, -1, 2}};
  corners.add(0, std::span(&force, 1));
  arrays.bodies[0].most_force = 3;
  arrays.find_units();
  arrays.give({&corners});
  const Body& body = arrays.bodies[0];
  Vec3 sum{};
  arrays.for_each_full(0, body.nodes, [&](const std::int64_t* node, IntVec3) {
    for (int d = 0; d < 3; ++d) sum[d] += sum_in(node, 4 + d) / body.units.force;
  });
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(sum[d], force.force[d], round_off);
  NodeStage stage(arrays.solids(), arrays.nodes, arrays.bodies, nullptr, nullptr, {});
  stage.move(arrays.scope.step, {}, false);  // no kick
  NodeBooks books;
  books.make_room(1);
  corners.after_nodes({0.5, 0.5, {}, 0}, books);
  const double work = 0.5 * (3 * 1 - 1 * 2 + 2 * 3);  // velocity 1, 2, 3
  EXPECT_NEAR(books.body(0)[BodyEnergySums::corner_work].value(), work, round_off);
  EXPECT_EQ(books.body(0)[BodyEnergySums::load_work].value(), 0);
}

// Impulse dk sum f and work dk sum f . u of what acts on particles.
TEST(LoadsOnParticles, BookImpulseAndWork) {
  StepArrays arrays(block(std::string(no_heat) + "<RunMMSProblem>AxisAligned</RunMMSProblem>"));
  OutsideForces outside(arrays.solids(), arrays.nodes.level, arrays.method->carried());
  const std::size_t count = arrays.sets[0].size();
  outside.make_room(0, count);
  outside.fill(0, 0, arrays.sets[0], 0, count, 1e-3);
  LoadsOnParticles loads(arrays.solids(), outside, arrays.nodes, arrays.work);
  NodeBooks unused;
  loads.after_nodes({0.25, 0.25, {}, 0}, unused);
  ParticlesToGrid columns;
  loads.give(arrays.work.front(), columns);
  ASSERT_NE(columns.load[0], nullptr);
  Vec3 sum{};
  double power = 0;
  for (std::size_t p = 0; p < count; ++p)
    for (int d = 0; d < 3; ++d) {
      sum[d] += columns.load[static_cast<std::size_t>(d)][p];
      power += (d + 0.5) * columns.load[static_cast<std::size_t>(d)][p];
    }
  for (const BlockWork& w : arrays.work) {
    Chunk block = arrays.chunk(0);
    block.work = &w;
    for_each_chunk(block, [&](const Chunk& chunk) {
      for (int d = 0; d < 3; ++d) {
        std::fill_n(chunk.read().u[d], chunk.n, d + 1 - chunk.body->units.reference[d]);
        std::fill_n(chunk.read().dv[d], chunk.n, 1.0);
      }
      loads.moved(chunk);
    });
  }
  const NodeBooks& books = arrays.report.books;
  EXPECT_GT(std::fabs(sum.x), 1e-6);
  for (int d = 0; d < 3; ++d)
    EXPECT_NEAR(books.sums[static_cast<std::size_t>(StepSums::force_x + d)].value(), 0.25 * sum[d],
                round_off * (1 + std::fabs(sum[d])));
  EXPECT_NEAR(books.sums[StepSums::force_work].value(), 0.25 * power,
              round_off * (1 + std::fabs(power)));
}

// q = rho (A_1 c_b |tr D| h + A_2 (tr D h)^2) in compression alone; the waves are faster then.
TEST(ArtificialViscosity, IsThatOfItsFormula) {
  StepArrays arrays(block(std::string(no_heat) +
                          "<artificial_viscosity>true</artificial_viscosity>"
                          "<artificial_viscosity_coeff1>0.2</artificial_viscosity_coeff1>"
                          "<artificial_viscosity_coeff2>2</artificial_viscosity_coeff2>"));
  ArtificialViscosity viscosity(arrays.solids(), arrays.method->carried(), arrays.nodes.level);
  const Chunk chunk = arrays.chunk(0);
  ASSERT_GT(chunk.n, 1);
  for (double* L : chunk.read().L) std::fill_n(L, chunk.n, 0.0);
  chunk.read().L[0][0] = -20;  // 1/s
  chunk.read().L[0][1] = 20;
  const double c = 30, h = 0.1, K = 1e6;
  std::fill_n(chunk.buffers->wave_speed, chunk.n, c);
  std::fill_n(chunk.buffers->heating, chunk.n, 0.0);
  std::copy_n(chunk.old(chunk.columns().volume), chunk.n, chunk.made(chunk.columns().volume));
  viscosity.to_particles(chunk);
  const double rho = 1000, squeeze = 20 * h, Q = 0.2 * std::sqrt(K / rho) + 2 * squeeze;
  const double* q = chunk.made(chunk.columns().viscous);
  EXPECT_NEAR(q[0], rho * Q * squeeze, 1e-9 * q[0]);
  EXPECT_EQ(q[1], 0);
  EXPECT_NEAR(chunk.buffers->wave_speed[0], Q + std::sqrt(Q * Q + c * c), 1e-9);
  EXPECT_EQ(chunk.buffers->wave_speed[1], c);
}

// Heat goes from warm to cold particles of a body between free sides: none is lost or won.
TEST(Heat, FlowsWithoutLoss) {
  StepArrays arrays(block(""));
  const Columns& c = arrays.columns(0);
  for (std::size_t p = 0; p < arrays.sets[0].size(); ++p)
    arrays.column(0, c.temperature)[p] = 300 + 50 * arrays.sets[0].position(p).x;
  arrays.give();
  const OutsideForces outside(arrays.solids(), arrays.nodes.level, arrays.method->carried());
  Heat heat(arrays.read.scene, arrays.solids(), arrays.nodes, arrays.bodies, arrays.work, outside);
  NodeBooks unused;
  heat.before_particles(arrays.scope, unused);
  HeatOfLaw law;
  double won = 0, moved = 0;
  for (const BlockWork& w : arrays.work) {
    Chunk block = arrays.chunk(0);
    block.work = &w;
    for_each_chunk(block, [&](const Chunk& chunk) {
      std::fill_n(chunk.buffers->heating, chunk.n, 0.0);
      law.to_particles(chunk);
      heat.to_particles(chunk);
      for (int q = 0; q < chunk.n; ++q) {
        const double dT = chunk.made(c.temperature)[q] - chunk.old(c.temperature)[q];
        won += chunk.old(c.mass)[q] * dT;
        moved += chunk.old(c.mass)[q] * std::fabs(dT);
      }
    });
  }
  EXPECT_GT(moved, 1e-8);
  EXPECT_NEAR(won, 0, 1e-9 * moved);
}

TEST(HeatOfLaw, HeatsByItsRate) {
  StepArrays arrays(block(no_heat));
  const Chunk chunk = arrays.chunk(0);
  std::fill_n(chunk.buffers->heating, chunk.n, 2e3);
  HeatOfLaw().to_particles(chunk);
  for (int q = 0; q < chunk.n; ++q)
    EXPECT_NEAR(chunk.made(chunk.columns().temperature)[q], 300 + 2e3 * arrays.scope.step.dt, 1e-9);
}

// Particles of the colour go, with their new velocity; the others stay.
TEST(Jumps, MoveParticlesOfAColour) {
  SolidDeck deck = block(std::string(no_heat) + "<with_color>true</with_color>");
  StepArrays arrays(deck);
  const Columns& c = arrays.columns(0);
  ASSERT_GE(c.colour, 0);
  Insertion jump;
  jump.time = 0;
  jump.colour = 7;
  jump.way = {0.1, 0, -0.2};
  jump.velocity = {5, 6, 7};
  Jumps jumps({jump});
  jumps.begin(arrays.scope);
  const Chunk chunk = arrays.chunk(0);
  arrays.column(0, c.colour)[chunk.at] = 7;
  for (int d = 0; d < 3; ++d) {
    std::copy_n(arrays.sets[0].coordinate(d), arrays.sets[0].size(), arrays.nexts[0].coordinate(d));
    std::copy_n(chunk.old(c.velocity + d), chunk.n, chunk.made(c.velocity + d));
  }
  jumps.to_particles(chunk);
  const Vec3 way = arrays.nexts[0].position(chunk.at) - arrays.sets[0].position(chunk.at);
  EXPECT_NEAR(way.x, 0.1, 1e-15);
  EXPECT_NEAR(way.z, -0.2, 1e-15);
  EXPECT_EQ(chunk.made(c.velocity + 1)[0], 6);
  EXPECT_EQ(chunk.made(c.velocity + 1)[1], 2);
  EXPECT_TRUE(arrays.report.left);
}

// The kinetic energy at both ends of a step.
TEST(EnergyBooks, SumTheEnergiesOfParticles) {
  StepArrays arrays(block(no_heat));
  const Columns& c = arrays.columns(0);
  EnergyBooks books;
  double mass = 0;
  for (const BlockWork& w : arrays.work) {
    Chunk block = arrays.chunk(0);
    block.work = &w;
    for_each_chunk(block, [&](const Chunk& chunk) {
      for (int d = 0; d < 3; ++d) std::fill_n(chunk.made(c.velocity + d), chunk.n, 2.0 * (d + 1));
      std::fill_n(chunk.made(c.energy), chunk.n, 0.0);
      std::fill_n(chunk.made(c.temperature), chunk.n, 300.0);
      books.to_particles(chunk);
      for (int q = 0; q < chunk.n; ++q) mass += chunk.old(c.mass)[q];
    });
  }
  using Of = BodyEnergySums;
  const BodyEnergySums& sums = arrays.report.books.bodies[0];
  EXPECT_NEAR(sums[Of::kinetic_before].value(), 0.5 * mass * 14, 1e-9 * mass);
  EXPECT_NEAR(sums[Of::kinetic_after].value(), 0.5 * mass * 56, 1e-9 * mass);
  EXPECT_NEAR(sums[Of::mass].value(), mass, 1e-9 * mass);
}

// Both phases keep their momentum in a kick without gravity, whatever the drag.
TEST(PoreWater, AKickKeepsTheMomentumOfBoth) {
  SolidDeck deck =
      block(std::string(no_heat) + "<coupled_flow_analysis>true</coupled_flow_analysis>");
  deck.material =
      "<water_density>1000</water_density><porosity>0.4</porosity>"
      "<permeability>1e-3</permeability><water_bulk_modulus>1e7</water_bulk_modulus>"
      "<initial_pore_pressure>20000</initial_pore_pressure>";
  StepArrays arrays(deck, "shmpm");
  const Columns& c = arrays.columns(0);
  double momentum = 0, mass = 0;
  for (std::size_t p = 0; p < arrays.sets[0].size(); ++p) {
    arrays.column(0, c.water_velocity)[p] = 4;
    momentum += arrays.column(0, c.mass)[p] * 1 + arrays.column(0, c.water_mass)[p] * 4;
    mass += arrays.column(0, c.mass)[p] + arrays.column(0, c.water_mass)[p];
  }
  PoreWater water(arrays.solids(), arrays.nodes, arrays.bodies, arrays.work);
  water.begin(arrays.scope);
  EXPECT_GT(water.tension(0), 0);
  arrays.give({&water});
  NodeStage stage(arrays.solids(), arrays.nodes, arrays.bodies, nullptr, nullptr, {&water});
  stage.move(arrays.scope.step, {1e-3, 1e-3, {}, 0}, false);
  double after = 0;
  const Body& body = arrays.bodies[0];
  arrays.for_each_full(0, body.nodes, [&](const std::int64_t* node, IntVec3) {
    after += as_real(node[3]) * (as_real(node[0]) + body.units.reference.x);
  });
  // What the solid won, the water lost: it is dragged along.
  double solid = 0;
  for (std::size_t p = 0; p < arrays.sets[0].size(); ++p) solid += arrays.column(0, c.mass)[p];
  EXPECT_GT(after, solid * 1.01);
  EXPECT_LT(after, momentum);
  EXPECT_GT(mass, solid);
}

TEST(StepOutcome, IncludesFurtherVelocities) {
  StepOutcome outcome;
  outcome.rates.assign(rate_count(2), 0.0);
  outcome.include_velocities(1, {1, 2, 3}, {-1, 5, 0});
  const KindRates rates = KindRates::from(
      std::span(outcome.rates).subspan(1 + static_cast<std::size_t>(KindRates::count)));
  EXPECT_EQ(rates.up, (Vec3{1, 2, 3}));
  EXPECT_EQ(rates.down, (Vec3{0, 5, 0}));
}

TEST(BookBodies, TakesTheSumsOfAllBodies) {
  using Of = BodyEnergySums;
  for (const bool prescribed : {false, true}) {
    NodeBooks books;
    books.make_room(2);
    for (BodyEnergySums& body : books.bodies) {
      body[Of::node_work].add(3);
      body[Of::stored_before].add(10);
      body[Of::stored_after].add(14);
    }
    book_bodies(prescribed, false, books);
    // The deformation itself works then: 4 on each.
    EXPECT_EQ(books.sums[StepSums::node_work].value(), prescribed ? -2 : 6);
    EXPECT_EQ(books.sums[StepSums::force_work].value(), prescribed ? 8 : 0);
  }
}

}  // namespace
}  // namespace sluice::mpm::effects_of_scene_test
