// sluice check finds what sluice run would end with: faults of levels and of the start too.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/command/command_test_support.hpp"
#include "framework/base/temporary_folder.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::check_command_test {
namespace {

using testing::HasSubstr;

class CheckCommand : public testing::Test {
 protected:
  static Outcome check(const std::string& deck, const std::vector<std::string>& overrides) {
    return run_sluice(words("check", deck, overrides));
  }
  Outcome run(const std::string& deck, const std::vector<std::string>& overrides) const {
    std::vector<std::string> all = words("run", deck, overrides);
    all.insert(all.end(),
               {"-o", folder_.string(), "--progress", "none", "--max-steps", "1", "--no-output"});
    return run_sluice(all);
  }

  TemporaryFolder folder_{TemporaryFolder::Place::disk};

 private:
  static std::vector<std::string> words(const char* command, const std::string& deck,
                                        const std::vector<std::string>& overrides) {
    std::vector<std::string> all = {
        command, std::string(SLUICE_SOURCE_DIR) + "/inputs/ice/" + deck + ".ups"};
    for (const std::string& o : overrides) all.insert(all.end(), {"--set", o});
    return all;
  }
};

struct Fault {
  const char* name;
  const char* deck;
  std::vector<std::string> overrides;
  int status;
  const char* place;  // deck and line
  const char* message;
};

const std::string left_end = "MaterialProperties/ICE/material[1]/geom_object/box/max=";
const std::string ratio = "AMR/Regridder/cell_refinement_ratio=";

const std::vector<Fault>& faults() {
  static const std::vector<Fault> all = {
      {"overlap",
       "two_gases_sod",
       {left_end + "[0.6,9,9]"},
       2,
       "two_gases_sod.ups:109",
       "volume fractions sum to 2 in cell"},
      {"gap",
       "two_gases_sod",
       {left_end + "[0.4,9,9]"},
       2,
       "two_gases_sod.ups:89",
       "no geom_object covers it"},
      {"half_a_gap",
       "two_gases_sod",
       {left_end + "[0.495,9,9]", "Grid/Level/Box/resolution=[100,1,1]"},
       2,
       "two_gases_sod.ups:95",
       "part of the cell is empty"},
      {"two_of_a_name",
       "two_gases_sod",
       {"MaterialProperties/ICE/material[2]/@name=diatomic"},
       2,
       "two_gases_sod.ups:89",
       "a second material 'diatomic'; the first is at"},
      {"ratio_one",
       "amr_followed_drop",
       {ratio + "[[1,1,1]]"},
       2,
       "--set AMR/Regridder",
       "level 1 refines no active direction"},
      {"small_tile",
       "amr_followed_drop",
       {"AMR/Regridder/min_patch_size=[[3,3,1]]"},
       2,
       "--set AMR/Regridder",
       "a tile of 3 cells in direction x"},
      {"flat_ratio",
       "amr_followed_drop",
       {ratio + "[[2,2,2]]"},
       0,
       "--set AMR/Regridder",
       "direction z"},
      {"no_dilation",
       "amr_followed_drop",
       {"AMR/Regridder/cell_stability_dilation=[0,0,0]"},
       0,
       "--set AMR/Regridder",
       "cell_stability_dilation 0 in direction x"},
      {"other_regridder",
       "amr_followed_drop",
       {"AMR/Regridder/@type=BNR"},
       0,
       "--set AMR/Regridder",
       "the BNR regridder is replaced by the Tiled one"},
      {"label_of_one_material",
       "two_gases_sod",
       {"DataArchiver/save[1]/@label=Li1"},
       0,
       "--set DataArchiver/save[1]/@label",
       "variable 'Li1' is not computed by this run; nothing is saved of it"},
  };
  return all;
}

TEST_F(CheckCommand, FindsWhatARunWouldTell) {
  for (const Fault& fault : faults()) {
    SCOPED_TRACE(fault.name);
    const Outcome found = check(fault.deck, fault.overrides);
    const Outcome met = run(fault.deck, fault.overrides);
    EXPECT_EQ(found.status, fault.status) << found.text;
    EXPECT_EQ(met.status, fault.status) << met.text;
    for (const std::string& text : {found.text, met.text}) {
      EXPECT_THAT(text, HasSubstr(fault.place));
      EXPECT_THAT(text, HasSubstr(fault.message));
    }
  }
}

TEST_F(CheckCommand, TellsOfARatioOnce) {
  const std::string said = check("amr_followed_drop", {ratio + "[[3,3,1]]"}).text;
  const std::size_t first = said.find("refinement ratio 3");
  ASSERT_NE(first, std::string::npos) << said;
  EXPECT_EQ(said.find("refinement ratio 3", first + 1), std::string::npos) << said;
}

// What a model of one deck brings is no variable of the next.
TEST_F(CheckCommand, JudgesEachDeckByItself) {
  const std::string inputs = std::string(SLUICE_SOURCE_DIR) + "/inputs/ice/";
  std::string text = text_of(inputs + "shock_tube.ups");
  text.insert(text.find("</DataArchiver>"), "<save label='scalar-f'/>");
  const std::string second = (folder_ / "second.ups").string();
  std::ofstream(second) << text;
  const Outcome found = run_sluice({"check", inputs + "amr_mixed_gas_water.ups", second});
  EXPECT_EQ(found.status, 0) << found.text;
  EXPECT_THAT(found.text, HasSubstr("amr_mixed_gas_water.ups: good"));
  EXPECT_THAT(found.text, HasSubstr("variable 'scalar-f' is not computed by this run"));
  const Outcome strict = run_sluice({"check", "--strict", second});
  EXPECT_EQ(strict.status, 2) << strict.text;
  EXPECT_THAT(strict.text, HasSubstr("error: variable 'scalar-f' is not computed by this run"));
}

// Labels are looked at whatever the number of cells.
TEST_F(CheckCommand, FindsLabelsOfALargeDeck) {
  const Outcome found = check("two_gases_sod", {"DataArchiver/save[1]/@label=nothing_CC",
                                                "Grid/Level/Box/resolution=[1000000,1,1]"});
  EXPECT_EQ(found.status, 2) << found.text;
  EXPECT_THAT(found.text, HasSubstr("there is no variable 'nothing_CC'"));
}

// Two solids without a fluid, and without an exchange between them.
TEST_F(CheckCommand, SolidsWithoutAFluidAreAFault) {
  std::string text = text_of(std::string(SLUICE_SOURCE_DIR) + "/inputs/mpmice/shock_over_foam.ups");
  const auto cut = [&](const std::string& from, const std::string& to, std::size_t begin) {
    const auto at = text.find(from, begin), end = text.find(to, at);
    ASSERT_NE(end, std::string::npos) << from;
    text.erase(at, end + to.size() - at);
  };
  const auto materials = text.find("<MaterialProperties>");
  cut("<ICE>", "</ICE>", materials);
  cut("<exchange_properties>", "</exchange_properties>", materials);
  const auto at = text.find("<material ", materials);
  const auto end = text.find("</material>", at) + std::string("</material>").size();
  text.insert(end, text.substr(at, end - at));
  const std::string deck = (folder_ / "solids.ups").string();
  std::ofstream(deck) << text;
  for (const char* command : {"check", "plan", "run"}) {
    const Outcome found = run_sluice({command, deck});
    EXPECT_EQ(found.status, 2) << command << found.text;
    EXPECT_THAT(found.text, HasSubstr("needs a material in <MaterialProperties><ICE>"));
  }
}

// A body that leaves no room for the fluid, whose ends lie far outside of the domain.
TEST_F(CheckCommand, FindsNothingWrongWithASolidLargerThanTheDomain) {
  const std::string piece = "MaterialProperties/MPM/material/geom_object/cylinder/";
  for (const char* radius : {"10", "1e6", "1e12"}) {
    const Outcome found = check(
        "../mpmice/moving_with_gas",
        {piece + "radius=" + radius, piece + "bottom=[0.4,0.4,-1e9]", piece + "top=[0.4,0.4,1e9]"});
    EXPECT_EQ(found.status, 0) << radius << ": " << found.text;
  }
}

// Cells of a large deck are not filled just to be judged.
TEST_F(CheckCommand, LeavesTheStartOfALargeDeckToTheRun) {
  const Outcome found =
      check("two_gases_sod", {left_end + "[0.4,9,9]", "Grid/Level/Box/resolution=[1000000,1,1]"});
  EXPECT_EQ(found.status, 0) << found.text;
}

}  // namespace
}  // namespace sluice::check_command_test
