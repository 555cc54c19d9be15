// Levels in awkward places: everywhere, nowhere, one tile wide, coming and going, at boundaries and
// corners, more of them than cells fit; ratios and dilations that cannot be or should not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "app/loading/sluice_schema.hpp"
#include "framework/archive/archive.hpp"
#include "framework/deck/load_deck.hpp"
#include "framework/run/levels/hierarchy.hpp"
#include "ice/ice.hpp"
#include "properties/deck_run.hpp"
#include "properties/planted_fault.hpp"
#include "properties/skew_deck.hpp"
#include "quick_cases.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::properties::amr_hard_cases_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr double allowed_drift = 1e-13;  // of sum |q|
constexpr int run_steps = 20;

Deck input_deck(const std::string& name, std::vector<std::string> overrides,
                int deck_steps = run_steps) {
  for (const std::string& one :
       {"Time/max_Timesteps=" + std::to_string(deck_steps), std::string("Time/maxTime=1000"),
        "DataArchiver/outputTimestepInterval=" + std::to_string(deck_steps)})
    overrides.push_back(one);
  return load_deck(SLUICE_SOURCE_DIR "/inputs/ice/" + name + ".ups", overrides, sluice_schema());
}

// Conserves, and gives the same bits on other boxes, blocks and threads.
RunReport expect_sound(const Deck& deck, const ScratchFolder& scratch) {
  RunReport plain = carry_out(deck, scratch / "plain");
  EXPECT_EQ(plain.message, "");
  EXPECT_LE(std::abs(plain.worst_drift), allowed_drift) << plain.conservation_json;
  DeckRun run;
  run.folder = scratch / "other";
  run.threads = 2;
  run.block = {5, 3, 2};
  run.box_cells = 1;
  run.split = {3, 2, 1};
  const RunReport other = carry_out(deck, run);
  EXPECT_EQ(difference(plain.archive.value(), other.archive.value(), false), "");
  EXPECT_EQ(other.conservation_json, plain.conservation_json);
  EXPECT_EQ(other.events_json, plain.events_json);
  return plain;
}

std::vector<double> values_of_level(const std::filesystem::path& folder, int level) {
  const Archive archive = Archive::open(folder);
  const ArchiveStep step = archive.read_output(archive.select_output("last"));
  std::vector<double> values;
  for (const char* name : {"rho_CC", "press_CC", "vel_CC", "temp_CC"}) {
    const DenseField field = step.read(*step.find(name, 0, level));
    for (const std::vector<double>& component : field.components)
      values.insert(values.end(), component.begin(), component.end());
  }
  return values;
}

TEST(LevelsEverywhere, TheFinestOneHasTheBitsOfTheUniformFineGrid) {
  ScratchFolder scratch;
  constexpr int coarse_steps = 6;
  const Deck levels = input_deck("amr_explosion",
                                 {"Grid/Level/Box/resolution=[16,16,1]", "Time/delt_max=0.00390625",
                                  "AMR/Regridder/cell_stability_dilation=[99,99,0]"},
                                 coarse_steps);
  const RunReport refined = expect_sound(levels, scratch);
  ASSERT_EQ(refined.levels.size(), 3u);
  EXPECT_EQ(refined.levels[2].cells, 64 * 64);
  EXPECT_EQ(refined.levels[2].boxes, 1);
  const Deck uniform = input_deck("amr_explosion",
                                  {"Grid/Level/Box/resolution=[64,64,1]",
                                   "Time/delt_max=0.0009765625", "AMR/Regridder/max_levels=1"},
                                  4 * coarse_steps);
  const RunReport fine = carry_out(uniform, scratch / "uniform");
  EXPECT_EQ(fine.time, refined.time);
  EXPECT_TRUE(values_of_level(fine.archive.value(), 0) ==
              values_of_level(refined.archive.value(), 2));
}

// Where the gas has not heard of the explosion yet blocks sleep, on every level alike.
TEST(LevelsEverywhere, SleepWhereNothingHappens) {
  const Deck deck = input_deck(
      "amr_explosion",
      {"Grid/Level/Box/resolution=[32,32,1]", "AMR/Regridder/cell_stability_dilation=[99,99,0]"},
      1);
  std::vector<Fault> faults;
  const Scene scene = read_scene(deck, {}, faults);
  const ice::Ice component(scene, ice::read_ice_scene(deck, scene, faults));
  for (const bool force_all : {false, true}) {
    SolverOptions options;
    options.block = {8, 8, 1};
    options.force_all = force_all;
    Hierarchy h(scene, component, world(), options);
    h.initialise();
    const RunControl control;
    EventLedger ledger;
    double time = 0;
    for (int step = 1; step <= 4; ++step) {
      const double dt = h.rates().limit().dt;
      ASSERT_TRUE(h.attempt(step, time, dt, {}, control, ledger).good);
      h.accept();
      time += dt;
    }
    ASSERT_EQ(h.level_count(), 3);
    for (int l = 0; l < 3; ++l) {
      const LevelSolver& level = h.level(l);
      EXPECT_GT(level.graphs().blocks_run(), 0) << l;
      if (force_all)
        EXPECT_EQ(level.graphs().blocks_skipped(), 0) << l;
      else  // blocks of the finer levels are smaller
        EXPECT_GT(level.graphs().blocks_skipped(), l * level.graphs().blocks_run() / 4) << l;
    }
  }
}

TEST(LevelsNowhere, GiveTheBitsOfOneLevel) {
  ScratchFolder scratch;
  const std::string cells = "Grid/Level/Box/resolution=[24,20,1]";
  const Deck none = input_deck(
      "amr_explosion", {cells, "AMR/ICE/Refinement_Criteria_Thresholds/Variable[1]/@value=1e9",
                        "AMR/ICE/Refinement_Criteria_Thresholds/Variable[2]/@value=1e9"});
  const RunReport levels = expect_sound(none, scratch);
  ASSERT_EQ(levels.levels.size(), 3u);
  EXPECT_EQ(levels.levels[1].max_cells, 0);
  EXPECT_EQ(levels.levels[2].max_cells, 0);
  const RunReport one = carry_out(
      input_deck("amr_explosion", {cells, "AMR/Regridder/max_levels=1"}), scratch / "one");
  EXPECT_EQ(one.levels.size(), 1u);
  EXPECT_EQ(difference(levels.archive.value(), one.archive.value(), false), "");
}

TEST(LevelsLimited, ToTwoOfThree) {
  ScratchFolder scratch;
  const RunReport two = expect_sound(
      input_deck("amr_explosion",
                 {"Grid/Level/Box/resolution=[24,20,1]", "AMR/Regridder/max_levels=2"}),
      scratch);
  ASSERT_EQ(two.levels.size(), 2u);
  EXPECT_GT(two.levels[1].cells, 0);
}

// Only the jump is flagged, by one cell to each side, and tiles are as small as can be.
TEST(LevelOneTileWide, InATube) {
  for (const std::string tile : {"[[4,1,1]]", "[[200,1,1]]"}) {
    SCOPED_TRACE(tile);
    ScratchFolder scratch;
    const RunReport report = expect_sound(
        input_deck("amr_shock_tube",
                   {"AMR/Regridder/min_patch_size=" + tile, "AMR/Regridder/max_levels=2",
                    "AMR/Regridder/cell_stability_dilation=[0,0,0]",
                    "AMR/Regridder/cell_deletion_dilation=[0,0,0]",
                    "AMR/ICE/Refinement_Criteria_Thresholds/Variable[1]/@value=6",
                    "AMR/ICE/Refinement_Criteria_Thresholds/Variable[2]/@value=6"},
                   12),
        scratch);
    EXPECT_GE(report.levels[1].max_cells, tile == "[[4,1,1]]" ? 4 : 200);
    EXPECT_LE(report.levels[1].max_cells, tile == "[[4,1,1]]" ? 60 : 200);
  }
}

TEST(LevelOneTileWide, MoreLevelsThanCellsFit) {
  ScratchFolder scratch;
  const RunReport report =
      expect_sound(input_deck("amr_explosion",
                              {"Grid/Level/Box/resolution=[2,3,1]", "AMR/Regridder/max_levels=5",
                               "AMR/Regridder/min_patch_size=[[16,16,1]]",
                               "CFD/ICE/customInitialization/formula/density=x > 0 ? 1 : 0.125",
                               "CFD/ICE/customInitialization/formula/pressure=y > 0.3 ? 1 : 0.1"}),
                   scratch);
  ASSERT_EQ(report.levels.size(), 5u);
  EXPECT_GT(report.levels[4].cells, 0);
}

TEST(TilesThatDoNotDivideTheDomain, AreCutAtItsEnd) {
  for (const char* cells : {"[17,13,1]", "[9,21,1]"})
    for (const char* tile : {"[[12,8,1],[20,12,1]]", "[[4,4,1]]"}) {
      SCOPED_TRACE(std::string(cells) + tile);
      ScratchFolder scratch;
      const RunReport report = expect_sound(
          input_deck("amr_explosion", {std::string("Grid/Level/Box/resolution=") + cells,
                                       std::string("AMR/Regridder/min_patch_size=") + tile}),
          scratch);
      EXPECT_GT(report.levels[2].cells, 0);
    }
}

// A standing wave: its gradients vanish twice a period, and with them the levels.
std::vector<std::string> standing_wave() {
  return {"Grid/Level/Box/resolution=[32,4,1]",
          "CFD/ICE/customInitialization/formula/density=(1 + 0.1*sin(0.5*pi*x))",
          "CFD/ICE/customInitialization/formula/pressure=(1 + 0.1*sin(0.5*pi*x))^1.4/1.4",
          "AMR/ICE/Refinement_Criteria_Thresholds/Variable[1]/@value=0.1",
          "AMR/ICE/Refinement_Criteria_Thresholds/Variable[2]/@value=0.1"};
}

// The same between walls.
Deck standing_wave_deck(int deck_steps) {
  Deck deck = input_deck("amr_explosion", standing_wave(), deck_steps);
  std::string xml = to_xml(*deck.root);
  for (const char* side : {"x-", "x+", "y-", "y+"}) {
    const std::string open = std::string("<Face side=\"") + side + "\">";
    const auto from = xml.find(open), to = xml.find("</Face>", from);
    if (from == std::string::npos) throw std::logic_error("no such face in the deck");
    xml.replace(from, to - from, open + "<BCType id=\"0\" label=\"Symmetric\" var=\"symmetry\"/>");
  }
  return load_deck_text(xml, "standing_wave", {}, sluice_schema());
}

TEST(LevelsThatVanish, ComeBackAndGiveTheirMemoryBack) {
  const FaultyDeck loaded(standing_wave_deck(1));
  const RunControl control;
  EventLedger ledger;
  Hierarchy h(loaded.scene, *loaded.component, world(), {});
  h.initialise();
  ASSERT_EQ(h.level_count(), 3);
  const auto fields = [&](int l) { return h.level(l).state().bytes(); };
  int vanished = 0, came_back = 0;
  double time = 0;
  for (int step = 1; step <= 400 && came_back == 0; ++step) {
    const double dt = h.rates().limit().dt;
    ASSERT_TRUE(h.attempt(step, time, dt, {}, control, ledger).good);
    h.accept();
    time += dt;
    const int before = h.level_count();
    const std::size_t held = h.level(1).memory_bytes(), state = fields(1);
    h.regrid(step);
    if (before > 1 && h.level_count() == 1) {
      ++vanished;
      EXPECT_EQ(fields(1), 0u);
      EXPECT_EQ(fields(2), 0u);
      // Old and new state and that at the start of the coarse step; scratch of blocks stays.
      EXPECT_LE(h.level(1).memory_bytes() + 3 * state, held);
      EXPECT_GT(state, 0u);
    }
    if (vanished > 0 && h.level_count() > 1) ++came_back;
  }
  EXPECT_EQ(vanished, 1);
  EXPECT_EQ(came_back, 1);
  EXPECT_TRUE(ledger.empty());
}

TEST(LevelsThatVanish, ConserveAndKeepTheirBits) {
  ScratchFolder scratch;
  const RunReport report = expect_sound(standing_wave_deck(160), scratch);
  EXPECT_GT(report.regrids, 1);
}

// Flags that blink do not lay the hierarchy anew each time.
TEST(OscillatingFlags, KeepTheirTiles) {
  std::vector<std::string> fast = standing_wave();
  ScratchFolder scratch;
  // Sixteen times as many waves: flags come and go within a few steps.
  fast[1] = "CFD/ICE/customInitialization/formula/density=(1 + 0.1*sin(8*pi*x))";
  fast[2] = "CFD/ICE/customInitialization/formula/pressure=(1 + 0.1*sin(8*pi*x))^1.4/1.4";
  fast.emplace_back("CFD/ICE/advection/@type=SecondOrder");
  fast.emplace_back("AMR/ICE/Refinement_Criteria_Thresholds/Variable[1]/@value=1");
  fast.emplace_back("AMR/ICE/Refinement_Criteria_Thresholds/Variable[2]/@value=1");
  fast.emplace_back("AMR/Regridder/max_timestep_interval=0");
  const RunReport report = expect_sound(input_deck("amr_explosion", fast, 40), scratch);
  EXPECT_GT(report.levels[1].cells, 0);
  EXPECT_LE(report.regrids, 10);
}

struct FixedCase {
  const char* name;
  SkewCase scene;
};
std::ostream& operator<<(std::ostream& out, const FixedCase& c) {
  return out << c.name;
}

class FixedLevels : public testing::TestWithParam<FixedCase> {};

TEST_P(FixedLevels, ConserveAndKeepTheirBits) {
  ScratchFolder scratch;
  SkewCase c = GetParam().scene;
  c.levels.most = 1 + static_cast<int>(c.levels.fixed.size());
  for (const bool lock_step : {false, true}) {
    c.levels.lock_step = lock_step;
    const Deck deck = load_deck_text(skew_deck(c, {}, run_steps), c.name, {}, sluice_schema());
    const RunReport report = expect_sound(deck, scratch);
    EXPECT_EQ(report.levels.size(), c.levels.fixed.size() + 1);
    for (const LevelCost& level : report.levels) EXPECT_GT(level.cells, 0);
  }
}

using enum SideKind;
using Boxes = std::vector<std::vector<std::pair<Vec3, Vec3>>>;

SkewCase fixed(IntVec3 cells, std::array<SideKind, 6> sides, std::vector<IntVec3> ratios,
               Boxes boxes) {
  SkewCase c;
  c.name = "fixed";
  c.cells = cells;
  c.sides = sides;
  c.levels.ratios = std::move(ratios);
  c.levels.fixed = std::move(boxes);
  return c;
}

const std::array<SideKind, 6> walls{wall, wall, wall, wall, symmetry, symmetry},
    rings{periodic, periodic, periodic, periodic, symmetry, symmetry},
    mixed{inflow, open, moving_wall, wall, symmetry, symmetry};

const FixedCase fixed_cases[] = {
    {"in_the_corners", fixed({16, 16, 1}, walls, {{2, 2, 1}},
                             {{{{-1, -1, 0}, {-0.5, -0.25, 0}}, {{0.5, 0.25, 0}, {1, 1, 0}}}})},
    {"along_each_side",
     fixed({16, 16, 1}, mixed, {{4, 2, 1}, {2, 2, 1}},
           {{{{-1, -1, 0}, {1, -0.5, 0}}, {{-1, -0.5, 0}, {-0.5, 1, 0}}, {{0.5, 0, 0}, {1, 1, 0}}},
            {{{-1, -1, 0}, {-0.625, 0.5, 0}}, {{0.25, -1, 0}, {1, -0.75, 0}}}})},
    {"at_one_periodic_end",
     fixed({16, 16, 1}, rings, {{2, 4, 1}},
           {{{{-1, -0.5, 0}, {-0.5, 0.5, 0}}, {{-0.25, 0.75, 0}, {0.5, 1, 0}}}})},
    {"across_periodic_ends",
     fixed({16, 16, 1}, rings, {{2, 2, 1}, {2, 2, 1}},
           {{{{-1, -0.5, 0}, {-0.5, 0.5, 0}}, {{0.5, -0.5, 0}, {1, 0.75, 0}}},
            {{{-1, -0.25, 0}, {-0.75, 0.25, 0}}, {{0.75, -0.25, 0}, {1, 0.25, 0}}}})},
    {"around_a_periodic_direction",
     fixed({16, 16, 1}, rings, {{2, 2, 1}}, {{{{-1, -0.25, 0}, {1, 0.25, 0}}}})},
    {"corner_to_corner",
     fixed({16, 16, 1}, walls, {{2, 2, 1}, {2, 2, 1}},
           {{{{-0.75, -0.75, 0}, {0, 0, 0}}, {{0, 0, 0}, {0.75, 0.75, 0}}},
            {{{-0.5, -0.5, 0}, {-0.25, -0.25, 0}}, {{0.25, 0.25, 0}, {0.5, 0.5, 0}}}})},
    {"a_hole", fixed({16, 16, 1}, walls, {{2, 2, 1}},
                     {{{{-0.75, -0.75, 0}, {0.75, -0.25, 0}},
                       {{-0.75, 0.25, 0}, {0.75, 0.75, 0}},
                       {{-0.75, -0.25, 0}, {-0.25, 0.25, 0}},
                       {{0.25, -0.25, 0}, {0.75, 0.25, 0}}}})},
    {"one_coarse_cell_wide",
     fixed({16, 16, 1}, walls, {{4, 4, 1}},
           {{{{-0.125, -1, 0}, {0, 1, 0}}, {{-1, 0.375, 0}, {-0.125, 0.5, 0}}}})},
    {"ratio_1_in_one_direction",
     fixed({16, 16, 1}, mixed, {{2, 1, 1}, {1, 4, 1}},
           {{{{-1, -1, 0}, {0.5, 0.5, 0}}}, {{{-1, -0.5, 0}, {0.25, 0.25, 0}}}})},
    {"tube",
     fixed({32, 1, 1}, {wall, open, symmetry, symmetry, symmetry, symmetry}, {{2, 1, 1}, {4, 1, 1}},
           {{{{-1, 0, 0}, {-0.25, 0, 0}}, {{0.5, 0, 0}, {1, 0, 0}}},
            {{{-1, 0, 0}, {-0.5, 0, 0}}, {{0.625, 0, 0}, {0.75, 0, 0}}}})},
    {"cube", fixed({8, 8, 8}, {wall, wall, periodic, periodic, inflow, open}, {{2, 2, 2}},
                   {{{{-1, -1, -1}, {0, 0, 0}}, {{0, -0.5, 0}, {0.75, 0.5, 1}}}})},
};
const auto name_of_case = [](const auto& test) { return std::string(test.param.name); };
INSTANTIATE_TEST_SUITE_P(Cases, FixedLevels,
                         testing::ValuesIn(cases_besides(fixed_cases, {"along_each_side"})),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(Full, FixedLevels,
                         testing::ValuesIn(cases_named(fixed_cases, {"along_each_side"})),
                         name_of_case);

// What a deck with such a regridder is told; the line of the tag in the text.
std::string told(const std::string& from, const std::string& to, Severity severity) {
  std::ifstream in(SLUICE_SOURCE_DIR "/inputs/ice/amr_explosion.ups");
  std::ostringstream all;
  all << in.rdbuf();
  std::string xml = all.str();
  const auto at = xml.find(from);
  if (at == std::string::npos) throw std::logic_error("no such tag in the deck");
  const auto line =
      std::count(xml.begin(), xml.begin() + static_cast<std::ptrdiff_t>(at), '\n') + 1;
  xml.replace(at, from.size(), to);
  const Deck deck = load_deck_text(xml, "deck.ups", {}, sluice_schema());
  std::vector<Fault> faults = deck.faults;
  const bool bad = std::any_of(faults.begin(), faults.end(),
                               [](const Fault& f) { return f.severity == Severity::error; });
  if (!bad) read_scene(deck, {}, faults);
  std::string words;
  for (const Fault& f : faults)
    if (f.severity == severity) words += to_string(f) + "\n";
  EXPECT_THAT(words, HasSubstr("deck.ups:" + std::to_string(line)));
  return words;
}

TEST(Regridder, TellsWhereARatioCannotBe) {
  const std::string ratio = "<cell_refinement_ratio>[[2,2,1]]";
  EXPECT_THAT(told(ratio, "<cell_refinement_ratio>[[3,2,1]]", Severity::error),
              AllOf(HasSubstr("refinement ratio 3"), HasSubstr("1, 2 or 4")));
  EXPECT_THAT(told(ratio, "<cell_refinement_ratio>[[2,8,1]]", Severity::error),
              AllOf(HasSubstr("refinement ratio 8"), HasSubstr("several levels")));
  EXPECT_THAT(told(ratio, "<cell_refinement_ratio>[[1,1,1]]", Severity::error),
              HasSubstr("refines no active direction"));
}

TEST(Regridder, WarnsOfADilationOfZeroAndRunsWithIt) {
  const std::string tag = "<cell_stability_dilation>";
  EXPECT_THAT(told(tag + "[1,1,0]", tag + "[0,0,0]", Severity::warning),
              AllOf(HasSubstr("cell_stability_dilation 0"), HasSubstr("use at least 1")));
  ScratchFolder scratch;
  expect_sound(input_deck("amr_explosion", {"Grid/Level/Box/resolution=[24,20,1]",
                                            "AMR/Regridder/cell_stability_dilation=[0,0,0]"}),
               scratch);
}

}  // namespace
}  // namespace sluice::properties::amr_hard_cases_test
