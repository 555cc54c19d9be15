// The deck's <DataArchiver>: what is kept, when and how. Intervals of time in s.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "framework/scene/index_set.hpp"

namespace sluice {

struct SaveRequest {
  std::string label;
  IndexSet materials;
  IndexSet levels;
  std::string compression;  // "gzip" or empty; the archive's own when the entry has none
  Location where;
};

// At most one of the intervals is positive; none: no checkpoints.
struct CheckpointSettings {
  double interval = 0;           // time
  int timestep_interval = 0;     // steps
  double walltime_interval = 0;  // seconds
  double walltime_start = 0;     // seconds
  int cycle = 2;                 // how many are kept; 0: all
  bool last_timestep = false;
  Location where;

  bool any() const {
    return interval > 0 || timestep_interval > 0 || walltime_interval > 0 || last_timestep;
  }
};

struct OutputSettings {
  std::string filebase;
  double interval = 0;        // time; 0: not by time
  int timestep_interval = 0;  // steps; 0: not by steps
  bool initial_timestep = false;
  bool last_timestep = false;
  bool doubles_as_floats = false;
  std::string compression;
  std::vector<SaveRequest> saves;
  CheckpointSettings checkpoint;
  // Lines of .dat files: written in steps N with N % frequency == on_timestep % frequency.
  int reduction_frequency = 1;
  int reduction_on_timestep = 0;
  bool reduction_step_column = false;
  bool reduction_time_column = true;
  Location where, interval_where;

  bool any() const { return interval > 0 || timestep_interval > 0 || last_timestep; }
};

struct TimeSettings;
// Warns of intervals of outputs and checkpoints that end beyond the run.
void check_intervals(const OutputSettings& output, const TimeSettings& time,
                     std::vector<Fault>& faults);

OutputSettings read_output_settings(const DeckNode& archiver, std::vector<Fault>& faults);

}  // namespace sluice
