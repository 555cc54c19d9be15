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

// Particles of disks and taylorImpact: mass over that of one.
constexpr Known known[] = {
    {"inputs/MPM/disks.ups", 12.6875, 6496},
    {"inputs/UintahRelease/MPM/disks_sulsky.ups", 13.0, 416},
    {"inputs/UintahRelease/MPM/taylorImpact.ups", 0.003036824999999944, 0},
    {"inputs/UintahRelease/MPM/foam.ups", 0, 0},
};

class PublicDecks : public testing::TestWithParam<Known> {};

TEST_P(PublicDecks, HaveTheirMass) {
  const char* decks = std::getenv("SLUICE_DECKS");
  if (decks == nullptr) GTEST_SKIP() << "SLUICE_DECKS is not set";
  const std::filesystem::path folder = decks;
  const ReadDeck read = read_solid_file((folder / GetParam().deck).string());
  ASSERT_FALSE(any_error(read.faults)) << read.text;
  const Seeder seeder(read.solids, read.scene.grid);
  double mass = 0;
  std::size_t count = 0;
  for (int m = 0; m < static_cast<int>(read.solids.materials.size()); ++m) {
    SeededParticles p;
    const Level& level = read.scene.grid.levels.front();
    seeder.seed(m, level, level.domain, {}, p);
    mass += std::accumulate(p.mass.begin(), p.mass.end(), 0.0);
    count += p.count();
  }
  if (GetParam().mass > 0) EXPECT_NEAR(mass / GetParam().mass, 1, 1e-13);
  if (GetParam().particles > 0) EXPECT_EQ(count, GetParam().particles);
  RecordProperty("particles", static_cast<int>(count));
}

INSTANTIATE_TEST_SUITE_P(Of, PublicDecks, testing::ValuesIn(known), [](const auto& deck) {
  return std::filesystem::path(deck.param.deck).stem().string();
});

}  // namespace
}  // namespace sluice::mpm::public_decks_test
