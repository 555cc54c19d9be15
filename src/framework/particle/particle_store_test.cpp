// Where particles live, in which order, and how they get there.
#include "framework/particle/particle_store.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "framework/particle/cell_points.hpp"
#include "framework/particle/domain_ends.hpp"
#include "framework/particle/particle_exchange.hpp"
#include "framework/particle/point_stencil.hpp"

namespace sluice::particle_store_test {
namespace {

// MPI must be closed before the test executable ends.
class EndOfMpi : public testing::Environment {
 public:
  void TearDown() override { world().finalize(); }
};
const testing::Environment* const end_of_mpi = testing::AddGlobalTestEnvironment(new EndOfMpi);

Level square(int index, int cells, std::vector<IndexBox> boxes) {
  Level level;
  level.index = index;
  level.spacing = {1.0 / cells, 1.0 / cells, 1};
  level.domain = {{0, 0, 0}, {cells, cells, 1}};
  level.active = {true, true, false};
  if (index > 0) level.ratio = {2, 2, 1};
  for (const IndexBox& b : boxes)
    level.boxes.push_back({b, 0, static_cast<int>(level.boxes.size())});
  return level;
}

// 8 x 8 cells in four boxes; the middle 4 x 4 refined.
ParticleMap two_levels() {
  const Level coarse = square(0, 8, split({{0, 0, 0}, {8, 8, 1}}, {2, 2, 1}));
  return ParticleMap({coarse, square(1, 16, {{{4, 4, 0}, {12, 12, 1}}})});
}

TEST(ParticleMap, FindsTheFinestLevelOverAPoint) {
  const ParticleMap map = two_levels();
  for (const auto& [x, level] : {std::pair{0.1, 0}, {0.24, 0}, {0.25, 1}, {0.74, 1}, {0.75, 0}}) {
    const ParticleMap::Home home = map.find({x, 0.5, 0.5});
    EXPECT_EQ(home.level, level) << x;
    EXPECT_TRUE(map.is_home(home.level, home.box, {x, 0.5, 0.5}));
    EXPECT_FALSE(map.is_home(1 - level, 0, {x, 0.5, 0.5})) << x;
  }
  EXPECT_EQ(map.find({1.0, 0.5, 0.5}).level, -1);
  EXPECT_EQ(map.find({-1e-300, 0.5, 0.5}).level, -1);
}

TEST(ParticleStore, SortsByCellAndIdWhateverTheOrderOfArrival) {
  const ParticleMap map = two_levels();
  std::vector<std::vector<std::int64_t>> orders;
  for (const bool backward : {false, true}) {
    ParticleStore store(1, 0);
    store.lay_out(map);
    ParticleSet all(1);
    for (int n = 0; n < 100; ++n)
      all.add({0.01 * ((n * 37) % 100) + 0.003, 0.01 * ((n * 61) % 100) + 0.003, 0.5},
              n % 10 * 100 + n);
    for (int n = 0; n < 100; ++n) {
      const std::size_t at = backward ? 99 - n : n;
      all.attribute(0, at) = static_cast<double>(all.id(at));
      store.adopt(all, at);
    }
    store.settle(world());
    EXPECT_EQ(store.count(), 100);
    std::vector<std::int64_t> order;
    for (int l = 0; l < 2; ++l)
      for (int b = 0; b < store.box_count(l); ++b) {
        const ParticleSet& set = store.set(l, b);
        for (std::size_t n = 0; n < set.size(); ++n) {
          order.push_back(set.id(n));
          EXPECT_EQ(set.attribute_values(0)[n], static_cast<double>(set.id(n)));
          EXPECT_TRUE(map.is_home(l, store.box(l, b).id, set.position(n)));
        }
      }
    orders.push_back(order);
  }
  EXPECT_EQ(orders[0], orders[1]);
}

TEST(ParticleStore, FollowsNewBoxes) {
  const ParticleMap map = two_levels();
  ParticleStore store(0, 0);
  store.lay_out(map);
  ParticleSet one;
  one.add({0.5, 0.5, 0.5}, 7);
  store.adopt(one, 0);
  EXPECT_EQ(store.set(1, 0).size(), 1U);
  const ParticleMap coarse({map.levels().front()});
  store.lay_out(coarse);
  EXPECT_EQ(store.count(), 1);
  store.settle(world());
  ASSERT_EQ(store.set(0, 3).size(), 1U);
  EXPECT_EQ(store.set(0, 3).id(0), 7);
}

// Every rank sends to every rank within a distance, and more to those further on.
void brings_each_to_its_rank(int distance, const std::vector<int>& neighbours) {
  Communicator& ranks = world();
  std::vector<ParticleSet> leaving(ranks.size(), ParticleSet(1));
  std::size_t expected = 0;
  for (int to = 0; to < ranks.size(); ++to) {
    if (std::abs(to - ranks.rank()) > distance) continue;
    expected += static_cast<std::size_t>(ranks.rank()) + 1;
    for (int n = 0; n <= to; ++n) {
      ParticleSet& set = leaving[to];
      set.add({1.0 * ranks.rank(), 1.0 * to, 1.0 * n}, most_particle_id - 1 - n);
      set.attribute(0, set.size() - 1) = 0.25 * n;
    }
  }
  const ParticleSet arrived = exchange_particles(leaving, neighbours, ranks);
  ASSERT_EQ(arrived.size(), expected);
  std::set<std::pair<double, double>> seen;
  for (std::size_t n = 0; n < arrived.size(); ++n) {
    EXPECT_EQ(arrived.position(n).y, ranks.rank());
    EXPECT_EQ(arrived.attribute_values(0)[n], 0.25 * arrived.position(n).z);
    EXPECT_EQ(arrived.id(n),
              most_particle_id - 1 - static_cast<std::int64_t>(arrived.position(n).z));
    EXPECT_TRUE(seen.insert({arrived.position(n).x, arrived.position(n).z}).second);
    if (n > 0 && arrived.position(n - 1).x != ranks.rank()) {
      EXPECT_LE(arrived.position(n - 1).x, arrived.position(n).x);
    }
  }
}

TEST(ParticleExchange, BringsEachToItsRank) {
  std::vector<int> beside;
  for (const int r : {world().rank() - 1, world().rank() + 1})
    if (r >= 0 && r < world().size()) beside.push_back(r);
  brings_each_to_its_rank(world().size(), {});
  brings_each_to_its_rank(world().size(), beside);
  brings_each_to_its_rank(1, beside);
}

// By the distance of every cell of one rank from every cell of another.
TEST(ParticleMap, RanksAreNearByTheDistanceOfTheirCells) {
  Level coarse = square(0, 16, {});
  coarse.periodic = {true, false, false};
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const int id = i + 4 * j;
      coarse.boxes.push_back({{{4 * i, 4 * j, 0}, {4 * i + 4, 4 * j + 4, 1}}, id % 7, id});
    }
  Level fine = square(1, 32, {});
  fine.periodic = coarse.periodic;
  fine.ratio = {2, 2, 1};
  fine.boxes = {{{{2, 2, 0}, {10, 6, 1}}, 8, 0}, {{{10, 2, 0}, {12, 6, 1}}, 9, 1}};
  const ParticleMap map({coarse, fine});
  const auto distance = [&](int a, int b) {  // of boxes of two ranks, cells of the fine level
    int least = 1000;
    for (const Level& one : map.levels())
      for (const GridBox& p : one.boxes)
        for (const Level& other : map.levels())
          for (const GridBox& q : other.boxes) {
            if (p.owner != a || q.owner != b) continue;
            const int f = one.index == 0 ? 2 : 1, g = other.index == 0 ? 2 : 1;
            for (int turn = -32; turn <= 32; turn += 32) {
              const int x = std::max(f * p.cells.lower.x + turn - g * q.cells.upper.x,
                                     g * q.cells.lower.x - f * p.cells.upper.x - turn);
              const int y = std::max(f * p.cells.lower.y - g * q.cells.upper.y,
                                     g * q.cells.lower.y - f * p.cells.upper.y);
              least = std::min(least, std::max(x, y));
            }
          }
    return least;
  };
  for (const int reach : {1, 2, 3})
    for (int a = 0; a < 10; ++a) {
      std::vector<int> expected;
      for (int b = 0; b < 10; ++b)
        if (b != a && distance(a, b) < 2 * reach) expected.push_back(b);
      EXPECT_EQ(map.ranks_near(a, reach), expected) << a << " within " << reach;
    }
}

TEST(DomainEnds, WrapMirrorOrLetOut) {
  Level level = square(0, 8, {});
  level.periodic = {true, false, false};
  const Reflects top_only = [](Side side, IntVec3) { return side == Side::y_plus; };
  Vec3 p{1.25, 1.125, 0.5};
  EXPECT_TRUE(bring_inside(level, top_only, p));
  EXPECT_EQ(p, (Vec3{0.25, 0.875, 0.5}));
  p = {-0.25, -0.125, 0.5};
  EXPECT_FALSE(bring_inside(level, top_only, p));
  // Round-off must not put it on the upper end, whose cell is outside.
  p = {-1e-300, 1.0, 0.5};
  EXPECT_TRUE(bring_inside(level, top_only, p));
  EXPECT_LT(p.x, 1.0);
  EXPECT_LT(p.y, 1.0);
  EXPECT_TRUE(level.domain.contains(cell_at(level, p)));
}

TEST(PointStencil, MeetsLinearFieldsAndMirrors) {
  Level level = square(0, 8, {});
  level.anchor = {-0.5, -0.5, 0};
  const auto linear = [&](IntVec3 c) { return 1 + 2 * level.centre(c).x - 3 * level.centre(c).y; };
  for (const Vec3 p : {Vec3{0.01, 0.2, 0.5}, Vec3{-0.3, 0.33, 0.5}, Vec3{0.0625, -0.0625, 0.5}})
    EXPECT_NEAR(interpolate(stencil_at(level, p), linear), 1 + 2 * p.x - 3 * p.y, 1e-15);
  const auto wavy = [](IntVec3 c) { return std::sin(3.0 * c.x + c.y); };
  const auto mirrored = [&](IntVec3 c) { return wavy({7 - c.x, c.y, c.z}); };
  for (const double x : {0.013, 0.2, 0.31})
    EXPECT_EQ(interpolate(stencil_at(level, {x, 0.1, 0.5}), wavy),
              interpolate(stencil_at(level, {-x, 0.1, 0.5}), mirrored));
}

TEST(CellPoints, StandInTheirCellAsManyAsAsked) {
  const Level level = square(0, 8, {});
  for (const double number : {0.0, 0.25, 1.0, 4.0, 5.0, 7.5, 9.0}) {
    const CellPoints points(level, number);
    std::int64_t count = 0;
    for_each_cell(level.domain, [&](IntVec3 cell) {
      std::set<std::pair<double, double>> places;
      for (int n = 0; n < points.count(cell); ++n) {
        const Vec3 p = points.point(cell, n);
        EXPECT_EQ(cell_at(level, p), cell);
        EXPECT_TRUE(places.insert({p.x, p.y}).second);
      }
      EXPECT_LE(points.count(cell), points.most());
      count += points.count(cell);
    });
    const double expected = 64 * number, share = number - std::floor(number);
    EXPECT_NEAR(static_cast<double>(count), expected, share == 0 ? 0 : 4 * std::sqrt(64 * share));
  }
  // Four: a lattice of two a direction.
  EXPECT_EQ(CellPoints(level, 4).point({0, 0, 0}, 3), (Vec3{0.09375, 0.09375, 0.5}));
}

// The mean of a linear function over the sequence comes near its mean over the cell.
TEST(CellPoints, SpreadEvenly) {
  const Level level = square(0, 1, {});
  constexpr int count = 1000;
  double x = 0, y = 0, xy = 0;
  for (int n = 0; n < count; ++n) {
    const Vec3 p = spread_point(level, {0, 0, 0}, n);
    x += p.x / count;
    y += p.y / count;
    xy += p.x * p.y / count;
  }
  EXPECT_NEAR(x, 0.5, 2e-3);
  EXPECT_NEAR(y, 0.5, 2e-3);
  EXPECT_NEAR(xy, 0.25, 2e-3);
}

}  // namespace
}  // namespace sluice::particle_store_test
