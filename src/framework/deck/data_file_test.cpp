// Where files of decks are found, and under which names archives keep them.
#include "framework/deck/data_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "framework/base/temporary_folder.hpp"
#include "framework/deck/load_deck.hpp"

namespace sluice::data_file_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

Schema schema() {
  Schema s;
  s.root =
      s.root.child(tag("piece", "a piece").multiple().child(tag("name", "a file").once().file()))
          .child(tag("surface", "two files").file({".tri", ".pts"}))
          .child(tag("title", "no file").text())
          .child(tag("profile", "a file").file().by_default("default.tab"));
  return s;
}

class DataFiles : public ::testing::Test {
 protected:
  void write(const std::string& name) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << name;
  }
  Deck read(const std::string& inside, const std::string& name = "deck.ups") const {
    return load_deck_text("<Uintah_specification>" + inside + "</Uintah_specification>",
                          (folder_ / name).string(), {}, schema());
  }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }

  TemporaryFolder folder_;
};

TEST_F(DataFiles, AreFoundBesideTheDeck) {
  write("a.tab");
  write("s.tri");
  write("default.tab");
  const Deck deck = read(
      "<piece><name>a.tab</name></piece><surface>s</surface><title>a.tab</title>"
      "<piece><name>none</name></piece>");
  EXPECT_TRUE(deck.faults.empty());
  const DeckNode& root = *deck.root;
  EXPECT_EQ(root.all("piece")[0]->string("name"), at("a.tab"));
  EXPECT_EQ(root.all("piece")[1]->string("name"), "none");  // for whoever reads it to refuse
  EXPECT_EQ(root.string("surface"), at("s"));
  EXPECT_EQ(root.string("title"), "a.tab");
  EXPECT_EQ(root.string("profile"), at("default.tab"));
}

TEST_F(DataFiles, AreFoundWithoutTheirFoldersOrGzippedWithAWarning) {
  write("a.tab.gz");
  const Deck deck = read("<piece><name>inputs/a.tab</name></piece>");
  EXPECT_EQ(deck.root->all("piece")[0]->string("name"), at("a.tab.gz"));
  ASSERT_EQ(deck.faults.size(), 1u);
  EXPECT_THAT(to_string(deck.faults[0]), HasSubstr("warning: 'inputs/a.tab' does not exist; '"));
}

TEST_F(DataFiles, AreFoundBesideTheTargetOfALink) {
  write("real/a.tab");
  write("real/deck.ups");
  fs::create_directory(folder_ / "links");
  fs::create_symlink("../real/deck.ups", folder_ / "links/deck.ups");
  const Deck deck = read("<piece><name>a.tab</name></piece>", "links/deck.ups");
  EXPECT_TRUE(deck.faults.empty());
  EXPECT_TRUE(fs::equivalent(deck.root->all("piece")[0]->string("name"), at("real/a.tab")));
  write("links/a.tab");  // goes first
  EXPECT_EQ(read("<piece><name>a.tab</name></piece>", "links/deck.ups")
                .root->all("piece")[0]
                ->string("name"),
            at("links/a.tab"));
}

TEST_F(DataFiles, AreKeptUnderNamesOfTheirOwn) {
  write("a.tab");
  write("more/a.tab");
  write("s.tri");
  write("s.pts");
  const Deck deck = read(
      "<piece><name>a.tab</name></piece><piece><name>more/a.tab</name></piece>"
      "<piece><name>a.tab</name></piece><surface>s</surface><piece><name>none</name></piece>");
  KeptFiles files;
  keep_files(*deck.root, schema(), files);
  const auto pieces = deck.root->all("piece");
  EXPECT_EQ(pieces[0]->string("name"), "input_files/a.tab");
  EXPECT_EQ(pieces[1]->string("name"), "input_files/2_a.tab");
  EXPECT_EQ(pieces[2]->string("name"), "input_files/a.tab");
  EXPECT_EQ(pieces[3]->string("name"), "none");
  EXPECT_EQ(deck.root->string("surface"), "input_files/s");
  EXPECT_EQ(files, (KeptFiles{{"input_files/a.tab", at("a.tab")},
                              {"input_files/2_a.tab", at("more/a.tab")},
                              {"input_files/s.tri", at("s.tri")},
                              {"input_files/s.pts", at("s.pts")}}));
}

}  // namespace
}  // namespace sluice::data_file_test
