// Runs of equal keys, pieces across short gaps, sets of materials: against a look at each cell.
#include "ice/step/material_runs.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace sluice::ice::runs_test {
namespace {

// Keys that change seldom, so that runs are longer and shorter than what is looked at in one go.
std::vector<double> keys_of(unsigned seed, int n) {
  std::mt19937 random(seed);
  std::vector<double> keys;
  while (static_cast<int>(keys.size()) < n) {
    const double key = static_cast<double>(random() % 3) - 1.0;
    keys.insert(keys.end(), 1 + random() % (random() % 2 == 0 ? 3 : 90), key);
  }
  keys.resize(n);
  return keys;
}

// What is left of runs, found in two parts of the row: runs may end where the first does.
struct Runs {
  explicit Runs(const std::vector<double>& k, int part = 0) : keys(k), left(k.size()) {
    find(0, part);
    find(part, static_cast<int>(k.size()) - part);
  }
  RunRow row() const { return {keys.data(), left.data()}; }
  void find(int first, int count) {
    RunWriter runs(keys.data() + first, left.data() + first);
    runs.find(count);
    runs.close();
  }

  std::vector<double> keys, left;
};

TEST(Runs, CoverTheRowAndEndWhereTheKeyChanges) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const int n = 1 + static_cast<int>(seed) * 3 % 301;
    const std::vector<double> keys = keys_of(seed, n);
    int next = 0;
    const Runs runs(keys);
    for_each_run(runs.row(), n, [&](int first, int count, double key) {
      ASSERT_EQ(first, next);
      ASSERT_GT(count, 0);
      for (int i = first; i < first + count; ++i) ASSERT_EQ(keys[i], key);
      next = first + count;
      if (next < n) {
        EXPECT_NE(keys[next], key);
      }
    });
    EXPECT_EQ(next, n);
  }
}

TEST(Runs, FacesBetweenUnlikeKeysAreMixed) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const int n = 150;
    const std::vector<double> a = keys_of(seed, n), b = keys_of(seed + 1000, n);
    int next = 0;
    const Runs low(a, 20), high(b, 77);
    for_each_face_run(low.row(), high.row(), n, [&](int first, int count, double key) {
      for (int i = first; i < first + count; ++i) {
        EXPECT_EQ(key, a[i] == b[i] ? a[i] : -1.0);
      }
      next = first + count;
    });
    EXPECT_EQ(next, n);
  }
}

// Cells of one material lie in exactly one piece, of the right kind, and end it on both sides.
TEST(Runs, PiecesHoldAllThatIsPure) {
  for (const bool alike : {true, false})
    for (unsigned seed = 0; seed < 200; ++seed) {
      const int n = 200;
      const std::vector<double> keys = keys_of(seed, n);
      const Runs runs(keys);
      const auto kind = [&](std::size_t m) { return alike ? 7 : static_cast<int>(m); };
      std::vector<int> met(n, 0);
      for_each_pure_piece([&](auto&& f) { for_each_run(runs.row(), n, f); }, kind,
                          [&](int first, int count, int of) {
                            for (int i = first; i < first + count; ++i) {
                              ++met[i];
                              if (keys[i] >= 0) {
                                EXPECT_EQ(of, kind(static_cast<std::size_t>(keys[i])));
                              }
                            }
                            EXPECT_GE(keys[first], 0);
                            EXPECT_GE(keys[first + count - 1], 0);
                          });
      for (std::size_t k = 0; k < keys.size(); ++k)
        if (keys[k] >= 0) {
          EXPECT_EQ(met[k], 1);
        }
    }
}

// The same, but all cells lie in a piece.
TEST(Runs, PiecesCoverTheRow) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const int n = 200;
    const Runs runs(keys_of(seed, n));
    int next = 0, kind = -1;
    for_each_piece([&](auto&& f) { for_each_run(runs.row(), n, f); }, n,
                   [](std::size_t m) { return static_cast<int>(m); },
                   [&](int first, int count, int of) {
                     ASSERT_EQ(first, next);
                     ASSERT_NE(of, kind);
                     for (int i = first; i < first + count; ++i) {
                       const double key = runs.keys[i];
                       EXPECT_TRUE(key < 0 || key == of);
                     }
                     next = first + count;
                     kind = of;
                   });
    EXPECT_EQ(next, n);
  }
}

TEST(Runs, NeighbourhoodsArePureWhereAllRowsHoldOneMaterialAllAround) {
  std::mt19937 random(5);
  for (unsigned seed = 0; seed < 300; ++seed) {
    const int n = 120, rows = seed % 3 == 0 ? 1 : seed % 3 == 1 ? 3 : 9;
    std::vector<Runs> around;
    std::vector<RunRow> views;
    std::vector<double> sets = keys_of(seed, n + 2);
    for (double& set : sets) set += 2.0;  // 1, 2, or both
    for (int r = 0; r < rows; ++r) {
      std::vector<double> own = sets;
      if (random() % 4 == 0) own[random() % own.size()] = 3.0;
      around.emplace_back(own, static_cast<int>(random() % own.size()));
    }
    for (const Runs& r : around) views.push_back(r.row());
    const int room = n + static_cast<int>(seed % 8);  // runs may leave whole vectors in it
    std::vector<double> pure(room), left(pure);
    write_pure(views.data(), rows, n, pure.data(), left.data(), room);
    pure.resize(n);
    left.resize(n);
    const Runs expected(pure);
    EXPECT_EQ(left, expected.left);
    for (std::size_t i = 0; i < pure.size(); ++i) {
      double key = single_of(sets[i + 1]);
      for (const Runs& r : around)
        for (std::size_t c = i; c < i + 3; ++c)
          if (r.keys[c] != around[0].keys[i + 1] || single_of(r.keys[c]) < 0) key = -1.0;
      EXPECT_EQ(pure[i], key);
    }
  }
}

TEST(Runs, CellsAreNearWhereAnyRowIsMixed) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const int n = 120;
    std::vector<Runs> around;
    std::vector<RunRow> views;
    for (unsigned r = 0; r < 1 + seed % 7; ++r)
      around.emplace_back(keys_of(100 * seed + r, n), static_cast<int>(seed));
    for (const Runs& r : around) views.push_back(r.row());
    const int room = n + static_cast<int>(seed % 8);
    std::vector<double> near(room), left(near);
    write_near(views.data(), static_cast<int>(views.size()), n, near.data(), left.data(), room);
    near.resize(n);
    left.resize(n);
    EXPECT_EQ(left, Runs(near).left);
    for (std::size_t i = 0; i < near.size(); ++i) {
      bool any = false;
      for (const Runs& r : around) any = any || r.keys[i] < 0.0;
      EXPECT_EQ(near[i], any ? 1.0 : 0.0);
    }
  }
}

TEST(Runs, SetsOfOneTellTheirMaterial) {
  for (int m = 0; m < max_materials; ++m) {
    EXPECT_EQ(single_of(only(m)), m);
    EXPECT_TRUE(is_single(only(m)));
    for (int other = 0; other < m; ++other) EXPECT_EQ(single_of(only(m) + only(other)), -1);
  }
  EXPECT_EQ(single_of(0.0), -1);
}

}  // namespace
}  // namespace sluice::ice::runs_test
