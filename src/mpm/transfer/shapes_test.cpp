// Weights of every basis against what they must sum to, and corners against places by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/transfer/corners.hpp"
#include "mpm/transfer/from_grid.hpp"

namespace sluice::mpm::shapes {
namespace {

constexpr double round_off = 1e-13;

// Particles of any shape in a level of 12 x 10 x 9 cells, stretched.
struct Scene {
  Level level;
  TransferGrid grid;
  std::vector<std::vector<double>> columns;  // x 3, F 9, edges 9, half 3
  int count = 40;

  explicit Scene(int directions) {
    level.anchor = {-1.2, -0.5, -0.9};
    level.spacing = {0.2, 0.1, 0.2};
    level.domain = {{0, 0, 0}, {12, 10, 9}};
    grid.count = directions;
    for (int d = 0; d < 3; ++d) {
      grid.axes[d] = axis_of(level, d);
      grid.active[d] = d;
      level.active[d] = d < directions;
    }
    std::uint64_t state = 7;
    const auto random = [&] {
      state = state * 6364136223846793005u + 1442695040888963407u;
      return static_cast<double>(state >> 11) * 0x1p-53;
    };
    columns.assign(24, std::vector<double>(count));
    for (int p = 0; p < count; ++p) {
      for (std::size_t d = 0; d < 3; ++d)
        columns[d][p] =
            level.anchor[static_cast<int>(d)] + level.spacing[static_cast<int>(d)] * (4 + random());
      for (std::size_t e = 0; e < 9; ++e) {
        columns[3 + e][p] = (e % 4 == 0) + 0.6 * (random() - 0.5);
        columns[12 + e][p] = 0.5 * (e % 4 == 0) + 0.1 * (random() - 0.5);
      }
      for (std::size_t d = 0; d < 3; ++d) columns[21 + d][p] = 0.1 + 0.39 * random();
    }
  }
  std::array<const double*, 3> x() const {
    return {columns[0].data(), columns[1].data(), columns[2].data()};
  }
  ParticleShape shape(bool widths) const {
    ParticleShape s;
    for (std::size_t e = 0; e < 9; ++e) {
      s.F[e] = columns[3 + e].data();
      s.edges[e] = columns[12 + e].data();
    }
    for (std::size_t d = 0; d < 3 && widths; ++d) s.half[d] = columns[21 + d].data();
    return s;
  }
};

struct Kind {
  const char* name;
  Basis basis;
  bool widths;
  double limit;
};

class EveryShape : public testing::TestWithParam<std::tuple<int, Kind>> {};

// A field 1 + a.x on the nodes: its value at a particle is that at its place (hats, B-splines,
// corners with their centroid there; GIMP too), and its gradient is a.
TEST_P(EveryShape, LinearFieldsAreExact) {
  const auto [directions, kind] = GetParam();
  if (kind.basis == Basis::cpti && directions != 3) return;
  Scene scene(directions);
  scene.grid.corner_limit = kind.limit;
  const BlockShape shape = block_shape(scene.level.active);
  Window window(shape, 1);
  IntVec3 low{0, 0, 0}, high{0, 0, 0};
  for (int d = 0; d < directions; ++d) {
    low[d] = 0;
    high[d] = 9;
  }
  window.begin(low, high);
  const double slope[3][3] = {{1, -2, 0.5}, {0.25, 3, -1}, {-0.75, 0.5, 2}};
  const auto field = [&](int e, Vec3 at) {
    double sum = e + 1;
    for (int d = 0; d < directions; ++d) sum += slope[e][d] * at[d];
    return sum;
  };
  for (int k = low.z; k <= high.z; ++k)
    for (int j = low.y; j <= high.y; ++j)
      for (int i = low.x; i <= high.x; ++i) {
        const Vec3 at = scene.level.anchor + Vec3{1.0 * i, 1.0 * j, 1.0 * k} * scene.level.spacing;
        for (int e = 0; e < 3; ++e) {
          window.at(i, j, k)[e] = as_bits(field(e, at));
          window.at(i, j, k)[4 + e] = as_bits(1.0);
        }
        window.at(i, j, k)[3] = as_bits(field(2, at));
      }
  GridAtParticles read;
  read_window(kind.basis, scene.grid, scene.x(), scene.shape(kind.widths), 0, scene.count, false,
              window, read);
  for (int p = 0; p < scene.count; ++p) {
    const Vec3 at{scene.columns[0][p], scene.columns[1][p], scene.columns[2][p]};
    for (int e = 0; e < 3; ++e) {
      EXPECT_NEAR(read.u[e][p], field(e, at), round_off * 10) << p;
      EXPECT_NEAR(read.dv[e][p], 1, round_off) << p;
      for (int d = 0; d < 3; ++d)
        EXPECT_NEAR(read.L[3 * e + d][p], d < directions ? slope[e][d] : 0.0, 1e-11) << p;
    }
  }
  GridAtParticles beside;
  read_velocities(kind.basis, scene.grid, scene.x(), scene.shape(kind.widths), 0, scene.count,
                  window, beside);
  for (int p = 0; p < scene.count; ++p) {
    EXPECT_EQ(beside.u[2][p], read.u[2][p]);
    EXPECT_EQ(beside.fourth[p], read.u[2][p]);
  }
  read_motion(kind.basis, scene.grid, scene.x(), scene.shape(kind.widths), 0, scene.count, window,
              beside);
  for (int p = 0; p < scene.count; ++p)
    for (int e = 0; e < 3; ++e) {
      EXPECT_EQ(beside.u[e][p], read.u[e][p]);
      EXPECT_EQ(beside.dv[e][p], read.dv[e][p]);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, EveryShape,
    testing::Combine(testing::Values(1, 2, 3),
                     testing::Values(Kind{"linear", Basis::linear, false, 1e300},
                                     Kind{"gimp", Basis::gimp, false, 1e300},
                                     Kind{"gimp_own", Basis::gimp, true, 1e300},
                                     Kind{"cpgimp", Basis::cpgimp, true, 1e300},
                                     Kind{"quadratic", Basis::quadratic, false, 1e300},
                                     Kind{"cubic", Basis::cubic, false, 1e300},
                                     Kind{"cpdi", Basis::cpdi, false, 1e300},
                                     Kind{"cpdi_cut", Basis::cpdi, false, 0.2},
                                     Kind{"cpti", Basis::cpti, false, 1e300})),
    [](const auto& of) {
      return std::string(std::get<1>(of.param).name) + "_" + std::to_string(std::get<0>(of.param));
    });

// What particles give to nodes adds up to what they have: mass, momentum, no force; and the force
// does the work of the stress, sum_i f_i . v_i = -V sigma : grad v for a linear velocity.
TEST_P(EveryShape, GivesAddUp) {
  const auto [directions, kind] = GetParam();
  if (kind.basis == Basis::cpti && directions != 3) return;
  Scene scene(directions);
  scene.grid.corner_limit = kind.limit;
  const BlockShape shape = block_shape(scene.level.active);
  Window window(shape, 1);
  IntVec3 high{0, 0, 0};
  for (int d = 0; d < directions; ++d) high[d] = 9;
  window.begin({0, 0, 0}, high);
  const std::vector<double> mass(40, 2.0), volume(40, 0.5), v(40, 0.25), one(40, 1.0),
      shear(40, 0.5);
  ParticlesToGrid p;
  p.x = scene.x();
  p.shape = scene.shape(kind.widths);
  p.mass = mass.data();
  p.volume = volume.data();
  p.v = {v.data(), v.data(), v.data()};
  p.stress = {one.data(), one.data(), one.data(), shear.data(), shear.data(), shear.data()};
  SumUnits units;
  units.mass = units.momentum = 0x1p40;
  units.force = 0x1p30;
  add_to_window(kind.basis, scene.grid, p, 0, scene.count, units, window);
  double m = 0, momentum = 0, force = 0, work = 0;
  for (int k = 0; k <= high.z; ++k)
    for (int j = 0; j <= high.y; ++j)
      for (int i = 0; i <= high.x; ++i) {
        const std::int64_t* node = window.at(i, j, k);
        if (node[count_lane] == 0) continue;
        m += sum_in(node, 0) / units.mass;
        momentum += sum_in(node, 1) / units.momentum;
        force += sum_in(node, 4) / units.force;
        // v = (x + y/2) e_x: sigma : grad v = sigma_xx + sigma_xy/2.
        work +=
            sum_in(node, 4) / units.force *
            (i * scene.level.spacing.x + (directions > 1 ? 0.5 * j * scene.level.spacing.y : 0));
      }
  EXPECT_NEAR(m, 80, 1e-9);
  EXPECT_NEAR(momentum, 20, 1e-9);
  EXPECT_NEAR(force, 0, 1e-4);
  EXPECT_NEAR(work, -20 * (1 + (directions > 1 ? 0.25 : 0)), 1e-4);
}

// Particles go eight at a time, and what is left one by one: each as if it were alone, to the bit.
TEST_P(EveryShape, ParticlesTogetherAreAsAlone) {
  const auto [directions, kind] = GetParam();
  if (kind.basis == Basis::cpti && directions != 3) return;
  Scene scene(directions);
  scene.grid.corner_limit = kind.limit;
  const int count = 37;
  const BlockShape shape = block_shape(scene.level.active);
  Window together(shape, 1), alone(shape, 1), nodes(shape, 1);
  IntVec3 high{0, 0, 0};
  for (int d = 0; d < directions; ++d) high[d] = 9;
  for (Window* w : {&together, &alone, &nodes}) w->begin({0, 0, 0}, high);
  ParticlesToGrid p;
  p.x = scene.x();
  p.shape = scene.shape(kind.widths);
  p.mass = scene.columns[21].data();
  p.volume = scene.columns[22].data();
  for (std::size_t n = 0; n < 9; ++n) {
    if (n < 3) p.v[n] = p.load[n] = scene.columns[4 + n].data();
    if (n < 6) p.stress[n] = scene.columns[14 + n].data();
    p.affine[n] = scene.columns[3 + n].data();
  }
  SumUnits units;
  units.mass = units.momentum = units.force = 0x1p40;
  units.reference = {0.1, 0.2, 0.3};
  add_to_window(kind.basis, scene.grid, p, 0, count, units, together);
  for (int q = 0; q < count; ++q) add_to_window(kind.basis, scene.grid, p, q, q + 1, units, alone);
  int given = 0;
  for (int k = 0; k <= high.z; ++k)
    for (int j = 0; j <= high.y; ++j)
      for (int i = 0; i <= high.x; ++i)
        for (int l = 0; l < lanes; ++l) {
          given += together.at(i, j, k)[l] != 0 ? 1 : 0;
          EXPECT_EQ(together.at(i, j, k)[l], alone.at(i, j, k)[l]);
          nodes.at(i, j, k)[l] = as_bits(std::sin(i + 3.0 * j + 7.0 * k + 0.5 * l));
        }
  EXPECT_GE(given, lanes * (1 << directions));
  GridAtParticles all, one;
  read_velocities(kind.basis, scene.grid, scene.x(), scene.shape(kind.widths), 0, count, nodes,
                  all);
  for (int q = 0; q < count; ++q) {
    read_velocities(kind.basis, scene.grid, scene.x(), scene.shape(kind.widths), q, 1, nodes, one);
    EXPECT_EQ(all.fourth[q], one.fourth[0]);
    for (std::size_t e = 0; e < 9; ++e) EXPECT_EQ(all.L[e][q], one.L[e][0]);
    for (std::size_t e = 0; e < 3; ++e) EXPECT_EQ(all.u[e][q], one.u[e][0]);
  }
}

// A square particle turned by 45 degrees: its corners lie on the axes.
TEST(Corners, AreWhereEdgesEnd) {
  Scene scene(2);
  scene.level.spacing = {0.2, 0.2, 0.2};
  for (int d = 0; d < 3; ++d) scene.grid.axes[d] = axis_of(scene.level, d);
  const double c = std::sqrt(0.5);
  const double F[9] = {c, -c, 0, c, c, 0, 0, 0, 1};
  for (std::size_t e = 0; e < 9; ++e) {
    scene.columns[3 + e][0] = F[e];
    scene.columns[12 + e][0] = e % 4 == 0 ? 0.5 : 0.0;
  }
  static Corners<2, false> corners;
  find_corners(scene.grid, scene.x(), scene.shape(false), 0, 1, Slopes::wanted, corners);
  const double far = 0.25 * std::sqrt(2.0);
  const double wanted[4][2] = {{0, -far}, {far, 0}, {-far, 0}, {0, far}};
  for (int k = 0; k < 4; ++k)
    for (int a = 0; a < 2; ++a) EXPECT_NEAR(corners.way[k][a][0], wanted[k][a], 1e-15);
  const CornerReach reach = corner_reach(Basis::cpdi, scene.grid, scene.shape(false), 0, 1);
  EXPECT_NEAR(reach.extent, far, 1e-15);
}

}  // namespace
}  // namespace sluice::mpm::shapes
