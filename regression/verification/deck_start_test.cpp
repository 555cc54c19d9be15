// Every deck of inputs/ice runs, and starts from the exact solution that it names.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "app/loading/archive_error.hpp"
#include "framework/archive/archive.hpp"
#include "sluice_source_dir.hpp"
#include "verification/case_run.hpp"

namespace sluice::verification::deck_start_test {
namespace {

// Relative mean difference of the start. Reference runs smear the jumps of their own start over a
// cell; Sedov's point is spread over a Gaussian.
constexpr double allowed = 1e-13, allowed_of_reference_runs = 2e-3;

std::vector<std::string> all_decks() {
  std::vector<std::string> names;
  const auto folder = std::filesystem::path(SLUICE_SOURCE_DIR) / "inputs" / "ice";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".ups") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class EveryDeck : public testing::TestWithParam<std::string> {};

TEST_P(EveryDeck, StartsFromItsExactSolution) {
  const CaseRun run(GetParam(), {}, {"--max-steps", "1"});
  EXPECT_EQ(run.steps(), 1);
  const Archive archive = Archive::open(run.archive());
  const auto reference = reference_of_archive(archive);
  if (!reference || GetParam() == "sedov") return;
  const Deck deck = read_deck((archive.folder() / "input.xml").string());
  const bool is_run = deck.root->find("Meta/exact_solution")->attribute("type") == "radial";
  const ArchiveStep start = archive.read_output(archive.select_output("first"));
  ASSERT_EQ(start.info().time, 0);
  const double limit = is_run ? allowed_of_reference_runs : allowed;
  EXPECT_LE(archive_error(start, *reference, "rho_CC", 0, 0).relative_l1, limit);
  EXPECT_LE(archive_error(start, *reference, "press_CC", 0, 0).relative_l1, limit);
  for (const int d : {0, 1, 2}) {
    EXPECT_LE(archive_error(start, *reference, "vel_CC", d, 0).linf, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Inputs, EveryDeck, testing::ValuesIn(all_decks()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace sluice::verification::deck_start_test
