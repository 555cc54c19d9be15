// The matrix of the nodes against differences of their forces; second differences; positive
// tangents.
#include "mpm/implicit/stiffness.hpp"

#include <gtest/gtest.h>

#include "mpm/implicit/second_differences.hpp"
#include "mpm/test_support/implicit_parts.hpp"

namespace sluice::mpm::stiffness_test {
namespace {

// Displacements without a pattern, of the size of a part of a cell.
double way_of(std::size_t node, int d, double size) {
  return size * std::sin(12.9898 * static_cast<double>(node) + 78.233 * d);
}

// sum T G by node, as the definition has it.
std::vector<double> forces_of(const StartOfStep& start, ParticleStresses& particles,
                              const Stiffness& stiffness) {
  std::string reason;
  EXPECT_TRUE(particles.evaluate(start.nodes, reason)) << reason;
  const auto w = static_cast<std::size_t>(stiffness.width());
  std::vector<double> forces(stiffness.rows().unknowns());
  const Stencils& s = start.parts.reached->of(0);
  for (std::size_t e = 0; e < s.node.size(); ++e)
    for (std::size_t c = 0; c < w; ++c) {
      const int d = stiffness.axis(static_cast<int>(c));
      const double* T = particles.stress(0).data() + 9 * (e / static_cast<std::size_t>(s.per));
      for (std::size_t k = 0; k < 3; ++k)
        forces[w * static_cast<std::size_t>(s.node[e]) + c] +=
            s.sign(e, d) * T[3 * static_cast<std::size_t>(d) + k] * s.slope[e][k];
    }
  return forces;
}

struct Case {
  int dimensions;
  const char* basis;
  bool periodic = false;  // along x, across which the block then reaches
};

class Matrix : public testing::TestWithParam<Case> {};

// K du is the change of the forces, in a deformed state; the symmetric matrix is the same one.
TEST_P(Matrix, IsTheDerivativeOfTheForces) {
  const Case& c = GetParam();
  constexpr double strained = 0.004, nudge = 1e-6;
  SolidDeck deck =
      block_of(c.dimensions,
               fmt::format("<dynamic>false</dynamic><interpolator>{}</interpolator>", c.basis));
  if (c.periodic) {
    deck.level = "<periodic>[1,0,0]</periodic>";
    deck.faces = free_face("y-") + free_face("y+") + held("z-") + held("z+");
  }
  look_at_start(deck, "matrix", [&](const StartOfStep& start) {
    const solve::Workers workers = workers_of(start.team);
    NodePairs pairs(start.parts, {false, true}, workers);
    Stiffness stiffness(start.parts, pairs, workers);
    ParticleStresses particles(start.parts, start.team, 0);
    const auto w = static_cast<std::size_t>(stiffness.width());
    const auto displace = [&](double along) {
      for (std::size_t n = 0; n < start.nodes.count(); ++n)
        for (std::size_t a = 0; a < w; ++a)
          start.nodes.u[n][stiffness.axis(static_cast<int>(a))] =
              way_of(n, static_cast<int>(a), strained) +
              along * way_of(7 * n + 3, static_cast<int>(a), 1);
    };
    displace(nudge);
    const std::vector<double> more = forces_of(start, particles, stiffness);
    displace(-nudge);
    const std::vector<double> less = forces_of(start, particles, stiffness);
    displace(0);
    std::string reason;
    ASSERT_TRUE(particles.evaluate_tangents(start.nodes, reason));
    EXPECT_LT(particles.asymmetry(), 1e-7);
    std::vector<double> x(more.size()), y(more.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = way_of(7 * (i / w) + 3, static_cast<int>(i % w), 1);
    for (const bool symmetric : {false, true}) {
      stiffness.assemble(particles, symmetric);
      solve::multiply(stiffness.rows(), workers, x, y);
      double most = 0, error = 0;
      for (std::size_t i = 0; i < y.size(); ++i) {
        most = std::max(most, std::fabs(y[i]));
        error = std::max(error, std::fabs(y[i] - (more[i] - less[i]) / (2 * nudge)));
      }
      EXPECT_LT(error, 1e-6 * most) << symmetric;
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Stiffness, Matrix,
                         testing::Values(Case{1, "linear"}, Case{1, "gimp"}, Case{2, "linear"},
                                         Case{2, "gimp"}, Case{3, "gimp"}, Case{2, "3rdorderBS"},
                                         Case{2, "gimp", true}));

// Rigid rotation with uniform strain meets no force; a parabola meets that of its second
// difference.
TEST(SecondDifferences, ActOnWhatIsNotLinear) {
  for (const int dimensions : {1, 2, 3})
    look_at_start(
        block_of(dimensions, "<dynamic>false</dynamic>"), "second", [&](const StartOfStep& start) {
          const solve::Workers workers = workers_of(start.team);
          NodePairs pairs(start.parts, {false, true}, workers);
          ParticleStresses particles(start.parts, start.team, 0);
          std::string reason;
          for (Vec3& u : start.nodes.u) u = {};
          ASSERT_TRUE(particles.evaluate(start.nodes, reason));
          ASSERT_TRUE(SecondDifferences::needed(start.parts, start.nodes, particles));
          const SecondDifferences second(start.parts, start.nodes, particles, pairs);
          Stiffness stiffness(start.parts, pairs, workers);
          second.add_stiffness(stiffness);
          const auto forces_in = [&](const std::function<Vec3(Vec3)>& field) {
            for (std::size_t n = 0; n < start.nodes.count(); ++n)
              start.nodes.u[n] = field(0.1 * to_real(start.parts.reached->index(n)));
            std::vector<Vec3> forces(start.nodes.count());
            second.add_forces(start.nodes, forces);
            return forces;
          };
          constexpr double modulus = 1e6 + 4.0 / 3 * 5e5, h = 0.1;
          for (const Vec3 f : forces_in([](Vec3 x) {
                 return Vec3{0.3 * x.x - 0.5 * x.y, 0.4 * x.x + 0.1 * x.z, -0.2 * x.x - x.z};
               }))
            for (int d = 0; d < 3; ++d) EXPECT_NEAR(f[d], 0, 1e-12 * modulus * h * h);
          // Nodes 0 to 3 along x: the first feels one triple, -g E h c_0 (c . u), c . u = 2 h^2.
          const std::vector<Vec3> f = forces_in([](Vec3 x) { return Vec3{x.x * x.x, 0, 0}; });
          const auto first = static_cast<std::size_t>(start.parts.reached->find({0, 0, 0}));
          EXPECT_NEAR(f[first].x / (-1e-4 * modulus * h * 2 * h * h), 1, 1e-6);
          // Its matrix says the same.
          const auto w = static_cast<std::size_t>(stiffness.width());
          std::vector<double> u(stiffness.rows().unknowns()), y(u.size());
          for (std::size_t n = 0; n < start.nodes.count(); ++n) u[w * n] = start.nodes.u[n].x;
          solve::multiply(stiffness.rows(), workers, u, y);
          for (std::size_t n = 0; n < start.nodes.count(); ++n)
            EXPECT_NEAR(y[w * n], -f[n].x, 1e-12 * modulus);
        });
}

// Compressed so far that some modes have no stiffness left: what remains has no negative
// eigenvalue, and a tangent that has none is left as it is.
TEST(ParticleStresses, TangentsBecomePositive) {
  look_at_start(block_of(3, "<dynamic>false</dynamic>"), "positive", [&](const StartOfStep& start) {
    ParticleStresses particles(start.parts, start.team, 0);
    // Is A + shift I positive definite: Cholesky's factors exist.
    const auto positive = [&](double shift) {
      double A[9][9];
      for (int i = 0; i < 9; ++i)
        for (int j = 0; j < 9; ++j)
          A[i][j] = 0.5 * (particles.tangent(0)[static_cast<std::size_t>(9 * i + j)] +
                           particles.tangent(0)[static_cast<std::size_t>(9 * j + i)]) +
                    (i == j ? shift : 0);
      for (int k = 0; k < 9; ++k) {
        if (!(A[k][k] > 0)) return false;
        for (int i = k + 1; i < 9; ++i)
          for (int j = k + 1; j < 9; ++j) A[i][j] -= A[i][k] * A[k][j] / A[k][k];
      }
      return true;
    };
    std::string reason;
    for (std::size_t n = 0; n < start.nodes.count(); ++n)
      start.nodes.u[n] = {-0.03 * start.parts.reached->index(n).x, 0, 0};
    ASSERT_TRUE(particles.evaluate_tangents(start.nodes, reason)) << reason;
    const double most = particles.stiffest(0)[0];
    EXPECT_FALSE(positive(1e-3 * most));
    particles.make_positive();
    EXPECT_TRUE(positive(1e-12 * most));
    const std::vector<double> once = particles.tangent(0);
    particles.make_positive();
    for (std::size_t e = 0; e < 81; ++e)
      EXPECT_NEAR(particles.tangent(0)[e], once[e], 1e-12 * most);
  });
}

}  // namespace
}  // namespace sluice::mpm::stiffness_test
