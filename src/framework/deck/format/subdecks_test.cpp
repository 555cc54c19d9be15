// The decks of a switcher's components: what is of the run's deck, what is their own, where they
// lie.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "framework/base/temporary_folder.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/format/switcher.hpp"
#include "framework/deck/load_deck.hpp"

namespace sluice::subdecks_test {
namespace {

using ::testing::HasSubstr;

Schema schema() {
  Schema all;
  add_framework_tags(all);
  return all;
}

std::string deck_text(const std::string& component, const std::string& title,
                      const std::string& end, const std::string& most) {
  return "<Uintah_specification>\n" + component + "\n<Meta><title>" + title +
         "</title></Meta><Time><initTime>0</initTime><maxTime>" + end +
         "</maxTime><delt_min>0</delt_min><delt_max>" + most +
         "</delt_max><timestep_multiplier>1</timestep_multiplier></Time>"
         "<DataArchiver><filebase>" +
         title +
         ".uda</filebase><outputInterval>1</outputInterval></DataArchiver>"
         "<Grid><BoundaryConditions/><Level><Box label=\"1\"><lower>[0,0,0]</lower>"
         "<upper>[1,1,1]</upper><resolution>[4,1,1]</resolution></Box></Level></Grid>"
         "</Uintah_specification>";
}

class SubDecks : public ::testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) const {
    std::filesystem::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << text;
  }
  Deck switcher(const std::string& parts) const {
    write("inputs/MPM/run.ups",
          deck_text("<SimulationComponent type=\"switcher\">" + parts + "</SimulationComponent>",
                    "whole", "3", "9"));
    return load_deck((folder_ / "inputs/MPM/run.ups").string(), {}, schema());
  }
  TemporaryFolder folder_;
};

const std::string until_5 =
    "<SwitchCriteria type=\"Timestep\"><timestep>5</timestep></SwitchCriteria>";

// Names begin at the folder that holds inputs/, whatever the working directory is.
TEST_F(SubDecks, HaveTheirOwnLimitsAndTheRunsTimesAndOutput) {
  write("inputs/MPM/a.ups", deck_text("<SimulationComponent type=\"mpm\"/>", "a", "77", "0.5"));
  write("inputs/IMPM/a.ups", deck_text("<SimulationComponent type=\"impm\"/>", "b", "88", "0.25"));
  const Deck run = switcher(
      "<subcomponent><input_file>inputs/MPM/a.ups</input_file>" + until_5 +
      "</subcomponent><subcomponent><input_file>inputs/IMPM/a.ups</input_file></subcomponent>");
  ASSERT_TRUE(run.good()) << to_string(run.faults.front());
  const std::vector<SubDeck> parts = read_subdecks(*run.root, schema());
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].after, 0);
  EXPECT_EQ(parts[1].after, 5);
  EXPECT_THAT(parts[1].deck.file, HasSubstr("IMPM/a.ups"));
  const double most[] = {0.5, 0.25};
  for (std::size_t n = 0; n < 2; ++n) {
    const DeckNode& root = *parts[n].deck.root;
    EXPECT_EQ(root.need("Time").real("maxTime"), 3);
    EXPECT_EQ(root.need("Time").real("delt_max"), most[n]);
    EXPECT_EQ(root.need("DataArchiver").string("filebase"), "whole.uda");
    EXPECT_EQ(root.need("Meta").string("title"), "whole");
    EXPECT_EQ(root.all("Grid").size(), 1u);
  }
}

// What lies beside the deck comes before what lies above it.
TEST_F(SubDecks, LieBesideTheDeckFirst) {
  write("inputs/MPM/a.ups", deck_text("<SimulationComponent type=\"mpm\"/>", "a", "77", "0.5"));
  write("a.ups", deck_text("<SimulationComponent type=\"mpm\"/>", "a", "77", "0.125"));
  const Deck run = switcher("<subcomponent><input_file>a.ups</input_file></subcomponent>");
  const std::vector<SubDeck> parts = read_subdecks(*run.root, schema());
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].deck.root->need("Time").real("delt_max"), 0.5);
}

TEST_F(SubDecks, TellWhatIsWrongInTheirOwnFile) {
  write("inputs/MPM/a.ups", deck_text("<SimulationComponent type=\"mpm\"/>", "a", "77", "none"));
  const Deck run = switcher("<subcomponent><input_file>a.ups</input_file></subcomponent>");
  ASSERT_TRUE(run.good());
  const std::vector<SubDeck> parts = read_subdecks(*run.root, schema());
  ASSERT_FALSE(parts[0].deck.good());
  EXPECT_THAT(to_string(parts[0].deck.faults.front()),
              AllOf(HasSubstr("inputs/MPM/a.ups:3:"), HasSubstr("<delt_max>: 'none'")));
}

TEST_F(SubDecks, BelongToASwitcherAlone) {
  write("inputs/MPM/run.ups",
        deck_text("<SimulationComponent type=\"mpm\"><subcomponent/></SimulationComponent>",
                  "whole", "3", "9"));
  const Deck run = load_deck((folder_ / "inputs/MPM/run.ups").string(), {}, schema());
  ASSERT_FALSE(run.good());
  EXPECT_THAT(to_string(run.faults.front()), HasSubstr("with type=switcher only"));
}

}  // namespace
}  // namespace sluice::subdecks_test
