// Solids in cells against boxes, polygons clipped cell by cell, volumes of particles, and
// themselves: particle by particle, mirrored, in another order.
#include "mpmice/geometry/solid_in_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "mpmice/geometry/found_geometry_test_support.hpp"
#include "mpmice/geometry/pieces.hpp"
#include "solids/corner_volume.hpp"

namespace sluice::mpmice::solid_in_cells {
namespace {

// Thresholds, with what was measured as the worst of all bodies and directions.
constexpr double of_boxes = 2e-15;             // 6e-17
constexpr double of_polygons = 1e-14;          // 3.3e-15: most of it the clipping
constexpr double of_directions = 4e-15;        // 9e-16
constexpr double of_single_particles = 2e-15;  // 2.2e-16
constexpr double of_volumes = 2e-13;           // 6.4e-14 of 91
constexpr double of_mirrors = 2e-14;           // 4.8e-15
constexpr double of_forces = 8e-15;            // 2e-15

template <int D>
SolidInCells<D> geometry(const Body<D>& body,
                         const CellBlocks<D>& blocks = test_cells<D>().blocks) {
  return GeometryOf<D>{blocks}.at(When::start, body);
}

// How much of [i, i + 1] lies in [low, high].
double overlap(int i, double low, double high) {
  return std::clamp(std::min(high, i + 1.0) - std::max(low, 1.0 * i), 0.0, 1.0);
}

// theta is a product of overlaps, and so is a; faces touched from one side are covered.
template <int D>
double error_of_box(Point<D> low, int n) {
  const Body<D> body = block<D>("", n, low);
  const SolidInCells<D> g = geometry<D>(body);
  double worst = 0;
  for_cells<D>(cells_of(g), [&](const Cell<D>& c, std::size_t at) {
    std::array<double, D> part;
    double theta = 1;
    for (std::size_t d = 0; d < D; ++d) theta *= part[d] = overlap(c[d], low[d], low[d] + 0.5 * n);
    worst = std::max(worst, std::abs(g.theta[at] - theta));
    for (std::size_t d = 0; d < D; ++d) {
      double a = c[d] >= low[d] && c[d] <= low[d] + 0.5 * n ? 1 : 0;
      for (std::size_t e = 0; e < D; ++e) a *= e == d ? 1 : part[e];
      worst = std::max(worst, std::abs(g.a[d][at] - a));
    }
  });
  return worst;
}

TEST(SolidInCells, ABlockIsTheProductOfItsOverlaps) {
  double worst = 0;
  for (const double low : {2.0, 2.3, 2.5, -1.0, 2.9999999999999996, 3 - 1e-9}) {
    worst = std::max(worst, error_of_box<1>({low}, 5));
    worst = std::max(worst, error_of_box<2>({low, 3}, 5));
    worst = std::max(worst, error_of_box<2>({low, 1.7}, 1));
    worst = std::max(worst, error_of_box<3>({low, 3, 1.25}, 5));
    worst = std::max(worst, error_of_box<3>({1.1, low, low}, 4));
  }
  RecordProperty("worst", std::to_string(worst * 1e16) + "e-16");
  EXPECT_LT(worst, of_boxes);
}

// A surface in a grid plane belongs to the cell outside, on both sides alike.
TEST(SolidInCells, SurfacesInGridPlanesLieInTheCellsTheyTouch) {
  const SolidInCells<3> g = geometry<3>(block<3>("", 4, {0, 0, 0}));  // [0, 2]^3
  EXPECT_EQ(g.n[0][cells_of(g).index({-1, 0, 1})], -1);
  EXPECT_EQ(g.n[0][cells_of(g).index({2, 1, 0})], 1);
  EXPECT_EQ(g.n[2][cells_of(g).index({1, 0, -1})], -1);
  EXPECT_EQ(g.n[2][cells_of(g).index({1, 0, 2})], 1);
  EXPECT_EQ(g.n[0][cells_of(g).index({0, 0, 0})], 0);
  for (const int i : {0, 1, 2}) EXPECT_EQ(g.a[0][cells_of(g).index({i, 1, 1})], 1) << i;
  EXPECT_EQ(g.a[0][cells_of(g).index({-1, 1, 1})], 0);
  EXPECT_EQ(g.a[0][cells_of(g).index({3, 1, 1})], 0);
}

TEST(SolidInCells, FacesBeyondTheBlocksAreRefused) {
  const OuterFaces<2> faces = block<2>("", 4, {0, 0}).faces();
  SolidSums<2> sums;
  const auto small = CellBlocks<2>::around({{0, 0}, {3, 3}}),
             large = CellBlocks<2>::around({{-1, -1}, {3, 3}});
  sums.begin(small);
  EXPECT_THROW(sums.add(faces, When::start, 0, faces.size(), nullptr), std::out_of_range);
  sums.begin(large);
  EXPECT_NO_THROW(sums.add(faces, When::start, 0, faces.size(), nullptr));
}

// Half planes of a cell clip a convex polygon: area, and length on the lower face along x.
struct Clipped {
  double area = 0, length = 0;
};
Clipped clipped(std::vector<Point<2>> p, const Cell<2>& c) {
  const auto keep = [&p](std::size_t d, double sign, double at) {
    std::vector<Point<2>> to;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Point<2>&a = p[i], &b = p[(i + 1) % p.size()];
      const double u = sign * (a[d] - at), v = sign * (b[d] - at);
      if (u >= 0) to.push_back(a);
      if ((u >= 0) != (v >= 0))
        to.push_back({a[0] + u / (u - v) * (b[0] - a[0]), a[1] + u / (u - v) * (b[1] - a[1])});
    }
    p = to;
  };
  keep(1, 1, c[1]);
  keep(1, -1, c[1] + 1);
  keep(0, 1, c[0]);
  Clipped to;
  double low = 1e300, high = -1e300;
  for (const Point<2>& q : p)
    if (std::abs(q[0] - c[0]) < 1e-13) low = std::min(low, q[1]), high = std::max(high, q[1]);
  to.length = std::max(0.0, high - low);
  keep(0, -1, c[0] + 1);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Point<2>&a = p[i], &b = p[(i + 1) % p.size()];
    to.area += 0.5 * ((a[0] - c[0]) * (b[1] - c[1]) - (a[1] - c[1]) * (b[0] - c[0]));
  }
  return to;
}

TEST(SolidInCells, ATurnedSquareIsWhatClippingGives) {
  double worst = 0;
  for (const double angle : {0.1, 0.7, 1.3, -0.4}) {
    Body<2> body = block<2>("", 7, {2.6, 3.05});
    body.move(rotation<2>(angle));
    body.take_step();
    std::vector<Point<2>> outline;
    for (const std::size_t corner : {0u, 1u, 3u, 2u}) {  // lattice corners of the square
      const std::size_t p = (corner & 1 ? 6 : 0) + 7 * (corner & 2 ? 6 : 0);
      outline.push_back({body.start[corner][0][p], body.start[corner][1][p]});
    }
    const SolidInCells<2> g = geometry<2>(body);
    for_cells<2>(cells_of(g), [&](const Cell<2>& c, std::size_t at) {
      const Clipped exact = clipped(outline, c);
      worst = std::max(worst, std::abs(g.theta[at] - exact.area));
      worst = std::max(worst, std::abs(g.a[0][at] - exact.length));
    });
  }
  RecordProperty("worst", std::to_string(worst * 1e16) + "e-16");
  EXPECT_LT(worst, of_polygons);
}

// theta along every direction, in real numbers.
template <int D>
double error_of_directions(const Body<D>& body) {
  const OuterFaces<D> faces = body.faces();
  const SolidInCells<D> g = geometry<D>(body);
  std::array<KeptArray<double>, D> T;
  for (auto& t : T) t.assign(cells_of(g).size(), 0.0);
  for_each_piece<D>(faces, When::start, 0, faces.size(),
                    [&](std::size_t i, int t, const Piece<D>& piece) {
                      const FacetNodes<D> x = facet_nodes<D>(faces.start, i, t);
                      for (std::size_t d = 0; d < D; ++d)
                        for (std::size_t k = 0; k < D; ++k)
                          T[d][cells_of(g).index(piece.cell)] +=
                              piece.n[d] * piece.m[k] * (x[k][d] - piece.cell[d]);
                    });
  double worst = 0;
  for_cells<D>(cells_of(g), [&](const Cell<D>& c, std::size_t at) {
    for (std::size_t d = 0; d < D; ++d) {
      Cell<D> above = c;
      const double a = ++above[d] < cells_of(g).upper[d] ? g.a[d][cells_of(g).index(above)] : 0;
      worst = std::max(worst, std::abs(g.theta[at] - (a + T[d][at])));
      // Nothing is left far from the body.
      if (c[d] == cells_of(g).lower[d]) worst = std::max(worst, std::abs(g.a[d][at]));
    }
  });
  return worst;
}

// All particles of a body, each as a body of its own: theta adds up.
template <int D>
double error_of_single_particles(const Body<D>& body) {
  Body<D> apart = body;
  std::fill(apart.outer.begin(), apart.outer.end(), static_cast<std::uint8_t>((1 << 2 * D) - 1));
  const SolidInCells<D> whole = geometry<D>(body), sum = geometry<D>(apart);
  double worst = 0;
  for (std::size_t c = 0; c < whole.theta.size(); ++c)
    worst = std::max(worst, std::abs(whole.theta[c] - sum.theta[c]));
  return worst;
}

// Of a particle: volume, and b_k = dV/dx_k.
template <int D>
solids::CornerVolume<D> corner_volume(const CornerColumns<D>& x, std::size_t p) {
  solids::CornerVolume<D> v;
  for (std::size_t k = 0; k < x.size(); ++k)
    for (std::size_t d = 0; d < D; ++d) v.x[k][d] = x[k][d][p];
  v.find();
  return v;
}

template <int D>
double error_of_volume(const Body<D>& body) {
  const SolidInCells<D> g = geometry<D>(body);
  double sum = 0;
  const auto x = Body<D>::columns(body.start);
  for (std::size_t p = 0; p < body.size(); ++p) sum += corner_volume<D>(x, p).volume;
  return std::abs(std::accumulate(g.theta.begin(), g.theta.end(), 0.0) - sum);
}

template <int D>
void check_identities() {
  std::array<double, 3> worst{};
  for_each_body<D>([&](const Body<D>& body) {
    SCOPED_TRACE(body.name);
    for (const NamedMotion<D>& motion : motions<D>()) {
      Body<D> moving = body;
      for (int step = 0; step < 2; ++step) {
        const double of_d = error_of_directions<D>(moving);
        const double of_one = error_of_single_particles<D>(moving);
        const double of_v = error_of_volume<D>(moving);
        EXPECT_LT(of_d, of_directions);
        EXPECT_LT(of_one, of_single_particles);
        EXPECT_LT(of_v, of_volumes);
        worst = {std::max(worst[0], of_d), std::max(worst[1], of_one), std::max(worst[2], of_v)};
        moving.move(motion.to);
        moving.take_step();
      }
    }
  });
  for (std::size_t i = 0; i < 3; ++i)
    ::testing::Test::RecordProperty("worst" + std::to_string(i),
                                    std::to_string(worst[i] * 1e16) + "e-16");
}

TEST(SolidInCells, DirectionsParticlesAndVolumesAgree) {
  check_identities<1>();
  check_identities<2>();
  check_identities<3>();
}

TEST(SolidInCells, CellsThatAreFullOrEmptyAreSo) {
  const SolidInCells<3> g = geometry<3>(ball<3>());
  int full = 0, empty = 0;
  double worst = 0;
  for_cells<3>(cells_of(g), [&](const Cell<3>& c, std::size_t at) {
    double nearest = 0, farthest = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const double low = c[d] - body_middle[d], high = low + 1;
      farthest += std::max(low * low, high * high);
      nearest += low > 0 ? low * low : high < 0 ? high * high : 0;
    }
    if (farthest < 2.1 * 2.1) ++full, worst = std::max(worst, std::abs(g.theta[at] - 1));
    if (nearest > 2.3 * 2.3) ++empty, worst = std::max(worst, std::abs(g.theta[at]));
  });
  EXPECT_GT(full, 6);
  EXPECT_GT(empty, 1000);
  RecordProperty("worst", std::to_string(worst * 1e16) + "e-16");
  EXPECT_LT(worst, of_directions);
}

// Mirrored in the box along one direction.
template <int D>
double error_of_mirror(const Body<D>& body, std::size_t along) {
  const SolidInCells<D> g = geometry<D>(body);
  const double sum = cells_of(g).lower[along] + cells_of(g).upper[along];
  Body<D> twin = body;
  for (std::size_t k = 0; k < Body<D>::corners; ++k)
    for (std::size_t d = 0; d < D; ++d) {
      const std::size_t other = k ^ (std::size_t{1} << along);
      for (std::size_t p = 0; p < body.size(); ++p)
        twin.start[k][d][p] = d == along ? sum - body.start[other][d][p] : body.start[other][d][p];
    }
  for (std::size_t p = 0; p < body.size(); ++p) {
    const unsigned bits = body.outer[p], low = 1u << (2 * along), high = low << 1;
    twin.outer[p] = static_cast<std::uint8_t>((bits & ~(low | high)) | (bits & low ? high : 0) |
                                              (bits & high ? low : 0));
  }
  twin.end = twin.start;
  const SolidInCells<D> m = geometry<D>(twin);
  double worst = 0;
  for_cells<D>(cells_of(g), [&](const Cell<D>& c, std::size_t at) {
    Cell<D> image = c;
    image[along] = cells_of(g).lower[along] + cells_of(g).upper[along] - 1 - c[along];
    worst = std::max(worst, std::abs(g.theta[at] - m.theta[cells_of(g).index(image)]));
    for (std::size_t d = 0; d < D; ++d) {
      Cell<D> face = image;
      if (d == along && ++face[d] == cells_of(g).upper[d]) continue;
      worst = std::max(worst, std::abs(g.a[d][at] - m.a[d][cells_of(g).index(face)]));
    }
  });
  return worst;
}

TEST(SolidInCells, MirrorImagesAgreeOnGridPlanesToo) {
  double worst = 0;
  const auto check = [&]<int D>() {
    for_each_body<D>([&](const Body<D>& body) {
      for (std::size_t d = 0; d < D; ++d) {
        const double error = error_of_mirror<D>(body, d);
        worst = std::max(worst, error);
        EXPECT_LT(error, of_mirrors) << body.name << ", " << D << ", along " << d;
      }
    });
  };
  check.operator()<1>();
  check.operator()<2>();
  check.operator()<3>();
  RecordProperty("worst", std::to_string(worst * 1e16) + "e-16");
}

// The hat of a node at a place.
template <int D>
double hat(const Cell<D>& node, const Point<D>& x) {
  double value = 1;
  for (std::size_t d = 0; d < D; ++d) value *= std::max(0.0, 1 - std::abs(x[d] - node[d]));
  return value;
}

// G_ci, summed over cells and over nodes: sum_c G_ci = sum_p V_p grad S_ip, sum_i G_ci = n_c.
template <int D>
double error_of_forces(const Body<D>& body) {
  const OuterFaces<D> faces = body.faces();
  const SolidInCells<D> g = geometry<D>(body);
  std::array<KeptArray<double>, D> on_nodes, in_cells;
  for (auto* to : {&on_nodes, &in_cells})
    for (auto& column : *to) column.assign(cells_of(g).size(), 0.0);
  const auto spread = [&](const Point<D>& x, std::size_t d, double value) {
    Cell<D> low;
    for (std::size_t e = 0; e < D; ++e) low[e] = static_cast<int>(std::floor(x[e]));
    for (unsigned corner = 0; corner < (1u << D); ++corner) {
      Cell<D> node = low;
      for (std::size_t e = 0; e < D; ++e) node[e] += static_cast<int>(corner >> e) & 1;
      on_nodes[d][cells_of(g).index(node)] += value * hat<D>(node, x);
    }
  };
  for_each_piece<D>(
      faces, When::start, 0, faces.size(), [&](std::size_t i, int t, const Piece<D>& piece) {
        std::array<double, corners_of_face<D>> share{};
        add_to_corners<D>(t, piece.m, share);
        for (std::size_t k = 0; k < share.size(); ++k) {
          const auto corner = static_cast<std::size_t>(faces.corner(i, static_cast<int>(k)));
          Point<D> x;
          for (std::size_t d = 0; d < D; ++d) x[d] = body.start[corner][d][faces.particle[i]];
          for (std::size_t d = 0; d < D; ++d) {
            spread(x, d, piece.n[d] * share[k]);
            in_cells[d][cells_of(g).index(piece.cell)] += piece.n[d] * share[k];
          }
        }
      });
  const auto columns = Body<D>::columns(body.start);
  for (std::size_t p = 0; p < body.size(); ++p) {
    const solids::CornerVolume<D> v = corner_volume<D>(columns, p);
    for (std::size_t k = 0; k < Body<D>::corners; ++k) {
      Point<D> x;
      for (std::size_t d = 0; d < D; ++d) x[d] = body.start[k][d][p];
      for (std::size_t d = 0; d < D; ++d) spread(x, d, -v.b[k][d]);
    }
  }
  double worst = 0;
  for (std::size_t d = 0; d < D; ++d)
    for (std::size_t c = 0; c < cells_of(g).size(); ++c)
      worst = std::max({worst, std::abs(on_nodes[d][c]), std::abs(in_cells[d][c] - g.n[d][c])});
  return worst;
}

TEST(SolidInCells, ForcesOfPressureAreThoseOfStress) {
  double worst = 0;
  const auto check = [&]<int D>() {
    for_each_body<D>([&](const Body<D>& body) {
      const double error = error_of_forces<D>(body);
      worst = std::max(worst, error);
      EXPECT_LT(error, of_forces) << body.name << ", " << D;
    });
  };
  check.operator()<1>();
  check.operator()<2>();
  check.operator()<3>();
  RecordProperty("worst", std::to_string(worst * 1e16) + "e-16");
}

TEST(SolidInCells, NoBitDependsOnTheOrderOfFacesOrOnBlocks) {
  const Body<3> body = block<3>("", 7, {2.6, 2.7, 2.8}, 0.3);
  const OuterFaces<3> faces = body.faces();
  SolidSums<3> whole, first, second;  // another order, in two parts
  for (SolidSums<3>* sums : {&whole, &first, &second}) sums->begin(test_cells<3>().blocks);
  whole.add(faces, When::start, 0, faces.size(), nullptr);
  for (std::size_t i = faces.size(); i-- > 0;)
    (i % 3 == 0 ? first : second).add(faces, When::start, i, i + 1, nullptr);
  second.merge(first);
  for (int lane = 0; lane < whole.sums().lanes(); ++lane)
    for (std::size_t i = 0; i < test_cells<3>().size(); ++i)
      ASSERT_EQ(whole.sums().lane(lane)[i], second.sums().lane(lane)[i]);
  // No more blocks than needed.
  const CellBox<3> near{{1, 1, 1}, {8, 8, 8}};
  const auto blocks = CellBlocks<3>::around(near);
  ASSERT_LT(blocks.size(), test_cells<3>().size());
  const SolidInCells<3> wide = geometry<3>(body), tight = geometry<3>(body, blocks);
  for_each_cell_of<3>(near, [&](const Cell<3>& c) {
    const std::size_t i = blocks.index(c), j = cells_of(wide).index(c);
    EXPECT_EQ(tight.theta[i], wide.theta[j]);
    EXPECT_EQ(tight.a[1][i], wide.a[1][j]);
  });
}

TEST(SolidInCells, CleanValuesLieBetweenNoughtAndOne) {
  KeptArray<double> a{-3e-16, 5e-15, 2e-14, 0.5, 1 - 5e-15, 1 + 3e-16, 2};
  clean_covered_parts(a);
  EXPECT_EQ(a, (KeptArray<double>{0, 0, 2e-14, 0.5, 1, 1, 1}));
  KeptArray<double> theta{-3e-16, 5e-15, 2e-14, 0.5, 1 - 2e-10, 1 - 5e-11, 1.3};
  clean_volume_fractions(theta);
  EXPECT_EQ(theta, (KeptArray<double>{0, 0, 2e-14, 0.5, 1 - 2e-10, 1, 1}));
}

}  // namespace
}  // namespace sluice::mpmice::solid_in_cells
