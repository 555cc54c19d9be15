// Bodies that cross a periodic side, and have burned in part, against the same in the middle.
#include "mpmice/geometry/covered_sides.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mpmice/geometry/bodies_test_support.hpp"
#include "mpmice/geometry/solid_in_cells.hpp"

namespace sluice::mpmice::covered_sides {
namespace {

constexpr double round_off = 4e-15;
constexpr int width = 8;  // cells of the domain

template <int D>
PeriodicSides<D> sides_along_x() {
  PeriodicSides<D> sides;
  sides.domain = {all<D>(0), all<D>(width)};
  sides.periodic[0] = true;
  return sides;
}

// All faces of particles whose bits are set, each by what is left of the particle.
template <int D>
OuterFaces<D> faces_of(const Body<D>& body, const std::vector<std::uint8_t>& bits) {
  OuterFaces<D> faces;
  faces.add(Body<D>::columns(body.start), nullptr, bits.data(), bits.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const std::uint32_t p = faces.particle[i];
    faces.weight.push_back(0.5 + 0.5 * hashed(p, D));
    faces.inner.push_back((body.outer[p] >> faces.face[i] & 1) == 0 ? 1 : 0);
  }
  return faces;
}

// theta of a block that begins at x, with the image of what lies beyond the high side.
template <int D>
SolidInCells<D> found(double x, const CellBlocks<D>& blocks) {
  constexpr unsigned every_face = (1u << (2 * D)) - 1;
  Point<D> low = {};
  for (std::size_t d = 0; d < D; ++d) low[d] = d == 0 ? x : 2.3;
  Body<D> body = block<D>("", 4, low);
  const PeriodicSides<D> sides = sides_along_x<D>();
  std::vector<std::uint8_t> whole(body.size(), every_face), outer(body.size(), 0), inner = outer;
  for (std::size_t p = 0; p < body.size(); ++p) {
    double middle = 0;
    for (const auto& corner : body.start) middle += corner[0][p] / Body<D>::corners;
    std::array<double, D> least, most;
    least.fill(1e300);
    most.fill(-1e300);
    for (auto& corner : body.start)
      for (std::size_t d = 0; d < D; ++d) {
        if (d == 0 && middle >= width) corner[d][p] -= width;
        least[d] = std::min(least[d], corner[d][p]);
        most[d] = std::max(most[d], corner[d][p]);
      }
    if (!crosses<D>(sides, least, most)) continue;
    outer[p] = body.outer[p];
    inner[p] = static_cast<std::uint8_t>(every_face & ~unsigned{body.outer[p]});
  }
  SolidSums<D> sums;
  sums.begin(blocks);
  const OuterFaces<D> faces = faces_of(body, whole);
  sums.add(faces, When::start, 0, faces.size());
  CoveredSides<D> covered;
  covered.begin(blocks, sides);
  covered.add(faces_of(body, outer), true, When::start);
  covered.add(faces_of(body, inner), false, When::start);
  covered.finish();
  SolidInCells<D> to;
  sums.finish(to, &covered);
  return to;
}

template <int D>
void check() {
  const auto blocks = CellBlocks<D>::around({all<D>(-4), all<D>(width + 4)});
  // In the middle, and four cells farther: across the side. On and off grid planes.
  for (const double x : {3.1, 2.9, 3.0, 3.5}) {
    const SolidInCells<D> middle = found<D>(x, blocks), across = found<D>(x + 4, blocks);
    double worst = 0;
    for_each_cell_of<D>({all<D>(0), all<D>(width)}, [&](const Cell<D>& c) {
      Cell<D> moved = c;
      moved[0] = (c[0] + 4) % width;
      const double a = middle.theta[blocks.index(c)], b = across.theta[blocks.index(moved)];
      worst = std::max(worst, std::fabs(a - b));
    });
    EXPECT_LT(worst, round_off) << D << " " << x;
  }
}

TEST(CoveredSides, BodiesThatHaveBurnedInPartCrossThem) {
  check<1>();
  check<2>();
  check<3>();
}

}  // namespace
}  // namespace sluice::mpmice::covered_sides
