// The report as JSON and as a few lines.
#include "framework/run/run_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "framework/base/console.hpp"

namespace sluice {

double RunReport::ns_per_cell_step() const {
  const double updates = static_cast<double>(cells) * steps;
  return updates > 0 ? 1e9 * stepping_seconds / updates : 0.0;
}

nlohmann::ordered_json to_json(const RunReport& r) {
  nlohmann::ordered_json effects = nlohmann::ordered_json::array();
  for (const EffectCost& e : r.effects) {
    nlohmann::ordered_json line = nullptr;
    if (!e.effect.line.file.empty()) line = to_string(e.effect.line);
    effects.push_back({{"name", e.effect.name},
                       {"on", e.effect.on},
                       {"reason", e.effect.reason},
                       {"line", line},
                       {"tasks", e.tasks},
                       {"bytes_per_cell", e.bytes_per_cell},
                       {"seconds", e.seconds}});
  }
  nlohmann::ordered_json archive = nullptr;
  if (r.archive) archive = *r.archive;
  return {{"status", to_string(r.status)},
          {"message", r.message},
          {"archive", archive},
          {"steps", r.steps},
          {"last_step", r.last_step},
          {"time", r.time},
          {"cells", r.cells},
          {"ranks", r.ranks},
          {"threads", r.threads},
          {"wall_s", r.wall_seconds},
          {"stepping_s", r.stepping_seconds},
          {"output_s", r.output_seconds},
          {"start_s", r.start_seconds},
          {"ns_per_cell_step", r.ns_per_cell_step()},
          {"peak_memory_bytes", r.peak_memory_bytes},
          {"blocks_run", r.blocks_run},
          {"blocks_asleep", r.blocks_asleep},
          {"step_limit", r.step_limit},
          {"effects", effects},
          {"events", nlohmann::ordered_json::parse(r.events_json)},
          {"conservation", nlohmann::ordered_json::parse(r.conservation_json)}};
}

std::string summary(const RunReport& r) {
  std::string text = fmt::format(
      "{}: {} steps to t = {:g} in {}; {} cells, {:.1f} ns per cell and step, peak memory {}{}\n",
      to_string(r.status), r.steps, r.time, human_duration(r.wall_seconds), human_count(r.cells),
      r.ns_per_cell_step(), human_bytes(static_cast<double>(r.peak_memory_bytes)),
      r.ranks > 1 ? fmt::format(" on {} ranks", r.ranks) : "");
  if (r.blocks_asleep > 0)
    text += fmt::format("quiet blocks: {:.0f} % slept\n",
                        100.0 * static_cast<double>(r.blocks_asleep) /
                            static_cast<double>(r.blocks_asleep + r.blocks_run));
  text += fmt::format("conservation: worst drift {:.1e} of the scale\n", r.worst_drift);
  if (r.archive) text += fmt::format("archive: {}\n", *r.archive);
  return text;
}

}  // namespace sluice
