// Clusters of grains against all pairs, and what shapes bodies may have without falling apart.
#include "mpm/grains/clusters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

namespace sluice::mpm::clusters_test {
namespace {

Level level_of(int directions, bool periodic) {
  Level level;
  level.anchor = {-1, 0, 2};
  level.spacing = {0.1, 0.2, 0.1};
  level.domain = {{0, 0, 0}, {12, directions > 1 ? 9 : 1, directions > 2 ? 7 : 1}};
  level.active = {true, directions > 1, directions > 2};
  level.periodic = {periodic, false, false};
  return level;
}

std::vector<GrainBox> random_boxes(const Level& level, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> in(0, 1);
  std::vector<GrainBox> boxes(count);
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    boxes[n].id = boxes[n].label = static_cast<std::int64_t>(7 * n + 3);
    for (int d = 0; d < 3; ++d) {
      if (!level.active[d]) continue;
      boxes[n].place[d] = level.anchor[d] + in(random)*level.domain.size()[d] * level.spacing[d];
      boxes[n].half[d] = (0.05 + 0.6 * in(random)) * level.spacing[d];
    }
  }
  std::shuffle(boxes.begin(), boxes.end(), random);
  return boxes;
}

// By spreading labels over all pairs until nothing changes.
std::map<std::int64_t, std::int64_t> by_all_pairs(std::vector<GrainBox> boxes, const Level& level) {
  for (bool changed = true; changed;) {
    changed = false;
    for (GrainBox& a : boxes)
      for (const GrainBox& b : boxes)
        if (b.label < a.label && overlap(a, b, level)) {
          a.label = b.label;
          changed = true;
        }
  }
  std::map<std::int64_t, std::int64_t> labels;
  for (const GrainBox& box : boxes) labels[box.id] = box.label;
  return labels;
}

std::map<std::int64_t, std::int64_t> labels_of(const std::vector<GrainBox>& boxes) {
  std::map<std::int64_t, std::int64_t> labels;
  for (const GrainBox& box : boxes) labels[box.id] = box.label;
  return labels;
}

TEST(Clusters, AreThoseOfAllPairsInAnyOrder) {
  const std::pair<int, int> cases[] = {{1, 12}, {2, 60}, {3, 220}};
  for (const auto& [directions, count] : cases)
    for (const bool periodic : {false, true})
      for (unsigned seed = 1; seed <= 6; ++seed) {
        const Level level = level_of(directions, periodic);
        std::vector<GrainBox> boxes = random_boxes(level, count, seed);
        const auto expected = by_all_pairs(boxes, level);
        label_clusters(boxes, level);
        EXPECT_EQ(labels_of(boxes), expected) << directions << ' ' << periodic << ' ' << seed;
        EXPECT_EQ(expected.begin()->second, expected.begin()->first);
        std::set<std::int64_t> names;
        for (const auto& [id, label] : expected) names.insert(label);
        EXPECT_GT(names.size(), 1U);
        EXPECT_LT(names.size(), expected.size());
      }
}

// Each part labels its own, and then what lies near others is joined: as ranks do it.
TEST(Clusters, DoNotDependOnWhoHoldsThem) {
  const Level level = level_of(2, true);
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::vector<GrainBox> boxes = random_boxes(level, 70, seed);
    const auto expected = by_all_pairs(boxes, level);
    std::vector<std::vector<GrainBox>> parts(3);
    for (const GrainBox& box : boxes) {
      const double share = (box.place.x - level.anchor.x) / 1.2;
      parts[share < 0.3 ? 0U : share < 0.5 ? 1U : 2U].push_back(box);
    }
    std::vector<GrainBox> rims;
    for (auto& part : parts) {
      label_clusters(part, level);
      rims.insert(rims.end(), part.begin(), part.end());
    }
    const auto renamed = join_rims(rims, level);
    for (GrainBox& box : rims) box.label = renamed.at(box.label);
    EXPECT_EQ(labels_of(rims), expected) << seed;
  }
}

// A lattice of four by four particles, two a cell and direction, that F has deformed.
std::size_t clusters_of_block(const std::array<double, 4>& F2) {
  Level level = level_of(2, false);
  level.spacing = {0.1, 0.1, 0.1};
  level.domain = {{0, 0, 0}, {80, 80, 1}};
  Columns c;
  c.F = 0;
  c.size = 9;
  c.volume = 18;
  c.volume_0 = 19;
  ParticleSet set(20);
  for (int i = 0; i < 16; ++i) {
    const double x = 0.05 * (i % 4), y = 0.05 * (i / 4);  // NOLINT(bugprone-integer-division)
    set.add({2 + F2[0] * x + F2[1] * y, 2 + F2[2] * x + F2[3] * y, 2}, i);
    for (std::size_t e = 0; e < 4; ++e) set.attribute(3 * (e / 2) + e % 2, i) = F2[e];
    set.attribute(8, i) = 1;
    for (std::size_t d = 0; d < 3; ++d) set.attribute(9 + 4 * d, i) = d < 2 ? 0.5 : 1;
    set.attribute(19, i) = 1;
    set.attribute(18, i) = F2[0] * F2[3] - F2[1] * F2[2];
  }
  std::vector<GrainBox> boxes;
  double corners = 0;
  add_grain_boxes(set, c, 1.08, level, boxes, corners);
  EXPECT_GT(corners, 0.1);
  label_clusters(boxes, level);
  std::set<std::int64_t> names;
  for (const GrainBox& box : boxes) names.insert(box.label);
  return names.size();
}

TEST(Clusters, OfADenseBodyAreOneWhateverItsShape) {
  const double c = std::cos(0.6), s = std::sin(0.6);
  EXPECT_EQ(clusters_of_block({1, 0, 0, 1}), 1U);
  EXPECT_EQ(clusters_of_block({c, -s, s, c}), 1U);
  EXPECT_EQ(clusters_of_block({1, 3, 0, 1}), 1U);         // shear
  EXPECT_EQ(clusters_of_block({3, 0, 0, 1.0 / 3}), 1U);   // stretched, as dense as before
  EXPECT_EQ(clusters_of_block({1.079, 0, 0, 1}), 1U);     // nearly J_c
  EXPECT_EQ(clusters_of_block({1.05, 0, 0, 1.05}), 16U);  // 1.1025
  EXPECT_EQ(clusters_of_block({0.7, 0, 0, 0.7}), 1U);
}

}  // namespace
}  // namespace sluice::mpm::clusters_test
