// What solids sweep: the identity of volumes, uniform motion, integrals over time, mirror images.
#include "mpmice/geometry/swept_volumes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "mpmice/geometry/found_geometry_test_support.hpp"

namespace sluice::mpmice::swept_volumes {
namespace {

// Thresholds, with what was measured as the worst of all bodies, motions and directions.
constexpr double of_identity = 4e-15;        // 6.2e-16
constexpr double of_uniform_motion = 4e-15;  // 4.4e-16
constexpr double of_volumes = 5e-14;         // 9.7e-15
constexpr double of_mirrors = 2e-14;         // 4.8e-15
constexpr double of_static_bodies = 2e-15;   // 2.2e-16

template <int D>
SolidInCells<D> geometry(const Body<D>& body, When when) {
  return GeometryOf<D>{}.at(when, body);
}

template <int D>
SweptVolumes<D> swept(const Body<D>& body) {
  return GeometryOf<D>{}.swept(body);
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
Errors errors_of(const Body<D>& body, const Point<D>& v) {
  const SolidInCells<D> before = geometry<D>(body, When::start),
                        after = geometry<D>(body, When::end);
  const SweptVolumes<D> s = swept<D>(body);
  const KeptArray<double> q = added_by_surface<D>(body.faces());
  Errors e;
  double grown = 0, moved = 0;
  for_cells<D>(cells_of(s), [&](const Cell<D>& c, std::size_t at) {
    double gain = q[at], uniform = q[at];
    for (int d = 0; d < D; ++d) {
      const auto a = static_cast<std::size_t>(d);
      gain += difference<D>(s.C[a], cells_of(s), c, d);
      uniform -= v[a] * difference<D>(s.A[a], cells_of(s), c, d);
    }
    e.identity = std::max(e.identity, std::abs(after.theta[at] - before.theta[at] - gain));
    if (v[0] < 1e300) e.uniform = std::max(e.uniform, std::abs(uniform));
    grown += after.theta[at] - before.theta[at];
    moved += q[at];
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
          const Errors e = errors_of<D>(moving, motion.uniform);
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
      const SolidInCells<D> g = geometry<D>(body, When::start);
      const SweptVolumes<D> s = swept<D>(body);
      for (std::size_t c = 0; c < g.theta.size(); ++c) {
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
    const SolidInCells<D> g = geometry<D>(there, When::end);
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
  const SweptVolumes<D> s = swept<D>(body);
  const auto exact = passed<D>(body, motion.uniform, n);
  Misfit m;
  int faces = 0;
  for (std::size_t d = 0; d < D; ++d)
    for (std::size_t c = 0; c < s.A[0].size(); ++c) {
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
  // Measured 8.3e-3 (rms 2.2e-3) and 6.1e-2 without C; 1.8e-3 (3.8e-4), 2.6e-3; 2.6e-5 (5.6e-6),
  // 4.2e-5.
  for (const Row& row : {Row{0.42, 1.2e-2, 3.5e-3, 0.05}, Row{0.21, 2.8e-3, 6e-4, 2e-3},
                         Row{0.05, 4e-5, 9e-6, 3.5e-5}}) {
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
  const SweptVolumes<D> s = swept<D>(body);
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
  const SweptVolumes<D> m = swept<D>(twin);
  double worst = 0;
  for_cells<D>(cells_of(s), [&](const Cell<D>& c, std::size_t at) {
    Cell<D> image = c;
    image[along] = cells_of(s).lower[along] + cells_of(s).upper[along] - 1 - c[along];
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

// Mixed shapes have the same mean volume fraction whichever direction they are summed along: in
// every cell Theta = A_d(upper) + T_d, so that A follows from A of other directions.
template <int D>
double error_of_directions(const Body<D>& body) {
  const OuterFaces<D> faces = body.faces();
  const SweptVolumes<D> s = swept<D>(body);
  std::array<KeptArray<double>, D> T;
  for (auto& t : T) t.assign(test_cells<D>().size(), 0.0);
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (int t = 0; t < facets_of_face<D>; ++t) {
      const MixedFacet<D> f(facet_nodes<D>(faces.start, i, t), facet_nodes<D>(faces.end, i, t),
                            faces.face[i]);
      for_each_mean_piece<D>(
          f, 1, false,
          [&](const std::array<Slots, D>&, const MeanArea<D>&, const MeanPiece<D>& piece) {
            Cell<D> cell = piece.cell;
            for (std::size_t d = 0; d < D; ++d) cell[d] += f.base[d];
            for (std::size_t d = 0; d < D; ++d) T[d][test_cells<D>().index(cell)] += piece.T[d];
          });
    }
  double worst = 0;
  for_cells<D>(cells_of(s), [&](const Cell<D>& c, std::size_t at) {
    std::array<double, D> theta;
    for (std::size_t d = 0; d < D; ++d) {
      Cell<D> above = c;
      const double A = ++above[d] < cells_of(s).upper[d] ? s.A[d][cells_of(s).index(above)] : 0;
      theta[d] = A + T[d][at];
      worst = std::max(worst, std::abs(theta[d] - theta[0]));
    }
  });
  return worst;
}

TEST(SweptVolumes, MeanFractionsAreTheSameAlongAllDirections) {
  double worst = 0;
  const auto check = [&]<int D>() {
    for (const NamedMotion<D>& motion : motions<D>())
      for_each_body<D>([&](Body<D> body) {
        body.move(motion.to);
        const double error = error_of_directions<D>(body);
        worst = std::max(worst, error);
        EXPECT_LT(error, of_identity) << D << ", " << body.name << ", " << motion.name;
      });
  };
  check.operator()<2>();
  check.operator()<3>();
  RecordProperty("worst", std::to_string(worst * 1e16) + "e-16");
}

TEST(SweptVolumes, NoBitDependsOnTheOrderOfFaces) {
  Body<3> body = block<3>("", 7, {2.6, 2.7, 2.8}, 0.3);
  body.move(deformation<3>());
  const OuterFaces<3> faces = body.faces();
  FreeCells<3> free;
  free.begin(test_cells<3>().blocks, {});
  SweptSums<3> whole, first, second;
  for (SweptSums<3>* sums : {&whole, &first, &second}) sums->begin(test_cells<3>().blocks);
  whole.add(faces, 0, faces.size(), free);
  for (std::size_t i = faces.size(); i-- > 0;)
    (i % 3 == 0 ? first : second).add(faces, i, i + 1, free);
  second.merge(first);
  for (int lane = 0; lane < whole.sums().lanes(); ++lane)
    for (std::size_t i = 0; i < test_cells<3>().size(); ++i)
      ASSERT_EQ(whole.sums().lane(lane)[i], second.sums().lane(lane)[i]);
}

TEST(SweptVolumes, CornersThatJumpFarAreRefused) {
  Body<1> body = block<1>("", 2, {0});
  body.move([](const Point<1>& x) -> Point<1> { return {x[0] + 40}; });
  SweptSums<1> sums;
  const auto cells = CellBlocks<1>::around({{-10}, {60}});
  sums.begin(cells);
  FreeCells<1> free;
  free.begin(cells, {});
  const OuterFaces<1> faces = body.faces();
  EXPECT_THROW(sums.add(faces, 0, faces.size(), free), std::out_of_range);
}

}  // namespace
}  // namespace sluice::mpmice::swept_volumes
