// The numbers that README names are those of the tables.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/command/command_test_support.hpp"
#include "app/loading/sluice_schema.hpp"
#include "eos/eos.hpp"
#include "mpm/material/materials.hpp"
#include "sluice_source_dir.hpp"
#include "sluice_version.hpp"

namespace sluice::readme_test {
namespace {

using testing::HasSubstr;

TEST(Readme, CountsWhatTheTablesHold) {
  const std::string text = text_of(SLUICE_SOURCE_DIR "/README.md");
  std::size_t laws = 0;
  eos::AllLaws::for_each([&]<class Law>() { laws += eos::is_named_by_decks<Law>() ? 1U : 0U; });
  EXPECT_THAT(text, HasSubstr(fmt::format("any of {} equations of state", laws)));
  const std::size_t models = mpm::material_models().size();
  EXPECT_THAT(text, HasSubstr(fmt::format("[{} models]", models)));
  EXPECT_THAT(text, HasSubstr(fmt::format("{} constitutive models", models)));
  const Schema schema = sluice_schema();
  const auto words = [&](const char* tag) { return schema.at(tag)->value.words.size(); };
  EXPECT_THAT(text, HasSubstr(fmt::format("{} bases and {} transfers", words("MPM/interpolator"),
                                          words("MPM/transfer"))));
}

TEST(Readme, CitationAndPackageNameTheVersion) {
  const std::string number = version::kNumber;
  EXPECT_THAT(text_of(SLUICE_SOURCE_DIR "/CITATION.cff"), HasSubstr("\nversion: " + number + "\n"));
  EXPECT_THAT(text_of(SLUICE_SOURCE_DIR "/README.md"),
              HasSubstr("sluice_" + number + "_amd64.deb"));
}

}  // namespace
}  // namespace sluice::readme_test
