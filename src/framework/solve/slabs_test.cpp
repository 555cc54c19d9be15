// Windows that ranks share, against the same windows whole on every rank: the same bits.
#include "framework/solve/slabs.hpp"

#include <gtest/gtest.h>

#include "framework/solve/all_boxes.hpp"
#include "framework/solve/multigrid_cycle.hpp"
#include "framework/solve/solve_test_support.hpp"

namespace sluice::solve::slabs_test {
namespace {

struct Case {
  IntVec3 cells, pieces;
  Sides sides;
  double aspect;
  int balls;
};

class SharedWindow : public testing::TestWithParam<Case> {
 protected:
  SharedWindow()
      : c_(GetParam()),
        level_(level_of(c_.cells, c_.pieces, c_.sides)),
        matrix_(matrix_of(*level_, {c_.sides == Sides::periodic ? 0.0 : 0.1,
                                    {1, c_.aspect * c_.aspect, 1},
                                    balls(c_.cells, c_.balls),
                                    c_.sides})),
        shared_(matrix_),
        whole_(make_whole()) {}

  static ConstBoxViews constant(const BoxViews& v) { return {v.begin(), v.end()}; }
  DenseSystem make_whole() const {
    const AllBoxes diagonal(*level_, constant(matrix_.diagonal()));
    const AllBoxes low0(*level_, constant(matrix_.low(0))), low1(*level_, constant(matrix_.low(1))),
        low2(*level_, constant(matrix_.low(2)));
    return {*level_, diagonal.views(), {low0.views(), low1.views(), low2.views()}};
  }
  DenseVector loaded(const DenseSystem& system) const {
    const BoxArrays b(boxes_of(*level_, world().rank()));
    fill_views(b.views(), noisy);
    DenseVector v = system.vector();
    system.load(b.values(), v);
    return v;
  }
  // How many cells of the slab of this rank differ.
  int different(const DenseVector& a, const DenseVector& b) const {
    int count = 0;
    shared_.for_cells([&](std::size_t c) { count += a[c] != b[c]; });
    return count;
  }

  Case c_;
  std::unique_ptr<Level> level_;
  CellMatrix matrix_;
  DenseSystem shared_, whole_;
};

TEST_P(SharedWindow, GivesTheBitsOfTheWhole) {
  EXPECT_EQ(shared_.slabs().shared(), world().size() > 1);
  EXPECT_EQ(shared_.singular(), whole_.singular());
  DenseVector x = loaded(shared_), y = shared_.vector();
  DenseVector whole_x = loaded(whole_), whole_y = whole_.vector();
  EXPECT_EQ(different(x, whole_x), 0);
  shared_.apply(x, y), whole_.apply(whole_x, whole_y);
  EXPECT_EQ(different(y, whole_y), 0);
  for (const Norm norm : {Norm::two, Norm::one, Norm::largest})
    EXPECT_EQ(shared_.norm(y, norm), whole_.norm(whole_y, norm));
  shared_.remove_mean(x), whole_.remove_mean(whole_x);
  MultigridCycle cycle(shared_), whole_cycle(whole_);
  const double size = whole_.norm(whole_x, Norm::two);
  cycle.apply(shared_, x, size, y), whole_cycle.apply(whole_, whole_x, size, whole_y);
  EXPECT_EQ(different(y, whole_y), 0);
  EXPECT_EQ(shared_.dot(x, y), whole_.dot(whole_x, whole_y));
}

TEST_P(SharedWindow, GoesBackIntoTheBoxes) {
  const BoxArrays found(boxes_of(*level_, world().rank()));
  shared_.store(loaded(shared_), found.views());
  for (const RealView& v : found.views())
    for_each_cell(v.box, [&](IntVec3 cell) { ASSERT_EQ(v(cell), noisy(cell)); });
}

TEST_P(SharedWindow, EveryRankNamesTheSameFault) {
  CellMatrix bad = matrix_of(*level_, {1.0, {1, 1, 1}, balls(c_.cells, 0), Sides::neumann});
  const IntVec3 at{1, c_.cells.y / 2, c_.cells.z - 1};
  for (const RealView& v : bad.diagonal())
    if (v.box.contains(at)) v(at) = -1;
  try {
    const DenseSystem system(bad);
    ADD_FAILURE() << "no fault found";
  } catch (const PhysicsError& error) {
    const std::string cell = fmt::format("cell ({}, {}, {})", at.x, at.y, at.z);
    EXPECT_NE(std::string(error.what()).find(cell), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(Of, SharedWindow,
                         testing::Values(Case{{16, 20, 24}, {1, 2, 3}, Sides::neumann, 1, 0},
                                         Case{{16, 20, 24}, {2, 1, 1}, Sides::mixed, 1, 5},
                                         Case{{17, 19, 29}, {1, 1, 2}, Sides::dirichlet, 1, 5},
                                         Case{{16, 16, 32}, {1, 1, 4}, Sides::periodic, 1, 0},
                                         Case{{24, 16, 20}, {2, 2, 2}, Sides::neumann, 100, 5},
                                         Case{{40, 8, 40}, {1, 1, 1}, Sides::mixed, 0.01, 0}));

}  // namespace
}  // namespace sluice::solve::slabs_test
