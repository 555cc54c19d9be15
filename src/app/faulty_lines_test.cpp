// Faulty command lines: each ends with the status and says the words of
// regression/command_lines/faulty.txt, no more and no less.
//
// An entry of that file is "$ WORDS", "= STATUS" and what was said, with {} in place of the working
// folder. SLUICE_RECORD=1 in the environment writes all entries again: read the changes before they
// are committed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "app/command/command_test_support.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::faulty_lines_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* list = SLUICE_SOURCE_DIR "/regression/command_lines/faulty.txt";

struct Entry {
  std::string words;
  int status = 0;
  std::string said;
};

std::vector<Entry> recorded() {
  std::istringstream in(text_of(list));
  std::vector<Entry> entries;
  std::string line;
  while (std::getline(in, line)) {
    if (line.starts_with("$ "))
      entries.push_back({line.substr(2), 0, {}});
    else if (line.starts_with("= ") && !entries.empty())
      entries.back().status = std::stoi(line.substr(2));
    else if (line.starts_with("| ") && !entries.empty())
      entries.back().said += line.substr(2) + "\n";
  }
  return entries;
}

// What the lines name: decks, good and bad, an archive, lists.
class Files {
 public:
  Files() {
    write("good.ups", text_of(SLUICE_SOURCE_DIR "/inputs/ice/riemann_sod.ups"));
    write("cut.ups", text_of(folder_ / "good.ups").substr(0, 700));
    write("empty.ups", "");
    write("bad.study", "{\"title\": 3}");
    write("cut.study", "{\"title\": \"a\"");
    write("bad.stability", "{\"titel\": \"a\"}");
    write("bad_cases.json", "{\"cases\": [{\"name\": \"a\", \"rank\": 2}]}");
    fs::create_directory(folder_.path() / "nothing");
    write_archive();
  }

  std::string folder() const { return folder_.string(); }

 private:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  void write_archive() const {
    const Outcome made = run_in_shell("cd " + folder() +
                                      " && " SLUICE_COMMAND
                                      " run good.ups --quiet --max-steps 3 --output-at-end "
                                      "--set DataArchiver/filebase=a.uda");
    EXPECT_EQ(made.status, 0) << made.text;
  }

  TemporaryFolder folder_;
};

Outcome outcome_of(const std::string& words) {
  static const Files files;
  Outcome outcome = run_in_shell("cd " + files.folder() + " && " + SLUICE_COMMAND + " " + words);
  for (std::size_t at; (at = outcome.text.find(files.folder())) != std::string::npos;)
    outcome.text.replace(at, files.folder().size(), "{}");
  if (!outcome.text.empty() && outcome.text.back() != '\n') outcome.text += '\n';
  return outcome;
}

class FaultyLine : public testing::TestWithParam<Entry> {};

TEST_P(FaultyLine, EndsAsRecorded) {
  if (std::getenv("SLUICE_RECORD") != nullptr) GTEST_SKIP() << "all are recorded again";
  const Outcome outcome = outcome_of(GetParam().words);
  EXPECT_EQ(outcome.status, GetParam().status) << GetParam().words;
  EXPECT_EQ(outcome.text, GetParam().said) << GetParam().words;
}

INSTANTIATE_TEST_SUITE_P(All, FaultyLine, testing::ValuesIn(recorded()),
                         [](const auto& line) { return fmt::format("Line{:02}", line.index + 1); });

// A faulty line is bad input, or names a file that the system refuses; something is said of it.
TEST(FaultyLines, AreSixtyAndSaySomething) {
  const std::vector<Entry> entries = recorded();
  EXPECT_GE(entries.size(), 60U);
  for (const Entry& e : entries) {
    EXPECT_TRUE(e.status == 2 || e.status == 3) << e.words;
    EXPECT_GT(e.said.size(), 10U) << e.words;
  }
}

TEST(FaultyLines, AreRecordedAgainWhereAsked) {
  if (std::getenv("SLUICE_RECORD") == nullptr) GTEST_SKIP() << "SLUICE_RECORD is not set";
  const std::string before = text_of(list);
  std::string text = before.substr(0, before.find("\n$ ") + 1);
  for (const Entry& e : recorded()) {
    const Outcome outcome = outcome_of(e.words);
    text += fmt::format("$ {}\n= {}\n", e.words, outcome.status);
    std::istringstream said(outcome.text);
    for (std::string line; std::getline(said, line);) text += "| " + line + "\n";
  }
  std::ofstream(list) << text;
}

}  // namespace
}  // namespace sluice::faulty_lines_test
