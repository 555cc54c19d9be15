// Bodies that cross a periodic side, whole, burned in part or as debris, against the same in the
// middle.
#include <gtest/gtest.h>

#include <cmath>

#include "mpmice/geometry/found_geometry_test_support.hpp"

namespace sluice::mpmice::periodic_bodies {
namespace {

constexpr double round_off = 4e-15;

enum class Kind { whole, burned, debris };

// A block that begins at x along the first direction, with the particles beyond the high side taken
// to the low one.
template <int D>
Body<D> block_across(double x, int width) {
  Point<D> low = {};
  for (std::size_t d = 0; d < D; ++d) low[d] = d == 0 ? x : 2.3;
  Body<D> body = block<D>("", 4, low);
  for (std::size_t p = 0; p < body.size(); ++p) {
    double middle = 0;
    for (const auto& corner : body.start) middle += corner[0][p] / Body<D>::corners;
    if (middle < width) continue;
    for (auto& corner : body.start) corner[0][p] -= width;
  }
  body.end = body.start;
  return body;
}

template <int D>
OuterFaces<D> faces_of(const Body<D>& body, Kind kind, const KeptArray<double>& parts) {
  if (kind == Kind::whole) return body.faces();
  const std::vector<std::uint8_t> every_face(body.size(), (1u << (2 * D)) - 1);
  OuterFaces<D> faces;
  faces.add(Body<D>::columns(body.start), nullptr, every_face.data(), every_face.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const std::uint32_t p = faces.particle[i];
    faces.weight.push_back(parts[p]);
    faces.inner.push_back((body.outer[p] >> faces.face[i] & 1) == 0 ? 1 : 0);
  }
  return faces;
}

template <int D>
void check(Kind kind, int width) {
  const auto blocks = CellBlocks<D>::around({all<D>(-4), all<D>(width + 4)});
  PeriodicSides<D> sides;
  sides.domain = {all<D>(0), all<D>(width)};
  sides.periodic[0] = true;
  const int far = width - 4;
  // In the middle, and some cells farther: across the side. On and off grid planes.
  for (const double x : {3.1, 2.9, 3.0, 3.5}) {
    const Body<D> middle = block_across<D>(x, width), across = block_across<D>(x + far, width);
    KeptArray<double> parts(middle.size(), 1.0);
    for (std::size_t p = 0; p < parts.size() && kind == Kind::burned; ++p)
      parts[p] = 0.5 + 0.5 * hashed(p, D);
    const GeometryOf<D> geometry{blocks, &parts, sides};
    const auto faces = faces_of(middle, kind, parts), faces_across = faces_of(across, kind, parts);
    const auto a = geometry.at(When::start, middle, faces),
               b = geometry.at(When::start, across, faces_across);
    const auto mean = geometry.swept(middle, faces), mean_b = geometry.swept(across, faces_across);
    double worst = 0;
    for_each_cell_of<D>({all<D>(0), all<D>(width)}, [&](const Cell<D>& c) {
      Cell<D> moved = c;
      moved[0] = (c[0] + far) % width;
      const std::size_t i = blocks.index(c), j = blocks.index(moved);
      worst = std::max(worst, std::fabs(a.theta[i] - b.theta[j]));
      for (std::size_t d = 0; d < D; ++d)
        worst = std::max(
            {worst, std::fabs(a.a[d][i] - b.a[d][j]), std::fabs(mean.A[d][i] - mean_b.A[d][j])});
    });
    EXPECT_LT(worst, round_off) << D << " " << x << " " << width;
  }
}

TEST(PeriodicBodies, CrossSidesAsIfTheyWereNotThere) {
  for (const Kind kind : {Kind::whole, Kind::burned, Kind::debris})
    for (const int width : {8, 11}) {  // on planes of blocks, and off them
      check<1>(kind, width);
      check<2>(kind, width);
      check<3>(kind, width);
    }
}

}  // namespace
}  // namespace sluice::mpmice::periodic_bodies
