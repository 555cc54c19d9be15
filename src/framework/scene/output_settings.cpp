// The deck's <DataArchiver>.
#include "framework/scene/output_settings.hpp"

#include <fmt/format.h>

#include <cmath>

#include "framework/scene/deck_values.hpp"
#include "framework/scene/time_settings.hpp"

namespace sluice {

namespace {

SaveRequest read_save(const DeckNode& node, const std::string& compression) {
  SaveRequest s;
  s.where = node.where;
  s.label = node.attribute("label").value_or("");
  if (s.label.empty()) throw InputError("<save>: no label; name the variable to be saved");
  s.materials = read_index_set(node.attribute("material").value_or(""));
  s.levels = read_index_set(node.attribute("levels").value_or(""));
  s.compression = node.attribute("compression").value_or(compression);
  return s;
}

CheckpointSettings read_checkpoint(const DeckNode& node) {
  CheckpointSettings c;
  c.where = node.where;
  const auto real = [&](std::string_view name) { return real_attribute(node, name).value_or(0); };
  c.interval = real("interval");
  c.timestep_interval = integer_attribute(node, "timestepInterval").value_or(0);
  c.walltime_interval = real("walltimeInterval") + 3600 * real("walltimeIntervalHours");
  c.walltime_start = real("walltimeStart") + 3600 * real("walltimeStartHours");
  c.cycle = integer_attribute(node, "cycle").value_or(2);
  c.last_timestep = true_attribute(node, "lastTimestep");
  if (c.interval < 0 || c.timestep_interval < 0 || c.walltime_interval < 0 || c.cycle < 0)
    throw InputError("<checkpoint>: intervals and cycle must be at least 0");
  if ((c.interval > 0) + (c.timestep_interval > 0) + (c.walltime_interval > 0) > 1)
    throw InputError(
        "<checkpoint>: more than one of interval, timestepInterval, walltimeInterval "
        "and walltimeIntervalHours; keep one");
  return c;
}

bool is_beyond(double interval, const TimeSettings& time) {
  // By multiples of the interval itself, not of the start.
  return interval > 0 && time.max_time > time.initial_time &&
         (std::floor(time.initial_time / interval) + 1) * interval > time.max_time * (1 + 1e-12);
}

bool is_beyond(int steps, const TimeSettings& time) {
  return steps > 1 && time.max_timesteps > 0 && steps >= time.max_timesteps;
}

}  // namespace

void check_intervals(const OutputSettings& output, const TimeSettings& time,
                     std::vector<Fault>& faults) {
  const auto end = [&](double interval) {
    return interval > 0 ? fmt::format("maxTime {:g}", time.max_time)
                        : fmt::format("max_Timesteps {}", time.max_timesteps);
  };
  if (is_beyond(output.interval, time) || is_beyond(output.timestep_interval, time))
    add_warning(faults, output.interval_where,
                fmt::format("the interval of outputs, {}, is beyond the end of the run, {}: {}",
                            output.interval > 0 ? fmt::format("{:g}", output.interval)
                                                : fmt::format("{} steps", output.timestep_interval),
                            end(output.interval),
                            output.last_timestep ? "only the first step and its end are saved"
                                                 : "only the first step is saved"),
                output.last_timestep ? "write a shorter interval"
                                     : "write a shorter interval, or <outputLastTimestep>");
  const CheckpointSettings& c = output.checkpoint;
  if (is_beyond(c.interval, time) || is_beyond(c.timestep_interval, time))
    add_warning(
        faults, c.where,
        fmt::format("the interval of checkpoints, {}, is beyond the end of the run, {}: {}",
                    c.interval > 0 ? fmt::format("{:g}", c.interval)
                                   : fmt::format("{} steps", c.timestep_interval),
                    end(c.interval), c.last_timestep ? "only its end is saved" : "none is written"),
        "write a shorter interval");
}

OutputSettings read_output_settings(const DeckNode& archiver, std::vector<Fault>& faults) {
  OutputSettings o;
  o.where = archiver.where;
  collect(faults, archiver.where, [&] {
    o.filebase = text_or(archiver, "filebase", "");
    o.interval_where = archiver.where;
    for (const char* name : {"outputInterval", "outputTimestepInterval"})
      if (const DeckNode* node = archiver.child(name); node != nullptr && !node->defaulted)
        o.interval_where = node->where;
    o.interval = real_or(archiver, "outputInterval", 0);
    o.timestep_interval = integer_or(archiver, "outputTimestepInterval", 0);
    o.initial_timestep = archiver.has("outputInitTimestep");
    o.last_timestep = boolean_or(archiver, "outputLastTimestep", false);
    o.doubles_as_floats = archiver.has("outputDoubleAsFloat");
    o.compression = text_or(archiver, "compression", "");
    o.reduction_frequency = integer_or(archiver, "frequency", 1);
    o.reduction_on_timestep = integer_or(archiver, "onTimeStep", 0);
    o.reduction_step_column = boolean_or(archiver, "timeStep", false);
    o.reduction_time_column = boolean_or(archiver, "simTime", true);
    if (o.filebase.empty()) throw InputError("<DataArchiver>: no <filebase>; name the archive");
    if (o.interval < 0 || o.timestep_interval < 0)
      throw InputError("<DataArchiver>: output intervals must be at least 0 (0: no output)");
    if (o.interval > 0 && o.timestep_interval > 0)
      throw InputError("<DataArchiver>: both outputInterval and outputTimestepInterval; keep one");
    if (o.reduction_frequency < 1)
      throw InputError(fmt::format("<DataArchiver>: frequency is {}; it must be at least 1",
                                   o.reduction_frequency));
  });
  for (const DeckNode* save : archiver.all("save"))
    collect(faults, save->where, [&] { o.saves.push_back(read_save(*save, o.compression)); });
  if (const DeckNode* checkpoint = archiver.child("checkpoint"))
    collect(faults, checkpoint->where, [&] { o.checkpoint = read_checkpoint(*checkpoint); });
  if (o.any() && o.saves.empty() && archiver.all("save").empty()) {
    add_warning(faults, archiver.where,
                "<DataArchiver> has an output interval but saves nothing: no output is written",
                "add <save label=\"...\"/>");
    o.interval = 0;
    o.timestep_interval = 0;
    o.last_timestep = false;
  }
  return o;
}

}  // namespace sluice
