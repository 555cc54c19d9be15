// The time block's tags and contradictions.
#include "framework/scene/time_settings.hpp"

#include "framework/scene/test_support/deck_text.hpp"

namespace sluice::time_settings_test {
namespace {

using testing::HasSubstr;

TEST(TimeSettings, ReadsEveryTag) {
  const DeckText deck(R"(<Time>
    <initTime>0.5</initTime> <maxTime>2</maxTime> <timestep_multiplier>0.4</timestep_multiplier>
    <delt_min>1e-12</delt_min> <delt_max output="true">0.1</delt_max>
    <delt_init checkpoint="true">1e-6</delt_init> <initial_delt_range>0.01</initial_delt_range>
    <max_delt_increase>1.5</max_delt_increase> <max_Timesteps>77</max_Timesteps>
    <max_wall_time>60</max_wall_time> <end_at_max_time_exactly>true</end_at_max_time_exactly>
    <clamp_time_to_output>true</clamp_time_to_output>
    <override_restart_delt>1e-5</override_restart_delt></Time>)");
  std::vector<Fault> faults;
  const TimeSettings t = read_time_settings(deck.first(), faults);
  EXPECT_EQ(all_faults(faults), "");
  EXPECT_EQ(t.initial_time, 0.5);
  EXPECT_EQ(t.max_time, 2);
  EXPECT_EQ(t.timestep_multiplier, 0.4);
  EXPECT_EQ(t.delt_min, 1e-12);
  EXPECT_EQ(t.delt_max, 0.1);
  EXPECT_EQ(t.delt_init, 1e-6);
  EXPECT_EQ(t.initial_delt_range, 0.01);
  EXPECT_EQ(t.max_delt_increase, 1.5);
  EXPECT_EQ(t.max_timesteps, 77);
  EXPECT_EQ(t.max_wall_time, 60);
  EXPECT_TRUE(t.end_at_max_time_exactly);
  EXPECT_TRUE(t.clamp_time_to_output);
  EXPECT_EQ(t.override_restart_delt, 1e-5);
  EXPECT_TRUE(t.on_delt_max.output);
  EXPECT_FALSE(t.on_delt_max.checkpoint);
  EXPECT_TRUE(t.on_delt_init.checkpoint);
  EXPECT_FALSE(t.on_delt_min.output);
}

TEST(TimeSettings, ReportsAllContradictionsAtTheirLines) {
  const DeckText deck(R"(<Time>
    <initTime>3</initTime>
    <maxTime>2</maxTime>
    <timestep_multiplier>0</timestep_multiplier>
    <delt_min>1</delt_min>
    <delt_max>0.1</delt_max>
    <max_delt_increase>-1</max_delt_increase></Time>)");
  std::vector<Fault> faults;
  read_time_settings(deck.first(), faults);
  const std::string text = all_faults(faults);
  EXPECT_EQ(faults.size(), 4u);
  EXPECT_THAT(text, HasSubstr("deck.ups:4:"));
  EXPECT_THAT(text, HasSubstr("maxTime 2 is before initTime 3"));
  EXPECT_THAT(text, HasSubstr("timestep_multiplier is 0"));
  EXPECT_THAT(text, HasSubstr("delt_min 1 is greater than delt_max 0.1"));
  EXPECT_THAT(text, HasSubstr("max_delt_increase is -1"));
}

}  // namespace
}  // namespace sluice::time_settings_test
