// On-the-fly analyses of several levels: the same text on ranks, boxes and after a restart while
// levels follow the flow, with the values that the archive holds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "framework/archive/archive.hpp"
#include "framework/base/temporary_folder.hpp"
#include "sluice_source_dir.hpp"
#include "verification/case_run.hpp"

namespace sluice::verification::analysis_levels_test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

void put_before(std::string& text, const std::string& place, const std::string& added) {
  const std::size_t at = text.rfind(place);
  ASSERT_NE(at, text.npos) << place;
  text.insert(at, added);
}

const char* const analysis = R"(
  <DataAnalysis>
    <Module name="minMax"><material>gas</material><samplingFrequency>1e10</samplingFrequency>
      <timeStart>0</timeStart><timeStop>100</timeStop>
      <Variables><analyze label="press_CC"/><analyze label="vel_CC" level="-1"/>
        <analyze label="uvel_FCME"/><analyze label="uvel_FC" level="0-1"/></Variables></Module>
    <Module name="lineExtract"><material>gas</material><samplingFrequency>1e10</samplingFrequency>
      <timeStart>0</timeStart><timeStop>100</timeStop>
      <Variables><analyze label="rho_CC"/><analyze label="vvel_FCME" level="1-2"/></Variables>
      <lines><line name="across"><startingPt>[-0.9, -0.8, 0]</startingPt>
        <endingPt>[0.9, 0.9, 0]</endingPt></line></lines></Module>
  </DataAnalysis>
)";

// A deck of inputs/ice, changed.
class ChangedDeck {
 public:
  explicit ChangedDeck(const std::string& name)
      : text_(text_of(fs::path(SLUICE_SOURCE_DIR) / "inputs/ice" / name)) {
    put_before(text_, "</", analysis);
    put_before(text_, "<save ", "<checkpoint interval=\"0.05\"/>");
  }
  std::string& text() { return text_; }
  std::string write() const {
    const fs::path path = folder_ / "deck.ups";
    std::ofstream(path) << text_;
    return path.string();
  }

 private:
  std::string text_;
  TemporaryFolder folder_;
};

std::map<std::string, std::string> analysis_files(const CaseRun& run) {
  std::map<std::string, std::string> files;
  for (const char* top : {"MinMax", "across"})
    for (const auto& entry : fs::recursive_directory_iterator(run.archive() / top))
      if (entry.is_regular_file())
        files[fs::relative(entry.path(), run.archive()).string()] = text_of(entry.path());
  return files;
}

// The words of the last line.
std::vector<double> last_numbers(const std::string& text) {
  std::istringstream line(text.substr(text.rfind('\n', text.size() - 2) + 1));
  std::vector<double> numbers;
  for (double x; line >> x;) numbers.push_back(x);
  return numbers;
}

TEST(FullAnalysisOfLevels, TheSameTextOnRanksBoxesAndAfterARestartWhileLevelsMove) {
  const ChangedDeck deck("amr_explosion.ups");
  const std::vector<std::string> settings = {resolution(32, 32), "Time/maxTime=0.15"};
  const CaseRun plain(deck.write(), settings);
  const auto files = analysis_files(plain);
  ASSERT_EQ(files.count("MinMax/L-2/vel_CC_0"), 1u);
  EXPECT_EQ(files.count("MinMax/L-1/vel_CC_0"), 0u);
  EXPECT_EQ(files.count("MinMax/L-2/uvel_FC_0"), 0u);
  // Cells of the finest level came, and not all at once.
  std::map<long, int> samples;
  for (const auto& [name, text] : files)
    if (name.find("across/L-2/") == 0) ++samples[std::count(text.begin(), text.end(), '\n')];
  EXPECT_GT(samples.size(), 2u);

  const CaseRun ranks(deck.write(), settings, {"--boxes", "3,2,1"}, 2);
  EXPECT_EQ(analysis_files(ranks), files);
  const CaseRun stopped(deck.write(), settings, {"--max-steps", std::to_string(plain.steps() - 2)});
  const int kept = Archive::open(stopped.archive()).checkpoints().front().step;
  const CaseRun restarted(
      deck.write(), settings,
      {"--restart", stopped.archive().string(), "--step", std::to_string(kept)});
  ASSERT_LT(restarted.steps(), plain.steps());
  EXPECT_EQ(analysis_files(restarted), files);
}

TEST(AnalysisOfLevels, HoldWhatTheArchiveHoldsOfAStaticLevel) {
  ChangedDeck deck("explosion_2d.ups");
  std::string& text = deck.text();
  text.replace(text.find("[128,128,1]"), 11, "[32,32,1]");
  put_before(text, "</Grid>", R"(<Level><Box label="fine"><lower>[-0.5,-0.5,0]</lower>
    <upper>[0.5,0.5,0.015625]</upper><extraCells>[0,0,0]</extraCells><patches>[1,1,1]</patches>
    <resolution>[32,32,1]</resolution></Box></Level>)");
  put_before(text, "<DataArchiver>", R"(<AMR type="StaticGridML"><ICE>
    <orderOfInterpolation>1</orderOfInterpolation></ICE></AMR>)");
  const CaseRun run(deck.write(), {"Time/maxTime=0.1"});
  const auto files = analysis_files(run);
  const Archive archive = Archive::open(run.archive());
  const ArchiveStep last = archive.read_output(archive.outputs().back());
  for (int level = 0; level < 2; ++level) {
    const std::string folder = "L-" + std::to_string(level) + "/";
    const DenseField pressure = last.read(*last.find("press_CC", 0, level));
    const auto [least, most] =
        std::minmax_element(pressure.components[0].begin(), pressure.components[0].end());
    EXPECT_THAT(last_numbers(files.at("MinMax/" + folder + "press_CC_0")),
                testing::ElementsAre(last.info().time, *least, *most));
    const DenseField density = last.read(*last.find("rho_CC", 0, level));
    int sampled = 0;
    for_each_cell(density.cells, [&](IntVec3 c) {
      const auto file = files.find("across/" + folder + "i" + std::to_string(c.x) + "_j" +
                                   std::to_string(c.y) + "_k0");
      if (file == files.end()) return;
      ++sampled;
      const std::vector<double> numbers = last_numbers(file->second);
      ASSERT_EQ(numbers.size(), level == 0 ? 6u : 7u);
      EXPECT_EQ(numbers[5], density.at(c));
      const Vec3 centre = last.grid().levels[static_cast<std::size_t>(level)].centre(c);
      EXPECT_EQ(numbers[0], centre.x);
      EXPECT_EQ(numbers[1], centre.y);
    });
    EXPECT_GT(sampled, 30);
    EXPECT_EQ(sampled, std::count_if(files.begin(), files.end(), [&](const auto& f) {
                return f.first.find("across/" + folder) == 0;
              }));
  }
}

}  // namespace
}  // namespace sluice::verification::analysis_levels_test
