// Runs of equal keys, pieces across short gaps, sets of materials: against a look at each cell.
#include "ice/mixture/runs.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace sluice::ice::mixture {
namespace {

// Keys that change seldom, so that runs are longer and shorter than what is looked at in one go.
std::vector<double> keys_of(unsigned seed, int n) {
  std::mt19937 random(seed);
  std::vector<double> keys;
  while (static_cast<int>(keys.size()) < n) {
    const double key = static_cast<double>(random() % 3) - 1.0;
    keys.insert(keys.end(), 1 + random() % (random() % 2 == 0 ? 3 : 90), key);
  }
  keys.resize(static_cast<std::size_t>(n));
  return keys;
}

TEST(Runs, CoverTheRowAndEndWhereTheKeyChanges) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const int n = 1 + static_cast<int>(seed) * 3 % 301;
    const std::vector<double> keys = keys_of(seed, n);
    int next = 0;
    for_each_run(keys.data(), n, [&](int first, int count, double key) {
      ASSERT_EQ(first, next);
      ASSERT_GT(count, 0);
      for (int i = first; i < first + count; ++i) ASSERT_EQ(keys[static_cast<std::size_t>(i)], key);
      next = first + count;
      if (next < n) {
        EXPECT_NE(keys[static_cast<std::size_t>(next)], key);
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
    for_each_face_run(a.data(), b.data(), n, [&](int first, int count, double key) {
      for (int i = first; i < first + count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        EXPECT_EQ(key, a[k] == b[k] ? a[k] : -1.0);
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
      const auto kind = [&](std::size_t m) { return alike ? 7 : static_cast<int>(m); };
      std::vector<int> met(static_cast<std::size_t>(n), 0);
      for_each_pure_piece([&](auto&& f) { for_each_run(keys.data(), n, f); }, kind,
                          [&](int first, int count, int of) {
                            for (int i = first; i < first + count; ++i) {
                              const auto k = static_cast<std::size_t>(i);
                              ++met[k];
                              if (keys[k] >= 0) {
                                EXPECT_EQ(of, kind(static_cast<std::size_t>(keys[k])));
                              }
                            }
                            EXPECT_GE(keys[static_cast<std::size_t>(first)], 0);
                            EXPECT_GE(keys[static_cast<std::size_t>(first + count - 1)], 0);
                          });
      for (std::size_t k = 0; k < keys.size(); ++k)
        if (keys[k] >= 0) {
          EXPECT_EQ(met[k], 1);
        }
    }
}

TEST(Runs, SetsOfOneTellTheirMaterial) {
  for (int m = 0; m < most_materials; ++m) {
    EXPECT_EQ(single_of(only(m)), m);
    EXPECT_TRUE(is_single(only(m)));
    for (int other = 0; other < m; ++other) EXPECT_EQ(single_of(only(m) + only(other)), -1);
  }
  EXPECT_EQ(single_of(0.0), -1);
}

}  // namespace
}  // namespace sluice::ice::mixture
