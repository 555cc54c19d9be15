// The initial states of the collection's decks of several materials: every cell is full, and what
// the materials weigh together is what their geometry says.
#include <gtest/gtest.h>

#include <filesystem>

#include "app/loading/sluice_schema.hpp"
#include "framework/base/test_support/environment.hpp"
#include "framework/deck/load_deck.hpp"
#include "ice/start/material_fill.hpp"

namespace sluice::peer_fill_test {
namespace {

namespace fs = std::filesystem;

struct Mixed {
  const char* deck;
  std::size_t materials;
  bool one_velocity;
};
const Mixed decks[] = {
    {"inputs/ICE/advect2mat.ups", 2, true},      {"inputs/ICE/hotBlob2mat.ups", 2, true},
    {"inputs/ICE/hotBlob2mat_sym.ups", 2, true}, {"inputs/ICE/moveBlock_mm.ups", 2, false},
    {"inputs/ICE/massX.ups", 2, true},           {"inputs/ICE/advect2matAMR.ups", 2, true},
};

std::ostream& operator<<(std::ostream& out, const Mixed& mixed) {
  return out << mixed.deck;
}

class PeerFill : public ::testing::TestWithParam<Mixed> {};

TEST_P(PeerFill, FillsEveryCell) {
  const std::optional<fs::path> folder = folder_in_environment("SLUICE_DECKS");
  if (!folder) GTEST_SKIP() << "SLUICE_DECKS is not set: no collection of decks";
  const fs::path back = fs::current_path();
  fs::current_path(*folder);
  Deck deck = load_deck(GetParam().deck, {}, sluice_schema());
  // What is not built does not keep the scene from being read.
  std::erase_if(deck.faults, [](const Fault& fault) { return fault.not_built; });
  fs::current_path(back);
  ASSERT_NE(deck.root, nullptr);
  std::vector<Fault> faults;
  const Scene scene = read_scene(deck, {}, faults);
  const ice::IceScene ice = ice::read_ice_scene(deck, scene, faults);
  for (const Fault& fault : faults)
    EXPECT_TRUE(fault.severity != Severity::error || fault.not_built) << to_string(fault);
  ASSERT_EQ(ice.materials.size(), GetParam().materials);
  EXPECT_EQ(ice.one_velocity(), GetParam().one_velocity);
  ASSERT_FALSE(scene.grid.levels.empty());
  const Level& level = scene.grid.levels.front();
  const ice::MixtureFill fill =
      ice::fill_materials(ice, scene.constants, level, level, level.domain,
                          ice::weight_profile(ice, scene.constants, level, level));
  std::vector<std::size_t> cells(ice.materials.size(), 0);
  for (std::size_t n = 0; n < fill.materials[0].volume_fraction.size(); ++n) {
    double sum = 0;
    for (std::size_t m = 0; m < cells.size(); ++m) {
      sum += fill.materials[m].volume_fraction[n];
      if (fill.materials[m].volume_fraction[n] > 0) ++cells[m];
    }
    EXPECT_EQ(sum, 1.0);
  }
  for (const std::size_t count : cells) EXPECT_GT(count, 0u);
}

INSTANTIATE_TEST_SUITE_P(All, PeerFill, ::testing::ValuesIn(decks), [](const auto& test) {
  return fs::path(test.param.deck).stem().string();
});

}  // namespace
}  // namespace sluice::peer_fill_test
