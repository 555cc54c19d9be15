// Ranks that hold parts of the faces get the bits of one that holds all. ctest runs this once more
// on three ranks.
#include <gtest/gtest.h>

#include "framework/base/close_ranks_test_support.hpp"
#include "mpmice/geometry/found_geometry_test_support.hpp"
#include "mpmice/geometry/occupied_cells.hpp"

namespace sluice::mpmice::solid_on_ranks {
namespace {

// Two ranks have all particles, others none.
bool is_mine(std::size_t p, std::size_t n) {
  if (world().size() == 1) return true;
  return p < n / 3 ? world().rank() == 0 : world().rank() == 1;
}

// The particles of a body that this rank has, or all of them.
Body<3> part_of(const Body<3>& body, bool all) {
  Body<3> to;
  for (std::size_t p = 0; p < body.size(); ++p) {
    if (!all && !is_mine(p, body.size())) continue;
    to.outer.push_back(body.outer[p]);
    for (std::size_t k = 0; k < Body<3>::corners; ++k)
      for (std::size_t d = 0; d < 3; ++d) {
        to.start[k][d].push_back(body.start[k][d][p]);
        to.end[k][d].push_back(body.end[k][d][p]);
      }
  }
  return to;
}

// The cells of tests, dealt out along x; every rank has and shares all blocks of them.
template <int D>
const CellBlocks<D>& shared_cells() {
  static const BlockSharers<D> sharers = [] {
    const int ranks = world().size(), width = 22 / ranks;
    std::vector<RankBox<D>> boxes;
    for (int rank = 0; rank < ranks; ++rank) {
      RankBox<D> box{{all<D>(-6), all<D>(16)}, rank};
      box.cells.lower[0] = -6 + rank * width;
      box.cells.upper[0] = rank + 1 < ranks ? -6 + (rank + 1) * width : 16;
      boxes.push_back(box);
    }
    return BlockSharers<D>(boxes, {}, {all<D>(-6), all<D>(16)}, world());
  }();
  static const CellBlocks<D> cells = [] {
    CellBlocks<D> blocks;
    blocks.begin({all<D>(-6), all<D>(16)}, &sharers);
    blocks.add({all<D>(-6), all<D>(16)});
    blocks.finish();
    return blocks;
  }();
  return cells;
}

struct Found {
  SolidInCells<3> end;
  SweptVolumes<3> swept;
};

Found find(const Body<3>& whole, bool all) {
  const Body<3> body = part_of(whole, all);
  const OuterFaces<3> faces = body.faces();
  const SolidParticles<3> particles = particles_of(body);
  FreeCells<3> free;
  SolidSums<3> end;
  SweptSums<3> swept;
  const CellBlocks<3>& cells = all ? test_cells<3>().blocks : shared_cells<3>();
  free.begin(cells, {});
  end.begin(cells);
  swept.begin(cells);
  free.add(particles, When::end);
  end.add(faces, When::end, 0, faces.size(), nullptr);
  swept.add(faces, 0, faces.size(), free);
  if (!all) {
    free.sums().sum_over_ranks(world());
    end.sum_over_ranks(world());
    swept.sum_over_ranks(world());
  }
  free.finish();
  ReferenceCells<3> at_end, mean;
  at_end.begin(free);
  at_end.add(particles, When::end);
  mean.begin(free);
  mean.add_mean(particles);
  if (!all) {
    at_end.sum_over_ranks(world());
    mean.sum_over_ranks(world());
  }
  Found to;
  end.finish(free, at_end.values(), to.end);
  swept.finish(free, mean.values(), to.swept);
  return to;
}

// In the cells that a rank has; the first of three has not those of the last.
void check_bits(const Body<3>& body) {
  const Found whole = find(body, true), parts = find(body, false);
  const CellBlocks<3>& cells = shared_cells<3>();
  for (std::size_t b = 1; b <= cells.block_count(); ++b)
    for_each_cell_of<3>(cells.cells(b), [&](const Cell<3>& c) {
      const std::size_t i = cells.index(c), j = test_cells<3>().index(c);
      EXPECT_EQ(parts.end.theta[i], whole.end.theta[j]);
      for (std::size_t d = 0; d < 3; ++d) {
        EXPECT_EQ(parts.end.a[d][i], whole.end.a[d][j]);
        EXPECT_EQ(parts.end.n[d][i], whole.end.n[d][j]);
        EXPECT_EQ(parts.swept.A[d][i], whole.swept.A[d][j]);
        EXPECT_EQ(parts.swept.C[d][i], whole.swept.C[d][j]);
      }
    });
}

TEST(SolidOnRanks, GeometryHasTheBitsOfOne) {
  Body<3> body = ball<3>();
  body.move(deformation<3>());
  check_bits(body);
}

// All faces of all particles: blocks without a free cell to begin at.
TEST(SolidOnRanks, DebrisHasTheBitsOfOne) {
  Body<3> body = block<3>("", 9, {1.1, 1.2, 1.3}, 0.2);
  std::fill(body.outer.begin(), body.outer.end(), static_cast<std::uint8_t>(0x3f));
  body.move(deformation<3>());
  check_bits(body);
}

TEST(SolidOnRanks, KnowTheCellsThatAnyOneOccupies) {
  const int rank = world().rank(), last = world().size() - 1;
  OccupiedCells<2> cells;
  cells.begin({{-8, -8}, {24, 24}});
  if (rank != 1) cells.add({{3 - rank, rank}, {5, 6 + rank}});  // rank 1 has none
  cells.grow();
  if (last > 0) cells.join(*shared_cells<2>().sharers(), 3);
  const int edge = last == 1 ? 0 : last;
  CellBox<2> hull;
  for (const CellBox<2>& box : cells.boxes()) hull.include(box);
  EXPECT_EQ(hull, (CellBox<2>{{3 - edge, 0}, {5, 6 + edge}}));
  for (const CellBox<2>& box : cells.boxes()) {
    const CellBox<2> blocks = BlockDirectory<2>::blocks_of(box);
    EXPECT_EQ(blocks.cells(), 1u);
  }
}

TEST(SolidOnRanks, NoFacesAtAll) {
  FreeCells<2> free;
  SolidSums<2> sums;
  free.begin(shared_cells<2>(), {});
  sums.begin(shared_cells<2>());
  sums.add(OuterFaces<2>(), When::start, 0, 0, &free);
  free.sums().sum_over_ranks(world());
  sums.sum_over_ranks(world());
  free.finish();
  SolidInCells<2> g;
  sums.finish(free, nullptr, g);
  EXPECT_EQ(g.theta, KeptArray<double>(shared_cells<2>().size(), 0.0));
}

}  // namespace
}  // namespace sluice::mpmice::solid_on_ranks
