// Which faces look where, and how they are taken from columns of particles.
#include "mpmice/geometry/outer_faces.hpp"

#include <gtest/gtest.h>

#include "mpmice/geometry/bodies_test_support.hpp"
#include "mpmice/geometry/facet.hpp"
#include "mpmice/geometry/pieces.hpp"

namespace sluice::mpmice::outer_faces {
namespace {

template <int D>
void check_orientation() {
  const OuterFaces<D> faces = block<D>("", 1, {}).faces();
  ASSERT_EQ(faces.size(), 2u * D);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    std::array<double, D> sum{};
    for (int t = 0; t < facets_of_face<D>; ++t) {
      const auto n = area_vector<D>(facet_nodes<D>(faces.start, i, t), faces.face[i]);
      for (std::size_t d = 0; d < D; ++d) sum[d] += n[d];
    }
    const auto axis = static_cast<std::size_t>(faces.face[i] / 2);
    const double side = faces.face[i] % 2 == 1 ? 1 : -1;
    for (std::size_t d = 0; d < D; ++d)
      EXPECT_EQ(sum[d], d == axis ? side * std::pow(0.5, D - 1) : 0) << i << ", " << d;
    for (int k = 0; k < corners_of_face<D>; ++k)  // all of its corners lie on that side
      EXPECT_EQ(faces.corner(i, k) >> axis & 1, faces.face[i] % 2);
  }
}

TEST(OuterFaces, LookOutward) {
  check_orientation<1>();
  check_orientation<2>();
  check_orientation<3>();
}

TEST(OuterFaces, AreThoseThatAreMarkedInCellsOfTheLevel) {
  Body<2> body = block<2>("", 3, {1, 2});  // edges 1/2
  body.move([](const Point<2>& x) -> Point<2> { return {x[0] + 4, x[1]}; });
  const auto from = Body<2>::columns(body.start), to = Body<2>::columns(body.end);
  CellUnits<2> units;
  units.origin = {1, 1};
  units.inverse = {4, 2};
  OuterFaces<2> faces;
  faces.add(from, &to, body.outer.data(), body.size(), units);
  EXPECT_EQ(faces.size(), 12u);
  faces.add(from, nullptr, body.outer.data(), 1, units, 100);  // two faces of the corner
  ASSERT_EQ(faces.size(), 14u);
  EXPECT_EQ(faces.particle[13], 100u);
  EXPECT_EQ(faces.particle[11], 8u);
  EXPECT_EQ(faces.face[12], 0);  // low along x, from above to below
  EXPECT_EQ(faces.start[0][0][12], 0);
  EXPECT_EQ(faces.start[0][1][12], 3);
  EXPECT_EQ(faces.start[1][1][12], 2);
  EXPECT_EQ(faces.end[0][1][12], 3);
  EXPECT_EQ(faces.end[0][0][0], 16);
  faces.clear();
  EXPECT_EQ(faces.size(), 0u);
  EXPECT_TRUE(faces.end[1][1].empty());
}

TEST(OuterFaces, BoxesOfActiveDirections) {
  const IndexBox box{{1, 0, -2}, {5, 1, 7}};
  const CellBox<2> to = cell_box<2>(box, {0, 2, 1});
  EXPECT_EQ(to, (CellBox<2>{{1, -2}, {5, 7}}));
  EXPECT_EQ(to.cells(), 36u);
  EXPECT_EQ(to.index({2, -1}), 5u);
}

// Pieces of a facet over many cells add up to it, its moments to a third each.
TEST(OuterFaces, PiecesAddUp) {
  Body<3> body = block<3>("", 1, {});
  body.move([](const Point<3>& x) -> Point<3> {
    return {7 * x[0] - 2 * x[1] + 0.3, 5 * x[1] + x[2] - 0.7, 6 * x[2] + 3 * x[0] * x[1] + 0.2};
  });
  const OuterFaces<3> faces = body.faces();
  std::array<std::array<double, 4>, 24> sums{};
  std::size_t pieces = 0;
  double worst = 0;
  for_each_piece<3>(
      faces, When::end, 0, faces.size(), [&](std::size_t i, int t, const Piece<3>& piece) {
        const FacetNodes<3> x = facet_nodes<3>(faces.end, i, t);
        auto& sum = sums[4 * i + static_cast<std::size_t>(t)];
        sum[3] += piece.s;
        for (std::size_t k = 0; k < 3; ++k) sum[k] += piece.m[k];
        ++pieces;
        for (std::size_t d = 0; d < 3; ++d) {  // its middle lies in its cell
          double middle = 0;
          for (std::size_t k = 0; k < 3; ++k) middle += piece.m[k] * x[k][d];
          if (piece.s < 1e-9) continue;
          worst = std::max(
              {worst, piece.cell[d] - middle / piece.s, middle / piece.s - (piece.cell[d] + 1)});
        }
      });
  EXPECT_GT(pieces, 100u);
  EXPECT_LT(worst, 1e-12);
  for (const auto& sum : sums) {
    EXPECT_NEAR(sum[3], 1, 1e-14);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(sum[k], 1.0 / 3, 1e-14);
  }
}

// The face between two particles in a grid plane, which one of them has left in part: in each cell
// beside it there is half of what they differ by.
TEST(OuterFaces, BothSidesOfAnInnerOneCancelInOneCell) {
  OuterFaces<2> faces;
  for (auto* x : {&faces.start, &faces.end}) {
    (*x)[0] = {KeptArray<double>{3, 3}, KeptArray<double>{1.25, 1.75}};
    (*x)[1] = {KeptArray<double>{3, 3}, KeptArray<double>{1.75, 1.25}};
  }
  faces.particle = {0, 1};
  faces.face = {1, 0};  // the high side of particle 0, the low side of particle 1
  faces.weight = {0.9, 0.7};
  const auto in_cells = [&] {
    std::array<double, 2> sums{};  // of the cells below and above the plane
    for_each_piece<2>(faces, When::start, 0, 2, [&](std::size_t i, int, const Piece<2>& piece) {
      sums[piece.cell[0] < 3 ? 0 : 1] += faces.weight_of(i) * piece.area[0];
    });
    return sums;
  };
  faces.inner = {1, 1};
  EXPECT_NEAR(in_cells()[0], 0.05, 1e-15);
  EXPECT_NEAR(in_cells()[1], 0.05, 1e-15);
  faces.inner = {0, 0};  // each looks into the other's cell
  EXPECT_NEAR(in_cells()[0], -0.35, 1e-15);
  EXPECT_NEAR(in_cells()[1], 0.45, 1e-15);
}

}  // namespace
}  // namespace sluice::mpmice::outer_faces
