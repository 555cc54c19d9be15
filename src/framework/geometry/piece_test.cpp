// Points inside, outside and on the surface of every piece, bad input, and the algebra of sets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <random>

#include "framework/base/error.hpp"
#include "framework/geometry/boolean.hpp"
#include "framework/geometry/box.hpp"
#include "framework/geometry/corrugated.hpp"
#include "framework/geometry/round.hpp"
#include "framework/geometry/shell.hpp"
#include "framework/geometry/smooth_cylinder.hpp"

namespace sluice::piece_test {
namespace {

using testing::HasSubstr;
using testing::Property;
using testing::ThrowsMessage;

void expect_points(const GeometryPiece& piece, const std::vector<Vec3>& in,
                   const std::vector<Vec3>& out) {
  for (Vec3 p : in) {
    EXPECT_TRUE(piece.inside(p)) << p.x << ' ' << p.y << ' ' << p.z;
    EXPECT_TRUE(piece.bounds().contains(p)) << p.x << ' ' << p.y << ' ' << p.z;
  }
  for (Vec3 p : out) EXPECT_FALSE(piece.inside(p)) << p.x << ' ' << p.y << ' ' << p.z;
}

TEST(Pieces, BoxIsClosed) {
  expect_points(BoxPiece({0, 0, 0}, {1, 2, 3}), {{0, 0, 0}, {1, 2, 3}, {0.5, 1, 1.5}},
                {{-1e-15, 1, 1}, {0.5, 2.0000001, 1}, {0.5, 1, 4}});
  EXPECT_THAT(
      [] {
        BoxPiece({0, 0, 0}, {1, 0, 1});
      },
      ThrowsMessage<InputError>(HasSubstr("in direction y")));
}

TEST(Pieces, SphereIsClosed) {
  expect_points(SpherePiece({1, 1, 1}, 0.5), {{1, 1, 1}, {1.5, 1, 1}, {1, 1, 0.5}},
                {{1.5, 1.0001, 1}, {1, 1.51, 1}});
  EXPECT_THAT([] { SpherePiece({}, 0); }, ThrowsMessage<InputError>(HasSubstr("radius is 0")));
}

TEST(Pieces, EllipsoidAlignedAndSkewed) {
  expect_points(EllipsoidPiece({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 3}),
                {{2, 0, 0}, {0, -1, 0}, {0, 0, 3}, {1, 0.5, 1}}, {{2, 0.01, 0}, {0, 0, 3.01}});
  expect_points(EllipsoidPiece({0, 0, 0}, {1, 1, 0}, {-0.25, 0.25, 0}, {0, 0, 1}),
                {{0.99, 0.99, 0}, {-0.2, 0.2, 0}}, {{0.99, 0.5, 0}, {-0.5, 0.5, 0}});
  EXPECT_THAT(
      [] {
        EllipsoidPiece({}, {1, 0, 0}, {0.1, 1, 0}, {0, 0, 1});
      },
      ThrowsMessage<InputError>(HasSubstr("orthogonal")));
}

TEST(Pieces, CylinderAlongAnAxisAndAcross) {
  const PiecePtr z = make_cylinder({0, 0, -1}, {0, 0, 1}, 0.5);
  expect_points(*z, {{0.5, 0, 1}, {0, -0.5, -1}, {0.3, 0.4, 0}},
                {{0.5, 0.01, 0}, {0, 0, 1.0001}, {0.5, 0.5, 0}});
  const PiecePtr diagonal = make_cylinder({0, 0, 0}, {1, 1, 1}, 0.1);
  expect_points(*diagonal, {{0.5, 0.5, 0.5}, {0.55, 0.45, 0.5}},
                {{-0.01, -0.01, -0.01}, {0.6, 0.4, 0.5}, {1.01, 1.01, 1.01}});
  EXPECT_THAT(
      [] {
        make_cylinder({1, 1, 1}, {1, 1, 1}, 1);
      },
      ThrowsMessage<InputError>(HasSubstr("same point")));
}

TEST(Pieces, ConeWidensLinearly) {
  const ConePiece cone({0, 0, 0}, {2, 0, 0}, 0, 1);
  expect_points(cone, {{0, 0, 0}, {1, 0.5, 0}, {2, 0, -1}, {2, 0.6, 0.8}},
                {{1, 0.51, 0}, {0, 0.01, 0}, {2.01, 0, 0}});
  EXPECT_THAT(
      [] {
        ConePiece({0, 0, 0}, {1, 0, 0}, -1, 1);
      },
      ThrowsMessage<InputError>(HasSubstr("radii")));
}

TEST(Pieces, TorusIsOpen) {
  const TorusPiece torus({0, 0, 0}, 2, 0.5, 2, 0);
  expect_points(torus, {{2, 0, 0}, {0, -2.4, 0}, {0, 2, 0.4}},
                {{2.5, 0, 0}, {0, 0, 0}, {1.5, 0, 0}, {0, 2, 0.51}});
  // Axis turned by a quarter: z becomes -x, the ring stands in the y-z plane.
  expect_points(TorusPiece({0, 0, 0}, 2, 0.5, 2, std::numbers::pi / 2),
                {{0, 2, 0}, {0, 0, 2}, {0.4, 0, 2}}, {{2, 0, 0}, {0.6, 2, 0}});
  expect_points(TorusPiece({0, 0, 0}, 2, 0.5, 0, 0), {{0, 2, 0}, {0, 0, -2}}, {{2, 0, 0}});
  expect_points(TorusPiece({1, 0, 0}, 2, 0.5, 1, 0), {{3, 0, 0}, {1, 0, 2}}, {{1, 2, 0}});
}

TEST(Pieces, ParallelepipedIsOpenAtItsFirstCorner) {
  const ParallelepipedPiece p({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 1});
  expect_points(p, {{1, 0.5, 0.5}, {2, 1, 1}, {1.5, 1, 0.5}},
                {{0, 0, 0}, {0.5, 0.2, 0}, {0.2, 0.5, 0.5}, {2.1, 1, 1}});
  EXPECT_THAT(
      [] {
        ParallelepipedPiece({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0});
      },
      ThrowsMessage<InputError>(HasSubstr("one plane")));
}

TEST(Pieces, PolyhedronFromHalfSpaces) {
  // The tetrahedron x, y, z >= 0, x + y + z <= 1.
  const PolyhedronPiece p({0.2, 0.2, 0.2}, {{{0, 0, 0}, {1, 0, 0}},
                                            {{0, 0, 0}, {0, 1, 0}},
                                            {{0, 0, 0}, {0, 0, 1}},
                                            {{1, 0, 0}, {-1, -1, -1}}});
  expect_points(p, {{0, 0, 0}, {1, 0, 0}, {0.3, 0.3, 0.3}}, {{0.4, 0.4, 0.4}, {-0.1, 0, 0}});
  EXPECT_NEAR(p.bounds().upper.y, 1, 1e-9);
  EXPECT_NEAR(p.bounds().lower.z, 0, 1e-9);
  EXPECT_THAT(
      [] {
        PolyhedronPiece({0, 0, 0}, {{{-1, 0, 0}, {1, 0, 0}},
                                    {{1, 0, 0}, {-1, 0, 0}},
                                    {{0, -1, 0}, {0, 1, 0}},
                                    {{0, 1, 0}, {0, -1, 0}}});
      },
      ThrowsMessage<InputError>(HasSubstr("open to infinity")));
  EXPECT_THAT(
      [] {
        PolyhedronPiece({5, 0, 0}, {{{0, 0, 0}, {1, 0, 0}},
                                    {{0, 0, 0}, {0, 1, 0}},
                                    {{0, 0, 0}, {0, 0, 1}},
                                    {{1, 0, 0}, {-1, -1, -1}}});
      },
      ThrowsMessage<InputError>(HasSubstr("center lies outside")));
}

TEST(Pieces, Shells) {
  expect_points(*make_plane_shell({0, 0, 1}, {0, 0, 2}, 0.5, 0.2),
                {{0, 0, 1}, {0.5, 0, 1}, {0, 0.3, 1.09}}, {{0, 0, 1.11}, {0.51, 0, 1}});
  expect_points(*make_sphere_shell({0, 0, 0}, 1, 0.2), {{1, 0, 0}, {0, 1.1, 0}, {0, 0, 0.9}},
                {{0.89, 0, 0}, {0, 1.11, 0}, {0, 0, 0}});
  expect_points(*make_cylinder_shell({0, 0, 0}, {0, 0, 1}, 1, 0.2), {{1, 0, 0}, {0, 0.95, 1}},
                {{0.85, 0, 0.5}, {0, 1, 1.01}, {1.2, 0, 0}});
  EXPECT_THAT(
      [] {
        make_sphere_shell({0, 0, 0}, 1, 3);
      },
      ThrowsMessage<InputError>(HasSubstr("thickness 3")));
}

TEST(Pieces, SmoothCylinderSector) {
  SmoothCylinder c;
  c.top = {0, 0, 1};
  c.inner_radius = 0.5;
  c.outer_radius = 1;
  c.arc_start_angle = 0;
  c.arc_angle = 90;
  expect_points(SmoothCylinderPiece(c), {{0.7, 0.1, 0.5}, {0.1, 0.7, 0}, {1, 0, 1}},
                {{-0.7, 0.1, 0.5}, {0.7, -0.1, 0.5}, {0.3, 0.3, 0.5}, {0.7, 0.1, 1.1}});
  c.arc_start_angle = 315;
  expect_points(SmoothCylinderPiece(c), {{0.7, -0.1, 0.5}, {0.7, 0.6, 0.5}},
                {{0.1, 0.7, 0.5}, {-0.7, 0, 0.5}});
  c.arc_angle = 360;
  c.endcap_thickness = 0.5;
  expect_points(SmoothCylinderPiece(c), {{-0.7, 0, -0.5}, {0, 0.7, 1.5}}, {{0.7, 0, 1.6}});
  c.inner_radius = 1;
  EXPECT_THAT([&] { SmoothCylinderPiece{c}; }, ThrowsMessage<InputError>(HasSubstr("inner < ")));
}

TEST(Pieces, CorrugatedEdge) {
  CorrugatedPlate plate;
  plate.xymin = {0, 0, 0};
  plate.xymax = {2, 1, 0};
  plate.thickness = 0.1;
  plate.edge_direction = 1;
  plate.edge_plus = true;
  plate.wavelength = 1;
  plate.amplitude = 0.2;
  // Crest at x = 1/4, trough at x = 3/4; the opposite edge is straight.
  expect_points(CorrugatedPiece(plate),
                {{0.25, 1.19, 0.05}, {0.75, 0.79, 0.05}, {0.75, 0, 0}, {0.25, 0, 0.1}},
                {{0.25, 1.21, 0.05}, {0.75, 0.81, 0.05}, {0.25, -0.01, 0}, {0.25, 0.5, 0.11}});
  plate.edge_plus = false;
  expect_points(CorrugatedPiece(plate), {{0.25, 0.21, 0}, {0.75, -0.19, 0}, {0.5, 1, 0}},
                {{0.25, 0.19, 0}, {0.75, -0.21, 0}, {0.25, 1.01, 0}});
  plate.amplitude = 2;
  EXPECT_THAT([&] { CorrugatedPiece{plate}; }, ThrowsMessage<InputError>(HasSubstr("amplitude")));
}

TEST(Pieces, EverywhereHoldsEveryPoint) {
  expect_points(EverywherePiece{}, {{1e300, -1e300, 0}, {0, 0, 0}}, {});
}

// inside() of composed pieces against the logic of their members, and cover() against inside().
class Algebra : public testing::Test {
 protected:
  PiecePtr box = std::make_shared<BoxPiece>(Vec3{-0.5, -0.5, -0.5}, Vec3{0.6, 0.5, 0.5});
  PiecePtr ball = std::make_shared<SpherePiece>(Vec3{0.4, 0.1, 0}, 0.55);
  PiecePtr rod = make_cylinder({-1, -0.2, 0}, {1, 0.3, 0.1}, 0.3);
  std::mt19937_64 random{12345};
  std::uniform_real_distribution<double> coordinate{-1, 1};

  Vec3 point() { return {coordinate(random), coordinate(random), coordinate(random)}; }
};

TEST_F(Algebra, FollowsSetLogic) {
  const UnionPiece both({box, ball, rod});
  const IntersectionPiece common({box, ball, rod});
  const DifferencePiece without(box, ball);
  int hits = 0;
  for (int n = 0; n < 20000; ++n) {
    const Vec3 p = point();
    const bool a = box->inside(p), b = ball->inside(p), c = rod->inside(p);
    ASSERT_EQ(both.inside(p), a || b || c);
    ASSERT_EQ(common.inside(p), a && b && c);
    ASSERT_EQ(without.inside(p), a && !b);
    hits += common.inside(p);
  }
  EXPECT_GT(hits, 100);
}

TEST_F(Algebra, DifferenceAndIntersectionPartitionAPiece) {
  const DifferencePiece without(box, ball);
  const IntersectionPiece within({box, ball});
  for (int n = 0; n < 20000; ++n) {
    const Vec3 p = point();
    ASSERT_EQ(without.inside(p) + within.inside(p), static_cast<int>(box->inside(p)));
  }
}

TEST_F(Algebra, CoverAgreesWithInside) {
  const std::vector<PiecePtr> pieces = {
      box,
      ball,
      rod,
      std::make_shared<UnionPiece>(std::vector<PiecePtr>{box, ball}),
      std::make_shared<IntersectionPiece>(std::vector<PiecePtr>{box, rod}),
      std::make_shared<DifferencePiece>(box, rod),
      std::make_shared<ConePiece>(Vec3{-1, 0, 0}, Vec3{1, 0.5, 0.2}, 0.6, 0.1),
      std::make_shared<EllipsoidPiece>(Vec3{0, 0, 0}, Vec3{0.8, 0, 0}, Vec3{0, 0.5, 0},
                                       Vec3{0, 0, 0.6}),
      std::make_shared<ParallelepipedPiece>(Vec3{-0.5, -0.5, -0.5}, Vec3{0.5, -0.4, -0.5},
                                            Vec3{-0.5, 0.5, -0.3}, Vec3{-0.4, -0.5, 0.5}),
      std::make_shared<TorusPiece>(Vec3{0, 0, 0}, 0.6, 0.2, 1, 0.3)};
  for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
    int all = 0, none = 0;
    for (int n = 0; n < 3000; ++n) {
      const Vec3 low = point();
      const double size = 0.2 * std::abs(coordinate(random));
      const Bounds window{low, low + Vec3::all(size)};
      const Cover c = pieces[piece]->cover(window);
      all += c == Cover::all;
      none += c == Cover::none;
      for (int m = 0; m < 8 && c != Cover::some; ++m) {
        const Vec3 p = low + (0.5 * size) * (point() + Vec3::all(1));
        ASSERT_EQ(pieces[piece]->inside(p), c == Cover::all) << "piece " << piece;
      }
    }
    EXPECT_GT(none, 50) << "piece " << piece;
    const bool never_all = piece + 1 == pieces.size();  // the torus makes no such promise
    EXPECT_GT(all, never_all ? -1 : 10) << "piece " << piece;
  }
}

}  // namespace
}  // namespace sluice::piece_test
