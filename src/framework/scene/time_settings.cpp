// The deck's <Time> block.
#include "framework/scene/time_settings.hpp"

#include <fmt/format.h>

#include "framework/scene/deck_values.hpp"

namespace sluice {

namespace {

LimitAction action_of(const DeckNode& time, std::string_view tag) {
  const DeckNode* limit = time.child(tag);
  if (limit == nullptr) return {};
  return {true_attribute(*limit, "output"), true_attribute(*limit, "checkpoint")};
}

const Location& where_of(const DeckNode& time, std::string_view tag) {
  const DeckNode* node = time.child(tag);
  return node != nullptr ? node->where : time.where;
}

void check(const TimeSettings& t, const DeckNode& time, std::vector<Fault>& faults) {
  if (t.max_time < t.initial_time)
    add_error(faults, where_of(time, "maxTime"),
              fmt::format("maxTime {} is before initTime {}", t.max_time, t.initial_time));
  if (!(t.timestep_multiplier > 0))
    add_error(
        faults, where_of(time, "timestep_multiplier"),
        fmt::format("timestep_multiplier is {}; it must be greater than 0", t.timestep_multiplier));
  if (t.delt_max > 0 && t.delt_min > t.delt_max)
    add_error(faults, where_of(time, "delt_min"),
              fmt::format("delt_min {} is greater than delt_max {}", t.delt_min, t.delt_max));
  auto not_negative = [&](std::string_view tag, double value) {
    if (value < 0)
      add_error(faults, where_of(time, tag),
                fmt::format("{} is {}; it must be at least 0 (0: off)", tag, value));
  };
  not_negative("delt_min", t.delt_min);
  not_negative("delt_max", t.delt_max);
  not_negative("delt_init", t.delt_init);
  not_negative("initial_delt_range", t.initial_delt_range);
  not_negative("max_delt_increase", t.max_delt_increase);
  not_negative("max_Timesteps", t.max_timesteps);
  not_negative("max_wall_time", t.max_wall_time);
  not_negative("override_restart_delt", t.override_restart_delt);
}

}  // namespace

TimeSettings read_time_settings(const DeckNode& time, std::vector<Fault>& faults) {
  TimeSettings t;
  t.where = time.where;
  collect(faults, time.where, [&] {
    t.initial_time = real_or(time, "initTime", 0);
    t.max_time = time.real("maxTime");
    t.timestep_multiplier = real_or(time, "timestep_multiplier", 1);
    t.delt_min = real_or(time, "delt_min", 0);
    t.delt_max = real_or(time, "delt_max", 0);
    t.delt_init = real_or(time, "delt_init", 0);
    t.initial_delt_range = real_or(time, "initial_delt_range", 0);
    t.max_delt_increase = real_or(time, "max_delt_increase", 0);
    t.max_timesteps = integer_or(time, "max_Timesteps", 0);
    t.max_wall_time = real_or(time, "max_wall_time", 0);
    t.end_at_max_time_exactly = boolean_or(time, "end_at_max_time_exactly", false);
    t.clamp_time_to_output = boolean_or(time, "clamp_time_to_output", false);
    t.override_restart_delt = real_or(time, "override_restart_delt", 0);
    t.on_delt_min = action_of(time, "delt_min");
    t.on_delt_max = action_of(time, "delt_max");
    t.on_delt_init = action_of(time, "delt_init");
    t.on_max_delt_increase = action_of(time, "max_delt_increase");
    check(t, time, faults);
  });
  return t;
}

}  // namespace sluice
