// sluice new: every template gives a deck that check finds good and that runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "app/command/command_test_support.hpp"
#include "framework/base/temporary_folder.hpp"

namespace sluice::new_command_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class NewCommand : public testing::Test {
 protected:
  Outcome sluice(const std::string& words) const {
    return run_in_shell("cd " + folder_.path().string() + " && " SLUICE_COMMAND " " + words);
  }
  TemporaryFolder folder_;
};

TEST_F(NewCommand, WritesAGoodDeckOfEachTemplate) {
  const std::string list = sluice("new --list").text;
  for (const char* name :
       {"shock_tube", "blast_on_levels", "impact", "shock_on_body", "cavity", "blank"}) {
    EXPECT_THAT(list, HasSubstr(name));
    const std::string own = std::string("my_") + name;
    const Outcome made = sluice("new " + own + " --like " + name);
    EXPECT_EQ(made.status, 0) << made.text;
    EXPECT_THAT(made.text, HasSubstr("sluice run " + own + ".ups --plot"));
    const Outcome checked = sluice("check --strict " + own + ".ups");
    EXPECT_EQ(checked.status, 0) << checked.text;
    const std::string text = text_of(folder_ / (own + ".ups"));
    EXPECT_THAT(text, HasSubstr("<filebase>" + own + ".uda</filebase>"));
    EXPECT_THAT(text, Not(HasSubstr("Subject:")));
    const Outcome ran = sluice("run " + own + ".ups --max-steps 2 --no-output --progress none");
    EXPECT_EQ(ran.status, 0) << ran.text;
  }
}

TEST_F(NewCommand, KeepsWhatIsThereAndNamesTheNearestTemplate) {
  ASSERT_EQ(sluice("new tube").status, 0);
  const std::string before = text_of(folder_ / "tube.ups");
  const Outcome again = sluice("new tube.ups --like blank");
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.text, HasSubstr("tube.ups is there already"));
  EXPECT_EQ(text_of(folder_ / "tube.ups"), before);
  EXPECT_THAT(sluice("new other --like shocktube").text, HasSubstr("did you mean 'shock_tube'?"));
  EXPECT_EQ(sluice("new").status, 2);
  EXPECT_FALSE(fs::exists(folder_ / "other.ups"));
}

}  // namespace
}  // namespace sluice::new_command_test
