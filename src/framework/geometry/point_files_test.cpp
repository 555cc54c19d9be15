// Pieces that come from files: triangulated surfaces, polygons, particle lists.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <random>

#include "framework/base/error.hpp"
#include "framework/base/temporary_folder.hpp"
#include "framework/geometry/point_file.hpp"
#include "framework/geometry/polygon.hpp"
#include "framework/geometry/sampling.hpp"
#include "framework/geometry/triangulation.hpp"

namespace sluice::point_files_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class FromFiles : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder / name, std::ios::binary) << text;
    return (folder / name).string();
  }
  std::string stem(const std::string& name) { return (folder / name).string(); }

  TemporaryFolder folder;
};

// The unit cube, two triangles a face.
Triangulation unit_cube() {
  Triangulation t;
  for (int n = 0; n < 8; ++n)
    t.points.push_back({double(n & 1), double(n >> 1 & 1), double(n >> 2 & 1)});
  t.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}};
  return t;
}

// A sphere of radius 0.8 as an octahedron whose faces are divided four times over.
Triangulation ball() {
  Triangulation t;
  t.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int x : {0, 1})
    for (int y : {2, 3})
      for (int z : {4, 5}) t.triangles.push_back({x, y, z});
  for (int level = 0; level < 4; ++level) {
    std::map<std::pair<int, int>, int> middle;
    auto half = [&](int a, int b) {
      const auto [found, fresh] = middle.emplace(std::minmax(a, b), int(t.points.size()));
      if (fresh) {
        const Vec3 m = t.points[std::size_t(a)] + t.points[std::size_t(b)];
        t.points.push_back((1 / std::sqrt(dot(m, m))) * m);
      }
      return found->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : t.triangles) {
      const int ab = half(a, b), bc = half(b, c), ca = half(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    t.triangles = finer;
  }
  for (Vec3& p : t.points) p = 0.8 * p;
  return t;
}

TEST(Triangulated, CubeInsideOutsideAndOnTheSurface) {
  const TriangulationPiece cube(unit_cube());
  EXPECT_TRUE(cube.closed());
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> coordinate(-0.5, 1.5);
  for (int n = 0; n < 5000; ++n) {
    const Vec3 p{coordinate(random), coordinate(random), coordinate(random)};
    ASSERT_EQ(cube.inside(p), (Bounds{{0, 0, 0}, {1, 1, 1}}.contains(p)));
  }
  // Rays through edges, corners and diagonals.
  EXPECT_TRUE(cube.inside({0.5, 0.5, 0.5}));
  EXPECT_TRUE(cube.inside({0.25, 0.25, 0.25}));
  EXPECT_TRUE(cube.inside({0.5, 0.5, 0}));
  EXPECT_TRUE(cube.inside({1, 0.3, 0.6}));
  EXPECT_FALSE(cube.inside({1.5, 0.5, 0.5}));
  EXPECT_FALSE(cube.inside({-0.5, 0, 0}));
}

TEST(Triangulated, BallHasTheVolumeOfItsTriangles) {
  const Triangulation t = ball();
  double volume = 0;
  for (const auto& [a, b, c] : t.triangles)
    volume += std::abs(dot(t.points[std::size_t(a)],
                           cross(t.points[std::size_t(b)], t.points[std::size_t(c)]))) /
              6;
  const TriangulationPiece piece(t);
  ASSERT_TRUE(piece.closed());
  const int n = 32;
  const CellLattice lattice{Vec3::all(-1), Vec3::all(2.0 / n)};
  const auto counts = count_inside(piece, lattice, {0, 0, 0}, IntVec3::all(n), {2, 2, 2});
  double sampled = 0;
  for (std::int32_t c : counts) sampled += c / 8.0 * std::pow(2.0 / n, 3);
  EXPECT_NEAR(sampled / volume, 1, 3e-3);
  // Settling whole blocks changes nothing, and the ball is symmetric.
  for (int k = 0; k < n; k += 3)
    for (int j = 0; j < n; j += 5)
      for (int i = 0; i < n; ++i) {
        const std::size_t row = std::size_t(n) * (std::size_t(j) + std::size_t(n) * std::size_t(k));
        ASSERT_EQ(counts[row + std::size_t(i)], count_inside(piece, lattice, {i, j, k}, {2, 2, 2}));
        ASSERT_EQ(counts[row + std::size_t(i)], counts[row + std::size_t(n - 1 - i)]);
      }
}

TEST(Triangulated, AHoleIsOutvoted) {
  Triangulation t = unit_cube();
  t.triangles.erase(t.triangles.begin() + 8);  // one half of the face x = 0
  const TriangulationPiece cube(t);
  EXPECT_FALSE(cube.closed());
  for (double x : {0.1, 0.5, 0.9}) EXPECT_TRUE(cube.inside({x, 0.7, 0.3}));
  EXPECT_FALSE(cube.inside({1.1, 0.7, 0.3}));
  EXPECT_FALSE(cube.inside({-0.1, 0.7, 0.3}));
}

TEST_F(FromFiles, TriangulationIsReadAndChecked) {
  write("cube.pts", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n\n");
  write("cube.tri", "0 1 2 \n0 1 3\n0 2 3\n1 2 3\n");
  const TriangulationPiece piece(read_triangulation(stem("cube")));
  EXPECT_TRUE(piece.closed());
  EXPECT_TRUE(piece.inside({0.1, 0.2, 0.3}));
  EXPECT_FALSE(piece.inside({0.4, 0.4, 0.4}));

  write("cube.tri", "0 1 2\n0 1 4\n");
  EXPECT_THAT([&] { read_triangulation(stem("cube")); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("cube.tri:2:5: "), HasSubstr("point 4"))));
  write("cube.pts", "0 0 0\n1 0\n");
  EXPECT_THAT([&] { read_triangulation(stem("cube")); },
              ThrowsMessage<InputError>(HasSubstr("cube.pts:2:4: number 3 of 3 (z) is missing")));
  EXPECT_THAT(
      [&] { read_triangulation(stem("nothing")); },
      ThrowsMessage<InputError>(AllOf(HasSubstr("nothing.pts"), HasSubstr("no such file"))));
}

TEST_F(FromFiles, PolygonIsAPrism) {
  // An arrow head: not convex.
  const PolygonPiece piece(read_polygon(write("arrow.pts", "0 0\n2 1\n0 2\n1 1\n")));
  EXPECT_TRUE(piece.inside({1.5, 1, 100}));
  EXPECT_TRUE(piece.inside({0.5, 0.4, -3}));
  EXPECT_FALSE(piece.inside({0.5, 1, 0}));
  EXPECT_FALSE(piece.inside({2.1, 1, 0}));
  EXPECT_TRUE(piece.inside({1, 1, 0}));  // on the surface
  EXPECT_TRUE(piece.inside({2, 1, 0}));  // a corner
  const CellLattice lattice{{0, 0, 0}, {0.05, 0.05, 1}};
  const auto counts = count_inside(piece, lattice, {0, 0, 0}, {40, 40, 1}, {2, 2, 1});
  double area = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    area += counts[i] / 4.0 * 0.0025;
    ASSERT_EQ(counts[i], count_inside(piece, lattice, {int(i % 40), int(i / 40), 0}, {2, 2, 1}));
  }
  EXPECT_NEAR(area, 1, 0.02);
  EXPECT_THAT([&] { PolygonPiece(read_polygon(write("two.pts", "0 0\n1 1\n"))); },
              ThrowsMessage<InputError>(HasSubstr("at least 3")));
}

TEST_F(FromFiles, PointsWithVariables) {
  const std::string name = write("p.pts", "0 0 0  2.5  1 2 3\n1 1 1, 3.5, 4 5 6 # note\n");
  const PointFile file = read_point_file(name, PointFormat::text, {"p.volume", "p.fiberdir"});
  ASSERT_EQ(file.points.size(), 2u);
  EXPECT_EQ(file.scalars.at("p.volume")[1], 3.5);
  EXPECT_EQ(file.vectors.at("p.fiberdir")[0], (Vec3{1, 2, 3}));
  EXPECT_THAT([&] { read_point_file(name, PointFormat::text, {"p.mass"}); },
              ThrowsMessage<InputError>(HasSubstr("unknown variable 'p.mass'")));
  EXPECT_THAT(
      [&] {
        read_point_file(name, PointFormat::text, {"p.fiberdir", "p.normal"});
      },
      ThrowsMessage<InputError>(HasSubstr("p.pts:1:18: number 8 of 9 (p.normal y) is missing")));
  EXPECT_THAT([&] { read_point_file(name, PointFormat::text, {"p.volume"}); },
              ThrowsMessage<InputError>(
                  HasSubstr("p.pts:1:13: '1' found after the last number; expected 4 numbers")));
}

TEST_F(FromFiles, BinaryPointsInEitherByteOrder) {
  const std::array<double, 6> numbers = {1, 2, 3, -0.5, 0.25, 1e-3};
  std::string bytes(sizeof numbers, '\0');
  std::memcpy(bytes.data(), numbers.data(), sizeof numbers);
  const std::string native = write("n.pts", bytes);
  std::string swapped;
  for (std::size_t i = 0; i < bytes.size(); i += 8)
    swapped += std::string(bytes.rbegin() + long(bytes.size() - i - 8),
                           bytes.rbegin() + long(bytes.size() - i));
  const std::string other = write("s.pts", swapped);
  EXPECT_EQ(read_point_file(native, PointFormat::binary, {}).points[1], (Vec3{-0.5, 0.25, 1e-3}));
  EXPECT_EQ(read_point_file(native, PointFormat::binary_little_endian, {}).points[0],
            (Vec3{1, 2, 3}));
  EXPECT_EQ(read_point_file(other, PointFormat::binary_big_endian, {}).points[1],
            (Vec3{-0.5, 0.25, 1e-3}));
  EXPECT_THAT(
      [&] { read_point_file(write("c.pts", bytes.substr(0, 40)), PointFormat::binary, {}); },
      ThrowsMessage<InputError>(HasSubstr("row 2 is cut short")));
}

}  // namespace
}  // namespace sluice::point_files_test
