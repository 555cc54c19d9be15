// Ranks that hold parts of the faces get the bits of one that holds all. ctest runs this once more
// on three ranks.
#include <gtest/gtest.h>

#include "framework/base/close_ranks_test_support.hpp"
#include "mpmice/geometry/bodies_test_support.hpp"
#include "mpmice/geometry/occupied_cells.hpp"
#include "mpmice/geometry/solid_in_cells.hpp"
#include "mpmice/geometry/swept_volumes.hpp"

namespace sluice::mpmice::solid_on_ranks {
namespace {

OuterFaces<3> moving_faces() {
  Body<3> body = ball<3>();
  body.move(deformation<3>());
  return body.faces();
}

// Two ranks have all faces, others none.
std::pair<std::size_t, std::size_t> mine(std::size_t n) {
  if (world().size() == 1) return {0, n};
  if (world().rank() > 1) return {n, n};
  return world().rank() == 0 ? std::pair{std::size_t{0}, n / 3} : std::pair{n / 3, n};
}

TEST(SolidOnRanks, ThetaAndFacesHaveTheBitsOfOne) {
  const OuterFaces<3> faces = moving_faces();
  const auto find = [&](std::size_t begin, std::size_t end, bool sum) {
    SolidSums<3> sums;
    sums.begin(test_cells<3>().blocks);
    sums.add(faces, When::start, begin, end);
    if (sum) sums.sum_over_ranks(world());
    SolidInCells<3> g;
    sums.finish(g);
    return g;
  };
  const auto [begin, end] = mine(faces.size());
  const SolidInCells<3> whole = find(0, faces.size(), false), g = find(begin, end, true);
  EXPECT_EQ(g.theta, whole.theta);
  EXPECT_EQ(g.a, whole.a);
  EXPECT_EQ(g.n, whole.n);
}

TEST(SolidOnRanks, SweptVolumesHaveTheBitsOfOne) {
  const OuterFaces<3> faces = moving_faces();
  const auto find = [&](std::size_t begin, std::size_t end, bool sum) {
    SweptSums<3> sums;
    sums.begin(test_cells<3>().blocks, true);
    sums.add(faces, begin, end);
    if (sum) sums.sum_over_ranks(world());
    SweptVolumes<3> s;
    sums.finish(s);
    return s;
  };
  const auto [begin, end] = mine(faces.size());
  const SweptVolumes<3> whole = find(0, faces.size(), false), s = find(begin, end, true);
  EXPECT_EQ(s.q, whole.q);
  EXPECT_EQ(s.A, whole.A);
  EXPECT_EQ(s.C, whole.C);
  EXPECT_EQ(s.M, whole.M);
}

TEST(SolidOnRanks, KnowTheCellsThatAnyOneOccupies) {
  const int rank = world().rank(), last = world().size() - 1;
  OccupiedCells<2> cells;
  cells.begin({{-8, -8}, {24, 24}});
  if (rank != 1) cells.add({{3 - rank, rank}, {5, 6 + rank}});  // rank 1 has none
  cells.join(world());
  const int edge = last == 1 ? 0 : last;
  EXPECT_EQ(cells.hull(), (CellBox<2>{{3 - edge, 0}, {5, 6 + edge}}));
  for (const CellBox<2>& box : cells.boxes()) {
    const CellBox<2> blocks = BlockDirectory<2>::blocks_of(box);
    EXPECT_EQ(blocks.cells(), 1u);
  }
}

TEST(SolidOnRanks, NoFacesAtAll) {
  SolidSums<2> sums;
  sums.begin(test_cells<2>().blocks);
  sums.add(OuterFaces<2>(), When::start, 0, 0);
  sums.sum_over_ranks(world());
  SolidInCells<2> g;
  sums.finish(g);
  EXPECT_EQ(g.theta, KeptArray<double>(test_cells<2>().size(), 0.0));
}

}  // namespace
}  // namespace sluice::mpmice::solid_on_ranks
