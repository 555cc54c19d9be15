// On-the-fly analysis of whole runs: budgets that close on moving levels, and files that neither
// ranks, boxes, threads nor a restart change.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "app/archive_runs_test_support.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::analysis_runs_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// The numbers of a file, a vector a line.
std::vector<std::vector<double>> lines_of(const fs::path& path) {
  std::vector<std::vector<double>> lines;
  std::istringstream text(text_of(path));
  for (std::string line; std::getline(text, line);) {
    if (line.empty() || line[0] == '#') continue;
    for (char& c : line)
      if (c == ',' || c == '[' || c == ']') c = ' ';
    std::istringstream words(line);
    lines.emplace_back();
    for (double x = 0; words >> x;) lines.back().push_back(x);
  }
  return lines;
}

constexpr const char* times =
    "<materialIndex>0</materialIndex><samplingFrequency>30</samplingFrequency>"
    "<timeStart>0.05</timeStart><timeStop>9</timeStop>";

std::string module_text(const std::string& name, const std::string& content) {
  return "<Module name=\"" + name + "\">" + times + content + "</Module>\n";
}

class AnalysisRuns : public ArchiveRuns {
 protected:
  // One of our decks with these modules.
  void write_deck(const std::string& deck, const std::string& modules,
                  const std::string& saves_too = "") {
    std::string text = text_of(fs::path(SLUICE_SOURCE_DIR "/inputs/ice") / (deck + ".ups"));
    const std::string end = "</Uintah_specification>";
    const auto at = text.rfind(end);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, end.size(), "<DataAnalysis>" + modules + "</DataAnalysis>" + end);
    text.insert(text.find("</DataArchiver>"), saves_too);
    std::ofstream(folder_ / "deck.ups") << text;
  }
  std::string deck() const { return (folder_ / "deck.ups").string(); }

  // Every file that analyses have written: those of the archive that are neither XML, JSON nor
  // fields.
  static std::map<std::string, std::string> samples(const fs::path& archive) {
    std::map<std::string, std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(archive)) {
      const std::string name = fs::relative(entry.path(), archive).string();
      const std::string end = entry.path().extension().string();
      if (!entry.is_regular_file() || end == ".xml" || end == ".h5" || end == ".xmf" ||
          end == ".json" || name == "levels.txt")
        continue;
      found[name] = text_of(entry.path());
    }
    return found;
  }
};

// The change of what is held between two lines is what the rates of the second say: columns of
// what is held, and for each the columns of what adds to it (from the second group on).
void expect_closed(const std::vector<std::vector<double>>& lines, std::size_t held,
                   const std::vector<std::pair<std::size_t, double>>& rates, double size,
                   double tolerance) {
  ASSERT_GE(lines.size(), 5u);
  for (std::size_t n = 1; n < lines.size(); ++n) {
    const double dt = lines[n][0] - lines[n - 1][0];
    double gained = 0;
    for (const auto& [column, sign] : rates) gained += sign * lines[n][column] * dt;
    EXPECT_NEAR(lines[n][held] - lines[n - 1][held], gained, tolerance * size)
        << "column " << held << ", line " << n;
  }
}

const std::string square = "<box><min>[-1,-2,0]</min><max>[2,1,1]</max></box>";
const std::string budgets =
    module_text("controlVolFluxes",
                "<controlVolumes><box label=\"square\"><min>[-1,-2,0]</min><max>[2,1,1]</max></box>"
                "</controlVolumes>") +
    module_text("momentumAnalysis", "<controlVolume>" + square + "</controlVolume>") +
    module_text("firstLawThermo", "<controlVolume>" + square + "</controlVolume>");
const std::string small = " --set Time/maxTime=0.6 --set Grid/Level/Box/resolution=[32,32,1]";

// A vortex that moves into the volume, followed by a finer level. The volume holds 9/8 of mass,
// momentum and energy of the order of 1. Measured: 1e-16, 2e-16, 4e-16.
TEST_F(AnalysisRuns, BudgetsCloseWhileLevelsMove) {
  write_deck("amr_vortex_followed", budgets);
  const fs::path archive = run("a", deck() + small);
  const auto mass = lines_of(archive / "square.dat");
  expect_closed(mass, 1, {{2, 1.0}, {3, 1.0}, {4, 1.0}}, 1, 2e-15);
  double most = 0;
  for (const auto& line : mass) {
    EXPECT_NEAR(line[2], line[5] - line[6], 1e-14);
    EXPECT_NEAR(line[3], line[7] - line[8], 1e-14);
    EXPECT_EQ(line[9], 0.0) << "z is no dimension of this run";
    most = std::max(most, std::fabs(line[5]));
  }
  EXPECT_GT(most, 0.1) << "something flows";
  const auto momentum = lines_of(archive / "momentumAnalysis.dat");
  for (std::size_t d = 0; d < 3; ++d)
    expect_closed(momentum, 1 + d, {{4 + d, 1.0}, {7 + d, 1.0}, {10 + d, 1.0}, {13 + d, 1.0}}, 1,
                  2e-15);
  auto energy = lines_of(archive / "1stLawThermo.dat");
  for (auto& line : energy) line.push_back(line[3] + line[5]);  // internal and kinetic
  expect_closed(energy, 7, {{4, -1.0}, {6, 1.0}}, 1, 4e-15);
}

// A tenfold pressure jump in a closed tube with gravity and friction; pressures of the order of 10.
// The second budget is of the whole tube. Measured: 2e-15 of it.
TEST_F(AnalysisRuns, BudgetsCloseUnderGravityWithFriction) {
  const std::string part = "<box><min>[0.1,0,0]</min><max>[0.7,1,1]</max></box>";
  write_deck("hot_gas_under_gravity",
             module_text("momentumAnalysis", "<controlVolume>" + part + "</controlVolume>") +
                 module_text("firstLawThermo", "<controlVolume/>"));
  const fs::path archive =
      run("a", deck() + " --set MaterialProperties/ICE/material/dynamic_viscosity=0.01");
  const auto momentum = lines_of(archive / "momentumAnalysis.dat");
  expect_closed(momentum, 1, {{4, 1.0}, {7, 1.0}, {10, 1.0}, {13, 1.0}}, 10, 4e-15);
  double friction = 0;
  for (const auto& line : momentum) {
    EXPECT_LT(line[13], -0.05) << "gravity pulls";
    friction = std::max(friction, std::fabs(line[7]));
  }
  EXPECT_GT(friction, 1e-3);
  auto energy = lines_of(archive / "1stLawThermo.dat");
  for (auto& line : energy) {
    EXPECT_NEAR(line[4], 0.0, 1e-18) << "nothing passes a wall";
    EXPECT_NE(line[6], 0.0);
    line.push_back(line[3] + line[5]);
  }
  expect_closed(energy, 7, {{4, -1.0}, {6, 1.0}}, 10, 4e-15);
}

// All gas falls alike, u = (1, -10 t, 0): variances follow from times of samples, sums of masses
// over planes are the mass, means by mass the velocity.
TEST_F(AnalysisRuns, FreeFallHasTheStatisticsOfItsTimes) {
  const std::string every_step =
      "<materialIndex>0</materialIndex><samplingFrequency>1e10</samplingFrequency>"
      "<timeStart>0.01</timeStart><timeStop>0.04</timeStop>";
  write_deck("free_fall",
             "<Module name=\"turbulentFluxes\">" + every_step +
                 "<Variables><analyze label=\"vel_CC\" fluidVelocityLabel=\"true\"/>"
                 "<analyze label=\"temp_CC\"/></Variables></Module>"
                 "<Module name=\"planeAverage\">" +
                 every_step +
                 "<planeOrientation>YZ</planeOrientation><weight label=\"mass_adv\"/><Variables>"
                 "<analyze label=\"mass_adv\"/><analyze label=\"vel_CC\" weighting=\"mass\"/>"
                 "</Variables></Module>",
             "<save label=\"variance_vel_CC\"/><save label=\"mean_vel_CC\"/>"
             "<save label=\"uv_vw_wu_prime\"/><save label=\"covariance_temp_CC\"/>");
  const fs::path archive = run("a", deck());
  std::vector<double> fallen;
  for (const auto& step : fs::directory_iterator(archive / "planeAverage")) {
    const fs::path folder = step.path() / "L-0";
    const std::string head = "# Simulation time: ";
    const double time = std::stod(text_of(folder / "vel_CC_0").substr(head.size()));
    fallen.push_back(-10 * time);
    double mass = 0;
    for (const auto& line : lines_of(folder / "mass_adv_0")) mass += line[3];
    EXPECT_NEAR(mass, 0.025, 1e-16);
    for (const auto& line : lines_of(folder / "vel_CC_0")) {
      EXPECT_NEAR(line[3], 1.0, 1e-14);
      EXPECT_NEAR(line[4], -10 * time, 1e-14);
    }
  }
  ASSERT_GE(fallen.size(), 3u);
  double mean = 0, variance = 0;
  for (const double v : fallen) mean += v / static_cast<double>(fallen.size());
  for (const double v : fallen)
    variance += (v - mean) * (v - mean) / static_cast<double>(fallen.size());
  EXPECT_GT(variance, 1e-4);
  const auto last = [&](const std::string& label) {  // x, y, z of the first cell
    const fs::path csv = folder_ / (label + ".csv");
    const std::string command = std::string(SLUICE_COMMAND) + " extract " + archive.string() +
                                " --var " + label + " --time last --csv " + csv.string();
    EXPECT_EQ(std::system(command.c_str()), 0);
    std::string text = text_of(csv);
    text.erase(0, text.find('\n') + 1);
    std::istringstream line(text.substr(0, text.find('\n')));
    std::vector<double> words;
    for (std::string word; std::getline(line, word, ',');) words.push_back(std::stod(word));
    return std::vector<double>(words.end() - 3, words.end());
  };
  EXPECT_NEAR(last("mean_vel_CC")[1], mean, 1e-14);
  EXPECT_NEAR(last("variance_vel_CC")[1], variance, 1e-14);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(last("uv_vw_wu_prime")[c], 0.0, 1e-15);
}

// A module of planes, each by two corners.
std::string planes_of_heat(const std::vector<std::pair<std::string, std::string>>& corners) {
  std::string planes;
  for (const auto& [start, end] : corners)
    planes +=
        "<plane><startingPt>" + start + "</startingPt><endingPt>" + end + "</endingPt></plane>";
  return "<Module name=\"flatPlate_heatFlux\">" + planes + "</Module>\n";
}
const std::string save_heat = "<save label=\"total_heatRate\"/><save label=\"TotalIntEng\"/>";

// The bar loses through its cold end, x = 0, what it has less: step by step to round-off; and as
// fast as Fourier's series says. Measured: 2e-16 of it, and 1.0e-4.
TEST_F(AnalysisRuns, HeatThroughAnEndIsWhatTheBarHasLess) {
  write_deck("conduction_bar", planes_of_heat({{"[0,-1,-1]", "[0,1,1]"}}), save_heat);
  const fs::path archive = run("a", deck());
  const auto rate = lines_of(archive / "total_heatRate.dat");
  const auto energy = lines_of(archive / "TotalIntEng.dat");
  ASSERT_EQ(rate.size(), energy.size());
  double worst = 0, size = std::fabs(energy.front()[1]);
  for (std::size_t n = 1; n < rate.size(); ++n) {
    const double dt = rate[n][0] - rate[n - 1][0];
    worst = std::max(worst, std::fabs(energy[n][1] - energy[n - 1][1] - rate[n][1] * dt));
  }
  EXPECT_LE(worst, 1e-15 * size);
  RecordProperty("worst", fmt::format("{}", worst / size));
  constexpr double pi = std::numbers::pi;
  const double time = rate.back()[0] - 0.5 * (rate.back()[0] - rate[rate.size() - 2][0]);
  const double wanted = -0.2 * (pi / 2) * std::exp(-0.1 * (pi / 2) * (pi / 2) * time) / (32 * 32);
  EXPECT_NEAR(rate.back()[1] / wanted, 1, 3e-4);
}

// Between the plates of couette_heated: mu u^2 is made and goes through the cold one; the hot
// one, at the high end of the domain, lets none through. Measured: 2e-9 of it.
const std::pair<std::string, std::string> cold_plate{"[-1,0,-1]", "[1,0,1]"},
    hot_plate{"[1,1,1]", "[-1,1,-1]"};

class HeatOfPlates : public AnalysisRuns {
 protected:
  double rate(const char* name, const std::string& planes, const std::string& time) {
    write_deck("couette_heated", planes, save_heat);
    const fs::path archive = run(name, deck() + " --set Time/maxTime=" + time);
    return lines_of(archive / "total_heatRate.dat").back()[1];
  }
};

TEST_F(HeatOfPlates, FullHeatOfFrictionLeavesThroughTheColdOne) {
  const double made = 0.1 / (32 * 32);
  EXPECT_NEAR(rate("a", planes_of_heat({cold_plate}), "40"), -made, 1e-8 * made);
  EXPECT_NEAR(rate("b", planes_of_heat({hot_plate}), "40"), 0, 1e-8 * made);
}

// In one module or in two.
TEST_F(HeatOfPlates, SeveralAddUp) {
  const double through_cold = rate("c", planes_of_heat({cold_plate}), "1");
  const double through_hot = rate("d", planes_of_heat({hot_plate}), "1");
  EXPECT_NE(through_hot, 0);
  EXPECT_EQ(rate("e", planes_of_heat({cold_plate, hot_plate}), "1"), through_cold + through_hot);
  EXPECT_EQ(rate("f", planes_of_heat({cold_plate}) + planes_of_heat({cold_plate}), "1"),
            2 * through_cold);
}

// Where two materials and two levels meet, against the closed solution; a plane outside has
// nothing. Measured: 1.3e-2.
TEST_F(AnalysisRuns, HeatPassesFromLevelToLevelAndFromOneMaterialToTheOther) {
  const auto rate = [&](const char* name, const std::string& planes) {
    write_deck("amr_layers_bar", planes, save_heat);
    return lines_of(run(name, deck()) / "total_heatRate.dat").back()[1];
  };
  const double w = std::numbers::pi / 8;
  const double wanted = -4 * (w / 2) * std::cos(2 * w) * std::exp(-4 * w * w) / 16;
  const double all = rate("a", planes_of_heat({{"[4,0,0]", "[4,1,1]"}}));
  EXPECT_NEAR(all / wanted, 1, 0.02);
  EXPECT_EQ(rate("b", planes_of_heat({{"[4,0,0]", "[4,1,1]"}, {"[8,0,0]", "[8,1,1]"}})), all);
}

const std::string all_kinds =
    budgets +
    module_text("planeExtract",
                "<Variables><analyze label=\"temp_CC\"/><analyze label=\"uvel_FC\" level=\"1\"/>"
                "</Variables><planes><plane name=\"cut\"><startingPt>[-0.3,-9,0]</startingPt>"
                "<endingPt>[-0.3,9,0.1]</endingPt></plane></planes>") +
    module_text("planeAvgTurbFluxes",
                "<planeOrientation>XZ</planeOrientation><weight label=\"rho_CC\"/>"
                "<velocity label=\"vel_CC\" weighting=\"mass\"/><Variables>"
                "<analyze label=\"press_CC\" weighting=\"nCells\"/></Variables>") +
    module_text("minMax", "<Variables><analyze label=\"vorticity\"/></Variables>") +
    planes_of_heat({{"[-0.3,-2,0]", "[-0.3,1,1]"}, {"[-1,0.1,0]", "[1,0.1,1]"}}) +
    "<Module name=\"spatialAvg\"><timeStart>0</timeStart><timeStop>9</timeStop>"
    "<avgBoxCells>[5,3,1]</avgBoxCells><Variables><analyze "
    "label=\"vel_CC\"/></Variables></Module>" +
    module_text("pointExtract",
                "<Variables><analyze label=\"press_CC\"/><analyze label=\"vel_CC\"/></Variables>"
                "<points><point name=\"p\"><position>[0.3,0.1,0]</position></point></points>") +
    module_text("statistics",
                "<computeHigherOrderStats>true</computeHigherOrderStats><Variables>"
                "<analyze label=\"temp_CC\"/><analyze label=\"vel_CC\" "
                "computeReynoldsStress=\"true\"/></Variables>");
const std::string conducting =
    small + " --set MaterialProperties/ICE/material/thermal_conductivity=0.01";
const std::string saves =
    "<save label=\"total_heatRate\"/><save label=\"spatialAvg_vel_CC\"/>"
    "<save label=\"spatialAvg_variance_vel_CC\"/>"
    "<save label=\"mean_temp_CC\"/><save label=\"variance_temp_CC\"/>"
    "<save label=\"kurtosis_vel_CC\"/><save label=\"uv_vw_wu_prime\"/>";

TEST_F(AnalysisRuns, NeitherRanksNorBoxesNorThreadsShow) {
  write_deck("amr_vortex_followed", all_kinds, saves);
  const fs::path a = run("a", deck() + conducting);
  const fs::path b =
      run("b", deck() + conducting + " --set Grid/Level/Box/patches=[3,2,1] --threads 2", 3);
  const auto whole = samples(a);
  EXPECT_GT(whole.size(), 50u);
  EXPECT_EQ(whole, samples(b));
  expect_same(a, b);
}

// On levels that move, with the model that looks farthest around a cell.
TEST_F(AnalysisRuns, StressBelowTheGridIsTheSameForAnyBoxes) {
  write_deck("amr_vortex_followed",
             "<Module name=\"SGS_ReynoldsStress\"/>" +
                 module_text("minMax", "<Variables><analyze label=\"SGS_uv_vw_wu\"/></Variables>"),
             "<save label=\"SGS_uu_vv_ww\"/><save label=\"SGS_uv_vw_wu\"/>");
  const std::string eddies = small + " --set CFD/ICE/turbulence/@model=Germano";
  const fs::path a = run("a", deck() + eddies);
  const fs::path b =
      run("b", deck() + eddies + " --set Grid/Level/Box/patches=[3,2,1] --threads 2", 3);
  expect_same(a, b);
  EXPECT_EQ(samples(a), samples(b));
  const auto extremes = lines_of(a / "MinMax/L-0/SGS_uv_vw_wu_0");
  ASSERT_EQ(extremes.back().size(), 7u);  // time, three least, three most
  EXPECT_GT(extremes.back()[4], 1e-6);
}

TEST_F(AnalysisRuns, ARestartGoesOnAsIfNothingHadHappened) {
  write_deck("amr_vortex_followed", all_kinds, saves);
  const std::string checkpoints = conducting +
                                  " --set DataArchiver/checkpoint/@timestepInterval=7 "
                                  "--set DataArchiver/checkpoint/@cycle=2";
  const fs::path whole = run("a", deck() + checkpoints);
  const fs::path first = run("b", deck() + checkpoints + " --max-steps 8");
  const fs::path second = run("c", "--restart " + first.string() + " --set Time/maxTime=0.6");
  EXPECT_EQ(samples(whole), samples(second));
  expect_same(whole, second);
}

}  // namespace
}  // namespace sluice::analysis_runs_test
