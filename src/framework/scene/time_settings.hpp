// The deck's <Time> block: when a run starts and ends and what bounds its step. Times and steps in
// s.
#pragma once
#include "framework/deck/deck.hpp"

namespace sluice {

// What else happens in a step whose size a limit has set.
struct LimitAction {
  bool output = false;
  bool checkpoint = false;
};

struct TimeSettings {
  double initial_time = 0;               // time
  double max_time = 0;                   // time
  double timestep_multiplier = 1;        // factor on the step that the physics computes
  double delt_min = 0;                   // floor of the step; 0: none
  double delt_max = 0;                   // cap of the step; 0: none
  double delt_init = 0;                  // cap while t + dt <= initial_delt_range; 0: none
  double initial_delt_range = 0;         // time; 0: the cap holds for the very first step only
  double max_delt_increase = 0;          // next step <= (1 + this) current; 0: no limit
  int max_timesteps = 0;                 // 0: no limit
  double max_wall_time = 0;              // seconds; 0: no limit
  bool end_at_max_time_exactly = false;  // shorten the last step
  bool clamp_time_to_output = false;     // shorten steps to meet outputs and checkpoints
  double override_restart_delt = 0;      // first step after a restart; 0: the stored one
  LimitAction on_delt_min, on_delt_max, on_delt_init, on_max_delt_increase;
  Location where;
};

TimeSettings read_time_settings(const DeckNode& time, std::vector<Fault>& faults);

}  // namespace sluice
