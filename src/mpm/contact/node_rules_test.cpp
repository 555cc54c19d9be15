// Rules of contact at one node: momentum, energy, friction, extreme masses, mirror images, gaps.
#include "mpm/contact/node_rules.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sluice::mpm::node_rules_test {
namespace {

const SurfaceTable& table() {
  static const SurfaceTable t(0.25);
  return t;
}

// A body below (side -1) or above the node along a normal, its surface on the node.
AtNode body(double mass, Vec3 v, Vec3 out) {
  AtNode b;
  b.mass = mass;
  b.before = b.v = v;
  b.volume = 0.5;
  b.gradient = out;
  const double size = std::sqrt(dot(out, out));
  b.place = (-0.3 / size) * out;
  return b;
}

std::vector<ContactBody> parties_of(std::vector<AtNode>& bodies) {
  std::vector<ContactBody> p;
  for (AtNode& b : bodies) p.push_back({&b, b.rigid, true, &table()});
  return p;
}

Vec3 momentum(const std::vector<AtNode>& bodies) {
  Vec3 sum{};
  for (const AtNode& b : bodies) sum += b.mass * b.v;
  return sum;
}

double energy(const std::vector<AtNode>& bodies) {
  double sum = 0;
  for (const AtNode& b : bodies) sum += 0.5 * b.mass * dot(b.v, b.v);
  return sum;
}

std::vector<AtNode> some_bodies(std::mt19937& random, std::size_t count) {
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<AtNode> bodies;
  for (std::size_t n = 0; n < count; ++n)
    bodies.push_back(body(std::pow(10, 3 * u(random)), {u(random), u(random), u(random)},
                          {u(random), u(random), u(random)}));
  return bodies;
}

TEST(ContactRules, KeepMomentumAndNeverMakeEnergyForTwoToFiveBodies) {
  std::mt19937 random(7);
  int acted = 0;
  for (int run = 0; run < 4000; ++run) {
    std::vector<AtNode> bodies = some_bodies(random, 2 + run % 4);
    const std::vector<AtNode> before = bodies;
    std::vector<ContactBody> parties = parties_of(bodies);
    if (run % 5 == 0)
      stick(parties);
    else
      slide(parties, {0.3 * (run % 3), run % 7 != 0, {1, 1, 1}});
    double size = 0;
    for (const AtNode& b : before) size += b.mass * std::sqrt(dot(b.v, b.v));
    const Vec3 drift = momentum(bodies) - momentum(before);
    for (int d = 0; d < 3; ++d) EXPECT_LE(std::fabs(drift[d]), 1e-15 * 4 * size);
    EXPECT_LE(energy(bodies), energy(before) * (1 + 1e-14));
    acted += energy(bodies) < energy(before);
  }
  EXPECT_GT(acted, 2000);
}

TEST(ContactRules, ImpactAlongTheNormalLeavesOneNormalVelocity) {
  std::vector<AtNode> bodies = {body(2, {1, 0.5, 0}, {3, 0, 0}), body(1, {-2, 0.5, 0}, {-2, 0, 0})};
  std::vector<ContactBody> parties = parties_of(bodies);
  slide(parties, {0.5, true, {1, 1, 1}});
  EXPECT_NEAR(bodies[0].v.x, 0, 1e-15);
  EXPECT_NEAR(bodies[1].v.x, 0, 1e-15);
  EXPECT_EQ(bodies[0].v.y, 0.5);
}

TEST(ContactRules, FrictionIsMuTimesTheNormalImpulseUntilBodiesStick) {
  for (const double mu : {0.0, 0.1, 0.3, 10.0}) {
    AtNode floor = body(1, {}, {0, 0, 1});
    floor.rigid = true;
    std::vector<AtNode> bodies = {floor, body(2, {1, 0, -0.5}, {0, 0, -1})};
    std::vector<ContactBody> parties = parties_of(bodies);
    slide(parties, {mu, true, {1, 1, 1}});
    EXPECT_NEAR(bodies[1].v.z, 0, 1e-15);
    EXPECT_NEAR(bodies[1].v.x, std::max(0.0, 1 - mu * 0.5), 1e-15);
    EXPECT_EQ(bodies[0].v, Vec3{});  // rigid
  }
}

TEST(ContactRules, BodiesThatPartAreLeftAlone) {
  std::vector<AtNode> bodies = {body(2, {-1, 0, 0}, {1, 0, 0}), body(1, {1, 0, 0}, {-1, 0, 0})};
  std::vector<ContactBody> parties = parties_of(bodies);
  slide(parties, {0.5, true, {1, 1, 1}});
  EXPECT_EQ(bodies[0].v, (Vec3{-1, 0, 0}));
  EXPECT_EQ(bodies[1].v, (Vec3{1, 0, 0}));
}

TEST(ContactRules, BodiesWithAGapAreLeftAlone) {
  std::vector<AtNode> bodies = {body(2, {1, 0, 0}, {1, 0, 0}), body(1, {-1, 0, 0}, {-1, 0, 0})};
  bodies[0].place = {-0.9, 0, 0};
  bodies[1].place = {0.9, 0, 0};
  std::vector<ContactBody> parties = parties_of(bodies);
  slide(parties, {0.5, true, {1, 1, 1}});
  EXPECT_EQ(bodies[0].v, (Vec3{1, 0, 0}));
}

TEST(ContactRules, MassesOfTenToTheMinus17GiveNumbers) {
  std::vector<AtNode> bodies = {body(1, {1, 0.2, 0}, {1, 0.1, 0}),
                                body(1e-17, {-1, 0, 0.3}, {-1e-17, 0, 0}),
                                body(3e-9, {-0.5, 0, 0}, {-1e-9, 2e-9, 0})};
  std::vector<ContactBody> parties = parties_of(bodies);
  slide(parties, {0.4, true, {1, 1, 1}});
  for (const AtNode& b : bodies)
    for (int d = 0; d < 3; ++d) EXPECT_TRUE(std::isfinite(b.v[d]));
  EXPECT_NEAR(bodies[0].v.x, 1, 1e-8);
  EXPECT_NEAR(dot(bodies[1].v - bodies[0].v, {1, 0.1, 0}), 0, 1e-7);
  stick(parties);
  EXPECT_EQ(bodies[1].v, bodies[0].v);
}

TEST(ContactRules, MirroredBodiesHaveMirroredBits) {
  std::mt19937 random(11);
  for (int run = 0; run < 300; ++run) {
    std::vector<AtNode> bodies = some_bodies(random, 3), images = bodies;
    for (AtNode& b : images) {
      b.v.x = -b.v.x;
      b.gradient.x = -b.gradient.x;
      b.place.x = -b.place.x;
    }
    std::vector<ContactBody> parties = parties_of(bodies), mirrored = parties_of(images);
    slide(parties, {0.3, true, {1, 2, 1}});
    slide(mirrored, {0.3, true, {1, 2, 1}});
    for (std::size_t n = 0; n < bodies.size(); ++n)
      EXPECT_EQ(images[n].v, (Vec3{-bodies[n].v.x, bodies[n].v.y, bodies[n].v.z}));
  }
}

TEST(ContactRules, EqualVelocitiesStayToTheBit) {
  std::vector<AtNode> bodies = {body(0.1, {0.3, 0.7, 0.1}, {1, 0, 0}),
                                body(0.7, {0.3, 0.7, 0.1}, {-1, 0, 0})};
  std::vector<ContactBody> parties = parties_of(bodies);
  stick(parties);
  slide(parties, {0.3, true, {1, 1, 1}});
  EXPECT_EQ(bodies[0].v, (Vec3{0.3, 0.7, 0.1}));
  EXPECT_EQ(bodies[1].v, (Vec3{0.3, 0.7, 0.1}));
}

// Mean place of particles of a half space above s, two or four a cell, with their weights.
double mean_of_half_space(double s, double l) {
  const double step = 2 * l;
  double sum = 0, moment = 0;
  for (double u = s + l; u < 1 + l; u += step) {
    const double r = std::fabs(u);
    const double w = r < l       ? 1 - (r * r + l * l) / (2 * l)
                     : r < 1 - l ? 1 - r
                                 : (1 + l - r) * (1 + l - r) / (4 * l);
    sum += w;
    moment += w * u;
  }
  return moment / sum;
}

TEST(SurfaceTable, FindsSurfacesOfHalfSpacesFromTheirParticles) {
  double worst[2] = {};
  int n = 0;
  for (const double l : {0.25, 0.125}) {
    const SurfaceTable t(l);
    for (double s = -0.6; s < 0.6; s += 0.01)
      worst[n] = std::max(worst[n], std::fabs(t.surface(mean_of_half_space(s, l)) - s));
    ++n;
  }
  EXPECT_LT(worst[0], 0.15);
  EXPECT_LT(worst[1], 0.05);
}

TEST(SurfaceTable, RisesAndIsBounded) {
  const SurfaceTable t(0.25);
  double last = t.surface(-1);
  EXPECT_EQ(last, -1.25);
  for (double mean = -0.5; mean < 2; mean += 0.01) {
    EXPECT_GE(t.surface(mean), last);
    last = t.surface(mean);
  }
  EXPECT_EQ(last, 1.25);
}

}  // namespace
}  // namespace sluice::mpm::node_rules_test
