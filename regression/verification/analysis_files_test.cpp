// Files of on-the-fly analyses: the same text on ranks, boxes and after a restart, with the values
// that the archive holds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "app/process/study_process.hpp"
#include "framework/archive/archive.hpp"
#include "framework/base/temporary_folder.hpp"
#include "sluice_source_dir.hpp"
#include "verification/case_run.hpp"

namespace sluice::verification::analysis_files_test {
namespace {

namespace fs = std::filesystem;

const char* const analysis = R"(
  <DataAnalysis>
    <Module name="minMax"><material>gas</material><samplingFrequency>1e10</samplingFrequency>
      <timeStart>0</timeStart><timeStop>100</timeStop>
      <Variables><analyze label="press_CC" matl="0"/><analyze label="vel_CC"/>
        <analyze label="uvel_FC"/></Variables></Module>
    <Module name="lineExtract"><material>gas</material><samplingFrequency>20</samplingFrequency>
      <timeStart>0.1</timeStart><timeStop>0.3</timeStop>
      <Variables><analyze label="rho_CC"/><analyze label="vel_CC"/><analyze label="vvel_FCME"/>
      </Variables>
      <lines>
        <line name="across"><startingPt>[-3, -0.9, 0]</startingPt>
          <endingPt>[0.9, 0.9, 0]</endingPt></line>
        <line name="up"><startingPt>[0.1, -0.5, 0]</startingPt><endingPt>[0.1, 0.5, 0]</endingPt>
          <stepSize>0.25</stepSize></line>
      </lines></Module>
  </DataAnalysis>
</)";

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

// The explosion deck with a <DataAnalysis> before the end of its last element.
class DeckWithAnalysis {
 public:
  explicit DeckWithAnalysis(const std::string& block = analysis) {
    std::string text = text_of(fs::path(SLUICE_SOURCE_DIR) / "inputs/ice/explosion_2d.ups");
    const std::size_t end = text.rfind("</");
    text.replace(end, 2, block);
    const std::string saves = "<save label=\"rho_CC\"/>";
    text.replace(text.find(saves), saves.size(), saves + "<checkpoint interval=\"0.15\"/>");
    std::ofstream(path()) << text;
  }
  std::string path() const { return (folder_ / "deck.ups").string(); }

 private:
  TemporaryFolder folder_;
};

const std::vector<std::string> settings = {resolution(30, 26), "Time/maxTime=0.4",
                                           "DataArchiver/outputInterval=0.1"};

// Path below the archive and text of every file that an analysis wrote.
std::map<std::string, std::string> analysis_files(const CaseRun& run) {
  std::map<std::string, std::string> files;
  for (const char* top : {"MinMax", "across", "up"})
    for (const auto& entry : fs::recursive_directory_iterator(run.archive() / top))
      if (entry.is_regular_file())
        files[fs::relative(entry.path(), run.archive()).string()] = text_of(entry.path());
  return files;
}

int count_lines(const std::string& text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

TEST(AnalysisFiles, TheSameTextOnRanksBoxesAndAfterARestart) {
  const DeckWithAnalysis deck;
  const CaseRun plain(deck.path(), settings);
  const auto files = analysis_files(plain);
  ASSERT_EQ(files.count("MinMax/L-0/vel_CC_0"), 1u);
  ASSERT_GT(files.size(), 30u);
  const CaseRun ranks(deck.path(), settings, {"--boxes", "3,2,1"}, 2);
  EXPECT_EQ(analysis_files(ranks), files);
  const CaseRun lazy(deck.path(), settings, {"--force-all"});
  EXPECT_EQ(analysis_files(lazy), files);

  // Stopped somewhere after the first checkpoint, then continued from that one.
  const CaseRun stopped(deck.path(), settings, {"--max-steps", std::to_string(plain.steps() - 2)});
  const int kept = Archive::open(stopped.archive()).checkpoints().front().step;
  const CaseRun restarted(
      deck.path(), settings,
      {"--restart", stopped.archive().string(), "--step", std::to_string(kept)});
  ASSERT_LT(restarted.steps(), plain.steps());
  EXPECT_EQ(analysis_files(restarted), files);
}

TEST(AnalysisFiles, HoldWhatTheArchiveHolds) {
  const DeckWithAnalysis deck;
  const CaseRun run(deck.path(), settings);
  const auto files = analysis_files(run);
  // The last sample of minMax is the last output.
  const std::string& extremes = files.at("MinMax/L-0/press_CC_0");
  EXPECT_EQ(count_lines(extremes), run.steps() + 1);
  std::istringstream last(extremes.substr(extremes.rfind('\n', extremes.size() - 2) + 1));
  double time = 0, least = 0, most = 0;
  last >> time >> least >> most;
  const CellValues pressure = run.field("press_CC");
  EXPECT_EQ(time, pressure.time);
  EXPECT_EQ(least, lowest(pressure));
  EXPECT_EQ(most, highest(pressure));
  // Lines: 20 samples a unit of time from 0.1 to 0.3, as far as the steps allow.
  ASSERT_EQ(files.count("up/L-0/i16_j6_k0"), 1u);
  const int samples = count_lines(files.at("up/L-0/i16_j6_k0")) - 1;
  EXPECT_GE(samples, 2);
  EXPECT_LE(samples, 5);
  std::istringstream line(files.at("up/L-0/i16_j6_k0"));
  std::string header;
  std::getline(line, header);
  EXPECT_EQ(header, "# X Y Z Timestep Time rho_CC_0 vel_CC_0.x vel_CC_0.y vel_CC_0.z vvel_FCME_0");
  double x = 0, y = 0, z = 0, first_time = 0, rho = 0;
  int step = 0;
  line >> x >> y >> z >> step >> first_time >> rho;
  const Vec3 centre = pressure.centre(16, 6);
  EXPECT_EQ(x, centre.x);
  EXPECT_EQ(y, centre.y);
  EXPECT_GE(first_time, 0.1);
  EXPECT_LT(first_time, 0.15);
  EXPECT_GT(step, 1);
  EXPECT_GT(rho, 0.1);
}

TEST(AnalysisFiles, ALineThatLeavesTheDomainIsTold) {
  const DeckWithAnalysis deck;
  const CaseRun run(deck.path(), settings, {"--max-steps", "1"});
  const std::string said = text_of(run.folder() / "run.log");
  EXPECT_NE(said.find("line 'across' extends beyond the domain"), std::string::npos) << said;
  EXPECT_EQ(said.find("line 'up'"), std::string::npos) << said;
}

TEST(AnalysisFiles, UnknownLabelsAndDoubleNamesAreRefused) {
  const auto message = [](std::string from, const std::string& to) {
    std::string block = analysis;
    block.replace(block.find(from), from.size(), to);
    const DeckWithAnalysis deck(block);
    try {
      const CaseRun run(deck.path(), settings);
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string("it ran");
  };
  EXPECT_THAT(message("rho_CC", "rho_C"), testing::HasSubstr("did you mean 'rho_CC'"));
  EXPECT_THAT(message("rho_CC", "TotalMass"), testing::HasSubstr("names no field of this run"));
  EXPECT_THAT(message("\"up\"", "\"across\""), testing::HasSubstr("choose another name"));
  EXPECT_THAT(message("\"up\"", "\"t00010\""), testing::HasSubstr("choose another name"));
}

}  // namespace
}  // namespace sluice::verification::analysis_files_test
