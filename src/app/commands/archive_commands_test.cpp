// The contract for scripts of info, extract, compare, norms and export: exits, columns, messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <tuple>

#include "app/command/command_line.hpp"
#include "app/commands/commands.hpp"
#include "framework/archive/archive_test_support.hpp"
#include "framework/archive/raw_archive_test_support.hpp"
#include "framework/base/error.hpp"

namespace sluice::archive_commands_test {
namespace {

using namespace archive_test;
using ::testing::HasSubstr;

struct Outcome {
  int status = 0;
  std::string output, error;
};

// Runs a command line as main does.
Outcome run(const std::string& line) {
  std::istringstream text(line);
  const std::vector<std::string> words{std::istream_iterator<std::string>(text), {}};
  CommandLine commands("test", "sluice");
  for (const CommandKind& kind : command_kinds()) {
    Command command = commands.add(kind.name, kind.summary);
    kind.declare(command);
  }
  Outcome o;
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  try {
    o.status = commands.run(words);
  } catch (const Error& e) {
    o.status = static_cast<int>(e.status());
    o.error = e.what();
  }
  std::fflush(stdout);
  o.output = ::testing::internal::GetCapturedStdout();
  o.error += ::testing::internal::GetCapturedStderr();
  return o;
}

class ArchiveCommands : public ::testing::Test {
 protected:
  ArchiveCommands() {
    a_ = write(0).string();
    b_ = write(1e-3).string();
  }
  fs::path write(double shift) {
    const Grid grid = make_grid({6, 4, 1}, {2, 1, 1});
    ArchiveWriter writer = ArchiveWriter::create(setup_in(folder_.path()));
    for (int step = 0; step <= 20; step += 10) {
      Fields fields;
      fields.add(grid.levels[0], real_label("press_CC"), 0,
                 [&](IntVec3 c, int m) { return wavy(c, m) + step + shift; });
      writer.history("TotalMass", -1, step, 0.01 * step, 1);
      writer.write_output({step, 0.01 * step, 0.01, 0.01, {}}, grid, fields.pieces());
      writer.write_checkpoint({step, 0.01 * step, 0.01, 0.01, {}}, grid, fields.pieces());
    }
    writer.finish();
    return writer.folder();
  }
  TemporaryFolder folder_;
  std::string a_, b_;
};

TEST_F(ArchiveCommands, ExtractWritesTheContractsColumns) {
  const Outcome all = run("extract " + a_ + " --var press_CC");
  EXPECT_EQ(all.status, 0) << all.error;
  EXPECT_TRUE(
      all.output.starts_with("time,level,material,i,j,k,x,y,z,value\n"
                             "0.20000000000000001,0,0,0,0,0,-0.94999999999999996,0.375,"
                             "3.25,"));
  EXPECT_EQ(std::count(all.output.begin(), all.output.end(), '\n'), 25);
  const Outcome first = run("extract " + a_ + " --var press_CC --time first --csv -");
  EXPECT_THAT(first.output, HasSubstr("\n0,0,0,0,0,0,"));
  EXPECT_EQ(run("extract " + a_ + " --var press_CC --time #1").output,
            run("extract " + a_ + " --var press_CC --time 0.14").output);
  const Outcome box = run("extract " + a_ +
                          " --var press_CC --from=-1,0,0 --to=-0.84,0.4,9 --level 0 --material 0");
  EXPECT_EQ(std::count(box.output.begin(), box.output.end(), '\n'), 3);
  const std::string file = (folder_.path() / "out.csv").string();
  EXPECT_EQ(run("extract " + a_ + " --var press_CC --csv " + file).output, "");
  EXPECT_EQ(read_text(file), all.output);
}

TEST_F(ArchiveCommands, HistoriesAreListedAndExtracted) {
  EXPECT_THAT(run("info " + a_).output, HasSubstr("history      TotalMass\n"));
  EXPECT_THAT(run("info " + a_ + " --json").output, HasSubstr("\"samples\""));
  const Outcome all = run("extract " + a_ + " --history TotalMass");
  EXPECT_EQ(all.status, 0) << all.error;
  EXPECT_TRUE(all.output.starts_with("Time,value\n0,1\n0.1")) << all.output;
  EXPECT_EQ(std::count(all.output.begin(), all.output.end(), '\n'), 4);
  const Outcome one = run("extract " + a_ + " --history TotalMass --time 0.12");
  EXPECT_EQ(std::count(one.output.begin(), one.output.end(), '\n'), 2) << one.output;
  const Outcome wrong = run("extract " + a_ + " --history TotalMas");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.error, HasSubstr("did you mean 'TotalMass'"));
  EXPECT_EQ(run("extract " + a_ + " --history TotalMass --var press_CC").status, 2);
}

// A box without a centre and a checkpoint that is not there are no empty answers.
TEST_F(ArchiveCommands, ExtractNamesTheNearestPoint) {
  const std::string file = (folder_.path() / "kept.csv").string();
  std::ofstream(file) << "as it was";
  const Outcome o =
      run("extract " + a_ + " --var press_CC --from=-0.99,0.2,3 --to=-0.96,0.3,4 --csv " + file);
  EXPECT_EQ(o.status, 2);
  EXPECT_THAT(o.error, HasSubstr("the nearest is [0, 0, 0] of level 0 at (-0.9499"));
  EXPECT_EQ(read_text(file), "as it was");
  const Outcome checkpoint = run("extract " + a_ + " --var press_CC --checkpoint --time first");
  EXPECT_EQ(checkpoint.status, 0) << checkpoint.error;
  EXPECT_THAT(checkpoint.output, HasSubstr("\n0.10000000000000001,0,0,"));  // two are kept
  EXPECT_EQ(run("extract " + a_ + " --var press_CC --checkpoint --time 0.3").status, 2);
  EXPECT_THAT(run("extract " + a_ + " --var press_CC --checkpoint --time 0.3").error,
              HasSubstr("no checkpoint near time"));
}

// wavy is sin(1 + i + 10 j)/3 here: its least and largest values are found by their formula.
TEST_F(ArchiveCommands, InfoTellsExtremesWithTheirPlaces) {
  double least = 1, most = -1;
  IntVec3 low, high;
  for_each_cell(IndexBox{{0, 0, 0}, {6, 4, 1}}, [&](IntVec3 c) {
    const double value = std::sin(1.0 + c.x + 10.0 * c.y) / 3;
    if (value < least) std::tie(least, low) = std::tuple(value, c);
    if (value > most) std::tie(most, high) = std::tuple(value, c);
  });
  const Outcome o = run("info " + a_ + " --extremes --json --time first");
  ASSERT_EQ(o.status, 0) << o.error;
  const auto state = nlohmann::json::parse(o.output).at("state");
  EXPECT_EQ(state.at("step"), 0);
  const auto& e = state.at("extremes").at(0);
  EXPECT_EQ(e.at("label"), "press_CC");
  EXPECT_EQ(e.at("values"), 24);
  EXPECT_DOUBLE_EQ(e.at("least").at("value").get<double>(), least);
  EXPECT_DOUBLE_EQ(e.at("largest").at("value").get<double>(), most);
  EXPECT_EQ(e.at("least").at("index"), nlohmann::json({low.x, low.y, low.z}));
  EXPECT_DOUBLE_EQ(e.at("largest").at("at").at(0).get<double>(), -1 + (high.x + 0.5) * 0.1);
  const Outcome text = run("info " + a_ + " --extremes --checkpoint");
  EXPECT_EQ(text.status, 0) << text.error;
  EXPECT_THAT(text.output, HasSubstr("extremes of step 20"));
  EXPECT_THAT(text.output, HasSubstr("cell ["));
}

// Cells are 0.1 x 0.25 x 0.5 m from (-1, 0.25, 3) on.
TEST_F(ArchiveCommands, ExtractsPointsAndLinesOverTime) {
  const std::string label = "extract " + a_ + " --var press_CC ";
  const Outcome probe = run(label + "--time all --at=-0.77,0.8,3.1");
  EXPECT_EQ(probe.status, 0) << probe.error;
  EXPECT_EQ(std::count(probe.output.begin(), probe.output.end(), '\n'), 4);
  EXPECT_THAT(probe.output, HasSubstr("\n0.10000000000000001,0,0,2,2,0,-0.75,0.875,3.25,"));
  EXPECT_EQ(run(label + "--time 0.1: --at=-0.77,0.8,3.1").output,
            run(label + "--time #1:last --at=-0.77,0.8,3.1").output);
  const auto line = nlohmann::json::parse(
      run(label + "--line=-1,0.3,3.1:-0.4,1.2,3.1:7 --linear --json -").output);
  EXPECT_EQ(line["columns"][1], "distance");
  ASSERT_EQ(line["rows"].size(), 7u);
  EXPECT_NEAR(line["rows"][6][1].get<double>(), std::hypot(0.6, 0.9), 1e-12);
  EXPECT_EQ(run("extract " + a_ + " --history TotalMass --time 0.05:0.15").output,
            "Time,value\n0.10000000000000001,1\n");
  EXPECT_EQ(run("extract " + a_ + " --history TotalMass --time 0.15:0.16").status, 2);
  const auto history =
      nlohmann::json::parse(run("extract " + a_ + " --history TotalMass --json -").output);
  EXPECT_EQ(history["rows"][1], nlohmann::json({0.1, 1}));
}

TEST_F(ArchiveCommands, ExtractRefusesWithExitTwo) {
  for (const std::string wrong : {"--at 0,0",
                                  "--at 9,9,9",
                                  "--at=-0.9,1,3 --line=-1,1,3:0,1,3",
                                  "--line=-1,1,3",
                                  "--line=-1,1,3:-1,1,3",
                                  "--line=-1,1,3:0,1,3:1",
                                  "--line 5,5,5:6,6,6",
                                  "--linear",
                                  "--follow",
                                  "--particle 5",
                                  "--particle x",
                                  "--time 0.01:0.02",
                                  "--time 2:1",
                                  "--at nan,0,0",
                                  "--csv - --json -",
                                  "--time 0.31",
                                  "--time -0.06",
                                  "--time #3",
                                  "--time soon",
                                  "--level 1",
                                  "--level x",
                                  "--material 7",
                                  "--from 0,0,0",
                                  "--from 1,0,0 --to 0,1,1",
                                  "--from 0,0 --to 1,1,1"}) {
    const Outcome o = run("extract " + a_ + " --var press_CC " + wrong);
    EXPECT_EQ(o.status, 2) << wrong << o.output;
    EXPECT_FALSE(o.error.empty()) << wrong;
  }
  EXPECT_THAT(run("extract " + a_ + " --var press_CC.x").error, HasSubstr("it has no parts"));
  EXPECT_THAT(run("extract " + a_ + " --var rho_CC").error, HasSubstr("it has press_CC"));
  EXPECT_EQ(run("extract " + a_ + "x --var press_CC").status, 2);
  EXPECT_EQ(run("extract " + a_).status, 2);
  EXPECT_EQ(run("extract " + a_ + " --var press_CC --csv /proc/absent/x").status, 3);
  EXPECT_EQ(run("extract " + a_ + " --var press_CC --csv /dev/full").status, 3);
}

TEST_F(ArchiveCommands, RawArchivesAreReadAndNotContinued) {
  raw_test::Writer writer(folder_.path() / "raw.uda.000");
  const auto place = [](const raw_test::Patch&, int n, int) { return 0.5 + n; };
  const auto count = [](const raw_test::Patch&) { return 2; };
  writer.add_step(1, 0.5,
                  {raw_test::make_level({{0, 0, 0}, {4, 1, 1}}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1})},
                  {{"press_CC", "CCVariable<double>", 0, [](IntVec3 i, int) { return i.x; }},
                   {"p.x", "ParticleVariable<Point>", 0, {}, count, place}});
  writer.write_index();
  const std::string raw = writer.folder().string();
  EXPECT_THAT(run("info " + raw + " --verify").output, HasSubstr("raw files have no checksums"));
  EXPECT_THAT(run("extract " + raw + " --var press_CC").output,
              HasSubstr("0.5,0,0,3,0,0,3.5,0.5,0.5,3\n"));
  // Particles without numbers have none in the table.
  EXPECT_THAT(run("extract " + raw + " --var p.x").output,
              HasSubstr("0.5,0,0,,1.5,1.5,1.5,1.5,1.5,1.5\n"));
  EXPECT_EQ(run("compare " + raw + " " + raw).status, 0);
  // Refused for its format, not for its deck, which is none.
  std::ofstream(writer.folder() / "input.xml") << "<Uintah_specification/>";
  const Outcome refused = run("run --restart " + raw);
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.error, HasSubstr("in Uintah's raw binary layout"));
  EXPECT_EQ(refused.error.find("fault"), std::string::npos);
}

TEST_F(ArchiveCommands, CompareExits) {
  EXPECT_EQ(run("compare " + a_ + " " + a_).status, 0);
  const Outcome o = run("compare " + a_ + " " + b_);
  EXPECT_EQ(o.status, 1);
  // One row for the label, over three outputs.
  EXPECT_THAT(o.output, HasSubstr("\npress_CC"));
  EXPECT_EQ(o.output.find("\npress_CC"), o.output.rfind("\npress_CC"));
  const auto j = nlohmann::json::parse(run("compare " + a_ + " " + b_ + " --json -").output);
  EXPECT_EQ(j["verdict"], "different");
  ASSERT_EQ(j["labels"].size(), 1u);
  EXPECT_EQ(j["labels"][0]["differing"], 72);
  EXPECT_NEAR(j["labels"][0]["largest"]["difference"].get<double>(), 1e-3, 1e-12);
  EXPECT_THAT(o.output,
              HasSubstr("first:   press_CC of material 0 on level 0 at [0, 0, 0], step 0"));
  EXPECT_THAT(o.output, HasSubstr("largest: press_CC"));
  EXPECT_EQ(run("compare " + a_ + " " + b_ + " --abs 0.0011").status, 0);
  EXPECT_EQ(run("compare " + a_ + " " + b_ + " --checkpoints").status, 1);
  EXPECT_EQ(run("compare " + a_ + " " + b_ + " --vars nothing").status, 2);
  EXPECT_EQ(run("compare " + a_ + " " + b_ + " --quiet").output, "");
  EXPECT_EQ(run("compare " + a_ + " " + a_ + " --histories").status, 0);
  std::ofstream(fs::path(b_) / "TotalMass.dat", std::ios::app) << "0.3\t1\n";
  EXPECT_EQ(run("compare " + a_ + " " + b_ + " --abs 1 --histories").status, 2);
  EXPECT_EQ(run("compare " + a_).status, 2);
  EXPECT_EQ(run("compare " + a_ + " " + b_ + " --abs -1").status, 2);
  EXPECT_EQ(run("compare " + a_ + " " + folder_.path().string()).status, 2);
}

TEST_F(ArchiveCommands, InfoSaysWhatIsThereAndFindsDamage) {
  const auto j = nlohmann::json::parse(run("info " + a_ + " --json --verify").output);
  EXPECT_EQ(j["outputs"].size(), 3u);
  EXPECT_EQ(j["outputs"][1]["step"], 10);
  EXPECT_EQ(j["checkpoints"].size(), 2u);
  EXPECT_EQ(j["labels"][0]["name"], "press_CC");
  EXPECT_EQ(j["levels"][0]["boxes"], 2);
  EXPECT_EQ(j["histories"][0], "TotalMass.dat");
  EXPECT_EQ(j["verified"], true);
  EXPECT_EQ(j["good_values"], 5 * 24);
  EXPECT_TRUE(j["damage"].empty());
  const Outcome text = run("info " + a_ + " --verify");
  EXPECT_EQ(text.status, 0);
  EXPECT_THAT(text.output, HasSubstr("#1     step 10"));
  EXPECT_THAT(text.output, HasSubstr("120 values good, nothing damaged"));
  const fs::path file = fs::path(a_) / "t00010" / "p00000.h5";
  flip_bit(file, static_cast<std::int64_t>(fs::file_size(file)) / 2);
  EXPECT_EQ(run("info " + a_).status, 0);  // not read without --verify
  const Outcome damaged = run("info " + a_ + " --verify");
  EXPECT_EQ(damaged.status, 1);
  EXPECT_THAT(damaged.output, HasSubstr("DAMAGED      " + file.string()));
}

TEST_F(ArchiveCommands, NormsAsTableCsvAndJson) {
  EXPECT_THAT(run("norms " + a_ + " " + b_).output, HasSubstr("1.000000e-03"));
  const Outcome csv = run("norms " + a_ + " " + b_ + " --csv - --time last");
  EXPECT_TRUE(
      csv.output.starts_with("time,level,material,label,points,L1,L2,Linf\n"
                             "0.20000000000000001,0,0,press_CC,24,0.001"))
      << csv.output;
  const auto j = nlohmann::json::parse(run("norms " + a_ + " " + b_ + " --json -").output);
  ASSERT_EQ(j.size(), 3u);
  EXPECT_NEAR(j[2]["Linf"].get<double>(), 1e-3, 1e-12);
  EXPECT_EQ(run("norms " + a_ + " " + b_ + " --vars nothing").status, 2);
}

TEST_F(ArchiveCommands, ExportNamesThePvdFile) {
  const std::string out = (folder_.path() / "paraview").string();
  const Outcome o = run("export " + a_ + " -o " + out + " --time last");
  EXPECT_EQ(o.status, 0) << o.error;
  EXPECT_EQ(o.output, out + "/box.uda.000.pvd\n");
  EXPECT_TRUE(fs::exists(out + "/t00020.vti"));
  EXPECT_FALSE(fs::exists(out + "/t00010.vti"));
  EXPECT_EQ(run("export " + a_ + " -o " + out + " --vars nothing").status, 2);
}

}  // namespace
}  // namespace sluice::archive_commands_test
