// The example components from deck to archive: the format's own decks where they are there, and
// ours; what is on nodes goes through every command that reads archives.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/command/command_test_support.hpp"
#include "framework/base/test_support/environment.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::example_decks_test {
namespace {

namespace fs = std::filesystem;

struct Place {
  double x, y, z, value;
};

// A run of the command in a folder of its own; it must end well.
class DeckRun {
 public:
  explicit DeckRun(const std::string& deck, const std::vector<std::string>& options = {}) {
    std::vector<std::string> words{"run",        deck,   "-o",     folder_.string(),
                                   "--progress", "none", "--json", (folder_ / "run.json").string()};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = run_sluice(words);
    EXPECT_EQ(outcome.status, 0) << deck << '\n' << outcome.text;
    record_ = nlohmann::json::parse(text_of(folder_ / "run.json"), nullptr, false);
  }
  std::string archive() const { return record_.at("archive").get<std::string>(); }
  int steps() const { return record_.at("steps").get<int>(); }
  fs::path folder() const { return folder_.path(); }

  // Values of a label in the last output, by place; all finite.
  std::vector<Place> places(const std::string& label, const std::string& level = "all") const {
    const Outcome csv =
        run_sluice({"extract", archive(), "--var", label, "--level", level, "--csv", "-"});
    EXPECT_EQ(csv.status, 0) << csv.text;
    std::vector<Place> places;
    std::istringstream lines(csv.text);
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
      std::replace(line.begin(), line.end(), ',', ' ');
      std::istringstream numbers(line);
      double time, lev, material, i, j, k;
      Place p{};
      numbers >> time >> lev >> material >> i >> j >> k >> p.x >> p.y >> p.z >> p.value;
      EXPECT_TRUE(std::isfinite(p.value)) << line;
      places.push_back(p);
    }
    return places;
  }
  std::vector<double> history(const std::string& label) const {
    std::istringstream lines(text_of(fs::path(archive()) / (label + ".dat")));
    std::vector<double> values;
    double time, value;
    for (std::string line; std::getline(lines, line);)
      if (std::istringstream s(line); s >> time >> value) values.push_back(value);
    return values;
  }

 private:
  TemporaryFolder folder_{TemporaryFolder::Place::disk};
  nlohmann::json record_;
};

double largest(const std::vector<Place>& places) {
  double most = 0;
  for (const Place& p : places) most = std::max(most, std::abs(p.value));
  return most;
}

double at(const std::vector<Place>& places, double x, double y, double z) {
  for (const Place& p : places)
    if (std::abs(p.x - x) + std::abs(p.y - y) + std::abs(p.z - z) < 1e-9) return p.value;
  return std::nan("");
}

class FormatExamples : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::optional<fs::path> folder = folder_in_environment("SLUICE_DECKS");
    if (!folder) GTEST_SKIP() << "SLUICE_DECKS is not set: no collection of decks";
    folder_ = *folder / "inputs/Examples";
  }
  std::string deck(const std::string& name) const { return (folder_ / (name + ".ups")).string(); }

 private:
  fs::path folder_;
};

TEST_F(FormatExamples, SweepsOfJacobi) {
  const DeckRun run(deck("poisson1"));
  EXPECT_EQ(run.steps(), 10);
  const std::vector<Place> phi = run.places("phi");
  EXPECT_EQ(phi.size(), 51U * 51 * 51);
  EXPECT_EQ(at(phi, 0, 0.5, 0.5), 1);
  EXPECT_EQ(at(phi, 1, 0.5, 0.5), 0);
  EXPECT_EQ(at(phi, 0.5, 0.5, 0.5), 0);  // a sweep carries a value one node far
  const std::vector<double> residual = run.history("residual");
  ASSERT_EQ(residual.size(), 10U);
  EXPECT_NEAR(residual[0], 49 * 49 / 36.0, 1e-10);  // a sixth beside each node of the side
  EXPECT_TRUE(std::is_sorted(residual.rbegin(), residual.rend()));
  EXPECT_EQ(DeckRun(deck("benchmark")).history("residual"), residual);
}

TEST_F(FormatExamples, FullSweepsUntilTheResidualIsSmall) {
  const DeckRun run(deck("poisson2"), {"--max-steps", "3"});
  const std::vector<Place> phi = run.places("phi");
  EXPECT_GT(at(phi, 0.1, 0.5, 0.5), at(phi, 0.5, 0.5, 0.5));
  EXPECT_LE(largest(phi), 1);
}

void expect_a_step_of_levels(const std::string& deck) {
  const DeckRun run(deck, {"--max-steps", "1"});
  EXPECT_EQ(run.steps(), 1);
  EXPECT_LE(largest(run.places("phi", "1")), 1);
}
TEST_F(FormatExamples, FullTwoLevelsOfPoisson) {
  expect_a_step_of_levels(deck("poisson3_2L"));
}
TEST_F(FormatExamples, FullThreeLevelsOfPoisson) {
  expect_a_step_of_levels(deck("poisson3_3L"));
}

TEST_F(FormatExamples, FullBurger) {
  const DeckRun run(deck("burger"), {"--max-steps", "20"});
  const std::vector<Place> u = run.places("u");
  EXPECT_EQ(u.size(), 51U * 51 * 51);
  // u stays along lines that move with it in every direction.
  const auto start = [](double x, double y, double z) {
    const double pi = std::acos(-1.0);
    return std::sin(pi * x) + std::sin(2 * pi * y) + std::sin(3 * pi * z);
  };
  for (const Place& p : u) {
    if (std::abs(p.x - 0.5) > 0.3 || std::abs(p.y - 0.5) > 0.3 || std::abs(p.z - 0.5) > 0.3)
      continue;
    const double t = 20 * 1e-4 * p.value;
    ASSERT_NEAR(p.value, start(p.x - t, p.y - t, p.z - t), 2e-3);
  }
  const DeckRun flat(deck("burger_4patch"), {"--max-steps", "2000"});
  EXPECT_EQ(flat.places("u").size(), 51U * 51);
  EXPECT_LT(largest(flat.places("u")), 2);  // beyond the time of the first shock
}

TEST_F(FormatExamples, Wave) {
  const DeckRun run(deck("wave"));
  EXPECT_EQ(run.places("phi").size(), 4U * 4 * 4);
  EXPECT_LT(largest(run.places("phi")), 1e-20);  // the bump is far smaller than a cell
}

TEST_F(FormatExamples, LinearSolve) {
  const DeckRun line(deck("solvertest1"), {"--max-steps", "2"});
  for (const Place& p : line.places("pressure")) {
    const bool on_axis = p.y < 0.1 && p.z < 0.1;
    EXPECT_NEAR(p.value, on_axis ? (10.5 - 10 * p.x) / 11 : 0.0, 1e-9);
  }
  const DeckRun cube(deck("solvertest1-2patch"), {"--max-steps", "2"});
  EXPECT_NEAR(at(cube.places("pressure"), 0.05, 0.05, 0.05), 0.185577107, 1e-8);
}

std::string own_deck(const std::string& name) {
  return std::string(SLUICE_SOURCE_DIR) + "/inputs/examples/" + name + ".ups";
}

TEST(OwnExamples, PoissonSquare) {
  const DeckRun run(own_deck("poisson_square"));
  EXPECT_NEAR(at(run.places("phi"), 0.5, 0.5, 0), 0.25, 1e-7);
}

TEST(OwnExamples, BurgerShock) {
  const DeckRun run(own_deck("burger_shock"));
  const std::vector<Place> u = run.places("u");
  EXPECT_NEAR(at(u, 1, 0, 0), 0, 1e-12);
  EXPECT_NEAR(largest(u), 0.7365, 0.02);
}

void expect_a_wave_ball(const std::vector<std::string>& options) {
  const DeckRun run(own_deck("wave_ball"), options);
  EXPECT_FALSE(run.places("phi", "1").empty());
  EXPECT_LT(largest(run.places("phi")), 400);
}
TEST(OwnExamples, WaveBall) {
  expect_a_wave_ball({"--set", "Grid/Level/Box/resolution=[16,16,16]"});
}
TEST(OwnExamples, FullWaveBall) {
  expect_a_wave_ball({});
}

TEST(OwnExamples, LinearSolve) {
  const DeckRun run(own_deck("linear_solve"));
  EXPECT_NEAR(at(run.places("pressure"), 0.5 / 32, 0.5 / 32, 0.5 / 32), 0.185577218, 1e-8);
}

TEST(OwnExamples, FieldsOnNodesGoThroughEveryCommand) {
  const DeckRun run(own_deck("poisson_square"), {"--set", "Grid/Level/Box/resolution=[16,16,1]"});
  const DeckRun other(own_deck("poisson_square"), {"--set", "Grid/Level/Box/resolution=[16,16,1]",
                                                   "--set", "Grid/Level/Box/patches=[2,3,1]"});
  EXPECT_THAT(run_sluice({"info", run.archive()}).text, ::testing::HasSubstr("node"));
  EXPECT_EQ(run_sluice({"compare", run.archive(), other.archive()}).status, 0);
  const Outcome exported =
      run_sluice({"export", run.archive(), "-o", (run.folder() / "vtk").string()});
  EXPECT_EQ(exported.status, 0) << exported.text;
  // Nodes on both sides of the one cell along z; three values that are none would read so.
  const std::string none = "AAAAAAAA+H8AAAAAAAD4fwAAAAAAAPh/";
  int images = 0;
  for (const auto& file : fs::recursive_directory_iterator(run.folder() / "vtk")) {
    if (file.path().extension() != ".vti") continue;
    ++images;
    EXPECT_EQ(text_of(file.path()).find(none), std::string::npos) << file.path();
  }
  EXPECT_EQ(images, 1);
}

TEST(OwnExamples, SameBitsOnTwoRanks) {
  for (const char* name : {"poisson_square", "wave_ball", "linear_solve"}) {
    const std::string options = "Grid/Level/Box/resolution=[12,12,12]";
    const DeckRun alone(own_deck(name), {"--set", options});
    const TemporaryFolder folder(TemporaryFolder::Place::disk);
    const std::string record = (folder / "run.json").string();
    const Outcome outcome =
        run_in_shell(on_ranks(2) + SLUICE_COMMAND " run " + own_deck(name) + " --set " + options +
                     " -o " + folder.string() + " --progress none --json " + record);
    ASSERT_EQ(outcome.status, 0) << name << outcome.text;
    const std::string shared = nlohmann::json::parse(text_of(record)).at("archive");
    const Outcome same = run_sluice({"compare", alone.archive(), shared, "--histories"});
    EXPECT_EQ(same.status, 0) << name << same.text;
  }
}

// From the checkpoint at the end of a part to the same bits.
TEST(OwnExamples, RestartsGiveTheSameBits) {
  const std::vector<std::string> small{"--set", "Grid/Level/Box/resolution=[12,12,12]"};
  std::vector<std::string> half = small;
  half.insert(half.end(), {"--max-steps", "3"});
  const DeckRun whole(own_deck("wave_ball"), small), begun(own_deck("wave_ball"), half);
  const TemporaryFolder folder;
  const Outcome on = run_sluice({"run", "--restart", begun.archive(), "-o", folder.string(),
                                 "--progress", "none", "--json", (folder / "run.json").string()});
  ASSERT_EQ(on.status, 0) << on.text;
  const auto record = nlohmann::json::parse(text_of(folder / "run.json"));
  const Outcome same = run_sluice(
      {"compare", whole.archive(), record.at("archive").get<std::string>(), "--common-times"});
  EXPECT_EQ(same.status, 0) << same.text;
}

}  // namespace
}  // namespace sluice::example_decks_test
