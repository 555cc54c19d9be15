// What solids sweep: the identity of volumes, uniform motion, integrals over time, mirror images.
#include "mpmice/geometry/swept_volumes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "mpmice/geometry/bodies_test_support.hpp"
#include "mpmice/geometry/solid_in_cells.hpp"

namespace sluice::mpmice::swept_volumes {
namespace {

// Thresholds, with what was measured as the worst of all bodies, motions and directions.
constexpr double of_identity = 4e-15;        // 6.2e-16
constexpr double of_uniform_motion = 4e-15;  // 4.4e-16
constexpr double of_volumes = 5e-14;         // 9.7e-15
constexpr double of_mirrors = 2e-14;         // 4.8e-15
constexpr double of_static_bodies = 2e-15;   // 2.2e-16
constexpr double of_moments = 1e-15;         // 5.6e-17

template <int D>
SolidInCells<D> geometry(const OuterFaces<D>& faces, When when) {
  SolidSums<D> sums;
  sums.begin(test_cells<D>().blocks);
  sums.add(faces, when, 0, faces.size());
  SolidInCells<D> to;
  sums.finish(to);
  return to;
}

template <int D>
SweptVolumes<D> swept(const OuterFaces<D>& faces, bool moments = false) {
  SweptSums<D> sums;
  sums.begin(test_cells<D>().blocks, moments);
  sums.add(faces, 0, faces.size());
  SweptVolumes<D> to;
  sums.finish(to);
  return to;
}

// Lower minus upper face of a cell.
template <int D>
double difference(const KeptArray<double>& f, const TestCells<D>& cells, Cell<D> c, int d) {
  const double low = f[cells.index(c)];
  const auto a = static_cast<std::size_t>(d);
  return low - (++c[a] < cells.upper[a] ? f[cells.index(c)] : 0.0);
}

struct Errors {
  double identity = 0, uniform = 0, volume = 0;
  void include(const Errors& e) {
    identity = std::max(identity, e.identity);
    uniform = std::max(uniform, e.uniform);
    volume = std::max(volume, e.volume);
  }
};

template <int D>
Errors errors_of(const OuterFaces<D>& faces, const Point<D>& v) {
  const SolidInCells<D> before = geometry<D>(faces, When::start),
                        after = geometry<D>(faces, When::end);
  const SweptVolumes<D> s = swept<D>(faces);
  Errors e;
  double grown = 0, moved = 0;
  for_cells<D>(cells_of(s), [&](const Cell<D>& c, std::size_t at) {
    double gain = s.q[at], uniform = s.q[at];
    for (int d = 0; d < D; ++d) {
      const auto a = static_cast<std::size_t>(d);
      gain += difference<D>(s.C[a], cells_of(s), c, d);
      uniform -= v[a] * difference<D>(s.A[a], cells_of(s), c, d);
    }
    e.identity = std::max(e.identity, std::abs(after.theta[at] - before.theta[at] - gain));
    if (v[0] < 1e300) e.uniform = std::max(e.uniform, std::abs(uniform));
    grown += after.theta[at] - before.theta[at];
    moved += s.q[at];
  });
  e.volume = std::abs(grown - moved);
  return e;
}

TEST(SweptVolumes, ThetaChangesByWhatIsSwept) {
  Errors worst;
  const auto check = [&]<int D>() {
    for_each_body<D>([&](const Body<D>& body) {
      for (const NamedMotion<D>& motion : motions<D>()) {
        Body<D> moving = body;
        for (int step = 0; step < 4; ++step) {
          moving.move(motion.to);
          const Errors e = errors_of<D>(moving.faces(), motion.uniform);
          EXPECT_LT(e.identity, of_identity) << D << ", " << body.name << ", " << motion.name;
          EXPECT_LT(e.uniform, of_uniform_motion) << D << ", " << body.name << ", " << motion.name;
          EXPECT_LT(e.volume, of_volumes) << D << ", " << body.name << ", " << motion.name;
          worst.include(e);
          moving.take_step();
        }
      }
    });
  };
  check.operator()<1>();
  check.operator()<2>();
  check.operator()<3>();
  RecordProperty("worst", std::to_string(worst.identity * 1e16) + ", " +
                              std::to_string(worst.uniform * 1e16) + ", " +
                              std::to_string(worst.volume * 1e16) + " e-16");
}

// A body at rest: A = a, nothing is swept, to the bit.
TEST(SweptVolumes, BodiesAtRestSweepNothing) {
  double worst = 0;
  const auto check = [&]<int D>() {
    for_each_body<D>([&](const Body<D>& body) {
      const OuterFaces<D> faces = body.faces();
      const SolidInCells<D> g = geometry<D>(faces, When::start);
      const SweptVolumes<D> s = swept<D>(faces);
      for (std::size_t c = 0; c < s.q.size(); ++c) {
        ASSERT_EQ(s.q[c], 0);
        for (std::size_t d = 0; d < D; ++d) {
          ASSERT_EQ(s.C[d][c], 0);
          worst = std::max(worst, std::abs(s.A[d][c] - g.a[d][c]));
        }
      }
    });
  };
  check.operator()<1>();
  check.operator()<2>();
  check.operator()<3>();
  RecordProperty("worst", std::to_string(worst * 1e16) + "e-16");
  EXPECT_LT(worst, of_static_bodies);
}

// int a v dt over a step by the midpoint rule on n parts, for a body in uniform motion.
template <int D>
std::array<KeptArray<double>, D> passed(const Body<D>& body, const Point<D>& v, int n) {
  std::array<KeptArray<double>, D> sum;
  for (auto& column : sum) column.assign(test_cells<D>().size(), 0.0);
  for (int i = 0; i < n; ++i) {
    Body<D> there = body;
    there.move([&](const Point<D>& x) {
      Point<D> y;
      for (std::size_t d = 0; d < D; ++d) y[d] = x[d] + v[d] * (i + 0.5) / n;
      return y;
    });
    const SolidInCells<D> g = geometry<D>(there.faces(), When::end);
    for (std::size_t d = 0; d < D; ++d)
      for (std::size_t c = 0; c < sum[d].size(); ++c) sum[d][c] += v[d] * g.a[d][c] / n;
  }
  return sum;
}

struct Misfit {
  double worst = 0, rms = 0, worst_without_C = 0;
};

// H_s = C + A v against it; rms over faces that differ from 0 and from v.
template <int D>
Misfit misfit(Body<D> body, const std::array<double, 3>& by, int n) {
  const NamedMotion<D> motion = translation<D>("", by);
  body.move(motion.to);
  const SweptVolumes<D> s = swept<D>(body.faces());
  const auto exact = passed<D>(body, motion.uniform, n);
  Misfit m;
  int faces = 0;
  for (std::size_t d = 0; d < D; ++d)
    for (std::size_t c = 0; c < s.q.size(); ++c) {
      const double v = motion.uniform[d], simple = v * s.A[d][c];
      const double error = std::abs(s.C[d][c] + simple - exact[d][c]);
      m.worst = std::max(m.worst, error);
      m.worst_without_C = std::max(m.worst_without_C, std::abs(simple - exact[d][c]));
      if (std::abs(exact[d][c]) > 1e-12 && std::abs(exact[d][c] - v) > 1e-12) {
        m.rms += error * error;
        ++faces;
      }
    }
  m.rms = std::sqrt(m.rms / std::max(faces, 1));
  return m;
}

// Along an axis a face is passed by the front within the step: the rule with n parts errs by half
// of one.
TEST(SweptVolumes, ABlockAlongAnAxisPassesExactly) {
  double worst = 0;  // in parts
  for (const double v : {0.05, 0.47, 0.83}) {
    worst = std::max(worst, misfit<1>(block<1>("", 7, {2.6}), {v, 0, 0}, 401).worst / v * 401);
    worst = std::max(worst, misfit<2>(block<2>("", 7, {2.6, 2.9}), {0, v, 0}, 401).worst / v * 401);
    worst =
        std::max(worst, misfit<3>(block<3>("", 7, {2.6, 2.9, 3}), {0, 0, v}, 41).worst / v * 41);
  }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LT(worst, 0.5 + 1e-11);
}

TEST(SweptVolumes, TheBallPassesNearlyAsTheIntegral) {
  const std::array<double, 3> way{0.77, -0.49, 0.41};
  struct Row {
    double length, worst, rms, without_C;
  };
  // Measured 8.3e-3 (rms 2.2e-3) and 6.7e-2 without C; 1.8e-3 (3.8e-4), 3.2e-3; 2.6e-5 (5.6e-6),
  // 5.7e-5.
  for (const Row& row : {Row{0.42, 1.2e-2, 3.5e-3, 0.05}, Row{0.21, 2.8e-3, 6e-4, 3e-3},
                         Row{0.05, 4e-5, 9e-6, 5e-5}}) {
    const double l = row.length;
    const Misfit m = misfit<3>(ball<3>(), {way[0] * l, way[1] * l, way[2] * l}, 100);
    EXPECT_LT(m.worst, row.worst) << l;
    EXPECT_LT(m.rms, row.rms) << l;
    EXPECT_GT(m.worst_without_C, row.without_C) << l;
  }
}

// Mirrored in the box along one direction: C changes its sign.
template <int D>
double error_of_mirror(const Body<D>& body, std::size_t along) {
  const SweptVolumes<D> s = swept<D>(body.faces());
  const double sum = cells_of(s).lower[along] + cells_of(s).upper[along];
  Body<D> twin = body;
  for (std::size_t k = 0; k < Body<D>::corners; ++k)
    for (std::size_t d = 0; d < D; ++d) {
      const std::size_t other = k ^ (std::size_t{1} << along);
      for (std::size_t p = 0; p < body.size(); ++p) {
        const double x = body.start[other][d][p], y = body.end[other][d][p];
        twin.start[k][d][p] = d == along ? sum - x : x;
        twin.end[k][d][p] = d == along ? sum - y : y;
      }
    }
  for (std::size_t p = 0; p < body.size(); ++p) {
    const unsigned bits = body.outer[p], low = 1u << (2 * along), high = low << 1;
    twin.outer[p] = static_cast<std::uint8_t>((bits & ~(low | high)) | (bits & low ? high : 0) |
                                              (bits & high ? low : 0));
  }
  const SweptVolumes<D> m = swept<D>(twin.faces());
  double worst = 0;
  for_cells<D>(cells_of(s), [&](const Cell<D>& c, std::size_t at) {
    Cell<D> image = c;
    image[along] = cells_of(s).lower[along] + cells_of(s).upper[along] - 1 - c[along];
    worst = std::max(worst, std::abs(s.q[at] - m.q[cells_of(s).index(image)]));
    for (std::size_t d = 0; d < D; ++d) {
      Cell<D> face = image;
      if (d == along && ++face[d] == cells_of(s).upper[d]) continue;
      const double sign = d == along ? -1 : 1;
      worst = std::max(worst, std::abs(s.C[d][at] - sign * m.C[d][cells_of(s).index(face)]));
      worst = std::max(worst, std::abs(s.A[d][at] - m.A[d][cells_of(s).index(face)]));
    }
  });
  return worst;
}

TEST(SweptVolumes, MirrorImagesAgree) {
  double worst = 0;
  const auto check = [&]<int D>() {
    for (const NamedMotion<D>& motion : motions<D>())
      for_each_body<D>([&](Body<D> body) {
        body.move(motion.to);
        for (std::size_t d = 0; d < D; ++d) {
          const double error = error_of_mirror<D>(body, d);
          worst = std::max(worst, error);
          EXPECT_LT(error, of_mirrors) << D << ", " << body.name << ", " << motion.name << d;
        }
      });
  };
  check.operator()<1>();
  check.operator()<2>();
  check.operator()<3>();
  RecordProperty("worst", std::to_string(worst * 1e16) + "e-16");
}

// First moments of a block's part of a face are known.
TEST(SweptVolumes, MomentsOfABlockAreThoseOfRectangles) {
  const Point<3> low{2.6, 3.3, 2};
  const SweptVolumes<3> s = swept<3>(block<3>("", 5, low).faces(), true);
  const auto part = [&](std::size_t d, int i) {  // length and first moment about the middle
    const double from = std::clamp(low[d] - i, 0.0, 1.0),
                 to = std::clamp(low[d] + 2.5 - i, 0.0, 1.0);
    return std::array{to - from, 0.5 * ((to - 0.5) * (to - 0.5) - (from - 0.5) * (from - 0.5))};
  };
  double worst = 0;
  for_cells<3>(cells_of(s), [&](const Cell<3>& c, std::size_t at) {
    for (std::size_t d = 0; d < 3; ++d) {
      const bool meets = c[d] >= low[d] && c[d] <= low[d] + 2.5;
      std::size_t j = 0;
      for (std::size_t u = 0; u < 3; ++u) {
        if (u == d) continue;
        const std::size_t v = 3 - d - u;
        const double exact = meets ? part(u, c[u])[1] * part(v, c[v])[0] : 0;
        worst = std::max(worst, std::abs(s.M[2 * d + j++][at] - exact));
      }
    }
  });
  RecordProperty("worst", std::to_string(worst * 1e16) + "e-16");
  EXPECT_LT(worst, of_moments);
}

// Fluid that turns with a ball keeps its volume: V_L = V' + sum (H_+ - H_-) with
// H = (1 - A) v_h - C - sum_u M_du d_u v, v_h = v - (v.grad) v/2 for corners that move straight by
// x' = x + v(x). Mean of |V_L/V - 1| where V > 1/2.
double error_of_turning(double angle, bool with_moments) {
  Body<3> body = ball<3>();
  body.move(rotation<3>(angle));
  const OuterFaces<3> faces = body.faces();
  const SolidInCells<3> before = geometry<3>(faces, When::start),
                        after = geometry<3>(faces, When::end);
  const SweptVolumes<3> s = swept<3>(faces, true);
  std::array<KeptArray<double>, 3> H;
  for (auto& column : H) column.assign(s.q.size(), 0.0);
  const double g[2][2] = {{std::cos(angle) - 1, -std::sin(angle)},
                          {std::sin(angle), std::cos(angle) - 1}};  // grad v
  for_cells<3>(cells_of(s), [&](const Cell<3>& c, std::size_t at) {
    for (std::size_t d = 0; d < 2; ++d) {
      const double x = c[0] + (d == 0 ? 0 : 0.5) - body_middle[0];
      const double y = c[1] + (d == 1 ? 0 : 0.5) - body_middle[1];
      const double v[2] = {g[0][0] * x + g[0][1] * y, g[1][0] * x + g[1][1] * y};
      const double v_h = v[d] - (with_moments ? 0.5 * (g[d][0] * v[0] + g[d][1] * v[1]) : 0.0);
      // The first other direction of d is y for x, x for y.
      const double slope = with_moments ? g[d][1 - d] * s.M[2 * d][at] : 0;
      H[d][at] = (1 - s.A[d][at]) * v_h - s.C[d][at] - slope;
    }
  });
  double sum = 0;
  int cells = 0;
  for_cells<3>(cells_of(s), [&](const Cell<3>& c, std::size_t at) {
    const double V = 1 - before.theta[at];
    if (V < 0.5 || V > 1 - 1e-12) return;
    double V_L = 1 - after.theta[at];
    for (int d = 0; d < 2; ++d)
      V_L -= difference<3>(H[static_cast<std::size_t>(d)], cells_of(s), c, d);
    sum += std::abs(V_L / V - 1);
    ++cells;
  });
  return sum / cells;
}

TEST(SweptVolumes, FluidThatTurnsWithABallKeepsItsVolume) {
  EXPECT_LT(error_of_turning(0.05, true), 5e-5);     // 2.7e-5
  EXPECT_GT(error_of_turning(0.05, false), 3e-3);    // 3.8e-3: what the moments are for
  EXPECT_LT(error_of_turning(0.0125, true), 8e-7);   // 4.0e-7
  EXPECT_GT(error_of_turning(0.0125, false), 3e-4);  // 3.8e-4
}

TEST(SweptVolumes, NoBitDependsOnTheOrderOfFaces) {
  Body<3> body = block<3>("", 7, {2.6, 2.7, 2.8}, 0.3);
  body.move(deformation<3>());
  const OuterFaces<3> faces = body.faces();
  const SweptVolumes<3> whole = swept<3>(faces, true);
  SweptSums<3> first, second;
  first.begin(test_cells<3>().blocks, true);
  second.begin(test_cells<3>().blocks, true);
  for (std::size_t i = faces.size(); i-- > 0;) (i % 3 == 0 ? first : second).add(faces, i, i + 1);
  second.merge(first);
  SweptVolumes<3> parts;
  second.finish(parts);
  EXPECT_EQ(whole.q, parts.q);
  EXPECT_EQ(whole.A, parts.A);
  EXPECT_EQ(whole.C, parts.C);
  EXPECT_EQ(whole.M, parts.M);
}

TEST(SweptVolumes, CornersThatJumpFarAreRefused) {
  Body<1> body = block<1>("", 2, {0});
  body.move([](const Point<1>& x) -> Point<1> { return {x[0] + 40}; });
  SweptSums<1> sums;
  const auto cells = CellBlocks<1>::around({{-10}, {60}});
  sums.begin(cells);
  const OuterFaces<1> faces = body.faces();
  EXPECT_THROW(sums.add(faces, 0, faces.size()), std::out_of_range);
}

}  // namespace
}  // namespace sluice::mpmice::swept_volumes
