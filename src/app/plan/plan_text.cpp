// A plan as tables for people and as JSON for scripts.
#include <fmt/format.h>

#include "app/command/effect_table.hpp"
#include "app/plan/plan_levels_text.hpp"
#include "app/plan/run_plan.hpp"
#include "app/plan/switched_plan.hpp"
#include "framework/base/console.hpp"
#include "framework/base/json.hpp"

namespace sluice {
namespace {

using Align = TextTable::Align;
const char* velocity_text(VelocityComponent v) {
  return v == VelocityComponent::solved    ? "solved"
         : v == VelocityComponent::carried ? "carried along"
                                           : "zero, dropped";
}

std::string directions_text(const RunPlan& p) {
  TextTable table({{"direction"}, {"active"}, {"velocity"}, {"because"}, {"deck line"}});
  for (std::size_t d = 0; d < 3; ++d)
    table.row({std::string(1, "xyz"[d]), p.directions[d].active ? "yes" : "no",
               velocity_text(p.directions[d].velocity), p.directions[d].reason,
               short_place(p.directions[d].where)});
  return table.text("  ");
}

std::string kinds_text(const RunPlan& p) {
  if (p.kind_tasks.size() < 2) return "";
  std::string tasks;
  for (std::size_t k = 0; k + 1 < p.kind_tasks.size(); ++k)
    tasks += fmt::format("{}{}", k > 0 ? ", " : "", p.kind_tasks[k]);
  return fmt::format(
      "  blocks of one material run only the step of that material ({} tasks); the table counts\n  "
      "the step of blocks where materials meet ({} tasks)\n",
      tasks, p.kind_tasks.back());
}

std::string outputs_text(const RunPlan& p) {
  if (p.outputs.empty()) return "  nothing is saved\n";
  TextTable table(
      {{"saved"}, {"made"}, {"bytes/cell", Align::right}, {"each", Align::right}, {"deck line"}});
  for (const PlannedOutput& o : p.outputs) {
    const bool field = o.bytes_per_cell > 0;
    const double each = o.bytes_per_cell * static_cast<double>(p.cell_count);
    const std::string made =
        o.materials > 1 ? fmt::format("{}, {} materials", o.made, o.materials) : o.made;
    table.row({o.label, made, field ? fmt::format("{:g}", o.bytes_per_cell) : "",
               field         ? human_bytes(each)
               : o.bytes > 0 ? human_bytes(o.bytes)
                             : "",
               short_place(o.where)});
  }
  return table.text("  ") + fmt::format("  outputs {}: {} each; checkpoints {}: {} each\n",
                                        p.output_times, human_bytes(p.output_bytes),
                                        p.checkpoint_times, human_bytes(p.checkpoint_bytes));
}

std::string limits_text(const RunPlan& p) {
  TextTable table({{"rule"}, {"value"}, {""}});
  for (const PlannedLimit& l : p.limits) table.row({l.rule, l.value, l.acts});
  std::string text = table.text("  ");
  if (p.first_dt)
    text += fmt::format("  first step {:.6g}; about {} steps at this size\n", *p.first_dt,
                        human_count(static_cast<std::int64_t>(p.estimated_steps)));
  return text + cost_text(p.cost);
}

std::string memory_text(const RunPlan& p) {
  const PlannedMemory& m = p.memory;
  TextTable table({{"memory per rank"}, {"bytes", Align::right}, {"of what"}});
  table.row({"program", human_bytes(m.base), ""});
  if (p.particles.any())
    table.row({"particles", human_bytes(m.particles),
               "old and new; nodes of the blocks that contain particles are additional"});
  table.row({"states", human_bytes(m.states),
             fmt::format("old and new{}, {:g} doubles per cell each, with ghost cells",
                         p.hierarchy.levels.size() > 1 ? ", with substeps also the start" : "",
                         m.state_doubles_per_cell)});
  if (m.work_fields > 0)
    table.row({"work fields", human_bytes(m.work_fields),
               fmt::format("old and new, {:g} doubles per cell each: what stages hand to sweeps",
                           m.work_doubles_per_cell)});
  if (m.step_arrays > 0)
    table.row({"arrays of the step", human_bytes(m.step_arrays),
               "in blocks of cells near the solids of the start; several ranks hold fewer each"});
  table.row({"outputs", human_bytes(m.outputs),
             fmt::format("{:g} doubles per cell, from the first step that stores them",
                         m.output_doubles_per_cell)});
  table.row({"scratch", human_bytes(m.scratch), "temporaries of one block, shared by all"});
  table.row({"initial fill", human_bytes(m.initial_fill), "while the initial state is set"});
  if (m.messages > 0) table.row({"messages", human_bytes(m.messages), "sent and received"});
  return table.text("  ") +
         fmt::format("  peak {} per rank{}; fields {:g} doubles per cell (budget 40)\n",
                     human_bytes(m.peak()),
                     p.ranks == 1 ? "" : ", all together " + human_bytes(m.all_ranks),
                     m.field_doubles_per_cell());
}

Json json_location(const Location& where) {
  if (where.file.empty()) return nullptr;
  return to_string(where);
}

Json directions_json(const RunPlan& p) {
  Json list = Json::array();
  for (std::size_t d = 0; d < 3; ++d)
    list.push_back({{"direction", std::string(1, "xyz"[d])},
                    {"active", p.directions[d].active},
                    {"velocity", velocity_text(p.directions[d].velocity)},
                    {"reason", p.directions[d].reason},
                    {"line", json_location(p.directions[d].where)}});
  return list;
}

Json effects_json(const RunPlan& p) {
  Json list = Json::array();
  for (std::size_t e = 0; e < p.effects.size(); ++e) {
    const EffectCost& c = p.effects[e];
    list.push_back({{"name", c.effect.name},
                    {"on", c.effect.on},
                    {"reason", c.effect.reason},
                    {"line", json_location(c.effect.line)},
                    {"tasks", c.tasks},
                    {"fields", p.effect_fields[e]},
                    {"bytes_per_cell", c.bytes_per_cell}});
  }
  return list;
}

Json particles_json(const RunPlan& p) {
  Json list = Json::array();
  for (const PlannedKind& k : p.particles.kinds)
    list.push_back({{"name", k.name},
                    {"count", p.particles.known ? Json(k.count) : Json(nullptr)},
                    {"numbers", k.numbers},
                    {"bytes", k.bytes()}});
  return list;
}

Json outputs_json(const RunPlan& p) {
  Json list = Json::array();
  for (const PlannedOutput& o : p.outputs)
    list.push_back({{"label", o.label},
                    {"made", o.made},
                    {"bytes_per_cell", o.bytes_per_cell},
                    {"materials", o.materials},
                    {"line", json_location(o.where)}});
  return {{"times", p.output_times},
          {"bytes_each", p.output_bytes},
          {"saves", list},
          {"checkpoint_times", p.checkpoint_times},
          {"checkpoint_bytes_each", p.checkpoint_bytes}};
}

Json limits_json(const RunPlan& p) {
  Json rules = Json::array();
  for (const PlannedLimit& l : p.limits)
    rules.push_back({{"rule", l.rule}, {"value", l.value}, {"acts", !l.acts.empty()}});
  Json first = nullptr;
  if (p.first_dt) first = *p.first_dt;
  return {{"rules", rules}, {"first_step", first}, {"estimated_steps", p.estimated_steps}};
}

Json cost_json(const PlannedCost& c) {
  if (!c.known) return nullptr;
  return {{"seconds", c.seconds()},
          {"start_s", c.start_s},
          {"stepping_s", c.stepping_s},
          {"output_s", c.output_s},
          {"steps", c.steps.steps},
          {"outputs", c.steps.outputs},
          {"checkpoints", c.steps.checkpoints},
          {"cell_updates_per_step", c.cell_updates},
          {"ns_per_cell", c.cell_ns},
          {"ns_per_particle", c.particle_ns},
          {"machine_factor", c.machine},
          {"from_rest", c.from_rest},
          {"archive_bytes", c.bytes()},
          {"outputs_bytes", c.outputs_bytes},
          {"checkpoints_bytes", c.checkpoints_bytes}};
}

Json memory_json(const RunPlan& p) {
  const PlannedMemory& m = p.memory;
  return {{"program", m.base},
          {"states", m.states},
          {"work_fields", m.work_fields},
          {"step_arrays", m.step_arrays},
          {"particles", m.particles},
          {"outputs", m.outputs},
          {"scratch", m.scratch},
          {"initial_fill", m.initial_fill},
          {"messages", m.messages},
          {"peak_bytes", m.peak()},
          {"all_ranks_bytes", m.all_ranks},
          {"field_doubles_per_cell", m.field_doubles_per_cell()}};
}

}  // namespace

namespace {

// What the studies prove for the solids of this deck.
std::string best_text(const BestSettings& best) {
  std::string text;
  for (const std::string& reason : best.reasons) text += fmt::format("  solids: {}\n", reason);
  for (const std::string& one : best.overrides) text += fmt::format("    --set '{}'\n", one);
  if (!best.overrides.empty()) text += "    `sluice run --best-settings` takes these\n";
  return text.empty() ? text : text + "\n";
}

Json best_json(const BestSettings& best) {
  Json set = Json::array(), reasons = Json::array();
  for (const std::string& one : best.overrides) set.push_back(one);
  for (const std::string& one : best.reasons) reasons.push_back(one);
  return {{"set", std::move(set)}, {"reasons", std::move(reasons)}};
}

}  // namespace

std::string plan_text(const RunPlan& p) {
  std::string text = fmt::format(
      "{}{}\n{} on {} x {} x {} = {} cells in {} box{} and {} block{}; {} rank{}, {} thread{} "
      "each\n\n",
      p.deck, p.title.empty() ? "" : ": " + p.title, p.component, p.cells.x, p.cells.y, p.cells.z,
      human_count(p.coarse_cells()), p.boxes, p.boxes == 1 ? "" : "es", p.blocks,
      p.blocks == 1 ? "" : "s", p.ranks, p.ranks == 1 ? "" : "s", p.threads,
      p.threads == 1 ? "" : "s");
  if (!p.parts.empty()) text += parts_text(p.parts) + "\n";
  if (p.hierarchy.levels.size() > 1) text += levels_text(p.hierarchy) + "\n";
  text += directions_text(p) + "\n";
  text += planned_effect_table(p.effects, p.effect_fields) + "\n";
  if (p.particles.any())
    return text + particles_text(p.particles) + "\n" + best_text(p.best) + outputs_text(p) + "\n" +
           limits_text(p) + "\n" + memory_text(p);
  text += fmt::format("  messages: one ghost exchange of {},{},{} layers per step, ", p.halo.x,
                      p.halo.y, p.halo.z);
  text += p.ranks == 1
              ? "copied within this rank\n"
              : fmt::format("{} to {} neighbour rank{}, and {} reduction{}\n",
                            human_bytes(static_cast<double>(p.messages.bytes)),
                            p.messages.neighbour_ranks, p.messages.neighbour_ranks == 1 ? "" : "s",
                            p.reductions == 1 ? "one" : "two", p.reductions == 1 ? "" : "s");
  text += kinds_text(p);
  text +=
      fmt::format("  skipped blocks: {}; {}{}\n\n", p.skipping_allowed ? "uniform ones" : "none",
                  p.skipping_reason,
                  p.skipping_where.file.empty() ? "" : " (" + short_place(p.skipping_where) + ")");
  text += best_text(p.best);
  text += outputs_text(p) + "\n";
  text += limits_text(p) + "\n";
  return text + memory_text(p);
}

std::string plan_json(const RunPlan& p) {
  const Json json = {{"deck", p.deck},
                     {"title", p.title},
                     {"component", p.component},
                     {"parts", parts_json(p.parts)},
                     {"resolution", {p.cells.x, p.cells.y, p.cells.z}},
                     {"cells", p.cell_count},
                     {"hierarchy", levels_json(p.hierarchy)},
                     {"boxes", p.boxes},
                     {"blocks", p.blocks},
                     {"ranks", p.ranks},
                     {"threads", p.threads},
                     {"directions", directions_json(p)},
                     {"effects", effects_json(p)},
                     {"particles", particles_json(p)},
                     {"stages", p.particles.stages},
                     {"best_settings", best_json(p.best)},
                     {"kind_tasks", p.kind_tasks},
                     {"messages",
                      {{"halo", {p.halo.x, p.halo.y, p.halo.z}},
                       {"bytes_per_step", p.messages.bytes},
                       {"neighbour_ranks", p.messages.neighbour_ranks},
                       {"reductions", p.reductions}}},
                     {"quiet",
                      {{"allowed", p.skipping_allowed},
                       {"reason", p.skipping_reason},
                       {"line", json_location(p.skipping_where)}}},
                     {"outputs", outputs_json(p)},
                     {"time_step", limits_json(p)},
                     {"cost", cost_json(p.cost)},
                     {"memory", memory_json(p)}};
  return json.dump(2) + "\n";
}

}  // namespace sluice
