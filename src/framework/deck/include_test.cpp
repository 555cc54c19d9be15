// Includes: sections, filters, look-up of files, loops.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "framework/base/temporary_folder.hpp"
#include "framework/deck/deck.hpp"

namespace sluice::include_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Include : public ::testing::Test {
 protected:
  void SetUp() override {
    here_ = fs::current_path();
    fs::create_directories(folder_ / "decks" / "parts");
    fs::current_path(folder_.path());
    write("decks/parts/steel.xml",
          "<Uintah_Include>\n"
          "  <density>7800</density>\n"
          "  <material name='hot'><heat>2</heat></material>\n"
          "  <material name='cold'><heat>1</heat><deep><yield>5</yield></deep></material>\n"
          "</Uintah_Include>");
  }
  void TearDown() override { fs::current_path(here_); }
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder_ / file) << text;
  }
  // The deck with these includes in place of the text.
  Deck read(const std::string& includes) const {
    write("decks/deck.ups",
          "<Uintah_specification><first/>\n" + includes + "\n<last/></Uintah_specification>");
    return read_deck("decks/deck.ups");
  }
  static std::string names(const Deck& deck) {
    std::string list;
    for (const auto& child : deck.root->children) list += child->name + ' ';
    return list;
  }

 private:
  TemporaryFolder folder_;
  fs::path here_;
};

TEST_F(Include, PutsAllChildrenInPlace) {
  const Deck deck = read("<include href='parts/steel.xml'/>");
  ASSERT_TRUE(deck.good());
  EXPECT_EQ(names(deck), "first density material material last ");
  EXPECT_EQ(to_string(deck.root->child("density")->where), "decks/parts/steel.xml:2:3");
}

TEST_F(Include, ChoosesASectionByPathAndAttributes) {
  EXPECT_EQ(names(read("<include href='parts/steel.xml' section='density'/>")),
            "first density last ");
  const Deck cold = read("<include href='parts/steel.xml' section='material' name='cold'/>");
  EXPECT_EQ(cold.root->child("material")->string("heat"), "1");
  const Deck deep = read("<include href='parts/steel.xml' section='material/deep'/>");
  EXPECT_EQ(deep.root->find("deep/yield")->text, "5");
  const Deck inside = read(
      "<include href='parts/steel.xml' section='material' name='hot' excludeSectionTag='true'/>");
  EXPECT_EQ(names(inside), "first heat last ");
}

TEST_F(Include, LooksBesideTheFileThenInTheCurrentFolder) {
  EXPECT_TRUE(read("<include href='parts/steel.xml'/>").good());        // beside
  EXPECT_TRUE(read("<include href='decks/parts/steel.xml'/>").good());  // current folder
  const fs::path absolute = fs::current_path() / "decks/parts/steel.xml";
  EXPECT_TRUE(read("<include href='" + absolute.string() + "'/>").good());
  EXPECT_FALSE(read("<include href='steel.xml'/>").good());
}

TEST_F(Include, Nests) {
  write("decks/parts/outer.xml",
        "<Uintah_Include><inner><include href='steel.xml' section='density'/></inner>"
        "</Uintah_Include>");
  const Deck deck = read("<include href='parts/outer.xml'/>");
  ASSERT_TRUE(deck.good());
  EXPECT_EQ(deck.root->find("inner/density")->text, "7800");
}

TEST_F(Include, MayTakeTwoSectionsOfOneFileWithinEachOther) {
  write("decks/parts/two.xml",
        "<Uintah_Include><a><include href='two.xml' section='b'/></a><b>1</b></Uintah_Include>");
  const Deck deck = read("<include href='parts/two.xml' section='a'/>");
  ASSERT_TRUE(deck.good()) << to_string(deck.faults.front());
  EXPECT_EQ(deck.root->find("a/b")->text, "1");
}

TEST_F(Include, SaysWhatIsMissing) {
  const auto message = [&](const std::string& include) {
    const Deck deck = read(include);
    EXPECT_FALSE(deck.good());
    return deck.faults.empty() ? std::string() : to_string(deck.faults.front());
  };
  EXPECT_THAT(message("<include href='nowhere.xml'/>"), HasSubstr("deck.ups:2:1: error"));
  EXPECT_THAT(message("<include/>"), HasSubstr("needs href"));
  EXPECT_THAT(message("<include href='parts'/>"), HasSubstr("not a regular file"));
  EXPECT_THAT(message("<include href='parts/steel.xml' section='material/none'/>"),
              HasSubstr("no section 'material/none'"));
  EXPECT_THAT(message("<include href='parts/steel.xml' section='material' name='warm'/>"),
              HasSubstr("with name='warm'"));
  EXPECT_THAT(message("<include href='deck.ups'/>"), HasSubstr("include loop"));
}

TEST_F(Include, ThatIsBrokenNamesTheIncludedFile) {
  write("decks/parts/broken.xml", "<Uintah_Include>\n<a></b></Uintah_Include>");
  const Deck deck = read("<include href='parts/broken.xml'/>");
  ASSERT_FALSE(deck.good());
  EXPECT_THAT(to_string(deck.faults.front()), HasSubstr("decks/parts/broken.xml:2"));
}

}  // namespace
}  // namespace sluice::include_test
