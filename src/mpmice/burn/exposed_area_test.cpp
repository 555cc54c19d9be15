// Exposed areas of particles of known shapes; faces that neighbours share.
#include "mpmice/burn/exposed_area.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "mpmice/surfaces/vanished_faces.hpp"

namespace sluice::mpmice::exposed_area_test {
namespace {

TEST(ExposedArea, OfFlatSurfacesIsTheirOwn) {
  ExposedArea<2> one;
  one.add(1, {0.3, 0}, {0, 2});
  one.add(1, {0.2, 0}, {0, 4});  // another piece, where more burns
  EXPECT_DOUBLE_EQ(one.flow(), 0.3 * 2 + 0.2 * 4);
  ExposedArea<3> none;
  EXPECT_EQ(none.flow(), 0);
}

TEST(ExposedArea, OfASheetCountsBothSides) {
  ExposedArea<2> sheet;
  sheet.add(0, {-1, 0}, {0, 1});
  sheet.add(1, {1, 0}, {0, 1});
  EXPECT_DOUBLE_EQ(sheet.flow(), 2);
}

// Stairs under 45 degrees: each particle has a step of two sides.
TEST(ExposedArea, OfStairsIsThatOfTheSlope) {
  ExposedArea<2> step;
  step.add(1, {1, 0}, {0, 1});
  step.add(3, {0, 1}, {0, 1});
  EXPECT_DOUBLE_EQ(step.flow(), std::numbers::sqrt2);
  ExposedArea<3> corner;
  corner.add(0, {-1, 0, 0}, {0, 1});
  corner.add(3, {0, 1, 0}, {0, 1});
  corner.add(5, {0, 0, 1}, {0, 1});
  EXPECT_DOUBLE_EQ(corner.flow(), std::numbers::sqrt3);
}

// Where faces of two axes lie in one smooth surface both count in full.
TEST(ExposedArea, OfASmoothSurfaceIsWhole) {
  ExposedArea<2> smooth;
  smooth.add(1, {0.6, 0.8}, {0, 1});
  smooth.add(3, {0.6, 0.8}, {0, 1});
  EXPECT_DOUBLE_EQ(smooth.flow(), 2);
}

// Particles in a row along x, corners as columns.
template <int D>
struct RowOfParticles {
  std::array<std::array<std::vector<double>, D>, corners_of_particle<D>> x;
  explicit RowOfParticles(std::size_t n) {
    for (std::size_t c = 0; c < x.size(); ++c)
      for (std::size_t d = 0; d < D; ++d)
        for (std::size_t p = 0; p < n; ++p) {
          const double side = c >> d & 1 ? 1 : 0;
          x[c][d].push_back(0.1 * ((d == 0 ? static_cast<double>(p) : 0.0) + side));
        }
  }
  CornerColumns<D> columns() const {
    CornerColumns<D> to;
    for (std::size_t c = 0; c < x.size(); ++c)
      for (std::size_t d = 0; d < D; ++d) to[c][d] = x[c][d].data();
    return to;
  }
};

template <int D>
void neighbours_lose_the_shared_face() {
  const RowOfParticles<D> row(4);
  VanishedFaces<D> gone;
  gone.add(0, row.columns(), 1);
  gone.tell_neighbours(nullptr);
  EXPECT_FALSE(gone.empty());
  EXPECT_EQ(gone.exposed(0, row.columns(), 0).faces, 1 << 1);
  EXPECT_EQ(gone.exposed(0, row.columns(), 2).faces, 1 << 0);
  EXPECT_FALSE(gone.exposed(0, row.columns(), 2).surface.lit());
  EXPECT_EQ(gone.exposed(0, row.columns(), 3).faces, 0);
  EXPECT_EQ(gone.exposed(1, row.columns(), 0).faces, 0);  // of another body
}

TEST(VanishedFaces, AreOuterOnesOfTheirNeighbours) {
  neighbours_lose_the_shared_face<1>();
  neighbours_lose_the_shared_face<2>();
  neighbours_lose_the_shared_face<3>();
}

// The last of a row and the first share a face across periodic sides.
template <int D>
void neighbours_across_periodic_sides() {
  const RowOfParticles<D> row(4);
  Periods<D> periods;
  periods.length[0] = 0.4;
  VanishedFaces<D> gone(periods);
  gone.add(0, row.columns(), 3);
  gone.tell_neighbours(nullptr);
  EXPECT_EQ(gone.exposed(0, row.columns(), 0).faces, 1 << 0);
  EXPECT_EQ(gone.exposed(0, row.columns(), 2).faces, 1 << 1);
  EXPECT_EQ(gone.exposed(0, row.columns(), 1).faces, 0);
}

TEST(VanishedFaces, AreKnownAcrossPeriodicSides) {
  neighbours_across_periodic_sides<1>();
  neighbours_across_periodic_sides<2>();
  neighbours_across_periodic_sides<3>();
}

// Of two the steeper; of one that has not burned nothing.
TEST(VanishedFaces, LeaveWhatTheirSurfacesRemember) {
  const RowOfParticles<2> row(5);
  VanishedFaces<2> gone;
  gone.add(0, row.columns(), 3);
  gone.add(0, row.columns(), 2, {700, 2e6});
  gone.add(0, row.columns(), 0, {800, 1e6});
  gone.tell_neighbours(nullptr);
  const models::SurfaceHistory between = gone.exposed(0, row.columns(), 1).surface;
  EXPECT_EQ(between.temperature, 700);
  EXPECT_EQ(between.gradient, 2e6);
  EXPECT_FALSE(gone.exposed(0, row.columns(), 4).surface.lit());
}

}  // namespace
}  // namespace sluice::mpmice::exposed_area_test
