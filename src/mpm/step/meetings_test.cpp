// Where bodies meet, and what contact, its heat and bodies that transmit forces make of it.
#include <gtest/gtest.h>

#include <cmath>

#include "mpm/step/contact_stage.hpp"
#include "mpm/step/node_stage.hpp"
#include "mpm/step/transmitted_forces.hpp"
#include "mpm/test_support/step_arrays.hpp"

namespace sluice::mpm::meetings_test {
namespace {

constexpr double round_off = 1e-11;  // measured: 3e-14

std::string box(const std::string& low, const std::string& high, const std::string& velocity) {
  return "<geom_object><box><min>" + low + "</min><max>" + high +
         "</max></box><res>[2,2,2]</res><velocity>" + velocity +
         "</velocity><temperature>300</temperature></geom_object>";
}

// Two blocks along x, the second from `x` on; both go to the other.
SolidDeck two_blocks(const std::string& x, const std::string& end, const std::string& rule) {
  SolidDeck deck;
  deck.flags = "<interpolator>gimp</interpolator>";
  deck.objects = box("[0.2,0.2,0.2]", "[0.5,0.6,0.6]", "[2,0,1]");
  deck.further =
      solid_material("second", box("[" + x + ",0.2,0.2]", "[" + end + ",0.6,0.6]", "[-1,0,0]"));
  deck.contacts = "<contact>" + rule + "<materials>[0,1]</materials></contact>";
  return deck;
}
const char* const stick = "<type>single_velocity</type>";
const char* const friction = "<type>friction</type><mu>0.3</mu>";

std::size_t marked(const MeetingBlocks& blocks, int body) {
  std::size_t count = 0;
  for (const char mark : blocks.marks(body)) count += mark != 0 ? 1 : 0;
  return count;
}

TEST(MeetingBlocks, AreThoseOfNodesThatTwoBodiesHave) {
  for (const bool near : {false, true}) {
    StepArrays arrays(two_blocks(near ? "0.5" : "0.75", near ? "0.8" : "0.9", stick));
    arrays.give();
    const Contact contact(arrays.solids(), arrays.nodes.level);
    MeetingBlocks blocks(contact);
    blocks.find(arrays.bodies);
    EXPECT_EQ(blocks.any(), near);
    for (const int m : {0, 1}) EXPECT_EQ(marked(blocks, m) > 0, near);
    BlockGroups groups;
    blocks.list_groups(arrays.bodies, groups);
    std::size_t members = 0, pairs = 0;
    for (std::size_t g = 0; g < groups.count(); ++g) {
      members += groups[g].size();
      pairs += groups[g].size() == 2 ? 1 : 0;
      if (blocks.meets(groups[g])) {
        EXPECT_EQ(groups[g].size(), 2u);
      }
    }
    EXPECT_EQ(members, static_cast<std::size_t>(arrays.bodies[0].table.count() +
                                                arrays.bodies[1].table.count()));
    EXPECT_GE(pairs, marked(blocks, 0));
  }
}

TEST(MeetingBlocks, AloneEveryBlockIsAGroup) {
  StepArrays arrays(two_blocks("0.5", "0.8", stick));
  arrays.give();
  BlockGroups groups;
  list_single_blocks(arrays.bodies, groups);
  EXPECT_EQ(groups.count(), static_cast<std::size_t>(arrays.bodies[0].table.count() +
                                                     arrays.bodies[1].table.count()));
}

struct Meeting {
  explicit Meeting(const SolidDeck& deck)
      : arrays(deck), contact(arrays.solids(), arrays.nodes, arrays.bodies) {
    arrays.give();
    contact.begin_step(arrays.scope.step);
    contact.begin_sums();
    contact.find_meetings(arrays.work, shared);
  }
  StepArrays arrays;
  std::vector<SharedBlocks> shared{2};
  ContactStage contact;
};

// sum V S of both bodies fills a cell's volume at nodes between them.
TEST(BodySurfaces, GiveTheVolumesAroundANode) {
  Meeting m(two_blocks("0.5", "0.8", friction));
  const BlockTable &one = m.arrays.bodies[0].table, &two = m.arrays.bodies[1].table;
  const IntVec3 node{5, 4, 4};  // at x = 0.5, within y and z
  const BlockShape& shape = m.arrays.nodes.shape;
  const int n = shape.place(node);
  const SurfaceAtNode a = m.contact.surfaces().at({0, one.find(shape.block_of(node))}, n);
  const SurfaceAtNode b = m.contact.surfaces().at({1, two.find(shape.block_of(node))}, n);
  EXPECT_NEAR((a.volume + b.volume) / m.arrays.nodes.level.cell_volume(), 1, round_off);
  EXPECT_NEAR(a.gradient.x, -b.gradient.x, round_off);
  EXPECT_GT(std::fabs(a.gradient.x), 0.005);  // 0.01: the face of a cell
}

TEST(ContactStage, BodiesThatStickHaveOneVelocityAndKeepTheirMomentum) {
  Meeting m(two_blocks("0.5", "0.8", stick));
  std::vector<Body>& bodies = m.arrays.bodies;
  NodeStage stage(m.arrays.solids(), m.arrays.nodes, bodies, &m.contact, nullptr, {});
  stage.move(m.arrays.scope.step, {1e-3, 1e-3, {}, 0}, false);
  Vec3 given{};
  double mass = 0;
  std::size_t joint = 0;
  for (const std::size_t k : {0, 1})
    m.arrays.for_each_full(k, bodies[k].nodes, [&](const std::int64_t* node, IntVec3 at) {
      mass += as_real(node[3]);
      for (int d = 0; d < 3; ++d) given[d] += as_real(node[3]) * as_real(node[4 + d]);
      const BlockTable& table = bodies[1].table;
      const int other = table.find(m.arrays.nodes.shape.block_of(at));
      if (k != 0 || other < 0) return;
      const std::int64_t* there =
          bodies[1].nodes.sums(other) + m.arrays.nodes.shape.place(at) * lanes;
      if (there[count_lane] == 0) return;
      ++joint;
      for (int d = 0; d < 3; ++d)
        EXPECT_NEAR(as_real(node[d]) + bodies[0].units.reference[d],
                    as_real(there[d]) + bodies[1].units.reference[d], round_off);
    });
  EXPECT_GT(joint, 10u);
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(given[d] / mass, 0, round_off);
}

// What contact takes heats the particles: sum c M dT over nodes is the loss in the books.
TEST(FrictionHeat, IsTheLossOfContact) {
  SolidDeck deck = two_blocks("0.5", "0.8", stick);
  deck.flags += "<do_contact_friction_heating>true</do_contact_friction_heating>";
  Meeting m(deck);
  std::vector<Body>& bodies = m.arrays.bodies;
  FrictionHeat heat(m.arrays.solids(), m.arrays.nodes, bodies);
  NodeStage stage(m.arrays.solids(), m.arrays.nodes, bodies, &m.contact, &heat, {});
  stage.move(m.arrays.scope.step, {1e-3, 1e-3, {}, 0}, false);
  double warmed = 0;
  for (const int k : {0, 1}) {
    const NodeLanes& rise = heat.rise(k);
    for (int b = 0; b < rise.blocks(); ++b)
      for (int n = 0; n < block_lanes; n += lanes)
        if (rise.sums(b)[n] != 0)
          warmed += as_real(rise.sums(b)[n]) * 5 *
                    as_real(bodies[static_cast<std::size_t>(k)].nodes.sums(b)[n + 3]);
  }
  const double loss = stage.books().sums[StepSums::contact_loss].value();
  EXPECT_GT(loss, 1);
  EXPECT_NEAR(warmed, loss, round_off * loss);
}

// dv = J/M + dk g along active directions.
TEST(TransmittedForces, PushABodyAsAWhole) {
  SolidDeck deck = two_blocks("0.5", "0.8", stick);
  StepArrays arrays(deck);
  MpmScene solids = arrays.solids();
  solids.materials[0].force_transmitting = true;
  const OutsideForces outside(solids, arrays.nodes.level, arrays.method->carried());
  TransmittedForces forces(solids, arrays.method->carried(), arrays.work, outside, nullptr);
  EXPECT_TRUE(forces.transmits(0));
  EXPECT_FALSE(forces.transmits(1));
  NodeBooks books;
  books.make_room(2);
  books.given[0][0].add(3);  // N s, to the other
  forces.after_nodes({0.5, 0.5, {0, 0, -10}, 0}, books);
  double mass = 0;
  for (std::size_t p = 0; p < arrays.sets[0].size(); ++p)
    mass += arrays.column(0, arrays.columns(0).mass)[p];
  EXPECT_NEAR(forces.sums(0)[0].value(), mass, round_off * mass);
  EXPECT_EQ(forces.sums(0)[1].value(), -3);
  EXPECT_NEAR(books.sums[StepSums::force_z].value(), -5 * mass, round_off * mass);
  forces.push(0, 2, {-3, 4, 0}, {true, false, true});
  EXPECT_EQ(forces.pushed(0), (Vec3{-1.5, 0, -5}));
  EXPECT_EQ(forces.pushed(1), Vec3{});
}

}  // namespace
}  // namespace sluice::mpm::meetings_test
