// Counts against closed-form volumes, to the bit against plain counting, and under mirroring.
#include "framework/geometry/sampling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "framework/geometry/boolean.hpp"
#include "framework/geometry/box.hpp"
#include "framework/geometry/corrugated.hpp"
#include "framework/geometry/point_file.hpp"
#include "framework/geometry/round.hpp"
#include "framework/geometry/shell.hpp"
#include "framework/grid/index_box.hpp"

namespace sluice::sampling_test {
namespace {

constexpr double volume_error_32 = 4e-3;  // relative, 32 cells and 2 sub-points a direction
constexpr double volume_error_64 = 1.5e-3;
constexpr double share_of_points = 0.03;  // that a ball is asked for; 0.025 measured

// The cube [-1, 1]^3 in n cells a direction.
CellLattice cube(int n) {
  return {Vec3::all(-1), Vec3::all(2.0 / n)};
}

double sampled_volume(const GeometryPiece& piece, int n) {
  const std::vector<std::int32_t> counts =
      count_inside(piece, cube(n), {0, 0, 0}, IntVec3::all(n), {2, 2, 2});
  const std::int64_t total = std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
  return static_cast<double>(total) / 8 * std::pow(2.0 / n, 3);
}

struct KnownVolume {
  const char* name;
  PiecePtr piece;
  double volume;
};

// Flat faces lie between sub-points (multiples of 1/16), so that what is left is the error of the
// curved and slanted ones.
std::vector<KnownVolume> known_volumes() {
  constexpr double pi = std::numbers::pi;
  CorrugatedPlate plate;
  plate.xymin = {-0.75, -0.75, -0.375};
  plate.xymax = {0.75, 0.75, 0};
  plate.thickness = 0.75;
  plate.edge_direction = 1;
  plate.edge_plus = true;
  plate.wavelength = 0.5;
  plate.amplitude = 0.1;
  const PiecePtr ball = std::make_shared<SpherePiece>(Vec3{0.03, 0.01, -0.02}, 0.9);
  const PiecePtr core = std::make_shared<SpherePiece>(Vec3{0.03, 0.01, -0.02}, 0.5);
  return {
      {"sphere", ball, 4.0 / 3 * pi * 0.729},
      {"difference", std::make_shared<DifferencePiece>(ball, core), 4.0 / 3 * pi * (0.729 - 0.125)},
      {"cylinder", make_cylinder({0, 0.02, -0.75}, {0, 0.02, 0.875}, 0.61),
       pi * 0.61 * 0.61 * 1.625},
      {"slanted cylinder", make_cylinder({-0.4, -0.3, -0.4}, {0.4, 0.3, 0.5}, 0.4),
       pi * 0.16 * std::sqrt(0.64 + 0.36 + 0.81)},
      {"cone", std::make_shared<ConePiece>(Vec3{-0.75, 0, 0}, Vec3{0.75, 0, 0}, 0.8, 0.3),
       pi * 1.5 / 3 * (0.64 + 0.24 + 0.09)},
      {"ellipsoid",
       std::make_shared<EllipsoidPiece>(Vec3{0, 0, 0}, Vec3{0.6, 0.6, 0}, Vec3{-0.3, 0.3, 0},
                                        Vec3{0, 0, 0.7}),
       4.0 / 3 * pi * std::sqrt(0.72) * std::sqrt(0.18) * 0.7},
      {"torus", std::make_shared<TorusPiece>(Vec3{0, 0, 0}, 0.6, 0.3, 2, 0.2),
       2 * pi * pi * 0.6 * 0.09},
      {"parallelepiped",
       std::make_shared<ParallelepipedPiece>(Vec3{-0.7, -0.6, -0.5}, Vec3{0.5, -0.6, -0.5},
                                             Vec3{-0.5, 0.5, -0.4}, Vec3{-0.6, -0.5, 0.6}),
       // determinant of the edges (1.2,0,0), (0.2,1.1,0.1), (0.1,0.1,1.1)
       1.2 * (1.1 * 1.1 - 0.1 * 0.1)},
      {"sphere shell", make_sphere_shell({0, 0, 0}, 0.7, 0.4), 4.0 / 3 * pi * (0.729 - 0.125)},
      {"corrugated", std::make_shared<CorrugatedPiece>(plate), 1.5 * 1.5 * 0.75},
  };
}

TEST(Sampling, VolumesConvergeToClosedForms) {
  for (const KnownVolume& k : known_volumes()) {
    EXPECT_NEAR(sampled_volume(*k.piece, 32) / k.volume, 1, volume_error_32) << k.name;
    EXPECT_NEAR(sampled_volume(*k.piece, 64) / k.volume, 1, volume_error_64) << k.name;
  }
}

TEST(Sampling, BlocksGiveTheSameBitsAsSubPoints) {
  const int n = 14;
  const IntVec3 low{-1, 2, 0}, high{n, n, n + 1};
  for (const KnownVolume& k : known_volumes()) {
    const std::vector<std::int32_t> counts = count_inside(*k.piece, cube(n), low, high, {2, 3, 1});
    std::size_t at = 0;
    for (int c = low.z; c < high.z; ++c)
      for (int b = low.y; b < high.y; ++b)
        for (int a = low.x; a < high.x; ++a, ++at)
          ASSERT_EQ(counts[at], count_inside(*k.piece, cube(n), {a, b, c}, {2, 3, 1}))
              << k.name << ' ' << a << ' ' << b << ' ' << c;
    ASSERT_EQ(at, counts.size());
  }
}

// The one cell of the whole cube has so many points that they are counted by halves.
TEST(Sampling, ManyPointsOfACellAreCountedAsEachOfThemSays) {
  const CellLattice lattice = cube(1);
  const IntVec3 res{20, 17, 23};
  for (const KnownVolume& k : known_volumes()) {
    std::int32_t inside = 0;
    for_each_cell({{0, 0, 0}, res}, [&](IntVec3 s) {
      Vec3 p;
      for (int d = 0; d < 3; ++d) p[d] = lattice.sub_point(d, 0, s[d], res[d]);
      inside += k.piece->inside(p);
    });
    EXPECT_GT(inside, 0) << k.name;
    EXPECT_EQ(count_inside(*k.piece, lattice, {0, 0, 0}, res), inside) << k.name;
  }
}

// Windows of two cells, some of which a piece misses.
TEST(Sampling, ASearchFindsWhatCountsFind) {
  const int n = 12;
  const IntVec3 res{2, 1, 3};
  for (const KnownVolume& k : known_volumes()) {
    int found = 0, missed = 0;
    for (int i = 0; i < n * n * n; ++i) {
      const IntVec3 low{i % n, i / n % n, i / n / n}, high = low + IntVec3{2, 1, 1};
      const auto counts = count_inside(*k.piece, cube(n), low, high, res);
      const bool any = counts[0] > 0 || counts[1] > 0;
      ASSERT_EQ(any_inside(*k.piece, cube(n), low, high, res), any) << k.name << ' ' << i;
      (any ? found : missed) += 1;
    }
    EXPECT_GT(found, 0) << k.name;
    EXPECT_GT(missed, 0) << k.name;
    EXPECT_TRUE(any_inside(*k.piece, cube(n), {0, 0, 0}, IntVec3::all(n), res)) << k.name;
    EXPECT_FALSE(any_inside(*k.piece, cube(n), IntVec3::all(n), IntVec3::all(n), res)) << k.name;
  }
}

// A packing of small balls, cut by a box and by a large ball: what lies far away is left out of the
// blocks, and nothing of it is lost.
TEST(Sampling, LargeUnionsAreCountedInFull) {
  std::vector<PiecePtr> balls;
  for (int n = 0; n < 300; ++n)
    balls.push_back(std::make_shared<SpherePiece>(
        Vec3{std::sin(n * 1.1), std::cos(n * 2.3), std::sin(n * 3.7 + 1)},
        0.03 + 0.001 * (n % 40)));
  const PiecePtr packing = std::make_shared<UnionPiece>(balls);
  const PiecePtr cut = std::make_shared<IntersectionPiece>(
      std::vector<PiecePtr>{packing, std::make_shared<BoxPiece>(Vec3::all(-0.9), Vec3::all(0.9))});
  const PiecePtr rest =
      std::make_shared<DifferencePiece>(std::make_shared<SpherePiece>(Vec3{}, 0.95), packing);
  const int n = 16;
  for (const PiecePtr& piece : {packing, cut, rest}) {
    const auto counts = count_inside(*piece, cube(n), {0, 0, 0}, IntVec3::all(n), {3, 3, 3});
    std::int64_t total = 0;
    for (int i = 0; i < n * n * n; ++i) {
      const std::int32_t plain =
          count_inside(*piece, cube(n), {i % n, i / n % n, i / n / n}, {3, 3, 3});
      ASSERT_EQ(counts[i], plain);
      total += plain;
    }
    EXPECT_GT(total, 500);
  }
}

// Every piece and its mirror image at x = 0, on a domain centred at zero with dx = 1/16.
TEST(Sampling, MirroredPiecesGiveMirroredCounts) {
  auto m = [](Vec3 p) { return Vec3{-p.x, p.y, p.z}; };
  struct Pair {
    const char* name;
    PiecePtr piece, mirror;
  };
  std::vector<Pair> pairs;
  const Vec3 low{-0.31, -0.7, -0.2}, high{0.13, 0.4, 0.9};
  pairs.push_back(
      {"box", std::make_shared<BoxPiece>(low, high),
       std::make_shared<BoxPiece>(Vec3{-high.x, low.y, low.z}, Vec3{-low.x, high.y, high.z})});
  pairs.push_back({"sphere", std::make_shared<SpherePiece>(low, 0.37),
                   std::make_shared<SpherePiece>(m(low), 0.37)});
  pairs.push_back({"cylinder", make_cylinder(low, high, 0.3), make_cylinder(m(low), m(high), 0.3)});
  pairs.push_back({"cylinder, ends exchanged", make_cylinder(low, high, 0.3),
                   make_cylinder(m(high), m(low), 0.3)});
  pairs.push_back({"cylinder along x", make_cylinder({-0.3, 0.1, 0.2}, {0.7, 0.1, 0.2}, 0.3),
                   make_cylinder({-0.7, 0.1, 0.2}, {0.3, 0.1, 0.2}, 0.3)});
  pairs.push_back({"cone", std::make_shared<ConePiece>(low, high, 0.5, 0.1),
                   std::make_shared<ConePiece>(m(high), m(low), 0.1, 0.5)});
  pairs.push_back({"ellipsoid",
                   std::make_shared<EllipsoidPiece>(low, Vec3{0.5, 0.5, 0}, Vec3{-0.2, 0.2, 0},
                                                    Vec3{0, 0, 0.3}),
                   std::make_shared<EllipsoidPiece>(m(low), Vec3{-0.5, 0.5, 0}, Vec3{0.2, 0.2, 0},
                                                    Vec3{0, 0, 0.3})});
  pairs.push_back({"torus", std::make_shared<TorusPiece>(low, 0.5, 0.2, 1, 0),
                   std::make_shared<TorusPiece>(m(low), 0.5, 0.2, 1, 0)});
  pairs.push_back(
      {"parallelepiped",
       std::make_shared<ParallelepipedPiece>(low, high, Vec3{0.5, -0.6, 0}, Vec3{0, 0, -0.8}),
       std::make_shared<ParallelepipedPiece>(m(low), m(high), m({0.5, -0.6, 0}), m({0, 0, -0.8}))});
  pairs.push_back({"shell", make_cylinder_shell(low, high, 0.4, 0.1),
                   make_cylinder_shell(m(low), m(high), 0.4, 0.1)});
  // Faces that pass through sub-points: the last bit of a coordinate decides.
  for (int i : {5, 9, 14}) {
    const double x = cube(32).sub_point(0, i, 0, 3), y = cube(32).sub_point(0, i + 7, 2, 3);
    pairs.push_back({"box through sub-points",
                     std::make_shared<BoxPiece>(Vec3{x, -0.7, -0.2}, Vec3{y, 0.4, 0.9}),
                     std::make_shared<BoxPiece>(Vec3{-y, -0.7, -0.2}, Vec3{-x, 0.4, 0.9})});
  }
  const std::size_t simple = pairs.size();
  for (std::size_t i = 1; i < simple; ++i)
    pairs.push_back({"difference",
                     std::make_shared<DifferencePiece>(pairs[0].piece, pairs[i].piece),
                     std::make_shared<DifferencePiece>(pairs[0].mirror, pairs[i].mirror)});
  const int n = 32;
  const CellLattice lattice = cube(n);
  for (const IntVec3 res : {IntVec3{2, 2, 2}, IntVec3{3, 1, 5}})
    for (const Pair& pair : pairs) {
      const auto a = count_inside(*pair.piece, lattice, {0, 0, 0}, IntVec3::all(n), res);
      const auto b = count_inside(*pair.mirror, lattice, {0, 0, 0}, IntVec3::all(n), res);
      std::int64_t partial = 0;
      for (std::size_t row = 0; row < a.size(); row += n)
        for (std::size_t i = 0; i < n; ++i) {
          ASSERT_EQ(a[row + i], b[row + n - 1 - i]) << pair.name;
          partial += a[row + i] > 0 && a[row + i] < res.x * res.y * res.z;
        }
      EXPECT_GT(partial, 0) << pair.name;
    }
}

TEST(Sampling, SubPointsLieSymmetrically) {
  const CellLattice lattice{{-0.75, 0, 0}, {0.125, 1, 1}};
  for (int res = 1; res < 8; ++res)
    for (int i = 0; i < 12; ++i)
      for (int s = 0; s < res; ++s) {
        EXPECT_EQ(lattice.sub_point(0, i, s, res), -lattice.sub_point(0, 11 - i, res - 1 - s, res));
        EXPECT_NEAR(lattice.sub_point(0, i, s, res), -0.75 + (i + (s + 0.5) / res) * 0.125, 1e-15);
      }
}

TEST(Sampling, PointFilesAreCountedByTheirPoints) {
  PointFile file;
  file.points = {{-0.9, -0.9, -0.9}, {-0.95, -0.9, -0.9}, {0.9, 0.9, 0.9}, {5, 5, 5}};
  const PointFilePiece piece(std::move(file));
  const auto counts = count_inside(piece, cube(4), {0, 0, 0}, {4, 4, 4}, {2, 2, 2});
  EXPECT_EQ(counts.front(), 2);
  EXPECT_EQ(counts.back(), 1);
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0), 3);
  EXPECT_EQ(count_inside(piece, cube(4), {0, 0, 0}, {2, 2, 2}), 2);
  EXPECT_TRUE(any_inside(piece, cube(4), {3, 3, 3}, {4, 4, 4}, {1, 1, 1}));
  EXPECT_FALSE(any_inside(piece, cube(4), {1, 1, 1}, {3, 3, 3}, {1, 1, 1}));
}

// How often a ball is asked, whichever way.
class CountingBall final : public GeometryPiece {
 public:
  bool inside(Vec3 p) const override {
    ++asked;
    return ball_.inside(p);
  }
  Bounds bounds() const override { return ball_.bounds(); }
  Cover cover(const Bounds& box) const override {
    ++asked;
    return ball_.cover(box);
  }
  mutable std::int64_t asked = 0;

 private:
  SpherePiece ball_{Vec3{0, 0, 0}, 0.8};
};

// 100^3 cells of 8 points each: points are asked for near the surface, never inside and outside.
TEST(Sampling, OfAMillionCellsAsksForFewPoints) {
  const auto ball = std::make_shared<CountingBall>();
  const PiecePtr whole = std::make_shared<BoxPiece>(Vec3::all(-2), Vec3::all(2));
  const DifferencePiece rest(whole, ball);
  const auto counts = count_inside(rest, cube(100), {0, 0, 0}, {100, 100, 100}, {2, 2, 2});
  EXPECT_EQ(counts.front(), 8);
  RecordProperty("asked", std::to_string(ball->asked));
  EXPECT_LT(static_cast<double>(ball->asked), share_of_points * 8e6);
}

// 60^3 points of one cell: only those near the surface, whose area is of 7,000.
TEST(Sampling, OfManyPointsOfACellFewAreAsked) {
  CountingBall ball;
  EXPECT_GT(count_inside(ball, cube(1), {0, 0, 0}, IntVec3::all(60)), 0);
  EXPECT_LT(static_cast<double>(ball.asked), 0.3 * 60 * 60 * 60);
}

}  // namespace
}  // namespace sluice::sampling_test
