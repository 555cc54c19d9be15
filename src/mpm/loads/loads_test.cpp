// Loads against sums in closed form, manufactured body forces against differences of the stress.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "framework/base/error.hpp"
#include "framework/base/temporary_folder.hpp"
#include "framework/geometry/box.hpp"
#include "framework/geometry/round.hpp"
#include "mpm/loads/corner_loads.hpp"
#include "mpm/loads/insertions.hpp"
#include "mpm/loads/load_curve.hpp"
#include "mpm/loads/load_curves.hpp"
#include "mpm/loads/manufactured.hpp"
#include "mpm/loads/prescribed_motion.hpp"

namespace sluice::mpm::loads_test {
namespace {

using Column = std::vector<double>;

LoadCurve curve_on(const char* shape, PiecePtr piece, double load) {
  LoadCurve c;
  c.shape = shape;
  c.piece = std::move(piece);
  c.points = {{0, 0}, {1, load}};
  return c;
}

// Particles in a lattice of width h that lie in a piece, at rest, with the loads on them.
struct Marked {
  std::array<Column, 3> x, marks, force;
  Column one, zero, heat;
  std::vector<double> counts;

  Marked(const MpmScene& solids, const GeometryPiece& body, double h, int n, double time) {
    const LoadCurves loads(solids);
    counts.resize(loads.count());
    for (int k = -n; k < n; ++k)
      for (int j = -n; j < n; ++j)
        for (int i = -n; i < n; ++i) {
          const Vec3 at{(i + 0.5) * h, (j + 0.5) * h, (k + 0.5) * h};
          if (!body.inside(at)) continue;
          bool surface = false;
          for (int d = 0; d < 3; ++d)
            for (const double s : {-h, h}) {
              Vec3 beside = at;
              beside[d] += s;
              surface |= !body.inside(beside);
            }
          const auto found = loads.marks_of(0, at, {h, h, h}, surface, {});
          for (std::size_t d = 0; d < 3; ++d) {
            x[d].push_back(at[static_cast<int>(d)]);
            marks[d].push_back(found[d]);
            if (found[d] != 0) counts[found[d] - 1] += 1;
          }
        }
    one.assign(x[0].size(), 1);
    zero.assign(x[0].size(), 0);
    heat = zero;
    for (Column& f : force) f = zero;
    LoadedParticles p;
    p.end = x[0].size();
    for (std::size_t d = 0; d < 3; ++d) {
      p.x[d] = x[d].data();
      p.marks[d] = marks[d].data();
    }
    for (std::size_t e = 0; e < 9; ++e) p.F[e] = e % 4 == 0 ? one.data() : zero.data();
    p.width = {h, h, h};
    loads.add_forces(time, counts, p, {force[0].data(), force[1].data(), force[2].data()});
    loads.add_heat(time, counts, p, heat.data());
  }
  double sum(int d) const {
    double s = 0;
    for (const double f : force[d]) s += f;
    return s;
  }
};

MpmScene one_material(LoadCurve curve) {
  MpmScene s;
  s.materials.resize(1);
  s.loads.push_back(std::move(curve));
  return s;
}

TEST(LoadCurve, IsStraightBetweenPointsAndConstantAfterThem) {
  const std::vector<std::pair<double, double>> p = {{1, 2}, {3, 6}, {4, 5}};
  EXPECT_EQ(load_at(p, 2), 4);
  EXPECT_EQ(load_at(p, 3.5), 5.5);
  EXPECT_EQ(load_at(p, 9), 5);
  EXPECT_EQ(load_at(p, 0), 0);  // the first piece goes on backwards
  EXPECT_EQ(load_at({{1, 7}}, 0), 7);
  EXPECT_EQ(load_at({}, 0), 0);
}

// A block 0.8 x 0.6 x 0.4 (in lattice lines) under pressure on its upper x face.
TEST(Loads, ForcesOfAPressureAddUpToPressureTimesArea) {
  const BoxPiece body({-0.4, -0.3, -0.2}, {0.4, 0.3, 0.2});
  const MpmScene s = one_material(curve_on(
      "box", std::make_shared<BoxPiece>(Vec3{0.399, -0.3, -0.2}, Vec3{0.401, 0.3, 0.2}), -5.0));
  const Marked m(s, body, 0.1, 6, 1.0);
  EXPECT_EQ(m.counts[0], 6 * 4);
  EXPECT_NEAR(m.sum(0), -5.0 * 0.6 * 0.4, 1e-14);
  EXPECT_EQ(m.sum(1), 0);
  EXPECT_EQ(m.sum(2), 0);
}

// A plane of one layer of cells, thinner than the box of the load: the face across y is loaded, and
// its area is that of a strip as wide as the layer.
TEST(Loads, ActAcrossADirectionThatMoves) {
  MpmScene s = one_material(
      curve_on("box", std::make_shared<BoxPiece>(Vec3{0, 0.499, 0}, Vec3{1, 0.501, 5e-4}), -1e3));
  s.moves_along = {true, true, false};
  const LoadSurface surface(s.loads.front(), false, s.moves_along);
  EXPECT_EQ(surface.direction({}).y, 1);
  EXPECT_DOUBLE_EQ(surface.area(), 5e-4);
  EXPECT_TRUE(surface.holds({0.4, 0.4875, 2.5e-4}, {0.025, 0.025, 5e-4}));
  EXPECT_FALSE(surface.holds({0.4, 0.4625, 2.5e-4}, {0.025, 0.025, 5e-4}));
  EXPECT_FALSE(surface.is_bulky());
  s.loads.front().piece = std::make_shared<BoxPiece>(Vec3{0, 0, 0}, Vec3{1, 0.7, 5e-4});
  EXPECT_TRUE(LoadSurface(s.loads.front(), false, s.moves_along).is_bulky());
}

TEST(Loads, HeatThroughABoxAddsUpToFluxTimesArea) {
  const BoxPiece body({-0.4, -0.3, -0.2}, {0.4, 0.3, 0.2});
  LoadCurve c = curve_on(
      "box", std::make_shared<BoxPiece>(Vec3{0.399, -0.3, -0.2}, Vec3{0.401, 0.3, 0.2}), 8.0);
  c.kind = LoadCurve::Kind::heat_flux;
  const Marked m(one_material(c), body, 0.1, 6, 0.5);
  double sum = 0;
  for (const double q : m.heat) sum += q;
  EXPECT_NEAR(sum, 4.0 * 0.6 * 0.4, 1e-14);
  EXPECT_EQ(m.sum(0), 0);
}

// On a sphere all directions cancel; the radial parts add up to p A.
TEST(Loads, PressureOnASphereActsOutward) {
  const SpherePiece body({0, 0, 0}, 0.5);
  const MpmScene s =
      one_material(curve_on("sphere", std::make_shared<SpherePiece>(Vec3{0, 0, 0}, 0.5), 3.0));
  const Marked m(s, body, 0.1, 6, 1.0);
  double outward = 0;
  for (std::size_t i = 0; i < m.one.size(); ++i) {
    const Vec3 x{m.x[0][i], m.x[1][i], m.x[2][i]};
    for (int d = 0; d < 3; ++d) outward += m.force[d][i] * x[d] / std::sqrt(dot(x, x));
  }
  EXPECT_NEAR(outward, 3.0 * 4 * std::numbers::pi * 0.25, 1e-12);
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(m.sum(d), 0, 1e-13);
}

// sum r x f = -T a: the format's torque turns against the axis from bottom to top.
TEST(Loads, TorquesAddUp) {
  const auto body = make_cylinder({0, 0, -0.4}, {0, 0, 0.4}, 0.45);
  LoadCurve c = curve_on("cylinder", body, 2.0);
  c.kind = LoadCurve::Kind::torque;
  const Marked m(one_material(c), *body, 0.1, 6, 1.0);
  EXPECT_GT(m.counts[0], 0);
  double about_z = 0;
  for (std::size_t i = 0; i < m.one.size(); ++i)
    about_z += m.x[0][i] * m.force[1][i] - m.x[1][i] * m.force[0][i];
  EXPECT_NEAR(about_z, -2.0, 1e-13);
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(m.sum(d), 0, 1e-13);
}

TEST(Loads, TheEndOfACylinderIsItsDisk) {
  const auto body = make_cylinder({0, 0, -0.4}, {0, 0, 0.4}, 0.45);
  LoadCurve c = curve_on("cylinder", make_cylinder({0, 0, 0.399}, {0, 0, 0.401}, 0.45), -1.0);
  c.ends = true;
  const Marked m(one_material(c), *body, 0.1, 6, 1.0);
  EXPECT_NEAR(m.sum(2), -std::numbers::pi * 0.45 * 0.45, 1e-13);
  EXPECT_EQ(m.sum(0), 0);
}

TEST(Loads, AForceIsSharedByTheParticlesOfItsBox) {
  const BoxPiece body({-0.4, -0.3, -0.2}, {0.4, 0.3, 0.2});
  LoadCurve c = curve_on("box", std::make_shared<BoxPiece>(Vec3{0, -1, -1}, Vec3{1, 1, 1}), 1.0);
  c.kind = LoadCurve::Kind::force;
  c.force = {1, -2, 3};
  c.points = {{0, 1}};
  const Marked m(one_material(c), body, 0.1, 6, 1.0);
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(m.sum(d), c.force[d], 1e-14);
}

TEST(Loads, TheRotationOfAStretchedRotationIsTheRotation) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  // R U, R about z, U = [[2, .3, 0], [.3, .5, 0], [0, 0, 1.5]].
  const std::array<double, 9> F = {
      c * 2 - s * 0.3, c * 0.3 - s * 0.5, 0, s * 2 + c * 0.3, s * 0.3 + c * 0.5, 0, 0, 0, 1.5};
  const std::array<double, 9> R = rotation_of(F), exact = {c, -s, 0, s, c, 0, 0, 0, 1};
  for (std::size_t e = 0; e < 9; ++e) EXPECT_NEAR(R[e], exact[e], 1e-14);
}

// rho_0 b = rho_0 a - Div P with central differences of the motion: P = lambda ln J F^-T + G (F -
// F^-T). Differences of differences of width 1e-4 leave 1e-6 or so of the terms.
class ManufacturedForce : public testing::TestWithParam<const char*> {};

std::array<double, 9> gradient(const Manufactured& motion, Vec3 X, double t, double h) {
  std::array<double, 9> F{1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (int k = 0; k < 3; ++k) {
    Vec3 a = X, b = X;
    a[k] -= h;
    b[k] += h;
    const Vec3 d = motion.displacement(b, t) - motion.displacement(a, t);
    for (int i = 0; i < 3; ++i) F[3 * i + k] += d[i] / (2 * h);
  }
  return F;
}

std::array<double, 9> first_stress(const std::array<double, 9>& F, double lambda, double G) {
  const Vec3 a{F[0], F[1], F[2]}, b{F[3], F[4], F[5]}, c{F[6], F[7], F[8]};
  const Vec3 bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  const double J = dot(a, bc);
  const std::array<double, 9> inverse = {bc.x, bc.y, bc.z, ca.x, ca.y, ca.z, ab.x, ab.y, ab.z};
  std::array<double, 9> P{};
  for (std::size_t e = 0; e < 9; ++e)
    P[e] = lambda * std::log(J) * inverse[e] / J + G * (F[e] - inverse[e] / J);
  return P;
}

TEST_P(ManufacturedForce, BalancesStressAndInertia) {
  const double lambda = 577, G = 385, rho = 1000, h = 1e-4;
  const auto motion = manufactured(GetParam(), {rho, lambda, G, 0, {1, 1, 1}});
  const bool ring = std::string(GetParam()) == "ExpandingRing";
  const double scale = ring ? 0.5 : std::string(GetParam()) == "GeneralizedVortex" ? 1.0 : 0.3;
  for (const double t : {0.13, 0.31})
    for (const double angle : {0.4, 2.1, 4.0}) {
      const double R = scale * (1 + 0.07 * angle / 4);
      const Vec3 X{R * std::cos(angle), R * std::sin(angle), 0.2};
      const Vec3 b = motion->body_force(X, t);
      const Vec3 now = motion->displacement(X, t);
      const Vec3 bend = motion->displacement(X, t + h) + motion->displacement(X, t - h) - 2.0 * now;
      Vec3 force{};
      for (int k = 0; k < 3; ++k) {
        Vec3 low = X, high = X;
        low[k] -= h;
        high[k] += h;
        const auto p = first_stress(gradient(*motion, high, t, h), lambda, G);
        const auto q = first_stress(gradient(*motion, low, t, h), lambda, G);
        for (int i = 0; i < 3; ++i) force[i] += (p[3 * i + k] - q[3 * i + k]) / (2 * h);
      }
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(b[i], bend[i] / (h * h) - force[i] / rho, 2e-4 * (1 + std::sqrt(dot(b, b))));
      const Vec3 v =
          (1 / (2 * h)) * (motion->displacement(X, t + h) - motion->displacement(X, t - h));
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(motion->velocity(X, t)[i], v[i], 1e-5);
    }
}
INSTANTIATE_TEST_SUITE_P(Every, ManufacturedForce,
                         testing::Values("AxisAligned", "ExpandingRing", "GeneralizedVortex"));

TEST(Manufactured, StartsInItsReferenceShape) {
  for (const char* name : {"AxisAligned", "ExpandingRing", "GeneralizedVortex"}) {
    const auto motion = manufactured(name, {1000, 577, 385, 0, {1, 1, 1}});
    const Vec3 u = motion->displacement({0.5, 0.1, 0.3}, 0);
    EXPECT_EQ(dot(u, u), 0) << name;
  }
  // No radial strain at the edges of the ring; its outer edge moves by the amplitude 0.1.
  const auto ring = manufactured("ExpandingRing", {1000, 0, 5e6, 0, {1, 1, 1}});
  const double t = 0.005, h = 1e-5;  // a quarter of the period 2/c, c = 100 m/s
  for (const double R : {0.4, 0.6})
    EXPECT_NEAR(ring->displacement({R + h, 0, 0}, t).x, ring->displacement({R - h, 0, 0}, t).x,
                1e-13);
  EXPECT_NEAR(ring->displacement({0, 0.6, 0}, t).y, 0.1, 1e-15);
  EXPECT_THROW(manufactured("Vortex", {}), std::invalid_argument);
}

// A quarter turn about z on top of a stretch of x to 2: (1, 0, 0) goes to (0, 2, 0) by steps of any
// length.
TEST(Insertions, MayNameAMaterial) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& rows) {
    const std::string file = (folder / "i.txt").string();
    std::ofstream(file) << rows;
    return read_insertions(file, 2);
  };
  const Insertion any = read("0.5 7  1 2 3  4 5 6\n").at(0);
  EXPECT_EQ(any.material, -1);
  EXPECT_EQ(any.colour, 7);
  EXPECT_EQ(any.velocity, (Vec3{4, 5, 6}));
  const Insertion one = read("0.5 1 7  1 2 3  4 5 6\n").at(0);
  EXPECT_EQ(one.material, 1);
  EXPECT_EQ(one.colour, 7);
  EXPECT_EQ(one.way, (Vec3{1, 2, 3}));
  EXPECT_EQ(one.velocity, (Vec3{4, 5, 6}));
  EXPECT_THROW(read("0.5 2 7  1 2 3  4 5 6\n"), InputError);
  EXPECT_THROW(read("0.5 1 7  1 2 3  4 5 6\n0.6 7  1 2 3  4 5 6\n"), InputError);
}

TEST(PrescribedMotion, FilesAreReadToTheEndOfEachRow) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& rows) -> std::string {
    const std::string file = (folder / "m.inp").string();
    std::ofstream(file) << "0 1 0 0 0 1 0 0 0 1 0 0 0 1\n" << rows;
    try {
      PrescribedMotion::read(file);
    } catch (const InputError& e) {
      return std::string(e.what()).substr(folder.path().string().size() + 1);
    }
    return "read";
  };
  const std::string F = " 1 0 0 0 1 0 0 0 1 ";
  EXPECT_EQ(refusal("1d0" + F + "90 0 0 1\n"), "read");
  EXPECT_EQ(refusal("1" + F + "90 0 0\n").substr(0, 41),
            "m.inp:2:27: number 14 of 14 (axis z) is m");
  EXPECT_EQ(refusal("0" + F + "0 0 0 1\n"), "m.inp:2:1: time 0 is not after the one before, 0");
  EXPECT_EQ(refusal("1" + F + "90 0 0 0\n"),
            "m.inp:2:24: the axis of this rotation is a zero vector");
}

TEST(PrescribedMotion, StepsMeetTheRowsExactly) {
  const PrescribedMotion motion({{0, {1, 0, 0, 0, 1, 0, 0, 0, 1}, 0, {0, 0, 1}},
                                 {1, {2, 0, 0, 0, 1, 0, 0, 0, 1}, 0, {0, 0, 1}},
                                 {2, {2, 0, 0, 0, 1, 0, 0, 0, 1}, 90, {0, 0, 1}}});
  std::array<double, 3> x = {1, 0.5, 0.25};
  const double steps[] = {0.3, 0.5, 0.4, 0.7, 0.1, 0.5};
  double t = 0;
  for (const double dt : steps) {
    const Matrix3 G = motion.rate(t, dt);
    const std::array<double, 3> from = x;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) x[i] += dt * G[3 * i + k] * from[k];
    t += dt;
  }
  EXPECT_NEAR(x[0], -0.5, 1e-14);
  EXPECT_NEAR(x[1], 2, 1e-14);
  EXPECT_NEAR(x[2], 0.25, 1e-14);
  EXPECT_THROW(PrescribedMotion({{0, {}, 0, {}}}), std::invalid_argument);
}

// The face that looks along -x of a particle stretched to twice its width along y.
TEST(CornerLoads, ActOnTheFaceThatLooksOutwardAndGrowWithIt) {
  const std::array<Vec3, 3> rest = {Vec3{0.2, 0, 0}, Vec3{0, 0.1, 0}, Vec3{0, 0, 0.1}};
  const std::array<Vec3, 3> now = {Vec3{0.2, 0, 0}, Vec3{0, 0.2, 0}, Vec3{0, 0, 0.1}};
  Vec3 sum{}, middle{};
  for (const CornerForce& c : corner_forces({1, 1, 1}, {3, 0, 0}, {-1, 0, 0}, now, rest)) {
    sum += c.force;
    middle += 0.25 * c.place;
    EXPECT_DOUBLE_EQ(c.place.x, 0.9);
  }
  EXPECT_DOUBLE_EQ(sum.x, 6);
  EXPECT_DOUBLE_EQ(middle.y, 1);
}

}  // namespace
}  // namespace sluice::mpm::loads_test
