// Error bars of decks against true errors, and resolutions chosen for a wanted error.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/command/command_test_support.hpp"
#include "framework/base/temporary_folder.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::deck_accuracy_test {
namespace {

using testing::HasSubstr;

const std::string sod = SLUICE_SOURCE_DIR "/inputs/ice/riemann_sod.ups";

TEST(DeckAccuracy, TheBarCoversTheTrueErrorOfSodsTube) {
  const TemporaryFolder folder;
  const Outcome said = run_sluice(
      {"accuracy", sod, "--set", "Grid/Level/Box/resolution=[128,1,1]", "-o", folder.string()});
  ASSERT_EQ(said.status, 0) << said.text;
  EXPECT_THAT(said.text, HasSubstr("rho_CC of material 0"));
  const auto json = nlohmann::json::parse(text_of(folder / "riemann_sod.json"));
  EXPECT_EQ(json["runs"].size(), 4u);
  for (const auto& q : json["quantities"])
    if (q["name"] == "rho_CC") {
      // Means over 128 cells have a relative error of 0.7 %.
      EXPECT_GT(q["relative_error_bars"][3].get<double>(), .006);
      EXPECT_LT(q["relative_error_bars"][3].get<double>(), .03);
    }
}

TEST(DeckAccuracy, AWantedErrorChoosesTheResolution) {
  const TemporaryFolder folder;
  const Outcome said = run_sluice(
      {"run", sod, "--target-error", "0.02", "--quantity", "rho_CC", "-o", folder.string()});
  ASSERT_EQ(said.status, 0) << said.text;
  EXPECT_THAT(said.text, HasSubstr("chosen: "));
  EXPECT_THAT(said.text, HasSubstr("Grid/Level[1]/Box[1]/resolution="));
}

TEST(DeckAccuracy, WhatCannotBePromisedIsRefused) {
  const auto refused = [](std::vector<std::string> words) {
    words.insert(words.begin(), {"run", sod, "--no-output"});
    const Outcome said = run_sluice(words);
    EXPECT_EQ(said.status, 2) << said.text;
    return said.text;
  };
  EXPECT_THAT(refused({"--target-error", "1e-7"}), HasSubstr("times the cells of the deck"));
  EXPECT_THAT(refused({"--target-error", "2"}), HasSubstr("between 0 and 1"));
  EXPECT_THAT(refused({"--quantity", "rho_CC"}), HasSubstr("--target-error"));
  EXPECT_THAT(refused({"--target-error", "0.1", "--quantity", "rho_C"}), HasSubstr("'rho_CC'"));
}

}  // namespace
}  // namespace sluice::deck_accuracy_test
