// Completion and man pages: the shells themselves read them.
#include "app/command/command_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "app/command/command_test_support.hpp"
#include "framework/base/temporary_folder.hpp"

namespace sluice::command_text_test {
namespace {

using ::testing::HasSubstr;

std::vector<CommandText> commands() {
  CommandText run{"run", "Run a deck", "", {}};
  run.options.push_back({"DECK", {}, true, {}, "The deck"});
  run.options.push_back(
      {"--progress", {"--progress"}, true, {"auto", "plain", "none"}, "Way to tell progress"});
  run.options.push_back({"-o,--output", {"-o", "--output"}, true, {}, "It's the folder"});
  return {run, {"plot", "Draw archives:\nprofiles", "Closing.", {}}};
}

std::string completed(const std::string& words, int at) {
  const TemporaryFolder folder;
  const auto file = folder / "completion";
  std::ofstream(file) << bash_completion(commands());
  return run_in_shell("bash -c 'source " + file.string() + "; COMP_WORDS=(" + words +
                      "); COMP_CWORD=" + std::to_string(at) +
                      "; _sluice; echo \"${COMPREPLY[@]}\"'")
      .text;
}

TEST(Completion, OfCommandsOptionsAndTheirWords) {
  EXPECT_EQ(completed("sluice pl", 1), "plot\n");
  EXPECT_EQ(completed("sluice run --pro", 2), "--progress\n");
  EXPECT_EQ(completed("sluice run --progress p", 3), "plain\n");
  EXPECT_EQ(completed("sluice run --output", 2), "--output\n");
}

TEST(Completion, OfFishQuotesItsTexts) {
  const std::string text = fish_completion(commands());
  EXPECT_THAT(text, HasSubstr("-a plot -d 'Draw archives:'"));
  EXPECT_THAT(text, HasSubstr("-s o -l output -r -d 'It'\\''s the folder'"));
  EXPECT_THAT(text, HasSubstr("-l progress -r -a 'auto plain none'"));
}

TEST(ManPage, HasEveryCommandAndOption) {
  const std::string page = man_page(commands(), "1.2");
  EXPECT_THAT(page, HasSubstr(".SS \"sluice plot\"\nDraw archives:\nprofiles\n.PP\nClosing."));
  EXPECT_THAT(page, HasSubstr("\\fB\\-\\-progress\\fR\nWay to tell progress"));
  EXPECT_THAT(page, HasSubstr("sluice 1.2"));
}

}  // namespace
}  // namespace sluice::command_text_test
