// Bodies that come apart by the method alone: since when, the largest share, checkpoints.
#include "framework/run/simulation/parted_bodies.hpp"

#include <gtest/gtest.h>

#include "framework/base/json.hpp"
#include "framework/run/simulation/energy_guard.hpp"

namespace sluice::parted_bodies_test {
namespace {

BodyEnergy body(const char* name, int material, double parted, double particles) {
  BodyEnergy b;
  b.name = name;
  b.material = material;
  b.parted = parted;
  b.particles = particles;
  return b;
}

TEST(SeparatedBodies, KeepSinceWhenAndTheLargestShare) {
  SeparatedBodies parted;
  parted.accept({body("ring", 2, 0, 100), body("bar", 0, 0, 10)}, 1, 0.1);
  EXPECT_FALSE(parted.any());
  EXPECT_EQ(parted.summary(), "");
  parted.accept({body("particle", 1, 1, 1)}, 1, 0.1);
  EXPECT_FALSE(parted.any());
  parted.accept({body("ring", 2, 3, 100)}, 2, 0.2);
  parted.accept({body("ring", 2, 7, 100)}, 3, 0.3);
  parted.accept({body("ring", 2, 5, 100)}, 4, 0.4);
  ASSERT_EQ(parted.all().size(), 1U);
  const SeparatedBodies::Parting& ring = parted.all().front();
  EXPECT_EQ(ring.material, 2);
  EXPECT_EQ(ring.since, 2);
  EXPECT_EQ(ring.since_time, 0.2);
  EXPECT_EQ(ring.largest, 0.07);
  EXPECT_EQ(ring.largest_time, 0.3);
  EXPECT_NE(parted.summary().find("solid 'ring' separates"), std::string::npos);
  EXPECT_NE(parted.summary().find("at most 7 % of them, at t = 0.3"), std::string::npos);
}

TEST(SeparatedBodies, GoOnFromACheckpoint) {
  SeparatedBodies parted, after;
  parted.accept({body("ring", 2, 3, 100)}, 2, 0.2);
  after.restore(Json::parse(parted.checkpoint().dump()));
  for (SeparatedBodies* p : {&parted, &after}) p->accept({body("ring", 2, 4, 100)}, 3, 0.3);
  EXPECT_EQ(after.checkpoint().dump(), parted.checkpoint().dump());
}

}  // namespace
}  // namespace sluice::parted_bodies_test
