// Particles counted without making any are those that a start makes.
#include <gtest/gtest.h>

#include "mpm/solid_particles.hpp"
#include "mpm/test_support/solid_deck.hpp"

namespace sluice::mpm::count_at_start_test {
namespace {

TEST(CountAtStart, IsWhatAStartMakes) {
  SolidDeck deck;
  deck.objects =
      "<geom_object><sphere><origin>[0.5,0.5,0.5]</origin><radius>0.33</radius></sphere>"
      "<res>[2,3,2]</res><velocity>[0,0,0]</velocity><temperature>300</temperature></geom_object>"
      "<geom_object><box><min>[0.9,0.9,0.9]</min><max>[2,2,2]</max></box>"
      "<res>[2,2,2]</res><velocity>[0,0,0]</velocity><temperature>300</temperature></geom_object>";
  const ReadDeck read = read_solids(deck);
  ASSERT_EQ(read.text, "");
  const SolidParticles particles(read.scene, read.solids);
  const Level& level = read.scene.grid.levels.front();
  for (const IndexBox& cells : {level.domain, IndexBox{{2, 3, 4}, {6, 10, 7}}}) {
    ParticleSet set(particles.kinds()[0].columns());
    particles.start(0, level, cells, set);
    EXPECT_GT(set.size(), 0u);
    EXPECT_EQ(particles.count_at_start(0, level, cells), static_cast<std::int64_t>(set.size()));
  }
}

}  // namespace
}  // namespace sluice::mpm::count_at_start_test
