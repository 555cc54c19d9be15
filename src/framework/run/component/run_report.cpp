// The report as JSON and as a few lines.
#include "framework/run/component/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/base/console.hpp"
#include "framework/base/json.hpp"
#include "framework/base/text.hpp"

namespace sluice {

double RunReport::ns_per_cell_step() const {
  return cell_updates > 0 ? 1e9 * stepping_seconds / static_cast<double>(cell_updates) : 0.0;
}

double RunReport::ns_per_particle_step() const {
  return particle_updates > 0 ? 1e9 * stepping_seconds / static_cast<double>(particle_updates) : 0;
}

double RunReport::uniform_updates() const {
  const LevelCost* finest = nullptr;
  for (const LevelCost& level : levels)
    if (level.updates > 0) finest = &level;
  if (finest == nullptr) return 0;
  return static_cast<double>(steps) * finest->substeps * static_cast<double>(finest->domain_cells);
}

namespace {

Json to_json(const EffectCost& e) {
  Json line = nullptr;
  if (!e.effect.line.file.empty()) line = to_string(e.effect.line);
  return {{"name", e.effect.name}, {"on", e.effect.on}, {"reason", e.effect.reason},
          {"line", line},          {"tasks", e.tasks},  {"bytes_per_cell", e.bytes_per_cell},
          {"seconds", e.seconds}};
}

Json to_json(const LevelCost& level) {
  return {{"cells", level.cells},          {"boxes", level.boxes},
          {"most_cells", level.max_cells}, {"domain_cells", level.domain_cells},
          {"substeps", level.substeps},    {"cell_updates", level.updates}};
}

Json to_json(const MessageCounts& counts) {
  Json kinds = Json::object();
  counts.for_each([&](const char* name, const MessageCount& n) {
    kinds[name] = {{"calls", n.calls}, {"bytes", n.bytes}};
  });
  return kinds;
}

}  // namespace

Json to_json(const RunReport& r) {
  Json effects = Json::array();
  for (const EffectCost& e : r.effects) effects.push_back(to_json(e));
  Json stages = Json::array();
  for (const StageCost& s : r.stages) stages.push_back({{"name", s.name}, {"seconds", s.seconds}});
  Json archive = nullptr;
  if (r.archive) archive = *r.archive;
  Json levels = Json::array();
  for (const LevelCost& level : r.levels) levels.push_back(to_json(level));
  Json particles = Json::array();
  for (const ParticleCount& p : r.particles)
    particles.push_back({{"name", p.name}, {"made", p.made}, {"left", p.left}, {"here", p.here}});
  Json budget = Json::object();
  for (const auto& [name, value] : r.budget) budget[name] = value;
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
          {"cell_updates", r.cell_updates},
          {"updates_asleep", r.updates_skipped},
          {"uniform_updates", r.uniform_updates()},
          {"levels", levels},
          {"particles", particles},
          {"particle_updates", r.particle_updates},
          {"ns_per_particle_step", r.ns_per_particle_step()},
          {"regrids", r.regrids},
          {"regrid_s", r.regrid_seconds},
          {"balances", r.balances},
          {"balance_s", r.balance_seconds},
          {"messages", to_json(r.messages)},
          {"blocks_run", r.blocks_run},
          {"blocks_asleep", r.blocks_skipped},
          {"step_limit", r.step_limit},
          {"effects", effects},
          {"stages", stages},
          {"events", Json::parse(r.events_json)},
          {"energy_account", budget},
          {"solids_energy", Json::parse(r.solids_json)},
          {"conservation", Json::parse(r.conservation_json)}};
}

namespace {

// Levels laid a cell wider are laid anew a third to a fifth as often, for a tenth to a quarter more
// cells: where regrids take more than this share, runs become shorter by it or stay as long.
constexpr double much_regridding = 0.05;

std::string regrids_text(const RunReport& r) {
  const double share = r.regrid_seconds / r.stepping_seconds;
  return fmt::format(
      "{} regrid{}: {} of the stepping time{}\n", r.regrids, r.regrids == 1 ? "" : "s",
      human_percent(share),
      share > much_regridding ? "; a larger <cell_regrid_dilation> reduces their number" : "");
}

// Several levels: what each holds, and what that saved.
std::string levels_text(const RunReport& r) {
  std::string text;
  for (std::size_t l = 0; l < r.levels.size(); ++l) {
    const LevelCost& level = r.levels[l];
    text += fmt::format("level {}: {} cells in {} box{}", l, human_count(level.cells), level.boxes,
                        level.boxes == 1 ? "" : "es");
    if (level.max_cells > level.cells)
      text += fmt::format(", at most {}", human_count(level.max_cells));
    text += fmt::format("; {} updates\n", human_count(level.updates));
  }
  const double uniform = r.uniform_updates();
  if (uniform > 0)
    text += fmt::format("{} updates: {} of the {} that a uniform fine grid needs\n",
                        human_count(r.cell_updates),
                        human_percent(static_cast<double>(r.cell_updates) / uniform),
                        human_count(static_cast<std::int64_t>(uniform)));
  if (r.regrid_seconds > 0) text += regrids_text(r);
  return text;
}

}  // namespace

namespace {

// Where energy went that is in no total, as shares of what there was.
std::string account_text(const RunReport& r) {
  std::vector<std::string> parts;
  for (const auto& [name, value] : r.budget)
    parts.push_back(
        fmt::format("{} {:.1e}", name, r.energy_scale > 0 ? value / r.energy_scale : 0.0));
  return fmt::format("energy budget, as fractions of the energy scale: {}\n", join(parts, ", "));
}

// How much there was, and what it cost.
std::string work_text(const RunReport& r) {
  if (!r.particles_alone)
    return fmt::format("{} cells, {:.1f} ns per cell and step", human_count(r.cells),
                       r.ns_per_cell_step());
  std::int64_t here = 0;
  for (const ParticleCount& p : r.particles) here += p.here;
  return fmt::format("{} particles, {:.1f} ns per particle and step", human_count(here),
                     r.ns_per_particle_step());
}

}  // namespace

std::string stages_text(const RunReport& r) {
  if (r.stages.empty() || r.steps == 0) return {};
  using Align = TextTable::Align;
  TextTable table(
      {{"stage of the step"}, {"time per step", Align::right}, {"share", Align::right}});
  for (const StageCost& s : r.stages)
    table.row({s.name, human_duration(s.seconds / r.steps),
               fmt::format("{:.1f} %", 100 * s.seconds / r.stepping_seconds)});
  return table.text("  ");
}

std::string messages_text(const RunReport& r) {
  if (r.messages == MessageCounts{} || r.steps == 0) return {};
  using Align = TextTable::Align;
  TextTable table(
      {{"messages"}, {"calls per step", Align::right}, {"bytes per step", Align::right}});
  const auto add = [&](std::string name, const MessageCount& n) {
    if (n.calls == 0) return;
    std::replace(name.begin(), name.end(), '_', ' ');
    table.row({name, fmt::format("{:.1f}", static_cast<double>(n.calls) / r.steps),
               human_bytes(static_cast<double>(n.bytes) / r.steps)});
  };
  r.messages.for_each(add);
  add("all but sends", r.messages.collectives());
  return table.text("  ");
}

std::string summary(const RunReport& r) {
  std::string text =
      fmt::format("{}: {} steps to t = {:g} in {}; {}, peak memory {}{}\n", to_string(r.status),
                  r.steps, r.time, human_duration(r.wall_seconds), work_text(r),
                  human_bytes(static_cast<double>(r.peak_memory_bytes)),
                  r.ranks > 1 ? fmt::format(" on {} ranks", r.ranks) : "");
  text += fmt::format("time: start {}, stepping {}, output {}\n", human_duration(r.start_seconds),
                      human_duration(r.stepping_seconds), human_duration(r.output_seconds));
  if (r.levels.size() > 1) text += levels_text(r);
  for (const ParticleCount& p : r.particles)
    text += fmt::format("particles {}: {} in the domain; {} created, {} left it\n", p.name,
                        human_count(p.here), human_count(p.made), human_count(p.left));
  if (r.blocks_skipped > 0)
    text += fmt::format("skipped blocks: {:.0f} % of all\n",
                        100.0 * static_cast<double>(r.blocks_skipped) /
                            static_cast<double>(r.blocks_skipped + r.blocks_run));
  text +=
      fmt::format("conservation: worst drift {:.1e} of the scale of its quantity\n", r.worst_drift);
  if (!r.budget.empty()) text += account_text(r);
  text += r.solids_text;
  if (r.archive) text += fmt::format("archive: {}\n", *r.archive);
  return text;
}

}  // namespace sluice
