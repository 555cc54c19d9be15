// Boxes are dealt out by the particles of solids in them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/command/command_test_support.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::balancing_test {
namespace {

struct Finished {
  nlohmann::json record;
  std::string archive;
};

Finished run_on(int ranks, const TemporaryFolder& folder) {
  const std::string report = (folder / "run.json").string();
  const Outcome outcome = run_in_shell(
      on_ranks(ranks) +
      SLUICE_COMMAND " run " SLUICE_SOURCE_DIR
                     "/inputs/bench/block_in_corner.ups --max-steps 6 --progress none -o " +
      folder.string() + " --json " + report);
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  Finished run;
  run.record = nlohmann::json::parse(text_of(report));
  run.archive = run.record.at("archive");
  return run;
}

// All particles of this deck lie in a few of 64 boxes, which one of two ranks has at the start.
TEST(Balancing, ABodyInACornerIsSharedSoonAndKeepsItsBits) {
  const TemporaryFolder of_one, of_two;
  const Finished one = run_on(1, of_one), two = run_on(2, of_two);
  EXPECT_EQ(one.record.at("balances"), 0);
  EXPECT_EQ(two.record.at("balances"), 1);
  const Outcome same = run_sluice({"compare", one.archive, two.archive});
  EXPECT_EQ(same.status, 0) << same.text;
}

}  // namespace
}  // namespace sluice::balancing_test
