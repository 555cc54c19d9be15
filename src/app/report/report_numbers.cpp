#include "app/report/report_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/process/html_text.hpp"
#include "framework/base/console.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

double number_in(const Json& json, const std::string& name) {
  return json.is_object() && json.contains(name) && json.at(name).is_number()
             ? json.at(name).get<double>()
             : 0;
}

std::string text_in(const Json& json, const std::string& name) {
  return json.is_object() && json.contains(name) && json.at(name).is_text()
             ? json.at(name).get<std::string>()
             : "";
}

Json part_of(const Json& json, const std::string& name) {
  return json.is_object() && json.contains(name) ? json.at(name) : Json();
}

std::string count_text(const Json& json, const std::string& name) {
  return human_count(static_cast<std::int64_t>(number_in(json, name)));
}

std::string share_text(double part, double whole) {
  return whole > 0 ? fmt::format("{:.1f} %", 100 * part / whole) : "";
}

std::string titled(const std::string& title, const HtmlTable& table) {
  return table.empty() ? "" : "<h3>" + html_text(title) + "</h3>\n" + table.text();
}

// A number of run.json; those that JSON does not have are written there as text.
std::string value_text(const Json& value, const char* form = "{:.9g}") {
  if (value.is_number()) return fmt::format(fmt::runtime(form), value.get<double>());
  return value.is_text() ? value.get<std::string>() : "";
}

std::string effects_table(const Json& run) {
  const Json effects = part_of(run, "effects");
  HtmlTable table({"effect", "on", "time", "share", "tasks", "bytes per cell", "because"});
  double total = 0;
  if (!effects.is_array()) return "";
  for (const Json& e : effects.entries()) total += number_in(e, "seconds");
  for (const Json& e : effects.entries()) {
    const double seconds = number_in(e, "seconds");
    table.row({text_in(e, "name"), e.value("on", false) ? "on" : "off",
               seconds > 0 ? human_duration(seconds) : "",
               seconds > 0 ? share_text(seconds, total) : "", count_text(e, "tasks"),
               fmt::format("{:g}", number_in(e, "bytes_per_cell")), text_in(e, "reason")});
  }
  return titled("Effects (measured on a sample of blocks, scaled up)", table);
}

std::string stages_table(const Json& run) {
  const Json stages = part_of(run, "stages");
  if (!stages.is_array()) return "";
  HtmlTable table({"stage of the step", "time", "share of the stepping time"});
  for (const Json& s : stages.entries())
    table.row({text_in(s, "name"), human_duration(number_in(s, "seconds")),
               share_text(number_in(s, "seconds"), number_in(run, "stepping_s"))});
  return titled("Stages", table);
}

std::string levels_table(const Json& run) {
  const Json levels = part_of(run, "levels");
  if (!levels.is_array()) return "";
  HtmlTable table({"level", "cells at the end", "at most", "boxes", "substeps", "cell updates",
                   "share of the updates", "of the stepping time, by updates"});
  const double all = number_in(run, "cell_updates"), stepping = number_in(run, "stepping_s");
  int n = 0;
  for (const Json& l : levels.entries()) {
    const double updates = number_in(l, "cell_updates");
    table.row({std::to_string(n++), count_text(l, "cells"), count_text(l, "most_cells"),
               count_text(l, "boxes"), count_text(l, "substeps"), count_text(l, "cell_updates"),
               share_text(updates, all), all > 0 ? human_duration(stepping * updates / all) : ""});
  }
  std::string text = titled("Levels", table);
  if (number_in(run, "regrids") > 0)
    text += fmt::format("<p>{} regrids took {}, {} of the stepping time.</p>\n",
                        count_text(run, "regrids"), human_duration(number_in(run, "regrid_s")),
                        share_text(number_in(run, "regrid_s"), stepping));
  return text;
}

std::string particles_table(const Json& run) {
  const Json particles = part_of(run, "particles");
  if (!particles.is_array()) return "";
  HtmlTable table({"particles", "created", "left the domain", "at the end"});
  for (const Json& p : particles.entries())
    table.row(
        {text_in(p, "name"), count_text(p, "made"), count_text(p, "left"), count_text(p, "here")});
  return titled("Particles", table);
}

std::string messages_table(const Json& run) {
  const Json messages = part_of(run, "messages");
  if (!messages.is_object()) return "";
  HtmlTable table({"messages", "calls", "bytes"});
  for (const auto& [name, count] : messages.members())
    if (number_in(count, "calls") > 0)
      table.row({name, count_text(count, "calls"), human_bytes(number_in(count, "bytes"))});
  return titled("Messages between ranks", table);
}

std::int64_t disk_bytes(const fs::path& folder) {
  std::int64_t bytes = 0;
  std::error_code error;
  for (auto entry = fs::recursive_directory_iterator(folder, error);
       !error && entry != fs::recursive_directory_iterator(); entry.increment(error))
    if (entry->is_regular_file(error)) bytes += static_cast<std::int64_t>(entry->file_size(error));
  return bytes;
}

void add_steps(const std::vector<StepEntry>& steps, const fs::path& folder, const char* kind,
               HtmlTable& table) {
  for (const StepEntry& s : steps)
    table.row({kind, std::to_string(s.step), fmt::format("{:.10g}", s.time),
               human_bytes(static_cast<double>(disk_bytes((folder / s.href).parent_path())))});
}

}  // namespace

std::string report_summary(const Archive& archive, const Json& run) {
  HtmlTable table({"of this run", "value"});
  table.row({"archive", archive.folder().string()});
  table.row({"program", archive.index().program});
  if (!archive.index().created.empty()) table.row({"created", archive.index().created});
  if (run.is_object()) {
    table.row({"ended as", text_in(run, "status")});
    if (const std::string why = text_in(run, "message"); !why.empty()) table.row({"because", why});
    table.row({"steps", fmt::format("{} (the last is step {})", count_text(run, "steps"),
                                    count_text(run, "last_step"))});
    table.row({"time reached", fmt::format("{:.10g} s", number_in(run, "time"))});
    table.row({"wall time", human_duration(number_in(run, "wall_s"))});
    table.row({"cells", count_text(run, "cells")});
    table.row({"ranks", count_text(run, "ranks")});
    table.row({"threads per rank", count_text(run, "threads")});
    table.row({"per cell and step", fmt::format("{:.1f} ns", number_in(run, "ns_per_cell_step"))});
    if (number_in(run, "particle_updates") > 0)
      table.row({"per particle and step",
                 fmt::format("{:.1f} ns", number_in(run, "ns_per_particle_step"))});
    table.row({"peak memory", human_bytes(number_in(run, "peak_memory_bytes"))});
    table.row({"last step set by", text_in(run, "step_limit")});
  }
  table.row({"outputs", std::to_string(archive.outputs().size())});
  table.row({"checkpoints", std::to_string(archive.checkpoints().size())});
  return table.text();
}

std::string report_conservation(const Json& run) {
  const Json conservation = part_of(run, "conservation");
  if (!conservation.is_object() || conservation.empty()) return "";
  HtmlTable table({"quantity", "start", "now", "through the boundary", "sources", "drift"});
  for (const auto& [name, q] : conservation.members()) {
    const auto part = [&](const char* of, const char* form) {
      return value_text(part_of(q, of), form);
    };
    table.row({name, part("start", "{:.9g}"), part("now", "{:.9g}"), part("boundary", "{:.4g}"),
               part("sources", "{:.4g}"), part("drift", "{:.2e}")});
  }
  return table.text() +
         "<p>The drift is what is neither there nor has passed the boundary or come from sources, "
         "as a share of the scale of the quantity.</p>\n";
}

std::string report_events(const Json& run) {
  const Json events = part_of(run, "events");
  if (!events.is_object()) return "";
  if (events.empty()) return "<p>No events: every step was accepted as computed.</p>\n";
  HtmlTable table({"event", "count", "first", "last"});
  for (const auto& [name, e] : events.members())
    table.row(
        {name, count_text(e, "count"), part_of(e, "first").dump(), part_of(e, "last").dump()});
  return table.text();
}

std::string report_times(const Json& run) {
  if (!run.is_object()) return "";
  HtmlTable table({"part of the run", "time", "share"});
  const double wall = number_in(run, "wall_s");
  double rest = wall;
  for (const auto& [name, key] : {std::pair{"start", "start_s"},
                                  {"steps", "stepping_s"},
                                  {"outputs and checkpoints", "output_s"}}) {
    const double seconds = number_in(run, key);
    rest -= seconds;
    table.row({name, human_duration(seconds), share_text(seconds, wall)});
  }
  table.row(
      {"the rest", human_duration(std::max(rest, 0.0)), share_text(std::max(rest, 0.0), wall)});
  table.row({"all", human_duration(wall), ""});
  return table.text() + effects_table(run) + stages_table(run) + levels_table(run) +
         particles_table(run) + messages_table(run);
}

std::string report_outputs(const Archive& archive) {
  HtmlTable table({"", "step", "time, s", "on disk"});
  add_steps(archive.outputs(), archive.folder(), "output", table);
  add_steps(archive.checkpoints(), archive.folder() / "checkpoints", "checkpoint", table);
  if (table.empty()) return "";
  return table.text() + fmt::format("<p>The whole archive: {}.</p>\n",
                                    human_bytes(static_cast<double>(disk_bytes(archive.folder()))));
}

}  // namespace sluice
