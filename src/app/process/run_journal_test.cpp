// A series that was killed goes on where it was.
#include "app/process/run_journal.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "framework/base/temporary_folder.hpp"

namespace sluice::run_journal_test {
namespace {

TEST(RunJournal, KeepsWhatWasFoundUntilTheSeriesIsComplete) {
  const TemporaryFolder folder;
  {
    RunJournal journal(folder.path());
    EXPECT_EQ(journal.size(), 0u);
    journal.add("a", {{"error", 0.5}});
    journal.add("b", {{"error", 0.25}});
  }
  // A kill in the middle of a line.
  std::ofstream(folder / "journal.jsonl", std::ios::app) << R"({"key": "c", "fou)";
  RunJournal again(folder.path());
  EXPECT_EQ(again.size(), 2u);
  EXPECT_EQ(again.find("b").value().at("error").get<double>(), .25);
  EXPECT_FALSE(again.find("c").has_value());
  again.add("c", {{"error", 0.125}});
  EXPECT_EQ(RunJournal(folder.path()).size(), 3u);
  again.finish();
  EXPECT_EQ(RunJournal(folder.path()).size(), 0u);
}

TEST(RunJournal, TheKeyChangesWithWordsAndDeck) {
  const TemporaryFolder folder;
  const std::string deck = (folder / "deck.ups").string();
  std::ofstream(deck) << "<a/>";
  const std::string key = RunJournal::key_of({"run", deck}, deck);
  EXPECT_EQ(RunJournal::key_of({"run", deck}, deck), key);
  EXPECT_NE(RunJournal::key_of({"run", deck, "--set", "x=1"}, deck), key);
  std::ofstream(deck) << "<b/>";
  EXPECT_NE(RunJournal::key_of({"run", deck}, deck), key);
}

}  // namespace
}  // namespace sluice::run_journal_test
