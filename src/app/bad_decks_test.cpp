// A corpus of bad decks: each is the good deck with one edit, and must be refused by
// `sluice check` with exit status 2, the right line and the right message. No clock is asked: what
// would grow without end never comes to its end, or to that of the memory that it is given here.
//
// The edits stand in src/framework/deck/bad_decks/*.rows, one paragraph each:
//   name: what is bad
//   from: text of good.ups (of solids.rows: good_solid.ups), of which the first occurrence is
//     replaced (\n: line end, \xff: byte)
//   to: the text in its place
//   line: where the message must point; 0: not checked
//   says: a piece of the message; {file}: the edited deck
//   status: 0 where a warning is all
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "app/command/command_test_support.hpp"
#include "framework/base/temporary_folder.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::bad_decks_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

#ifdef __SANITIZE_ADDRESS__
const std::string limit;  // the sanitizer reserves all addresses
#else
const std::string limit = "ulimit -v 1048576; ";  // KiB
#endif
const fs::path corpus = SLUICE_SOURCE_DIR "/src/framework/deck/bad_decks";

struct BadDeck {
  std::string name, from, to, message;
  int line = 0;
  int status = 2;
};

Outcome check(const std::string& arguments) {
  return run_in_shell(limit + SLUICE_COMMAND + " check " + arguments);
}

// A folder of its own for the edited decks, with the fragments that some include.
class Folder {
 public:
  Folder() {
    for (const auto& entry : fs::directory_iterator(corpus))
      fs::copy_file(entry.path(), folder_ / entry.path().filename());
  }
  std::string write(const std::string& name, const std::string& text) const {
    const fs::path file = folder_ / name;
    std::ofstream(file, std::ios::binary) << text;
    return file.string();
  }

 private:
  TemporaryFolder folder_;
};

std::string edited(const std::string& good, const BadDeck& bad) {
  std::string text = good;
  const auto at = text.find(bad.from);
  EXPECT_NE(at, std::string::npos) << bad.name << ": nothing to edit";
  if (at != std::string::npos) text.replace(at, bad.from.size(), bad.to);
  return text;
}

void expect_refused(const BadDeck& bad, const std::string& file, const Outcome& outcome) {
  SCOPED_TRACE(bad.name);
  EXPECT_EQ(outcome.status, bad.status) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr(bad.message));
  if (bad.line == 0) return;
  // The message stands in a line that begins with the file and this line number.
  const std::string place = file + ':' + std::to_string(bad.line) + ':';
  bool found = false;
  for (std::size_t at = outcome.text.find(place); at != std::string::npos && !found;
       at = outcome.text.find(place, at + 1)) {
    const auto end = outcome.text.find('\n', at);
    found = outcome.text.substr(at, end - at).find(bad.message) != std::string::npos;
  }
  EXPECT_TRUE(found) << "expected at line " << bad.line << ", got\n" << outcome.text;
}

std::string unescaped(std::string text) {
  const std::pair<const char*, const char*> escapes[] = {
      {"\\n", "\n"}, {"\\xff", "\xff"}, {"\\xfe", "\xfe"}};
  for (const auto& [written, meant] : escapes) {
    for (auto at = text.find(written); at != std::string::npos; at = text.find(written)) {
      text.replace(at, std::string(written).size(), meant);
    }
  }
  return text;
}

BadDeck with_name_of(const std::string& file, BadDeck bad) {
  const std::string mark = "{file}";
  const auto at = bad.message.find(mark);
  if (at != std::string::npos) bad.message.replace(at, mark.size(), file);
  return bad;
}

std::vector<BadDeck> read_rows(const fs::path& file) {
  std::vector<BadDeck> rows;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const auto colon = line.find(':');
    if (line.empty() || line[0] == '#' || colon == std::string::npos) continue;
    const std::string key = line.substr(0, colon);
    const std::string value = line.size() > colon + 2 ? line.substr(colon + 2) : "";
    if (key == "name") rows.push_back({value, "", "", "", 0, 2});
    if (key == "from") rows.back().from = unescaped(value);
    if (key == "to") rows.back().to = unescaped(value);
    if (key == "says") rows.back().message = value;
    if (key == "line") rows.back().line = std::stoi(value);
    if (key == "status") rows.back().status = std::stoi(value);
  }
  return rows;
}

class BadDecks : public ::testing::TestWithParam<const char*> {};

// The rows of a set, and the edited decks in a folder.
struct Edited {
  Folder folder;
  std::vector<BadDeck> rows;
  std::vector<std::string> files;

  explicit Edited(const std::string& set) : rows(read_rows(corpus / (set + ".rows"))) {
    const std::string good = text_of(corpus / (set == "solids" ? "good_solid.ups" : "good.ups"));
    for (BadDeck& bad : rows) {
      EXPECT_FALSE(bad.message.empty()) << bad.name;
      files.push_back(folder.write(bad.name + ".ups", edited(good, bad)));
      bad = with_name_of(files.back(), bad);
    }
    EXPECT_GE(rows.size(), 10u);
  }
};

// What one process said of each of several decks: it ends with the deck's name and verdict.
std::vector<Outcome> parts_of(const std::string& text, const std::vector<std::string>& files) {
  std::vector<Outcome> parts;
  std::size_t from = 0;
  for (const std::string& file : files) {
    const auto ends_with = [&](const char* verdict) {
      const std::string words = file + ": " + verdict + ", ";
      const auto at =
          text.compare(from, words.size(), words) == 0 ? from : text.find("\n" + words, from);
      return at == std::string::npos ? at : text.find('\n', at + 1);
    };
    const auto good = ends_with("good"), bad = ends_with("bad");
    const auto to = std::min(good, bad);
    EXPECT_NE(to, std::string::npos) << "no verdict on " << file;
    if (to == std::string::npos) return parts;
    parts.push_back({to == bad ? 2 : 0, text.substr(from, to + 1 - from)});
    from = to + 1;
  }
  return parts;
}

TEST_P(BadDecks, AreRefused) {
  const Edited decks(GetParam());
  std::string all;
  for (const std::string& file : decks.files) all += " " + file;
  const Outcome outcome = check(all);
  EXPECT_EQ(outcome.status, 2);
  const std::vector<Outcome> parts = parts_of(outcome.text, decks.files);
  ASSERT_EQ(parts.size(), decks.rows.size()) << outcome.text;
  for (std::size_t n = 0; n < parts.size(); ++n)
    expect_refused(decks.rows[n], decks.files[n], parts[n]);
}

TEST_P(BadDecks, FullAreRefusedByAProcessOfTheirOwn) {
  const Edited decks(GetParam());
  for (std::size_t n = 0; n < decks.rows.size(); ++n)
    expect_refused(decks.rows[n], decks.files[n], check(decks.files[n]));
}

INSTANTIATE_TEST_SUITE_P(Of, BadDecks,
                         ::testing::Values("values", "grids", "boundaries", "materials", "models",
                                           "output", "solids", "not_built", "xml"),
                         [](const auto& set) { return std::string(set.param); });

TEST(BadDeckChecks, TheGoodOnesAreGood) {
  for (const char* deck : {"good.ups", "good_solid.ups"}) {
    const Outcome outcome = check((corpus / deck).string());
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("good, 0 errors, 0 warnings"));
  }
}

// Bombs and giants, made here because they are large.
TEST(BadDeckChecks, BombsAreRefusedAtOnce) {
  const Folder folder;
  std::string laughs = "<!DOCTYPE r [<!ENTITY a0 \"ha\">\n";
  for (int i = 1; i < 20; ++i) {
    const std::string inner = "&a" + std::to_string(i - 1) + ";";
    laughs += "<!ENTITY a" + std::to_string(i) + " \"";
    for (int k = 0; k < 10; ++k) laughs += inner;
    laughs += "\">\n";
  }
  std::string deep = "<Uintah_specification>";
  for (int i = 0; i < 100000; ++i) deep += "<union>";
  std::string wide = "<Uintah_specification>";
  for (int i = 0; i < 1000000; ++i) wide += "<a/>";
  std::string long_value = "<Uintah_specification><Meta><title>" + std::string(12000000, 'x') +
                           "</title></Meta></Uintah_specification>";
  std::string chain;  // includes that nest without a loop
  for (int i = 0; i < 60; ++i) {
    folder.write("chain_" + std::to_string(i) + ".xml", "<Uintah_Include><include href=\"chain_" +
                                                            std::to_string(i + 1) +
                                                            ".xml\"/></Uintah_Include>");
  }
  chain = "<Uintah_specification><include href=\"chain_0.xml\"/></Uintah_specification>";

  // Each piece repeats the one before twice: 2^40 boxes.
  std::string doubling = "<Uintah_specification><geom_object><union label=\"u0\"><null/></union>";
  for (int i = 1; i < 40; ++i) {
    const std::string before = "<union label=\"u" + std::to_string(i - 1) + "\"/>";
    doubling += "<union label=\"u" + std::to_string(i) + "\">" + before + before + "</union>";
  }
  doubling += "</geom_object></Uintah_specification>";

  const struct {
    const char* name;
    std::string text;
    const char* message;
  } bombs[] = {
      {"laughs", laughs + "]><r>&a19;</r>", "may not declare entities"},
      {"deep", deep, "nested deeper than"},
      {"wide", wide + "</Uintah_specification>", "too many elements"},
      {"long", long_value, "needs <SimulationComponent>"},
      {"huge", std::string((16u << 20) + 1, ' '), "more than the limit of"},
      {"chain", chain, "too many includes"},
      {"doubling", doubling, "repeats pieces endlessly"},
      {"empty", "", "the file is empty"},
      {"binary", std::string("\x89PNG\r\n\x1a\n\0\0\0", 11), "XML:"},
  };
  for (const auto& bomb : bombs) {
    SCOPED_TRACE(bomb.name);
    const Outcome outcome = check(folder.write(std::string(bomb.name) + ".ups", bomb.text));
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.text.substr(0, 20000), HasSubstr(bomb.message));
  }
}

TEST(BadDeckChecks, AllFaultsAreFoundInOnePass) {
  const Folder folder;
  std::string text = text_of(corpus / "good.ups");
  const auto edit = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  edit("<cfl>0.4</cfl>", "<clf>0.4</clf>");
  edit("<gamma>1.4</gamma>", "");
  edit("ideal_gas", "idael_gas");
  edit("label=\"Velocity\"", "label=\"Velocty\"");
  edit("<upper>[1,", "<upper>[-1,");
  const Outcome outcome = check(folder.write("many.ups", text));
  EXPECT_EQ(outcome.status, 2);
  for (const char* message : {"<clf> does not exist", "<material> needs <gamma>", "idael_gas",
                              "Velocty", "no condition for Velocity", "inverted in x"}) {
    EXPECT_THAT(outcome.text, HasSubstr(message));
  }
}

TEST(BadDeckChecks, OverridesThatFailSayWhy) {
  const std::string good = (corpus / "good.ups").string();
  const struct {
    const char* set;
    const char* message;
  } rows[] = {
      {"CFD/clf=0.3", "<CFD> has no <clf> (did you mean 'cfl'?)"},
      {"CFD/cfl=7", "--set CFD/cfl=7: error: <cfl>: '7' is out of range"},
      {"CFD/cfl", "there is no '='"},
      {"=3", "the path is empty"},
      {"CFD/ICE/advection/@tpye=FirstOrder", "did you mean 'type'?"},
      {"Grid/Level[2]/spacing=[1,1,1]", "there is no <Level>[2] in <Grid>: it has 1"},
      {"Grid/Level[x]/spacing=[1,1,1]", "neither a number from 1 on"},
      {"Grid/Level/Box[@label=nose]/patches=[1,1,1]", "no <Box> in <Level> has label=\"nose\""},
      {"DataArchiver/save/@label=vel_CC", "choose one with save[1]"},
      {"Gird/Level/Box/resolution=[5,1,1]", "did you mean 'Grid'?"},
  };
  for (const auto& row : rows) {
    SCOPED_TRACE(row.set);
    const Outcome outcome = check("--set '" + std::string(row.set) + "' " + good);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.text, HasSubstr(row.message));
  }
}

}  // namespace
}  // namespace sluice::bad_decks_test
