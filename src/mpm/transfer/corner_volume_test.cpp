// Volumes of particles that carry their corners, against determinants, derivatives and surfaces.
#include "solids/corner_volume.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/transfer/from_grid.hpp"
#include "mpm/transfer/to_grid.hpp"

namespace sluice::mpm::corner_volume {
namespace {

constexpr double round_off = 1e-14;
constexpr double most_force = 1e-12;  // of the largest nodal force; measured 6e-14

class Random {
 public:
  double operator()() {  // -1/2 to 1/2
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state_ >> 11) * 0x1p-53 - 0.5;
  }

 private:
  std::uint64_t state_ = 11;
};

// A box of unit corners, moved at random by `shaken` edges.
template <int D>
solids::CornerVolume<D> box(Random& random, double shaken) {
  solids::CornerVolume<D> v;
  for (int k = 0; k < v.count; ++k)
    for (int a = 0; a < D; ++a) v.x[k][a] = 3 + (k >> a & 1) + shaken * random();
  return v;
}

template <int D>
void derivatives_hold() {
  Random random;
  for (int n = 0; n < 50; ++n) {
    const solids::CornerVolume<D> start = box<D>(random, 0.6);
    solids::CornerVolume<D> v = start;
    v.find();
    for (int a = 0; a < D; ++a) {
      double sum = 0;
      for (int k = 0; k < v.count; ++k) sum += v.b[k][a];
      EXPECT_NEAR(sum, 0, round_off);
      for (int e = 0; e < D; ++e) {  // sum b (x) x = V 1
        double moment = 0;
        for (int k = 0; k < v.count; ++k) moment += v.b[k][a] * v.x[k][e];
        EXPECT_NEAR(moment, a == e ? v.volume : 0, 10 * round_off);
      }
    }
    // V is at most of the third degree in one corner: central differences are exact but for it.
    for (int k = 0; k < v.count; ++k)
      for (int a = 0; a < D; ++a) {
        const double h = 1e-4;
        solids::CornerVolume<D> up = start, down = start;
        up.x[k][a] += h;
        down.x[k][a] -= h;
        up.find();
        down.find();
        EXPECT_NEAR((up.volume - down.volume) / (2 * h), v.b[k][a], 1e-9);
      }
  }
}

TEST(CornerVolume, ItsDerivativesAreTheWeights) {
  derivatives_hold<1>();
  derivatives_hold<2>();
  derivatives_hold<3>();
}

// x -> A x + c of a box: turned and stretched.
TEST(CornerVolume, OfAnAffineImageIsTheDeterminant) {
  Random random;
  for (int n = 0; n < 100; ++n) {
    double A[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) A[i][j] = (i == j ? 1.5 : 0) + 2 * random();
    const double flat = A[0][0] * A[1][1] - A[0][1] * A[1][0];
    const double full = A[0][0] * (A[1][1] * A[2][2] - A[1][2] * A[2][1]) -
                        A[0][1] * (A[1][0] * A[2][2] - A[1][2] * A[2][0]) +
                        A[0][2] * (A[1][0] * A[2][1] - A[1][1] * A[2][0]);
    const auto image = [&]<int D>(solids::CornerVolume<D>& v) {
      for (int k = 0; k < v.count; ++k) {
        double x[3] = {};
        for (int i = 0; i < D; ++i)
          for (int j = 0; j < D; ++j) x[i] += A[i][j] * (k >> j & 1 ? 0.5 : -0.5);
        for (int i = 0; i < D; ++i) v.x[k][i] = 7 + x[i];
      }
      v.find();
      return v.volume;
    };
    solids::CornerVolume<2> two;
    solids::CornerVolume<3> three;
    EXPECT_NEAR(image(two), flat, 100 * round_off);
    EXPECT_NEAR(image(three), full, 100 * round_off);
  }
}

TEST(CornerVolume, KeepsItsBitsWhereAllCornersMoveByMultiplesOfTheUnit) {
  Random random;
  const double unit = 0x1p-44;
  for (int n = 0; n < 100; ++n) {
    solids::CornerVolume<3> v = box<3>(random, 0.8);
    for (auto& corner : v.x)
      for (double& x : corner) x = std::nearbyint(x / unit) * unit;
    solids::CornerVolume<3> moved = v;
    for (auto& corner : moved.x)
      for (int a = 0; a < 3; ++a) corner[a] += (40 + 17 * a) + 12345 * unit;
    v.find();
    moved.find();
    EXPECT_EQ(v.volume, moved.volume);
    for (int k = 0; k < 8; ++k)
      for (int a = 0; a < 3; ++a) EXPECT_EQ(v.b[k][a], moved.b[k][a]);
  }
}

// A body of 4 parts a direction, its corners shaken; shared ones alike.
struct Body {
  static constexpr int parts = 4;
  int directions;
  std::vector<std::vector<double>> columns{27, std::vector<double>()};  // x 3, corners 24
  std::map<int, std::array<double, 3>> corner;

  explicit Body(int d) : directions(d) {
    Random random;
    const int n = parts + 1;
    for (int i = 0; i < n * n * n; ++i)
      corner[i] = {2 + 0.45 * (i % n) + 0.2 * random(), 2 + 0.4 * (i / n % n) + 0.2 * random(),
                   2 + 0.5 * (i / n / n) + 0.2 * random()};
    const int ny = d > 1 ? parts : 1, nz = d > 2 ? parts : 1;
    for (int z = 0; z < nz; ++z)
      for (int y = 0; y < ny; ++y)
        for (int x = 0; x < parts; ++x) add(x, y, z);
  }
  static int number(int x, int y, int z) { return x + (parts + 1) * (y + (parts + 1) * z); }
  void add(int x, int y, int z) {
    for (int a = 0; a < 3; ++a) columns[a].push_back(2);
    for (int k = 0; k < 8; ++k)
      for (std::size_t a = 0; a < 3; ++a)
        columns[3 + 3 * k + a].push_back(
            corner[number(x + (k & 1), y + (k >> 1 & 1), z + (k >> 2 & 1))][a]);
  }
  int count() const { return static_cast<int>(columns[0].size()); }
  ParticleShape shape() const {
    ParticleShape s;
    for (std::size_t k = 0; k < 24; ++k) s.corners[k] = columns[3 + k].data();
    return s;
  }
};

using Forces = std::map<int, std::array<double, 3>>;  // by number of the corner

// Integrals of n times the hats of corners over the surface, by other formulas: ends of a line,
// edges of a polygon, triangles around the centres of faces.
Forces surface_of(const Body& b) {
  Forces f;
  const int last = Body::parts;
  const auto at = [&](int k) { return b.corner.at(k); };
  if (b.directions == 1) {
    f[Body::number(0, 0, 0)][0] -= 1;
    f[Body::number(last, 0, 0)][0] += 1;
  } else if (b.directions == 2) {
    const auto edge = [&](int k, int m) {  // the body on the left
      const auto p = at(k), q = at(m);
      for (const int end : {k, m}) {
        f[end][0] += 0.5 * (q[1] - p[1]);
        f[end][1] -= 0.5 * (q[0] - p[0]);
      }
    };
    for (int n = 0; n < last; ++n) {
      edge(Body::number(n, 0, 0), Body::number(n + 1, 0, 0));
      edge(Body::number(n + 1, last, 0), Body::number(n, last, 0));
      edge(Body::number(last, n, 0), Body::number(last, n + 1, 0));
      edge(Body::number(0, n + 1, 0), Body::number(0, n, 0));
    }
  } else {
    const auto face = [&](const std::array<int, 4>& c) {  // outward by the right hand
      std::array<double, 3> m{};
      for (const int k : c)
        for (std::size_t a = 0; a < 3; ++a) m[a] += 0.25 * at(k)[a];
      for (std::size_t t = 0; t < 4; ++t) {
        const int k = c[t], l = c[(t + 1) % 4];
        double p[3], q[3];
        for (std::size_t a = 0; a < 3; ++a) {
          p[a] = at(k)[a] - m[a];
          q[a] = at(l)[a] - m[a];
        }
        for (std::size_t a = 0; a < 3; ++a) {
          const std::size_t i = (a + 1) % 3, j = (a + 2) % 3;
          const double n = 0.5 * (p[i] * q[j] - p[j] * q[i]);
          f[k][a] += n / 3;
          f[l][a] += n / 3;
          for (const int each : c) f[each][a] += n / 12;
        }
      }
    };
    for (int i = 0; i < last; ++i)
      for (int j = 0; j < last; ++j)
        for (const int side : {0, last}) {
          const auto turned = [&](std::array<int, 4> c) {
            if (side == 0) std::swap(c[1], c[3]);
            face(c);
          };
          turned({Body::number(side, i, j), Body::number(side, i + 1, j),
                  Body::number(side, i + 1, j + 1), Body::number(side, i, j + 1)});
          turned({Body::number(j, side, i), Body::number(j, side, i + 1),
                  Body::number(j + 1, side, i + 1), Body::number(j + 1, side, i)});
          turned({Body::number(i, j, side), Body::number(i + 1, j, side),
                  Body::number(i + 1, j + 1, side), Body::number(i, j + 1, side)});
        }
  }
  return f;
}

Window window_of(const Level& level, int directions) {
  Window window(block_shape(level.active), 1);
  IntVec3 high{0, 0, 0};
  for (int d = 0; d < directions; ++d) high[d] = 8;
  window.begin({0, 0, 0}, high);
  return window;
}

// One pressure p in all particles, and -p on the surface: no node feels anything, though each
// feels either alone.
TEST(CornerVolume, OnePressureInsideIsThatOfTheSurface) {
  for (const int directions : {1, 2, 3}) {
    const Body body(directions);
    Level level;
    level.domain = {{0, 0, 0}, {8, 8, 8}};
    TransferGrid grid;
    grid.count = directions;
    for (int d = 0; d < 3; ++d) {
      level.active[d] = d < directions;
      grid.axes[d] = axis_of(level, d);
      grid.active[d] = d;
    }
    const std::size_t n = body.count();
    std::vector<double> ones(n, 1), zero(n, 0), pressed(n, -3), volume(n);
    for (std::size_t p = 0; p < n; ++p) {
      const auto measure = [&]<int D>(solids::CornerVolume<D> v) {
        solids::read_carried<D>(body.shape().corners, grid.active, OneOf{p}, v.x);
        v.find();
        return v.volume;
      };
      volume[p] = directions == 3   ? measure(solids::CornerVolume<3>{})
                  : directions == 2 ? measure(solids::CornerVolume<2>{})
                                    : measure(solids::CornerVolume<1>{});
      ASSERT_GT(volume[p], 0);
    }
    ParticlesToGrid p;
    p.x = {body.columns[0].data(), body.columns[1].data(), body.columns[2].data()};
    p.shape = body.shape();
    p.mass = ones.data();
    p.volume = volume.data();
    p.v = {zero.data(), zero.data(), zero.data()};
    p.stress = {pressed.data(), pressed.data(), pressed.data(),
                zero.data(),    zero.data(),    zero.data()};
    SumUnits units;
    units.mass = units.momentum = 1;
    units.force = 0x1p46;
    Window window = window_of(level, directions);
    add_to_window(Basis::carried, grid, p, 0, body.count(), units, window);
    double most = 0, worst = 0;
    const Forces surface = surface_of(body);
    for (int k = 0; k <= (directions > 2 ? 8 : 0); ++k)
      for (int j = 0; j <= (directions > 1 ? 8 : 0); ++j)
        for (int i = 0; i <= 8; ++i)
          for (int d = 0; d < directions; ++d) {
            const double inside = sum_in(window.at(i, j, k), 4 + d) / units.force;
            double outside = 0;
            for (const auto& [corner, force] : surface) {
              double w = -3 * force[d];
              const int at[3] = {i, j, k};
              for (int a = 0; a < directions; ++a)
                w *= std::fmax(0, 1 - std::fabs(body.corner.at(corner)[a] - at[a]));
              outside += w;
            }
            most = std::fmax(most, std::fabs(inside));
            worst = std::fmax(worst, std::fabs(inside + outside));
          }
    RecordProperty("worst_" + std::to_string(directions), std::to_string(1e15 * worst / most));
    EXPECT_GT(most, 0.1);
    EXPECT_LE(worst, most_force * most) << directions;
  }
}

template <int D>
void eight_have_the_bits_of_single_ones() {
  Random random;
  std::array<std::vector<double>, 3 * max_corners> columns;
  std::array<const double*, 3 * max_corners> corners{};
  for (std::size_t c = 0; c < columns.size(); ++c) {
    for (int n = 0; n < 8; ++n) columns[c].push_back(random());
    corners[c] = columns[c].data();
  }
  solids::CornerVolume<D, Eight> all;
  solids::read_carried<D>(corners, {0, 1, 2}, EightOf{0}, all.x);
  all.find();
  for (std::size_t n = 0; n < 8; ++n) {
    solids::CornerVolume<D> one;
    solids::read_carried<D>(corners, {0, 1, 2}, OneOf{n}, one.x);
    one.find();
    EXPECT_EQ(all.volume[n], one.volume);
    for (int a = 0; a < D; ++a) EXPECT_EQ(all.middle[a][n], one.middle[a]);
    for (int k = 0; k < one.count; ++k)
      for (int a = 0; a < D; ++a) {
        EXPECT_EQ(all.x[k][a][n], one.x[k][a]);
        EXPECT_EQ(all.b[k][a][n], one.b[k][a]);
      }
  }
}

TEST(CornerVolume, EightTogetherHaveTheBitsOfSingleOnes) {
  eight_have_the_bits_of_single_ones<1>();
  eight_have_the_bits_of_single_ones<2>();
  eight_have_the_bits_of_single_ones<3>();
}

// A linear velocity on the nodes is read exactly, at the middle and at corners, with its gradient.
TEST(CornerVolume, LinearFieldsAreExact) {
  for (const int directions : {1, 2, 3}) {
    const Body body(directions);
    Level level;
    level.domain = {{0, 0, 0}, {8, 8, 8}};
    TransferGrid grid;
    grid.count = directions;
    for (int d = 0; d < 3; ++d) {
      level.active[d] = d < directions;
      grid.axes[d] = axis_of(level, d);
      grid.active[d] = d;
    }
    const double slope[3][3] = {{1, -2, 0.5}, {0.25, 3, -1}, {-0.75, 0.5, 2}};
    const auto field = [&](int e, const double* x) {
      double sum = e;
      for (int d = 0; d < directions; ++d) sum += slope[e][d] * x[d];
      return sum;
    };
    Window window = window_of(level, directions);
    for (int k = 0; k <= (directions > 2 ? 8 : 0); ++k)
      for (int j = 0; j <= (directions > 1 ? 8 : 0); ++j)
        for (int i = 0; i <= 8; ++i) {
          const double x[3] = {1.0 * i, 1.0 * j, 1.0 * k};
          for (int e = 0; e < 3; ++e) {
            window.at(i, j, k)[e] = as_bits(field(e, x));
            window.at(i, j, k)[4 + e] = as_bits(0.0);
          }
        }
    static GridAtParticles read;
    const int n = std::min(body.count(), chunk_size);
    read_window(Basis::carried, grid,
                {body.columns[0].data(), body.columns[1].data(), body.columns[2].data()},
                body.shape(), 0, n, false, window, read);
    for (int p = 0; p < n; ++p)
      for (int e = 0; e < 3; ++e) {
        double mean = 0;
        for (int k = 0; k < 1 << directions; ++k) {
          double x[3];
          for (std::size_t a = 0; a < 3; ++a) x[a] = body.columns[3 + 3 * k + a][p];
          EXPECT_NEAR(read.corner[k][e][p], field(e, x), 1e-13);
          mean += field(e, x) / (1 << directions);
        }
        EXPECT_NEAR(read.u[e][p], mean, 1e-13);
        for (int d = 0; d < 3; ++d)
          EXPECT_NEAR(read.L[3 * e + d][p], d < directions ? slope[e][d] : 0, 1e-11);
      }
  }
}

}  // namespace
}  // namespace sluice::mpm::corner_volume
