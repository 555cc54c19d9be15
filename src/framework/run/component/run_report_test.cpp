// What the report says of time and of levels.
#include "framework/run/component/run_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/base/json.hpp"

namespace sluice::run_report_test {
namespace {

using testing::HasSubstr;
using testing::Not;

// Ten coarse steps; level 1 stands on a quarter of the domain, level 2 may exist but never did.
RunReport two_of_three_levels() {
  RunReport r;
  r.steps = 10;
  r.levels = {{100, 1, 1000, 100, 100, 1}, {100, 3, 2400, 140, 400, 2}, {0, 0, 0, 0, 6400, 8}};
  r.cell_updates = 3400;
  r.updates_skipped = 40;
  r.cells = 200;
  r.stepping_seconds = 0.5;
  r.regrids = 1;
  r.regrid_seconds = 0.01;
  return r;
}

TEST(RunReport, TheUniformGridIsAsFineAsTheFinestLevelThatWas) {
  EXPECT_EQ(two_of_three_levels().uniform_updates(), 10 * 2 * 400);
  EXPECT_EQ(RunReport{}.uniform_updates(), 0);
}

TEST(RunReport, TellsLevelsSavingsAndRegrids) {
  const std::string text = summary(two_of_three_levels());
  EXPECT_THAT(text, HasSubstr("level 0: 100 cells in 1 box; 1,000 updates\n"));
  EXPECT_THAT(text, HasSubstr("level 1: 100 cells in 3 boxes, at most 140; 2,400 updates\n"));
  EXPECT_THAT(text, HasSubstr("3,400 updates: 42 % of the 8,000 that a uniform fine grid needs"));
  EXPECT_THAT(text, HasSubstr("1 regrid: 2 % of the stepping time\n"));
  const Json json = to_json(two_of_three_levels());
  EXPECT_EQ(json.at("uniform_updates"), 8000);
  EXPECT_EQ(json.at("updates_asleep"), 40);
  EXPECT_EQ(json.at("levels").at(1).at("substeps"), 2);
  EXPECT_EQ(json.at("levels").at(1).at("domain_cells"), 400);
}

TEST(RunReport, TellsStartSteppingAndOutputApart) {
  RunReport r = two_of_three_levels();
  r.start_seconds = 0.02;
  r.output_seconds = 1.5;
  EXPECT_THAT(summary(r), HasSubstr("time: start 20 ms, stepping 500 ms, output 1.5 s\n"));
  EXPECT_EQ(to_json(r).at("start_s"), 0.02);
  EXPECT_EQ(to_json(r).at("output_s"), 1.5);
}

TEST(RunReport, TellsHowToRegridLessWhereThatTakesLong) {
  RunReport r = two_of_three_levels();
  EXPECT_THAT(summary(r), Not(HasSubstr("cell_regrid_dilation")));
  r.regrid_seconds = 0.06;
  EXPECT_THAT(summary(r), HasSubstr("12 % of the stepping time; a larger <cell_regrid_dilation>"));
}

// 40 particles through 10 steps in half a second.
TEST(RunReport, TellsWorkByParticleWhereCellsCarryNothing) {
  RunReport r = two_of_three_levels();
  r.particles = {{"disks", 40, 3, 37}};
  r.particle_updates = 400;
  EXPECT_THAT(summary(r), HasSubstr("200 cells"));
  r.particles_alone = true;
  EXPECT_THAT(summary(r), HasSubstr("; 37 particles, 1250000.0 ns per particle and step, peak"));
  EXPECT_THAT(summary(r), Not(HasSubstr("200 cells")));
  EXPECT_EQ(to_json(r).at("particle_updates"), 400);
  EXPECT_EQ(to_json(r).at("ns_per_particle_step"), 1.25e6);
}

TEST(RunReport, TellsMessagesByStep) {
  RunReport r = two_of_three_levels();
  EXPECT_EQ(messages_text(r), "");
  r.messages.reductions = {25, 5600};
  r.messages.gathers_to_all = {10, 20480};
  r.messages.sends = {40, 40000};
  const std::string text = messages_text(r);
  EXPECT_THAT(text, testing::ContainsRegex("reductions +2.5 +560 B"));
  EXPECT_THAT(text, testing::ContainsRegex("gathers to all +1.0 +2.0 KiB"));
  EXPECT_THAT(text, testing::ContainsRegex("sends +4.0 +3.9 KiB"));
  EXPECT_THAT(text, Not(HasSubstr("barriers")));
  EXPECT_THAT(text, testing::ContainsRegex("all but sends +3.5 +2.5 KiB"));
  const Json json = to_json(r).at("messages");
  EXPECT_EQ(json.at("sends").at("bytes"), 40000);
  EXPECT_EQ(json.at("barriers").at("calls"), 0);
}

TEST(RunReport, SaysNothingOfLevelsWhereThereIsOne) {
  RunReport r = two_of_three_levels();
  r.levels.resize(1);
  EXPECT_THAT(summary(r), Not(HasSubstr("level 0")));
}

}  // namespace
}  // namespace sluice::run_report_test
