// A warning where <exact_solution> and the start of a deck are two problems, and none where they
// are one: in the decks of the project.
#include "app/loading/exact_start.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "app/command/command_test_support.hpp"
#include "app/loading/scene_loader.hpp"
#include "app/loading/sluice_schema.hpp"
#include "framework/deck/load_deck.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::exact_start_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

std::string ice_deck(const std::string& name) {
  return std::string(SLUICE_SOURCE_DIR) + "/inputs/ice/" + name + ".ups";
}

// The warning of `sluice check`; empty when there is none.
std::string warning_of(const std::string& file, const std::vector<std::string>& overrides = {}) {
  const Deck deck = load_deck(file, overrides, sluice_schema());
  EXPECT_TRUE(deck.good()) << file;
  for (const Fault& fault : scene_faults(deck))
    if (fault.message.find("disagrees with the start") != std::string::npos)
      return to_string(fault);
  return "";
}

TEST(ExactStart, TheProjectsDecksAgree) {
  int compared = 0;
  for (const auto& entry : fs::directory_iterator(std::string(SLUICE_SOURCE_DIR) + "/inputs/ice")) {
    if (entry.path().extension() != ".ups" ||
        text_of(entry.path()).find("<exact_solution") == std::string::npos)
      continue;
    EXPECT_EQ(warning_of(entry.path().string()), "");
    ++compared;
  }
  EXPECT_GT(compared, 35);
}

TEST(ExactStart, AnotherProblemIsTold) {
  // Velocities of -3 and 2 in place of -2 and 2.
  const std::string left =
      warning_of(ice_deck("riemann_123"), {"Meta/exact_solution/left=[1,-3,0.4]"});
  EXPECT_THAT(left, HasSubstr("in 99 of 200 cells: at t = 0 vel_CC.x of the deck is -2"));
  EXPECT_THAT(left, HasSubstr("that of the exact solution -3"));
  EXPECT_THAT(left, HasSubstr("riemann_123.ups:15:"));
  // The deck changed, not the solution: its second state.
  EXPECT_THAT(warning_of(ice_deck("riemann_sod"),
                         {"MaterialProperties/ICE/material/geom_object[2]/velocity=[0.2,0,0]"}),
              HasSubstr("vel_CC.x of the deck is 0.2"));
  // A diaphragm elsewhere, by eight cells of 200.
  EXPECT_THAT(warning_of(ice_deck("riemann_123"), {"Meta/exact_solution/position=0.54"}),
              HasSubstr("disagrees with the start of the deck in 7 of 200 cells"));
  // By less than a cell: cells that hold a jump are no fault.
  EXPECT_EQ(warning_of(ice_deck("riemann_123"), {"Meta/exact_solution/position=0.502"}), "");
  // Several materials, two dimensions, levels.
  EXPECT_THAT(warning_of(ice_deck("air_helium"), {"Meta/exact_solution/right=[0.2,0,1e5]"}),
              HasSubstr("rho_CC of the deck is 0.1379"));
}

TEST(ExactStart, RunsTellItTooAndStrictOnesRefuse) {
  const TemporaryFolder folder;
  const std::vector<std::string> words = {"run",         ice_deck("riemann_123"),
                                          "--set",       "Meta/exact_solution/left=[1,-3,0.4]",
                                          "-o",          folder.string(),
                                          "--max-steps", "1",
                                          "--progress",  "none"};
  const auto with = [&](const std::string& more) {
    std::vector<std::string> all = words;
    all.push_back(more);
    return run_sluice(all);
  };
  const Outcome plain = run_sluice(words);
  EXPECT_EQ(plain.status, 0);
  EXPECT_THAT(plain.text, HasSubstr("warning: <exact_solution> disagrees"));
  EXPECT_THAT(with("--quiet").text, Not(HasSubstr("disagrees")));
  const Outcome strict = with("--strict");
  EXPECT_EQ(strict.status, 2);
  EXPECT_THAT(strict.text, HasSubstr("<exact_solution> disagrees"));
  const Outcome ranks = run_in_shell(
      on_ranks(2) + SLUICE_COMMAND " run " + ice_deck("riemann_123") +
      " --set 'Meta/exact_solution/left=[1,-3,0.4]' --boxes 2,1,1 --max-steps 1 --no-output"
      " --progress none");
  EXPECT_EQ(ranks.status, 0) << ranks.text;
  EXPECT_THAT(ranks.text, HasSubstr("in 99 of 200 cells: at t = 0 vel_CC.x of the deck is -2"));
}

}  // namespace
}  // namespace sluice::exact_start_test
