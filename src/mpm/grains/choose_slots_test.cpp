// The rules by which clusters of grains get materials, one after the other.
#include "mpm/grains/choose_slots.hpp"

#include <gtest/gtest.h>

namespace sluice::mpm::choose_slots_test {
namespace {

using Slots = std::vector<int>;

// 40 cells along x, in parts of 4.
Level line(bool periodic = false) {
  Level level;
  level.domain = {{0, 0, 0}, {40, 1, 1}};
  level.active = {true, false, false};
  level.periodic = {periodic, false, false};
  return level;
}

Cluster cluster(const GridParts& parts, std::int64_t label, std::int64_t size, int home,
                std::vector<double> places) {
  Cluster c;
  c.label = label;
  c.size = size;
  c.home = home;
  for (const double x : places) c.parts.insert(parts.of({x, 0, 0}));
  return c;
}

TEST(Slots, TheLargestPartKeepsTheMaterial) {
  const Level level = line();
  const GridParts parts(level, 4);
  const GrainFamily family{{1, 2, 5}, 3};
  const std::vector<Cluster> clusters = {cluster(parts, 3, 4, 2, {1}), cluster(parts, 7, 9, 2, {5}),
                                         cluster(parts, 8, 9, 2, {9})};
  const SlotChoice choice = choose_slots(clusters, family, parts);
  EXPECT_EQ(choice.slots, (Slots{5, 2, 1}));  // equal ones by label
  EXPECT_EQ(choice.near_ones, 0);
}

TEST(Slots, FarClustersShareBeforeOnesWithoutContact) {
  const Level level = line();
  const GridParts parts(level, 4);
  const GrainFamily family{{1, 2, 8}, 2};
  EXPECT_TRUE(all_fit(2, family));
  EXPECT_FALSE(all_fit(3, family));
  std::vector<Cluster> clusters = {cluster(parts, 1, 9, 1, {1}), cluster(parts, 2, 8, 1, {5}),
                                   cluster(parts, 3, 7, 1, {30}), cluster(parts, 4, 6, 1, {3}),
                                   cluster(parts, 5, 5, 1, {2})};
  SlotChoice choice = choose_slots(clusters, family, parts);
  EXPECT_EQ(choice.slots, (Slots{1, 2, 1, 8, 1}));
  EXPECT_EQ(choice.near_ones, 1);
  // What has been chosen is chosen again.
  for (std::size_t n = 0; n < clusters.size(); ++n) clusters[n].home = choice.slots[n];
  EXPECT_EQ(choose_slots(clusters, family, parts).slots, choice.slots);
  // What no contact acted on comes back as soon as there is room; the near one gives way.
  clusters.erase(clusters.begin());
  EXPECT_EQ(choose_slots(clusters, family, parts).slots, (Slots{2, 1, 1, 8}));
}

TEST(Slots, PartsAreNeighboursThroughPeriodicSides) {
  for (const bool periodic : {false, true}) {
    const Level level = line(periodic);
    const GridParts parts(level, 4);
    const GrainFamily family{{0, 1}, 0};
    const std::vector<Cluster> clusters = {
        cluster(parts, 1, 9, 0, {1}), cluster(parts, 2, 8, 1, {20}), cluster(parts, 3, 7, 0, {39})};
    EXPECT_EQ(choose_slots(clusters, family, parts).slots,
              periodic ? (Slots{0, 1, 1}) : (Slots{0, 1, 0}));
  }
}

}  // namespace
}  // namespace sluice::mpm::choose_slots_test
