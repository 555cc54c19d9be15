// Pressure, friction and forces on the walls of a block in gas: the formulas, number by number.
#include "mpmice/walls/walls.hpp"

#include <gtest/gtest.h>

#include "mpmice/test_support/block_in_cells.hpp"

namespace sluice::mpmice::walls_test {
namespace {

constexpr double rho = 1.2, p = 1e5, gamma = 1.4;
const double sound = std::sqrt(gamma * p / rho);

// A block in a gas of one state that moves along x, viscous if asked.
template <int D>
struct BlockInGas {
  BlockInCells<D> block;
  GivenFluid fluid;
  Warehouse state;
  FluidStates<D> states;
  SmoothNormals<D> normals;

  BlockInGas(double velocity, const std::string& viscosity = "0", bool rigid = false)
      : block(24, 0.5, 5.25, 12.5, 0, rigid, viscosity != "0"),
        fluid(deck(viscosity)),
        state(block.level, 0),
        states(fluid.part(), false) {
    const ice::Labels& l = ice::labels();
    const int place = fluid.part().options().place(0);
    const int components = fluid.part().options().grid.components;
    fill(state.add({l.mass, place, 1, 0}), 0, rho);
    fill(state.add({l.energy, place, 1, 0}), 0, p / (gamma - 1));
    const int momentum = state.add({l.momentum, place, components, 0});
    fill(momentum, 0, rho * velocity);
    const int fraction = state.add({l.solid_fraction, place, 1, 0});
    block.find_surfaces();
    block.near.frame().for_each_held(block.level.domain, [&](IntVec3 c, std::size_t i) {
      state.view(fraction, 0, 0)(c) = block.surfaces.solid().theta[i];
    });
    states.gather(block.near, state, false);
    states.take();
    normals.find(block.near, block.surfaces.solid(), block.surfaces.on());
  }
  static CoupledDeck deck(const std::string& viscosity) {
    CoupledDeck deck;
    deck.viscosity = viscosity;
    return deck;
  }
  void fill(int slot, int component, double value) {
    const RealView to = state.view(slot, component, 0);
    for_each_cell(to.box, [&](IntVec3 c) { to(c) = value; });
  }
  WallPressure<D> pressure(double dt, const LightWalls<D>& light, double reference = 0) const {
    WallPressure<D> pressure(false, 1.2, reference);
    pressure.find(block.near, block.surfaces.solid(), block.surfaces.on(), states, normals, light,
                  dt);
    return pressure;
  }
};

TEST(FluidStates, AreThoseOfCellsWithFluid) {
  BlockInGas<2> gas(30, "2e-5");
  const std::size_t beside = gas.block.at({5, 9}), inside = gas.block.at({6, 6});
  EXPECT_DOUBLE_EQ(gas.states.density()[beside], rho);
  EXPECT_NEAR(gas.states.pressure()[beside], p, 1e-9);
  EXPECT_NEAR(gas.states.sound()[beside], sound, 1e-10);
  EXPECT_NEAR(gas.states.velocity()[0][beside], 30, 1e-12);
  EXPECT_DOUBLE_EQ(gas.states.viscosity()[beside], 2e-5);
  EXPECT_EQ(gas.states.density()[inside], 0);
  EXPECT_NEAR(gas.states.highest_impedance(), rho * sound, 1e-9);
}

// p_w = p + z du with z = rho (c + A max(0, du)) on a rigid wall, du the speed of approach.
TEST(WallPressure, OfARigidWallIsThatOfTheRiemannProblem) {
  const LightWalls<2> heavy(false);
  for (const double u : {30.0, -30.0}) {
    BlockInGas<2> gas(u, "0", true);
    const Column on_wall = gas.pressure(1e-5, heavy).values();
    const auto expected = [&](double du) {
      return p + rho * (sound + 1.2 * std::max(0.0, du)) * du;
    };
    EXPECT_NEAR(on_wall[gas.block.at({5, 9})], expected(u), 1e-8 * p);  // looks to the left
    EXPECT_NEAR(on_wall[gas.block.at({12, 9})], expected(-u), 1e-8 * p);
    EXPECT_NEAR(on_wall[gas.block.at({9, 5})], p, 1e-8 * p);
  }
}

// Never less than a tenth of the pressure of the fluid.
TEST(WallPressure, IsAtLeastATenth) {
  const LightWalls<2> heavy(false);
  BlockInGas<2> gas(-300, "0", true);
  EXPECT_NEAR(gas.pressure(1e-5, heavy).values()[gas.block.at({5, 9})], 0.1 * p, 1e-8 * p);
}

// w = 1/(1 + z y): the stress behind a soft wall counts by 1 - w.
TEST(WallPressure, OfASoftWallTakesTheStressBehind) {
  BlockInGas<2> gas(0);
  BlockInCells<2>& block = gas.block;
  block.solids.waves = 10 / 0.5;  // c_s = 10 m/s
  block.give(block.columns().stress, -4e5);
  block.find_surfaces();
  const double z = rho * sound, y = 1 / (1000.0 * 10), w = 1 / (1 + z * y), reference = 1e5;
  const LightWalls<2> heavy(false);
  const Column on_wall = gas.pressure(1e-9, heavy, reference).values();
  EXPECT_NEAR(on_wall[block.at({5, 9})], p + (1 - w) * (4e5 + reference - p), 1e-8 * p);
}

// Cells without fluid have the mean of their neighbours, two layers deep.
TEST(WallPressure, GoesOnIntoTheSolid) {
  const LightWalls<2> heavy(false);
  BlockInGas<2> gas(30, "0", true);
  const Column on_wall = gas.pressure(1e-5, heavy).values();
  EXPECT_NEAR(on_wall[gas.block.at({6, 9})], on_wall[gas.block.at({5, 9})], 1e-8 * p);
}

// b = 1 - rho_s h/(z dt) where that is positive; what is behind has the mean stress.
TEST(LightWalls, AreLightWhereSoundCrossesALayer) {
  BlockInGas<2> gas(0);
  BlockInCells<2>& block = gas.block;
  block.solids.waves = 10 / 0.5;
  block.give(block.columns().stress, -4e5);
  block.find_surfaces();
  const OnSurfaces<2>& on = block.surfaces.on();
  const WallPressure<2> pressure(false, 1.2, 0);
  const double z = rho * sound, crosses = 1000 * 0.5 / z;
  for (const double dt : {0.5 * crosses, 4 * crosses}) {
    LightWalls<2> light(false);
    light.begin(block.near.frame(), z / 1000, dt);
    const Column impedance =
        pressure.impedance(block.near, block.surfaces.solid(), on, gas.states, gas.normals, dt);
    light.find(block.near, block.sets, on, gas.normals, impedance, dt, world());
    const std::size_t left = block.at({5, 9});
    EXPECT_NEAR(light.lightness(left), dt > crosses ? 0.75 : 0, 1e-12);
    if (dt > crosses) {
      EXPECT_NEAR(light.pressure_behind(left), 4e5, 1e-8 * 4e5);
    }
  }
}

// t = mu w/h with h from the surface to the centre of the cell, or of the next one.
TEST(WallFriction, IsThatOfTheDistance) {
  BlockInGas<2> gas(30, "2e-3");
  WallFriction<2> friction;
  friction.find(gas.block.near, gas.block.surfaces.solid(), gas.block.surfaces.on(), gas.states,
                gas.normals, 1e-9);
  // Below, the surface lies .25 cells above the low corner: the centre is .25 cells inside of it.
  EXPECT_NEAR(friction.along(0)[gas.block.at({9, 5})], 2e-3 * 30 / (0.75 * 0.5), 1e-12);
  EXPECT_NEAR(friction.along(1)[gas.block.at({9, 5})], 0, 1e-15);
  EXPECT_NEAR(friction.along(0)[gas.block.at({5, 9})], 0, 1e-15);  // across
}

// What fluid loses in dt: t A of momentum.
TEST(WallFriction, IsTakenFromTheFluid) {
  const double dt = 1e-4;
  BlockInGas<2> gas(30, "2e-3");
  const OnSurfaces<2>& on = gas.block.surfaces.on();
  WallFriction<2> friction;
  friction.find(gas.block.near, gas.block.surfaces.solid(), on, gas.states, gas.normals, dt);
  CellAmounts<2> amounts;
  amounts.momentum.assign(2, Column(gas.block.near.size(), 0.0));
  amounts.kinetic.assign(gas.block.near.size(), 0.0);
  amounts.touched.assign(gas.block.near.size(), 0);
  friction.take(gas.block.near, on, {0, 1, -1}, dt, amounts);
  const std::size_t below = gas.block.at({9, 5});
  EXPECT_NEAR(amounts.momentum[0][below], -friction.along(0)[below] * dt / 0.5, 1e-15);
  EXPECT_EQ(amounts.kinetic[below], 0);  // the wall rests
  EXPECT_EQ(amounts.touched[below], 1);
}

// A uniform pressure pushes no closed body; the fluid's motion does, by its pressure on both sides.
TEST(WallForces, AddUpToThePressureOnBothSides) {
  for (const double u : {0.0, 30.0}) {
    BlockInGas<2> gas(u);
    BlockInCells<2>& block = gas.block;
    const LightWalls<2> heavy(false);
    const WallPressure<2> pressure = gas.pressure(1e-5, heavy);
    const WallFriction<2> friction;
    WallForces<2> forces(block.solids, pressure, friction, false);
    forces.find_overlaps(block.near, block.surfaces.solid(), false);
    Vec3 sum{};
    const auto on_corners = forces.on_corners(block.near.frame(), block.sets, block.surfaces.on());
    for (const solids::CornerForce& f : on_corners.front()) sum = sum + f.force;
    double expected[2] = {0, 0};  // over the edges, cell by cell
    for (int j = 5; j < 13; ++j) {
      const double area = (j == 5 ? 0.75 : j == 12 ? 0.5 : 1.0) * 0.5 * 0.5;
      const auto p_w = [&](Cell<2> c) { return pressure.values()[block.at(c)]; };
      expected[0] += area * (p_w({5, j}) - p_w({12, j}));
      expected[1] += area * (p_w({j, 5}) - p_w({j, 12}));
    }
    for (int d = 0; d < 2; ++d) EXPECT_NEAR(sum[d], expected[d], 1e-9 * p);
    if (u > 0) {
      EXPECT_GT(sum[0], 0);
    }
  }
}

// What holds a rigid body is booked as its reaction, and its impulse comes from outside.
TEST(WallForces, OfRigidBodiesAreBooked) {
  const double dt = 1e-5;
  BlockInGas<2> gas(30, "0", true);
  BlockInCells<2>& block = gas.block;
  const LightWalls<2> heavy(false);
  const WallPressure<2> pressure = gas.pressure(dt, heavy);
  const WallFriction<2> friction;
  WallForces<2> forces(block.solids, pressure, friction, false);
  forces.find_overlaps(block.near, block.surfaces.solid(), true);
  EXPECT_TRUE(
      forces.on_corners(block.near.frame(), block.sets, block.surfaces.on()).front().empty());
  CouplingBooks books;
  forces.book(block.near, block.surfaces.solid(), block.sets, dt, books);
  const double reaction = books.of_forces(Booked::reaction, 0).value();
  EXPECT_GT(reaction, 0);
  EXPECT_NEAR(books.of_forces(Booked::impulse, 0).value(), -reaction * dt, 1e-12 * p);
}

}  // namespace
}  // namespace sluice::mpmice::walls_test
