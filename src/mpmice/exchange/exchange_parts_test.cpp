// The parts of the exchange through surfaces: what is in front, what is behind, how they are
// joined, who gets what.
#include <gtest/gtest.h>

#include "mpmice/exchange/surface_exchange.hpp"
#include "mpmice/test_support/block_in_cells.hpp"

namespace sluice::mpmice::exchange_parts_test {
namespace {

constexpr double rho = 1.2, c_v = 717.5, hot = 900, cold = 300, h = 0.5, dt = 1e-3;

// A hot gas that moves along y around a cold block at rest, half a cell inside of the grid.
struct HotGas {
  BlockInCells<2> block{16, h, 5.5, 8.5};
  GivenFluid fluid;
  CellAmounts<2> amounts;
  KeptArray<SurfaceContact<2>> contacts;
  ExchangeScales most;

  explicit HotGas(double velocity = 0) {
    block.give(block.columns().temperature, cold);
    block.find_surfaces();
    block.find_moved();
    const std::size_t n = block.near.size();
    amounts.volume.assign(n, 1.0);
    amounts.near.assign(n, 1);
    amounts.touched.assign(n, 0);
    for (auto* of : {&amounts.mass, &amounts.filled, &amounts.energy}) of->assign(1, Column(n));
    amounts.momentum.assign(2, Column(n));
    amounts.kinetic.assign(n, 0.0);
    block.near.for_each([&](const Cell<2>&, std::size_t i) {
      const double V = 1 - block.surfaces.solid().theta_next[i];
      amounts.volume[i] = amounts.filled[0][i] = V;
      amounts.mass[0][i] = rho * V;
      amounts.momentum[1][i] = rho * V * velocity;
      amounts.kinetic[i] = V * rho * (c_v * hot + 0.5 * velocity * velocity);
    });
    contacts =
        surface_contacts<2>(block.near, block.surfaces.solid(), amounts, block.sets.all(), 0);
  }
  CellMask all() const { return CellMask(block.near.size(), 1); }
};

TEST(SurfaceContacts, HaveTheAreaOfTheSurface) {
  HotGas gas;
  double area = 0;
  for (const SurfaceContact<2>& c : gas.contacts) area += c.area * h * h * h;
  EXPECT_NEAR(area / (4 * 3 * h * h), 1, 1e-13);
  // A plane in the middle of a cell leaves half of it: the centre of that cell is on the surface.
  for (const SurfaceContact<2>& c : gas.contacts) EXPECT_LE(c.to_fluid, 0.5 * h + 1e-12);
}

TEST(FluidInFront, HasTheStateOfItsCell) {
  HotGas gas(20);
  FluidInFront<2> front(gas.block.near.frame(), gas.fluid.part());
  front.look(gas.contacts, gas.amounts, gas.most);
  ASSERT_FALSE(gas.contacts.empty());
  for (std::size_t n = 0; n < gas.contacts.size(); ++n) {
    const double V = gas.amounts.volume[gas.contacts[n].fluid];
    EXPECT_NEAR(front.temperature(n, 0), hot, 1e-10 * hot);
    EXPECT_NEAR(front.capacity(n, 0), rho * V * c_v, 1e-10 * rho * c_v);
    EXPECT_NEAR(front.velocity(n, 1), 20, 1e-12);
    EXPECT_EQ(front.share(n, 0), 1);
  }
  EXPECT_NEAR(gas.most.temperature, hot, 1e-10 * hot);
}

TEST(SolidBehind, HasWhatParticlesHave) {
  HotGas gas;
  gas.block.give(gas.block.columns().velocity, 3);
  SolidBehind<2> behind(gas.block.solids.materials.front());
  behind.include(gas.block.near.frame(), gas.block.sets.all(), 0, gas.most);
  gas.most.join(world());
  behind.find(gas.block.near, gas.all(), gas.block.sets.all(), 0, gas.most, world());
  double mass = 0;
  gas.block.near.for_each([&](const Cell<2>&, std::size_t i) {
    if (!(behind.mass(i) > 0)) return;
    mass += behind.mass(i) * h * h * h;
    EXPECT_NEAR(behind.temperature(i), cold, 1e-10 * cold);
    EXPECT_NEAR(behind.velocity(0, i), 3, 1e-10);
  });
  EXPECT_NEAR(mass / (1000 * 9 * h * h * h), 1, 1e-12);
  ASSERT_EQ(behind.counted(0).size(), 1u);  // one thread
  EXPECT_EQ(behind.counted(0).front().size(), 9u);
}

struct Joined {
  HotGas gas;
  FluidInFront<2> front{gas.block.near.frame(), gas.fluid.part()};
  SolidBehind<2> behind{gas.block.solids.materials.front()};
  FilmCoefficients films;
  Conductances<2> conductances;
  PassedAmounts<2> passed{front, behind, gas.most};

  Joined(double velocity, double drag, double heat) : gas(velocity), films{{drag}, {heat}} {
    front.look(gas.contacts, gas.amounts, gas.most);
    behind.include(gas.block.near.frame(), gas.block.sets.all(), 0, gas.most);
    gas.most.join(world());
    behind.find(gas.block.near, gas.all(), gas.block.sets.all(), 0, gas.most, world());
    conductances.find(gas.block.near, gas.block.sets.all(), gas.contacts, gas.amounts, front,
                      behind, films, dt, world());
    passed.pass(gas.block.near, gas.contacts, conductances, films, dt, world());
  }
};

// A coefficient per volume acts as K l/4 per area; each contact is joined whole.
TEST(Conductances, OfAContactAreThoseOfItsArea) {
  const double K = 5e4;
  Joined joined(0, K, 2 * K);
  std::vector<double> drag(joined.gas.contacts.size()), heat = drag;
  for (std::size_t n = 0; n < joined.conductances.pairs().size(); ++n) {
    const auto& pair = joined.conductances.pairs()[n];
    drag[pair.contact] += pair.drag;
    heat[pair.contact] += joined.conductances.heat(n, 0);
  }
  for (std::size_t n = 0; n < drag.size(); ++n) {
    const SurfaceContact<2>& c = joined.gas.contacts[n];
    EXPECT_NEAR(drag[n] / (c.area * K * c.width / 4), 1, 1e-9);
    EXPECT_NEAR(heat[n] / (c.area * 2 * K * c.width / 4), 1, 1e-9);
  }
}

// Heat that the fluid loses, particles get; the books have it.
TEST(PassedAmounts, KeepTheEnergy) {
  Joined joined(0, 0, 1e6);
  BlockInCells<2>& block = joined.gas.block;
  const double before = joined.gas.amounts.kinetic[block.at({5, 7})];
  double lost = 0, gained = 0;
  const Column kinetic = joined.gas.amounts.kinetic;
  joined.passed.give_to_fluid(block.near, joined.gas.amounts);
  for (std::size_t i = 0; i < kinetic.size(); ++i)
    lost += (kinetic[i] - joined.gas.amounts.kinetic[i]) * h * h * h;
  CouplingBooks books;
  SolidSet<2>& s = block.sets.all().front();
  joined.passed.give_to_set(block.near, s, 0, books);
  const double* T = block.next.column(static_cast<std::size_t>(block.columns().temperature));
  for (std::size_t p = 0; p < block.next.size(); ++p) {
    gained += block.set.column(0)[p] * 1000 * (T[p] - cold);
    EXPECT_GE(T[p], cold);
    EXPECT_LE(T[p], hot);
  }
  EXPECT_GT(lost, 0);
  EXPECT_NEAR(gained / lost, 1, 1e-11);
  EXPECT_NEAR(books.of_exchange(Booked::heat_from_fluid).value() / lost, 1, 1e-11);
  EXPECT_LT(joined.gas.amounts.kinetic[block.at({5, 7})], before);
}

// Momentum that the fluid loses, particles get; none passes the velocity of the other side.
TEST(PassedAmounts, KeepTheMomentum) {
  Joined joined(20, 1e9, 0);
  BlockInCells<2>& block = joined.gas.block;
  const Column P = joined.gas.amounts.momentum[1];
  joined.passed.give_to_fluid(block.near, joined.gas.amounts);
  double lost = 0, gained = 0;
  for (std::size_t i = 0; i < P.size(); ++i)
    lost += (P[i] - joined.gas.amounts.momentum[1][i]) * h * h * h;
  CouplingBooks books;
  joined.passed.give_to_set(block.near, block.sets.all().front(), 0, books);
  const double* v = block.next.column(static_cast<std::size_t>(block.columns().velocity + 1));
  for (std::size_t p = 0; p < block.next.size(); ++p) {
    gained += block.set.column(0)[p] * v[p];
    EXPECT_GE(v[p], 0);
    EXPECT_LE(v[p], 20);
  }
  EXPECT_GT(lost, 0);
  EXPECT_NEAR(gained / lost, 1, 1e-11);
  EXPECT_EQ(joined.gas.amounts.momentum[0][block.at({7, 5})], 0);
}

TEST(SurfaceExchange, ActsWhereTheDeckAsksForIt) {
  CoupledDeck deck;
  EXPECT_FALSE(films_of(GivenFluid(deck).part().scene(), 0).any());
  deck.heat = "7";
  const GivenFluid fluid(deck);
  const FilmCoefficients films = films_of(fluid.part().scene(), 0);
  EXPECT_TRUE(films.any_heat());
  EXPECT_FALSE(films.any_drag());
  EXPECT_EQ(films.heat.front(), 7);
}

}  // namespace
}  // namespace sluice::mpmice::exchange_parts_test
