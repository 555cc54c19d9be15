// Particles of public decks against the masses that the format's other implementation reports.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <string>

#include "mpm/start/seed.hpp"
#include "mpm/test_support/solid_deck.hpp"

namespace sluice::mpm::public_decks_test {
namespace {

struct Known {
  const char* deck;
  double mass;  // TotalMass of all materials at the first step
  std::size_t particles;
};

// TotalMass of the foam is what follows from its 380,892 points, 8 a cell, and its piston of 102 x
// 102 x 4 cells.
constexpr Known known[] = {
    {"inputs/MPM/disks.ups", 12.6875, 3248},
    {"inputs/UintahRelease/MPM/disks_sulsky.ups", 13.0, 832},
    {"inputs/UintahRelease/MPM/taylorImpact.ups", 0.003036824999999944, 49356},
    {"inputs/UintahRelease/MPM/foam.ups", 1.9e6 * (0.04 / (102 * 102)) * 0.0025 / 8 * 713820,
     713820},
};

class PublicDecks : public testing::TestWithParam<Known> {};

TEST_P(PublicDecks, HaveTheirMass) {
  const char* decks = std::getenv("SLUICE_DECKS");
  if (decks == nullptr) GTEST_SKIP() << "SLUICE_DECKS is not set";
  const std::filesystem::path folder = decks;
  const ReadDeck read = read_solid_file((folder / GetParam().deck).string());
  ASSERT_FALSE(any_error(read.faults)) << read.text;
  const Seeder seeder(read.solids, read.scene.grid);
  long double mass = 0;
  std::size_t count = 0;
  for (int m = 0; m < static_cast<int>(read.solids.materials.size()); ++m) {
    SeededParticles p;
    const Level& level = read.scene.grid.levels.front();
    seeder.seed(m, level, level.domain, {}, p);
    mass += std::accumulate(p.mass.begin(), p.mass.end(), 0.0L);
    count += p.count();
  }
  // The reported ones are plain sums, right to 5e-13.
  EXPECT_NEAR(static_cast<double>(mass / GetParam().mass), 1, 1e-12);
  EXPECT_EQ(count, GetParam().particles);
}

INSTANTIATE_TEST_SUITE_P(Of, PublicDecks, testing::ValuesIn(known), [](const auto& deck) {
  return std::filesystem::path(deck.param.deck).stem().string();
});

}  // namespace
}  // namespace sluice::mpm::public_decks_test
