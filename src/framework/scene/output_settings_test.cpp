// The archiver's tags, defaults and faults.
#include "framework/scene/output_settings.hpp"

#include "framework/scene/test_support/deck_text.hpp"
#include "framework/scene/time_settings.hpp"

namespace sluice::output_settings_test {
namespace {

using testing::HasSubstr;

OutputSettings read(const std::string& content, std::string* said = nullptr) {
  const DeckText deck("<DataArchiver>" + content + "</DataArchiver>");
  std::vector<Fault> faults;
  OutputSettings o = read_output_settings(deck.first(), faults);
  if (said != nullptr)
    *said = all_faults(faults);
  else
    EXPECT_EQ(all_faults(faults), "");
  return o;
}

const std::string save = "<save label=\"rho_CC\"/>";
const std::string base = "<filebase>a.uda</filebase>";

TEST(OutputSettings, ReadsEveryTag) {
  const OutputSettings o = read(base + R"(<outputInterval>0.5</outputInterval>
    <outputInitTimestep/><outputLastTimestep>true</outputLastTimestep><outputDoubleAsFloat/>
    <compression>gzip</compression><frequency>3</frequency><onTimeStep>1</onTimeStep>
    <timeStep>true</timeStep><simTime>false</simTime>
    <save label="press_CC" material="0" levels="-1" compression=""/>
    <save label="rho_CC" material="0-1"/>
    <checkpoint timestepInterval="75" cycle="3" lastTimestep="true"/>)");
  EXPECT_EQ(o.filebase, "a.uda");
  EXPECT_EQ(o.interval, 0.5);
  EXPECT_TRUE(o.initial_timestep);
  EXPECT_TRUE(o.last_timestep);
  EXPECT_TRUE(o.doubles_as_floats);
  EXPECT_EQ(o.compression, "gzip");
  EXPECT_EQ(o.reduction_frequency, 3);
  EXPECT_EQ(o.reduction_on_timestep, 1);
  EXPECT_TRUE(o.reduction_step_column);
  EXPECT_FALSE(o.reduction_time_column);
  ASSERT_EQ(o.saves.size(), 2u);
  EXPECT_EQ(o.saves[0].label, "press_CC");
  EXPECT_EQ(o.saves[0].compression, "");
  EXPECT_TRUE(o.saves[0].levels.contains(2, 3));
  EXPECT_FALSE(o.saves[0].levels.contains(0, 3));
  EXPECT_EQ(o.saves[1].compression, "gzip");
  EXPECT_TRUE(o.saves[1].materials.contains(1, 3));
  EXPECT_FALSE(o.saves[1].materials.contains(2, 3));
  EXPECT_EQ(o.checkpoint.timestep_interval, 75);
  EXPECT_EQ(o.checkpoint.cycle, 3);
  EXPECT_TRUE(o.checkpoint.last_timestep);
}

TEST(OutputSettings, Defaults) {
  const OutputSettings o = read(base + "<outputTimestepInterval>0</outputTimestepInterval>");
  EXPECT_FALSE(o.any());
  EXPECT_FALSE(o.checkpoint.any());
  EXPECT_EQ(o.checkpoint.cycle, 2);
  EXPECT_FALSE(o.initial_timestep);
  EXPECT_FALSE(o.reduction_step_column);
  EXPECT_TRUE(o.reduction_time_column);
  EXPECT_EQ(o.reduction_frequency, 1);
}

TEST(OutputSettings, WallTimeCheckpointsInSecondsOrHours) {
  const OutputSettings o = read(base + save + "<outputTimestepInterval>5</outputTimestepInterval>" +
                                R"(<checkpoint walltimeIntervalHours="0.5" walltimeStartHours="1"
                                   cycle="0"/>)");
  EXPECT_EQ(o.timestep_interval, 5);
  EXPECT_EQ(o.checkpoint.walltime_interval, 1800);
  EXPECT_EQ(o.checkpoint.walltime_start, 3600);
  EXPECT_EQ(o.checkpoint.cycle, 0);
}

TEST(OutputSettings, OutputThatSavesNothingIsDropped) {
  std::string said;
  const OutputSettings o = read(base + "<outputInterval>1</outputInterval>", &said);
  EXPECT_THAT(said, HasSubstr("saves nothing"));
  EXPECT_FALSE(o.any());
}

TEST(OutputSettings, IntervalsBeyondTheEndAreTold) {
  const auto told = [](const std::string& content, const TimeSettings& time) {
    const OutputSettings o = read(base + save + content);
    std::vector<Fault> faults;
    check_intervals(o, time, faults);
    return all_faults(faults);
  };
  TimeSettings time;
  time.max_time = 2;
  EXPECT_EQ(told("<outputInterval>2</outputInterval>", time), "");
  EXPECT_THAT(told("\n<outputInterval>2.5</outputInterval>", time),
              HasSubstr("deck.ups:3:1: warning: the interval of outputs, 2.5, is beyond the end of "
                        "the run, maxTime 2: only the first step is saved"));
  EXPECT_THAT(told("<outputInterval>9</outputInterval><outputLastTimestep>true"
                   "</outputLastTimestep>",
                   time),
              HasSubstr("only the first step and its end are saved"));
  EXPECT_THAT(told("<checkpoint interval=\"3\" cycle=\"1\"/>", time),
              HasSubstr("the interval of checkpoints, 3, is beyond"));
  // Multiples of the interval itself: 4 lies between 3 and 5.
  time.initial_time = 3;
  time.max_time = 5;
  EXPECT_EQ(told("<outputInterval>4</outputInterval>", time), "");
  EXPECT_THAT(told("<outputInterval>6</outputInterval>", time), HasSubstr("beyond"));
  time.max_timesteps = 10;
  TimeSettings one_step = time;
  one_step.max_timesteps = 1;
  EXPECT_EQ(told("<outputTimestepInterval>9</outputTimestepInterval>", time), "");
  EXPECT_EQ(told("<outputTimestepInterval>1</outputTimestepInterval>", one_step), "");
  EXPECT_THAT(told("<outputTimestepInterval>10</outputTimestepInterval>", time),
              HasSubstr("10 steps, is beyond the end of the run, max_Timesteps 10"));
}

TEST(OutputSettings, Faults) {
  struct Case {
    std::string content, message;
  };
  const std::vector<Case> cases = {
      {save + "<outputInterval>1</outputInterval>", "no <filebase>"},
      {base + save + "<outputInterval>-1</outputInterval>", "at least 0"},
      {base + save +
           "<outputInterval>1</outputInterval><outputTimestepInterval>1</outputTimestepInterval>",
       "keep one"},
      {base + save + "<outputInterval>1</outputInterval><frequency>0</frequency>",
       "frequency is 0"},
      {base + "<save/>", "no label"},
      {base + "<save label=\"a\" levels=\"x\"/>", "index set 'x'"},
      {base + "<checkpoint interval=\"1\" timestepInterval=\"2\" cycle=\"1\"/>",
       "more than one of"},
      {base + "<checkpoint interval=\"-1\" cycle=\"1\"/>", "at least 0"},
      {base + "<checkpoint interval=\"1\" cycle=\"two\"/>", "attribute cycle"},
  };
  for (const Case& c : cases) {
    std::string said;
    read(c.content, &said);
    EXPECT_THAT(said, HasSubstr(c.message)) << c.content;
    EXPECT_THAT(said, HasSubstr("deck.ups:2:")) << c.content;
  }
}

}  // namespace
}  // namespace sluice::output_settings_test
