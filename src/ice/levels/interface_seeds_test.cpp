// Which cells hold an interface between materials, whoever owns them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "ice/fluid/labels.hpp"
#include "ice/levels/interface_seeds.hpp"

namespace sluice::ice::interface_seeds_test {
namespace {

using Cells = std::set<std::tuple<int, int, int>>;

// Volume fractions of materials 0 and 1 in 6 x 4 x 2 cells, or fewer dimensions of them.
class InterfaceSeeds : public testing::Test {
 protected:
  void build(int axes, IntVec3 boxes = {1, 1, 1}) {
    level_ = {};
    level_.domain = {{0, 0, 0}, {6, axes > 1 ? 4 : 1, axes > 2 ? 2 : 1}};
    level_.active = {true, axes > 1, axes > 2};
    for (const IndexBox& b : split(level_.domain, boxes))
      level_.boxes.push_back({b, 0, static_cast<int>(level_.boxes.size())});
    state_ = std::make_unique<Warehouse>(level_, 0);
    for (int m = 0; m < 3; ++m) state_->add({labels().volume, m, 1, 3});
  }
  // The rest of a cell is of material 1; ghost cells hold what lies across a periodic side.
  template <class F>
  void fill(F&& fraction) {
    const IntVec3 n = level_.domain.size();
    for (int b = 0; b < static_cast<int>(level_.boxes.size()); ++b) {
      const RealView v = state_->view(0, 0, b), rest = state_->view(1, 0, b);
      for_each_cell(v.box, [&](IntVec3 c) {
        v(c) = fraction({(c.x + n.x) % n.x, (c.y + n.y) % n.y, (c.z + n.z) % n.z});
        rest(c) = 1 - v(c);
      });
    }
  }
  Cells seeds(int material, double distance = 0) const {
    const auto all = interface_seeds(*state_, {0, 1, 2}, {{material, distance, 1, {}}});
    EXPECT_EQ(all.size(), 1u);
    EXPECT_EQ(all.front().distance, distance);
    Cells cells;
    for (const IntVec3& c : all.front().cells) cells.insert({c.x, c.y, c.z});
    return cells;
  }

  Level level_;
  std::unique_ptr<Warehouse> state_;
};

TEST_F(InterfaceSeeds, AreCellsFilledInPart) {
  build(1);
  fill([](IntVec3 c) { return c.x < 3 ? 1.0 : c.x == 3 ? 0.3 : 0.0; });
  // At the periodic side full and empty cells meet at a face.
  const Cells wanted = {{0, 0, 0}, {3, 0, 0}, {5, 0, 0}};
  EXPECT_EQ(seeds(0), wanted);
  EXPECT_EQ(seeds(1), wanted);
  EXPECT_EQ(seeds(-1), wanted);
  EXPECT_EQ(seeds(2), Cells());  // it is nowhere
}

TEST_F(InterfaceSeeds, AreBothCellsAtAFaceWhereFullMeetsEmptyInAnyDirection) {
  for (int axes = 1; axes <= 3; ++axes)
    for (int d = 0; d < axes; ++d)
      for (const IntVec3 boxes : {IntVec3{1, 1, 1}, IntVec3{3, axes > 1 ? 2 : 1, 1}}) {
        SCOPED_TRACE(axes * 10 + d);
        build(axes, boxes);
        IntVec3 full{4, axes > 1 ? 1 : 0, 0};
        fill([&](IntVec3 c) { return c[d] == full[d] ? 1.0 : 0.0; });
        Cells wanted;
        const int n = level_.domain.size()[d];
        for_each_cell(level_.domain, [&](IntVec3 c) {
          const int apart = std::abs(c[d] - full[d]);
          if (std::min(apart, n - apart) <= 1) wanted.insert({c.x, c.y, c.z});
        });
        EXPECT_EQ(seeds(0), wanted);
      }
}

TEST_F(InterfaceSeeds, AreNotWhereThereAreTracesOrSmoothMixturesOfThem) {
  build(2);
  fill([](IntVec3 c) { return c.x == 2 ? 1e-6 : 0.0; });
  EXPECT_EQ(seeds(-1), Cells());
  fill([](IntVec3 c) { return c.x < 2 ? 1 - 1e-6 : c.x == 2 ? 1e-6 : 0.0; });  // full enough
  EXPECT_EQ(seeds(0).count({1, 0, 0}), 1u);
  EXPECT_EQ(seeds(0).count({2, 0, 0}), 1u);
  EXPECT_EQ(seeds(0).count({3, 0, 0}), 0u);
}

TEST_F(InterfaceSeeds, AskForLevelsUpToTheOneThatIsNamed) {
  build(1);
  fill([](IntVec3) { return 0.5; });
  const std::vector<InterfaceCriterion> criteria = {{0, 0.3, 1, {}}, {-1, 0.1, 2, {}}};
  EXPECT_EQ(interface_seeds(*state_, {0, 1, 2}, criteria).size(), 2u);
  level_.index = 1;
  const auto finer = interface_seeds(*state_, {0, 1, 2}, criteria);
  ASSERT_EQ(finer.size(), 1u);
  EXPECT_EQ(finer.front().distance, 0.1);
  level_.index = 2;
  EXPECT_TRUE(interface_seeds(*state_, {0, 1, 2}, criteria).empty());
}

// Off: no cell is looked at, not even for where the fractions are.
TEST_F(InterfaceSeeds, AreNoneWithoutACriterionOrWithOneMaterial) {
  const Level level;
  const Warehouse nothing(level, 0);
  EXPECT_TRUE(interface_seeds(nothing, {0, 1, 2}, {}).empty());
  EXPECT_TRUE(interface_seeds(nothing, {0}, {{-1, 1, 1, {}}}).empty());
}

}  // namespace
}  // namespace sluice::ice::interface_seeds_test
