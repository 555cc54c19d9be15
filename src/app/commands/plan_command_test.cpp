// sluice plan as a user meets it: what it says before a run holds when the run is done.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/command/command_test_support.hpp"
#include "app/process/study_process.hpp"
#include "framework/base/temporary_folder.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::plan_command_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

class PlanCommand : public testing::Test {
 protected:
  static std::string deck(const std::string& name) {
    return std::string(SLUICE_SOURCE_DIR) + "/inputs/ice/" + name + ".ups";
  }
  int sluice(const std::vector<std::string>& words) {
    const Outcome outcome = run_sluice(words);
    said_ = outcome.text;
    return outcome.status;
  }
  json plan(std::vector<std::string> words) {
    words.insert(words.begin(), "plan");
    words.emplace_back("--json");
    EXPECT_EQ(sluice(words), 0) << said_;
    return json::parse(said_.substr(said_.find('{')));  // after the warnings
  }
  void expect_no_cost_of_effects_that_are_off(std::size_t every);
  static json effect(const json& of, const std::string& name) {
    for (const json& e : of.at("effects"))
      if (e.at("name") == name) return e;
    return {};
  }

  TemporaryFolder folder_{TemporaryFolder::Place::disk};
  std::string said_;
};

TEST_F(PlanCommand, TellsDirectionsEffectsOutputsLimitsAndMemory) {
  ASSERT_EQ(sluice({"plan", deck("shock_tube")}), 0) << said_;
  for (const char* part :
       {"one cell between symmetric faces", "400 cells", "gravity", "<gravity> is zero",
        "shock_tube.ups:", "rho_CC", "from the state", "history, one line per step",
        "end_at_max_time_exactly", "sets the first step", "skipped blocks: uniform ones", "peak",
        "budget 40"})
    EXPECT_THAT(said_, HasSubstr(part));
}

TEST_F(PlanCommand, SwitchesEffectsByTheDeckAlone) {
  const std::string gravity = "PhysicalConstants/gravity=[0,-9.8,0]";
  const json plain = plan({deck("shock_tube")});
  EXPECT_FALSE(effect(plain, "gravity").at("on").get<bool>());
  EXPECT_TRUE(plain.at("quiet").at("allowed").get<bool>());
  EXPECT_FALSE(plain.at("directions").at(1).at("active").get<bool>());
  const json falling = plan({deck("shock_tube"), "--set", gravity});
  EXPECT_TRUE(effect(falling, "gravity").at("on").get<bool>());
  EXPECT_FALSE(falling.at("quiet").at("allowed").get<bool>());
  EXPECT_TRUE(falling.at("directions").at(1).at("active").get<bool>());
  const json first = plan({deck("shock_tube"), "--set", "CFD/ICE/advection/@type=FirstOrder"});
  EXPECT_GT(effect(plain, "second order").at("tasks").get<int>(), 0);
  EXPECT_EQ(effect(first, "second order").at("tasks").get<int>(), 0);
}

TEST_F(PlanCommand, NamesFieldsThatAnAnalysisGives) {
  const json planned = plan({deck("observed_vortex")});
  std::map<std::string, json> outputs;
  for (const json& o : planned.at("outputs").at("saves")) outputs[o.at("label")] = o;
  for (const char* name : {"mean_press_CC", "skewness_press_CC", "uv_vw_wu_prime"})
    ASSERT_EQ(outputs.count(name), 1u) << name;
  EXPECT_EQ(outputs["mean_press_CC"].at("bytes_per_cell"), 8);
  EXPECT_EQ(outputs["uv_vw_wu_prime"].at("bytes_per_cell"), 24);
}

// Of every deck, an effect that is off adds no task, no field and no byte; ranks exchange the state
// of the halo and nothing else, so it adds no message either. One of every so many decks.
void PlanCommand::expect_no_cost_of_effects_that_are_off(std::size_t every) {
  std::map<std::string, std::pair<int, int>> decks;  // of each effect: where it is on, where off
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(SLUICE_SOURCE_DIR "/inputs/ice"))
    if (entry.path().extension() == ".ups") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  std::size_t tubes = 0;
  for (std::size_t n = 0; n < files.size(); n += every) {
    SCOPED_TRACE(files[n]);
    const json planned = plan({files[n], "--ranks", "2"});
    double state = 0;  // bytes of a cell, old and new
    for (const json& e : planned.at("effects")) {
      const bool on = e.at("on").get<bool>();
      ++(on ? decks[e.at("name")].first : decks[e.at("name")].second);
      state += e.at("bytes_per_cell").get<double>();
      if (on) continue;
      for (const char* cost : {"tasks", "fields", "bytes_per_cell"})
        EXPECT_EQ(e.at(cost), 0) << e.at("name") << ": " << cost;
    }
    const auto cells = planned.at("resolution").get<std::vector<int>>();
    const int halo = planned.at("messages").at("halo").at(0).get<int>();
    if (cells[1] * cells[2] > 1 || cells[0] < 4 * halo ||
        planned.at("hierarchy").at("levels").size() > 1)
      continue;
    ++tubes;
    // Cells sent: to one neighbour, to both where the tube is periodic; where waves leave, the cell
    // beyond the side has a state as well.
    const double sent = planned.at("messages").at("bytes_per_step").get<double>() / (state / 2);
    EXPECT_TRUE(sent == halo || sent == 2 * halo || sent == halo + 1) << sent << " of " << halo;
  }
  EXPECT_GT(tubes, 20 / every);
  EXPECT_GT(decks.size(), 15u);
  if (every > 1) return;  // which effects some decks have is chance
  for (const char* name : {"gravity", "viscous stress", "heat conduction", "momentum exchange",
                           "heat exchange", "scalars", "model sources", "turbulence"}) {
    EXPECT_GT(decks[name].first, 0) << name;
    EXPECT_GT(decks[name].second, 0) << name;
  }
}
TEST_F(PlanCommand, EffectsThatAreOffCostNothing) {
  expect_no_cost_of_effects_that_are_off(3);
}
TEST_F(PlanCommand, FullEffectsThatAreOffCostNothing) {
  expect_no_cost_of_effects_that_are_off(1);
}

// Means over open faces cost a reduction where a deck needs them, and nothing where it does not.
TEST_F(PlanCommand, MeansOverOpenFacesCostAReductionWhereTheyAreNeeded) {
  struct Expected {
    const char* deck;
    bool open;
    int reductions;
    const char* reason;
  };
  for (const Expected& e : {Expected{"vortex_leaving_unaimed", true, 2, "means over 4 open parts"},
                            Expected{"vortex_leaving", true, 1, "LODI with vel_infinity"},
                            Expected{"pulse_leaving", true, 1, "one dimension"},
                            Expected{"explosion_2d", false, 1, "no LODI face"}}) {
    SCOPED_TRACE(e.deck);
    const json planned = plan({deck(e.deck), "--ranks", "2"});
    const json faces = effect(planned, "open faces");
    EXPECT_EQ(faces.at("on"), e.open);
    EXPECT_EQ(faces.at("tasks"), 0);
    EXPECT_NE(faces.at("reason").get<std::string>().find(e.reason), std::string::npos);
    EXPECT_EQ(planned.at("messages").at("reductions"), e.reductions);
  }
}

TEST_F(PlanCommand, PredictsTheFirstStepToTheBit) {
  const json planned = plan({deck("explosion_2d")});
  const std::string report = (folder_ / "run.json").string();
  ASSERT_EQ(sluice({"run", deck("explosion_2d"), "--max-steps", "1", "-o", folder_.string(),
                    "--json", report}),
            0)
      << said_;
  const json run = json::parse(text_of(report));
  EXPECT_EQ(planned.at("time_step").at("first_step").get<double>(), run.at("time").get<double>());
  EXPECT_EQ(effect(planned, "flow").at("tasks"), effect(run, "flow").at("tasks"));
  EXPECT_EQ(effect(planned, "flow").at("bytes_per_cell"), effect(run, "flow").at("bytes_per_cell"));
}

TEST_F(PlanCommand, NamesTheLabelsOfParticles) {
  ASSERT_EQ(sluice({"plan", deck("tracers")}), 0) << said_;
  for (const char* part : {"p.particleID  of particles", "dust in gas, moved after each step"})
    EXPECT_THAT(said_, HasSubstr(part));
}

TEST_F(PlanCommand, ALabelThatNoMaterialHasIsLeftOut) {
  std::ostringstream read;
  read << std::ifstream(SLUICE_SOURCE_DIR "/inputs/mpm/colliding_disks.ups").rdbuf();
  std::string text = read.str();
  const std::string archiver = "<DataArchiver>";
  text.insert(text.find(archiver) + archiver.size(), "<save label='gradPAccNC'/>");
  const fs::path absent = folder_ / "absent.ups";
  std::ofstream(absent) << text;
  ASSERT_EQ(sluice({"plan", absent.string()}), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("nothing is saved of it"));
}

TEST_F(PlanCommand, CountsFieldsMessagesAndOutputs) {
  const json p = plan({deck("blast_3d"), "--boxes", "2,1,1", "--ranks", "2"});
  EXPECT_LE(p.at("memory").at("field_doubles_per_cell").get<double>(), 40);
  EXPECT_GT(p.at("messages").at("bytes_per_step").get<double>(), 0);
  EXPECT_EQ(p.at("messages").at("neighbour_ranks").get<int>(), 1);
  const double cells = p.at("cells").get<double>();
  double per_cell = 0;
  for (const json& s : p.at("outputs").at("saves"))
    per_cell += s.at("bytes_per_cell").get<double>();
  EXPECT_EQ(p.at("outputs").at("bytes_each").get<double>(), per_cell * cells);
  EXPECT_EQ(p.at("outputs").at("checkpoint_bytes_each").get<double>(), 5 * 8 * cells);
}

TEST_F(PlanCommand, PredictsTheMemoryThatARunTakes) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer has memory of its own";
#endif
  const std::string size = "Grid/Level/Box/resolution=[100,100,100]";
  const json planned = plan({deck("blast_3d"), "--set", size});
  const std::string report = (folder_ / "run.json").string();
  ASSERT_EQ(sluice({"run", deck("blast_3d"), "--set", size, "--max-steps", "1", "-o",
                    folder_.string(), "--json", report}),
            0)
      << said_;
  const double measured = json::parse(text_of(report)).at("peak_memory_bytes").get<double>();
  // Planned and measured: 1.703e8 and 1.695e8.
  EXPECT_NEAR(planned.at("memory").at("peak_bytes").get<double>(), measured, 0.1 * measured);
}

// Fields that stages tell the sweeps, and arrays near both bodies, however far they are apart.
TEST_F(PlanCommand, PredictsTheMemoryOfFluidAndSolids) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer has memory of its own";
#endif
  const std::string report = (folder_ / "run.json").string();
  std::vector<std::string> words = {"run", SLUICE_SOURCE_DIR "/inputs/bench/two_balls.ups", "--set",
                                    "Grid/Level/Box/resolution=[48,48,48]"};
  const json near = plan({words.begin() + 1, words.end()}).at("memory");
  words.insert(
      words.end(),
      {"--set",
       "MaterialProperties/MPM/material/geom_object[2]/sphere/origin=[0.875,0.875,0.875]"});
  const json memory = plan({words.begin() + 1, words.end()}).at("memory");
  EXPECT_GT(memory.at("step_arrays").get<double>(), 1e6);
  // Of small balls beside each other many blocks are the same: 1.66.
  EXPECT_LT(memory.at("step_arrays").get<double>(), 2 * near.at("step_arrays").get<double>());
  words.insert(words.end(), {"--max-steps", "3", "--json", report, "-o", folder_.string()});
  ASSERT_EQ(sluice(words), 0) << said_;
  const double measured = json::parse(text_of(report)).at("peak_memory_bytes").get<double>();
  // Planned and measured: 2.23e8 and 2.24e8.
  EXPECT_NEAR(memory.at("peak_bytes").get<double>(), measured, 0.15 * measured);
}

TEST_F(PlanCommand, PredictsTheMemoryThatAllRanksTake) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer has memory of its own";
#endif
  const std::vector<std::string> words = {
      deck("blast_3d"), "--set", "Grid/Level/Box/resolution=[100,100,100]", "--boxes", "4,1,1"};
  std::vector<std::string> planning = words;
  planning.insert(planning.end(), {"--ranks", "2"});
  const json planned = plan(planning);
  const std::string report = (folder_ / "run.json").string();
  std::string line = on_ranks(2) + SLUICE_COMMAND + " run";
  for (const std::string& word : words) line += " '" + word + "'";
  const Outcome ran =
      run_in_shell(line + " --max-steps 1 -o " + folder_.string() + " --json " + report);
  ASSERT_EQ(ran.status, 0) << ran.text;
  const double measured = json::parse(text_of(report)).at("peak_memory_bytes").get<double>();
  // Planned and measured: 2.55e8 and 2.55e8.
  EXPECT_NEAR(planned.at("memory").at("all_ranks_bytes").get<double>(), measured, 0.1 * measured);
  // Both send what was planned of one; an output fills ghost cells of the next step.
  ASSERT_EQ(run_in_shell(line + " --max-steps 1 --no-output --json " + report).status, 0);
  EXPECT_EQ(json::parse(text_of(report)).at("messages").at("sends").at("bytes").get<double>(),
            2 * planned.at("messages").at("bytes_per_step").get<double>());
}

TEST_F(PlanCommand, PlansWhatNoMemoryCouldHold) {
  const json p = plan({deck("blast_3d"), "--set", "Grid/Level/Box/resolution=[2000,2000,2000]"});
  EXPECT_GT(p.at("memory").at("peak_bytes").get<double>(), 8e9 * 80);
  EXPECT_TRUE(p.at("time_step").at("first_step").is_null());
}

TEST_F(PlanCommand, WritesTheGraph) {
  const std::string file = (folder_ / "graph.dot").string();
  ASSERT_EQ(sluice({"plan", deck("shock_tube"), "--graph", file}), 0) << said_;
  const std::string dot = text_of(file);
  EXPECT_THAT(dot, HasSubstr("digraph"));
  EXPECT_THAT(dot, HasSubstr("primitives"));
  const bool has_graphviz = fs::exists("/usr/bin/dot");
  const std::string picture = (folder_ / "graph.svg").string();
  EXPECT_EQ(sluice({"plan", deck("shock_tube"), "--graph", picture}), has_graphviz ? 0 : 3);
  EXPECT_EQ(fs::exists(picture), has_graphviz);
  if (!has_graphviz) {
    EXPECT_THAT(said_, HasSubstr("apt-get install graphviz"));
  }
  ASSERT_EQ(sluice({"plan", deck("shock_tube"), "--graph", file, "--every-graph"}), 0) << said_;
  EXPECT_THAT(text_of(file), HasSubstr("level 0, blocks of kind 0: repeated step"));
  EXPECT_THAT(text_of(file), HasSubstr("level 0: labels of a state"));
  EXPECT_EQ(sluice({"plan", deck("shock_tube"), "--every-graph"}), 2);
  EXPECT_EQ(sluice({"plan", deck("shock_tube"), "--graph", "graph.txt"}), 2);
  EXPECT_THAT(said_, HasSubstr(".dot or .svg"));
}

TEST_F(PlanCommand, RefusesWhatIsNoDeckOrNoNumber) {
  EXPECT_EQ(sluice({"plan", "nowhere.ups"}), 2);
  EXPECT_EQ(sluice({"plan", deck("shock_tube"), "--ranks", "0"}), 2);
  EXPECT_EQ(sluice({"plan", deck("shock_tube"), "--boxes", "2,2"}), 2);
  EXPECT_THAT(said_, HasSubstr("--boxes"));
}

TEST_F(PlanCommand, RefusesALabelThatTheRunCannotMake) {
  EXPECT_EQ(sluice({"plan", deck("shock_tube"), "--set", "DataArchiver/save[1]/@label=rho_C"}), 2);
  EXPECT_THAT(said_, HasSubstr("did you mean 'rho_CC'"));
}

TEST_F(PlanCommand, ARunDrawsItsPictureAndNamesItLast) {
  ASSERT_EQ(sluice({"run", deck("shock_tube"), "--plot", "-o", folder_.string()}), 0) << said_;
  const std::string picture = (folder_ / "shock_tube.uda.000" / "picture.png").string();
  EXPECT_TRUE(fs::exists(picture));
  EXPECT_THAT(said_, testing::EndsWith("picture: " + picture + "\n"));
  EXPECT_EQ(sluice({"run", deck("shock_tube"), "--plot", "--no-output"}), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("nothing to draw"));
}

TEST_F(PlanCommand, ARunTellsItsCostsAndItsError) {
  ASSERT_EQ(sluice({"run", deck("shock_tube"), "--costs", "-o", folder_.string()}), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("error against the exact solution at t = 0.2"));
  EXPECT_THAT(said_, HasSubstr("rho_CC"));
  EXPECT_THAT(said_, testing::ContainsRegex("[0-9.]+ %.*conservative scheme"));
}

// The shock tube with another gas on the right.
std::string two_gases() {
  std::ifstream in(SLUICE_SOURCE_DIR "/inputs/ice/shock_tube.ups");
  std::stringstream whole;
  whole << in.rdbuf();
  std::string text = whole.str();
  const auto replace = [&text](const std::string& from, const std::string& to) {
    std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    for (; at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  };
  replace("id=\"0\"", "id=\"all\"");
  replace("<geom_object>\n          <box label=\"right\">",
          "</material>\n<material name=\"heavy\"><EOS type=\"ideal_gas\"/>"
          "<dynamic_viscosity>0</dynamic_viscosity>"
          "<thermal_conductivity>0</thermal_conductivity><specific_heat>1</specific_heat>"
          "<gamma>1.667</gamma><geom_object>\n          <box label=\"right\">");
  replace("</ICE>\n  </MaterialProperties>",
          "</ICE><exchange_properties><exchange_coefficients><momentum>[1e15]</momentum>"
          "<heat>[0]</heat></exchange_coefficients></exchange_properties></MaterialProperties>");
  return text;
}

TEST_F(PlanCommand, TellsWhatSeveralMaterialsCost) {
  const std::string file = (folder_ / "two_gases.ups").string();
  std::ofstream(file) << two_gases();
  const json p = plan({file, "--quiet"});
  EXPECT_TRUE(effect(p, "pressure equilibration").at("on").get<bool>());
  EXPECT_TRUE(effect(p, "momentum exchange").at("on").get<bool>());
  EXPECT_FALSE(effect(p, "heat exchange").at("on").get<bool>());
  EXPECT_THAT(effect(p, "heat exchange").at("reason").get<std::string>(), HasSubstr("0 (0-1)"));
  // Old and new: mass, volume, energy of each, one momentum.
  double bytes = 0;
  for (const json& e : p.at("effects")) bytes += e.at("bytes_per_cell").get<double>();
  EXPECT_EQ(bytes, 2 * 8 * 7);
  const std::vector<int> tasks = p.at("kind_tasks");
  ASSERT_EQ(tasks.size(), 3u);
  EXPECT_GT(tasks[2], tasks[0]);
  EXPECT_EQ(tasks[1], tasks[0]);
  for (const json& s : p.at("outputs").at("saves"))
    if (s.at("label") == "press_CC") {
      EXPECT_EQ(s.at("materials"), 2);
      EXPECT_EQ(s.at("bytes_per_cell"), 16.0);
    }
  // The run that is planned.
  const std::string report = (folder_ / "run.json").string();
  ASSERT_EQ(sluice({"run", file, "--max-steps", "3", "-o", folder_.string(), "--quiet", "--json",
                    report}),
            0)
      << said_;
  const json run = json::parse(text_of(report));
  for (const char* name : {"flow", "pressure equilibration", "boundary account"}) {
    EXPECT_EQ(effect(p, name).at("tasks"), effect(run, name).at("tasks")) << name;
    EXPECT_EQ(effect(p, name).at("bytes_per_cell"), effect(run, name).at("bytes_per_cell")) << name;
  }
}

// A block of one material runs the tasks that it runs where the deck has no other.
TEST_F(PlanCommand, MaterialsThatAreAbsentAddNoTask) {
  const std::string materials = "MaterialProperties/ICE/material";
  const std::vector<int> tasks = plan({deck("three_in_a_row")}).at("kind_tasks");
  ASSERT_EQ(tasks.size(), 4u);
  for (std::size_t alone = 1; alone <= 3; ++alone) {
    std::vector<std::string> words = {deck("three_in_a_row")};
    const auto set = [&](const std::string& word) { words.insert(words.end(), {"--set", word}); };
    const auto of = [&](std::size_t m) { return materials + "[" + std::to_string(m) + "]"; };
    set(of(alone) + "/geom_object[1]/box/min=[-9,-9,-9]");
    set(of(alone) + "/geom_object[1]/box/max=[9,9,9]");
    if (alone == 3) {
      set(of(3) + "/geom_object[3]=");
      set(of(3) + "/geom_object[2]=");
    }
    for (std::size_t other = 3; other > 0; --other)
      if (other != alone) set(of(other) + "=");
    set("MaterialProperties/exchange_properties=");
    const std::vector<int> by_itself = plan(words).at("kind_tasks");
    ASSERT_EQ(by_itself.size(), 1u);
    EXPECT_EQ(tasks[alone - 1], by_itself[0]) << alone;
    EXPECT_LT(tasks[alone - 1], tasks[3]);
  }
}

}  // namespace
}  // namespace sluice::plan_command_test
