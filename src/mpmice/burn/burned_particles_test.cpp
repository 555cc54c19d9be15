// Solids that become fluid: what particles lose is what cells get.
#include "mpmice/burn/burned_particles.hpp"

#include <gtest/gtest.h>

#include "mpmice/burn/burn_products.hpp"
#include "mpmice/test_support/block_in_cells.hpp"

namespace sluice::mpmice::burned_particles_test {
namespace {

constexpr double h = 0.5, Q = 4e6, T = 350;

// A block that burns, in a gas.
struct BurningBlock {
  BlockInCells<2> block{16, h, 5.25, 8.25};
  GivenFluid fluid;
  SolidSets<2>& sets = block.sets;
  CellAmounts<2> amounts;
  Column pressure;
  StageScope scope;

  BurningBlock() {
    solids::ParticleColumns& c = block.solids.materials.front().columns;
    c.filled = BlockInCells<2>::stress_column + 8;
    block.give(c.filled, 1);
    block.give(c.temperature, T);
    block.give(c.velocity, 10);
    read_filled<2>(sets.all().front());
    block.find_surfaces();
    block.find_moved();
    const std::size_t n = block.near.size();
    amounts.volume.assign(n, 0.0);
    block.near.for_each([&](const Cell<2>&, std::size_t i) {
      amounts.volume[i] = 1 - block.surfaces.solid().theta_next[i];
    });
    amounts.near.assign(n, 1);
    amounts.touched.assign(n, 0);
    for (auto* of : {&amounts.mass, &amounts.filled, &amounts.energy}) of->assign(1, Column(n));
    amounts.momentum.assign(2, Column(n));
    amounts.kinetic.assign(n, 0.0);
    pressure.assign(n, 1e5);
    scope.ranks = &world();
  }
  BurningStep<2> step() {
    return {scope, block.near, block.surfaces.solid(), sets, amounts, pressure, fluid.part()};
  }
  double whole_mass() const { return 1000 * 9 * h * h * h; }
};

TEST(BurnedParticles, LoseTheirSharesAndKeepTheirBooks) {
  BurningBlock burning;
  BurnedParticles<2> particles(burning.block.solids, 1);
  particles.begin(burning.sets);
  const std::vector<Column> shares = {Column(9, 0.25)};
  double mass = 0;
  for (const GivenByParticle& g : particles.take(burning.sets, 0, 0, Q, shares)) {
    mass += g.mass;
    EXPECT_NEAR(g.energy, 1000 * T + Q, 1e-9 * Q);  // c_s T + Q
    EXPECT_NEAR(g.kinetic, 50, 1e-12);
  }
  EXPECT_NEAR(mass / (0.25 * burning.whole_mass()), 1, 1e-14);
  EXPECT_EQ(burning.sets.all().front().filled[4], 0.75);
  std::vector<double> sums(5, 0.0);  // of a solid, of a fluid; energy, burned, heat
  particles.book(world(), sums);
  EXPECT_NEAR(sums[0], -mass, 1e-12 * mass);
  EXPECT_NEAR(sums[1], mass, 1e-12 * mass);
  EXPECT_NEAR(sums[3], mass, 1e-12 * mass);
  EXPECT_NEAR(sums[4], Q * mass, 1e-12 * Q * mass);
}

// What is left of less than a thousandth burns with the rest; neighbours then have outer faces.
TEST(BurnedParticles, EndAndExposeTheirNeighbours) {
  BurningBlock burning;
  BurnedParticles<2> particles(burning.block.solids, 1);
  particles.begin(burning.sets);
  std::vector<Column> shares = {Column(9, 0.0)};
  shares[0][4] = 0.9995;  // the one in the middle
  EXPECT_EQ(particles.take(burning.sets, 0, 0, Q, shares).size(), 1u);
  SolidSet<2>& s = burning.sets.all().front();
  EXPECT_EQ(s.filled[4], 0);
  particles.expose_neighbours(burning.block.near, burning.sets, world());
  EXPECT_EQ(s.outer[3] & 2, 2);  // its high face along x
  EXPECT_EQ(s.outer[5] & 1, 1);
  StepJournal journal;
  particles.note(journal, burning.sets);
  journal.accept();
  EXPECT_EQ(burning.block.set.column(0)[4], 0);
}

TEST(BurnProducts, AreWhatParticlesGave) {
  BurningBlock burning;
  const BurningStep<2> step = burning.step();
  BurnedParticles<2> particles(burning.block.solids, 1);
  particles.begin(burning.sets);
  BurnProducts<2> products;
  products.begin(burning.amounts, burning.block.near.size());
  EXPECT_FALSE(products.give(step, 0, {}, {}));
  const std::vector<GivenByParticle> given =
      particles.take(burning.sets, 0, 0, Q, {Column(9, 0.25)});
  ASSERT_TRUE(products.give(step, 0, given, {}));
  double mass = 0, energy = 0, momentum = 0, kinetic = 0;
  const double volume = h * h * h;
  burning.block.near.for_each([&](const Cell<2>&, std::size_t i) {
    mass += burning.amounts.mass[0][i] * volume;
    energy += burning.amounts.energy[0][i] * volume;
    kinetic += burning.amounts.kinetic[i] * volume;
    momentum += burning.amounts.momentum[0][i] * volume;
  });
  const double burned = 0.25 * burning.whole_mass();
  EXPECT_NEAR(mass / burned, 1, 1e-12);
  EXPECT_NEAR(energy / (burned * (1000 * T + Q)), 1, 1e-12);
  EXPECT_NEAR(momentum / (burned * 10), 1, 1e-12);
  EXPECT_NEAR(kinetic / (burned * 50), 1, 1e-12);
  EXPECT_EQ(products.all(), products.made().front());
}

}  // namespace
}  // namespace sluice::mpmice::burned_particles_test
