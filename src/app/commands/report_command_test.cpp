// sluice report: the page of a run has all of its parts in it, and loads nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>

#include "app/command/command_test_support.hpp"
#include "app/process/html_text.hpp"
#include "framework/base/json.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::report_command_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(HtmlText, BytesAsText) {
  // RFC 4648, section 10.
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\xff\xfe", 2)), "//4=");
  EXPECT_EQ(html_text("<a & \"b\">"), "&lt;a &amp; &quot;b&quot;&gt;");
}

class Report : public ::testing::Test {
 protected:
  void SetUp() override {
    const Outcome run = run_sluice({"run", SLUICE_SOURCE_DIR "/inputs/ice/shock_tube.ups", "--set",
                                    "Grid/Level/Box/resolution=[40,1,1]", "--progress", "none",
                                    "-o", folder_.path().string()});
    ASSERT_EQ(run.status, 0) << run.text;
    archive_ = (folder_ / "shock_tube.uda").string();
  }
  TemporaryFolder folder_{TemporaryFolder::Place::disk};
  std::string archive_;
};

TEST_F(Report, HoldsDeckPlanTimesConservationAndEvents) {
  const std::string file = (folder_ / "page.html").string();
  const Outcome o =
      run_sluice({"report", archive_, "-o", file, "--no-pictures", "--title", "A <b>"});
  ASSERT_EQ(o.status, 0) << o.text;
  EXPECT_THAT(o.text, HasSubstr("0 pictures"));
  const std::string page = text_of(file);
  for (const char* part : {"summary", "conservation", "events", "times", "outputs", "plan", "deck"})
    EXPECT_THAT(page, HasSubstr("<section id=\"" + std::string(part) + "\">"));
  EXPECT_THAT(page, HasSubstr("<title>A &lt;b&gt;</title>"));
  EXPECT_THAT(page, HasSubstr("&lt;Uintah_specification"));
  EXPECT_THAT(page, HasSubstr("memory per rank"));  // of the plan
  const Json run = Json::parse(text_of(fs::path(archive_) / "run.json"));
  EXPECT_THAT(page, HasSubstr(std::to_string(run.at("last_step").get<int>())));
  for (const auto& [name, quantity] : run.at("conservation").members())
    EXPECT_THAT(page, HasSubstr("<td>" + name + "</td>"));
  for (const Json& effect : run.at("effects").entries())
    EXPECT_THAT(page, HasSubstr("<td>" + html_text(effect.at("name").get<std::string>())));
  // Nothing from elsewhere.
  EXPECT_FALSE(std::regex_search(page, std::regex("(src|href)=\"(?!#|data:)")));
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("@import")));
}

TEST_F(Report, SaysWhatIsMissing) {
  fs::remove(fs::path(archive_) / "run.json");
  const Outcome o = run_sluice({"report", archive_, "-o", "-", "--no-pictures"});
  EXPECT_EQ(o.status, 0) << o.text;
  EXPECT_THAT(o.text, HasSubstr("note: no run.json"));
  EXPECT_THAT(o.text, HasSubstr("<section id=\"deck\">"));
  EXPECT_THAT(o.text, Not(HasSubstr("<section id=\"times\">")));
  EXPECT_EQ(run_sluice({"report", archive_ + "x"}).status, 2);
  EXPECT_EQ(run_sluice({"report", archive_, "--no-pictures", "-o", "/proc/absent/x"}).status, 3);
}

}  // namespace
}  // namespace sluice::report_command_test
