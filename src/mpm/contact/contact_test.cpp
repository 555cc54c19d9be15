// Rules of a deck in its order; motions of masters against closed forms.
#include "mpm/contact/contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sluice::mpm::contact_test {
namespace {

ContactRule rule_of(ContactKind kind, std::vector<int> materials = {}) {
  ContactRule r;
  r.kind = kind;
  r.materials = std::move(materials);
  return r;
}

struct Node {
  MpmScene scene;
  Level level;
  ContactNode meeting;

  explicit Node(std::size_t materials) : scene{} {
    scene.materials.resize(materials);
    level.spacing = {1, 1, 1};
    level.active = {true, true, true};
    for (std::size_t m = 0; m < materials; ++m) {
      AtNode b;
      b.body = static_cast<int>(m);
      b.mass = 1.0 + static_cast<double>(m);
      b.before = b.v = {1.0 - static_cast<double>(m), 0.25, -1};
      b.volume = 0.5;
      meeting.bodies.push_back(b);
    }
  }
  void act(Hook hook, double time = 0, double dt = 0.5) {
    for (AtNode& b : meeting.bodies) b.rigid = scene.materials[b.body].rigid;
    meeting.outside = {};
    Contact contact(scene, level);
    contact.begin_step(time, dt);
    contact.act(hook, meeting);
  }
  Vec3 v(int m) const { return meeting.bodies[m].v; }
};

TEST(Contact, ActsOnTheMaterialsOfARuleOnly) {
  Node n(3);
  n.scene.contacts = {rule_of(ContactKind::single_velocity, {0, 1})};
  n.act(Hook::before_forces);
  EXPECT_NEAR(n.v(0).x, 1.0 / 3, 1e-15);
  EXPECT_EQ(n.v(0), n.v(1));
  EXPECT_EQ(n.v(2), (Vec3{-1, 0.25, -1}));
}

TEST(Contact, OneStepActsAfterForcesAlone) {
  Node n(2);
  n.scene.contacts = {rule_of(ContactKind::single_velocity)};
  n.scene.contacts[0].applied_before_and_after_integration = false;
  n.act(Hook::before_forces);
  EXPECT_EQ(n.v(0).x, 1);
  n.act(Hook::after_forces);
  EXPECT_EQ(n.v(0), n.v(1));
}

TEST(Contact, AnExcludedMaterialSwitchesARuleOff) {
  Node n(3);
  n.scene.contacts = {rule_of(ContactKind::single_velocity, {0, 1})};
  n.scene.contacts[0].exclude = 2;
  n.act(Hook::after_forces);
  EXPECT_EQ(n.v(0).x, 1);
  n.meeting.bodies.pop_back();
  n.act(Hook::after_forces);
  EXPECT_EQ(n.v(0), n.v(1));
}

TEST(Contact, AVolumeConstraintAsksForFullCells) {
  Node n(2);
  n.scene.contacts = {rule_of(ContactKind::single_velocity)};
  n.scene.contacts[0].volume_constraint = 1.1;
  n.act(Hook::after_forces);
  EXPECT_EQ(n.v(0).x, 1);
  n.scene.contacts[0].volume_constraint = 0.9;
  n.act(Hook::after_forces);
  EXPECT_EQ(n.v(0), n.v(1));
}

TEST(Contact, OthersTakeTheFlaggedComponentsOfTheMaster) {
  Node n(3);
  n.scene.contacts = {rule_of(ContactKind::specified)};
  ContactRule& r = n.scene.contacts[0];
  r.master = 1;
  r.profile = {{0, 5, 6, 7}, {10, 5, 6, 7}};
  r.directions = {0, 0, 1};
  n.act(Hook::after_forces);
  EXPECT_EQ(n.v(0), (Vec3{1, 0.25, 7}));
  EXPECT_EQ(n.v(1), (Vec3{5, 6, 7}));  // the master takes all
  EXPECT_EQ(n.v(2), (Vec3{-1, 0.25, 7}));
  // Impulse and work from outside are those of all changes, the reaction that on the others.
  Vec3 impulse{};
  for (const AtNode& b : n.meeting.bodies) impulse += b.mass * (b.v - b.before);
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(n.meeting.outside.impulse[d], impulse[d], 1e-13);
  EXPECT_NEAR(n.meeting.outside.reaction.z, -(1 * 8 + 3 * 8), 1e-13);
}

TEST(Contact, WithoutAFileTheMasterKeepsItsVelocity) {
  Node n(2);
  n.scene.contacts = {rule_of(ContactKind::specified)};
  n.scene.contacts[0].directions = {1, 1, 1};
  n.meeting.bodies[0].v = {9, 9, 9};  // after forces
  n.act(Hook::after_forces);
  EXPECT_EQ(n.v(0), (Vec3{1, 0.25, -1}));
  EXPECT_EQ(n.v(1), (Vec3{1, 0.25, -1}));
}

TEST(Contact, RulesActInDeckOrder) {
  Node n(3);
  n.scene.contacts = {rule_of(ContactKind::specified, {0, 1}),
                      rule_of(ContactKind::single_velocity, {1, 2})};
  n.scene.contacts[0].profile = {{0, 3, 0, 0}, {1, 3, 0, 0}};
  n.scene.contacts[0].directions = {1, 1, 1};
  n.act(Hook::after_forces);
  EXPECT_NEAR(n.v(1).x, (2 * 3 + 3 * -1) / 5.0, 1e-15);  // specified first, then the mean
}

TEST(Contact, ARigidBodyTakesNoImpulseAndGivesItsVelocity) {
  Node n(2);
  n.scene.materials[1].rigid = true;
  n.scene.contacts = {rule_of(ContactKind::single_velocity)};
  n.act(Hook::after_forces);
  EXPECT_EQ(n.v(1), (Vec3{0, 0.25, -1}));
  EXPECT_EQ(n.v(0), n.v(1));
  EXPECT_EQ(n.meeting.outside.impulse, (Vec3{-1, 0, 0}));
}

TEST(MasterMotion, IsTheMeanOfTheProfileOverTheStep) {
  ContactRule r;
  r.profile = {{1, 0, 0, 0}, {2, 4, 0, 0}, {3, 0, 0, 0}};
  EXPECT_EQ(motion_in_step(r, 0, 1).velocity.x, 0);
  EXPECT_DOUBLE_EQ(motion_in_step(r, 1, 1).velocity.x, 2);
  EXPECT_DOUBLE_EQ(motion_in_step(r, 1, 2).velocity.x, 2);
  EXPECT_DOUBLE_EQ(motion_in_step(r, 1.5, 1).velocity.x, 3);
  // Ways over any steps add up to the area below the profile.
  double way = 0, t = 0.3;
  for (const double dt : {0.4, 0.7, 0.9, 1.3}) {
    way += dt * motion_in_step(r, t, dt).velocity.x;
    t += dt;
  }
  EXPECT_NEAR(way, 4, 1e-14);
}

TEST(MasterMotion, StopsAtTheStopTime) {
  ContactRule r;
  r.profile = {{0, 2, 0, 0}, {9, 2, 0, 0}};
  r.stop_time = 1;
  r.velocity_after_stop = {0, 0, 3};
  EXPECT_EQ(motion_in_step(r, 0, 1).velocity, (Vec3{2, 0, 0}));
  EXPECT_EQ(motion_in_step(r, 1, 1).velocity, (Vec3{0, 0, 3}));
  const Vec3 v = motion_in_step(r, 0.5, 1).velocity;  // half of the step
  EXPECT_DOUBLE_EQ(v.x, 1);
  EXPECT_DOUBLE_EQ(v.z, 1.5);
  r.profile.clear();
  EXPECT_FALSE(is_prescribed(r, 0, 0.5));
  EXPECT_TRUE(is_prescribed(r, 0.9, 0.5));
}

TEST(MasterMotion, ARotationStaysOnItsCircle) {
  ContactRule r;
  r.rotates = true;
  r.profile = {{0, 0, 0, 0, 1, 0, 0, 0, 0, std::numbers::pi / 2}, {9}};
  std::copy_n(r.profile[0].begin() + 1, 9, r.profile[1].begin() + 1);
  Vec3 x{3, 0, 5};
  for (int step = 0; step < 8; ++step) x += 0.25 * motion_in_step(r, 0.25 * step, 0.25).at(x);
  // Half a turn about the axis through x = 1.
  EXPECT_NEAR(x.x, -1, 1e-14);
  EXPECT_NEAR(x.y, 0, 1e-14);
  EXPECT_EQ(x.z, 5);
  const MasterMotion m = motion_in_step(r, 0, 0.25);
  const std::array<double, 9> g = m.gradient();
  const Vec3 a{0.3, -0.2, 0.7}, b{-0.1, 0.4, 0.2}, change = m.at(a) - m.at(b);
  for (int d = 0; d < 3; ++d) {
    double sum = 0;
    for (int c = 0; c < 3; ++c) sum += g[3 * d + c] * (a - b)[c];
    EXPECT_NEAR(change[d], sum, 1e-15);
  }
}

}  // namespace
}  // namespace sluice::mpm::contact_test
