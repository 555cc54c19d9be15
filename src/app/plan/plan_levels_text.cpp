#include "app/plan/plan_levels_text.hpp"

#include <fmt/format.h>

#include "app/command/effect_table.hpp"
#include "framework/base/console.hpp"
#include "framework/base/json.hpp"

namespace sluice {
namespace {

using Align = TextTable::Align;
std::string triple(IntVec3 v) {
  return fmt::format("{},{},{}", v.x, v.y, v.z);
}

std::string percent(double share) {
  return fmt::format("{:.3g} %", 100 * share);
}

std::string level_table(const PlannedHierarchy& p) {
  TextTable table({{"level", Align::right},
                   {"ratio"},
                   {"tile"},
                   {"cells", Align::right},
                   {"boxes", Align::right},
                   {"of the domain", Align::right},
                   {"substeps", Align::right},
                   {"updates per coarse step", Align::right}});
  for (const PlannedLevel& l : p.levels) {
    const bool finer = l.level.index > 0;
    const bool told = !finer || p.known;
    const auto updates = static_cast<std::int64_t>(l.updates());
    table.row({std::to_string(l.level.index), finer ? triple(l.level.ratio) : "",
               finer && p.adaptive ? triple(l.tile) : "",
               told ? human_count(l.level.cell_count()) : "?",
               told ? std::to_string(l.level.boxes.size()) : "?", told ? percent(l.share()) : "?",
               std::to_string(l.substeps), told ? human_count(updates) : "?"});
  }
  return table.text("  ");
}

std::string rule_table(const char* title, const char* value,
                       const std::vector<PlannedRule>& rules) {
  TextTable table({{title}, {value}, {"deck line"}});
  for (const PlannedRule& r : rules) table.row({r.what, r.value, short_place(r.where)});
  return table.text("  ");
}

std::string indented(const std::string& lines) {
  std::string text;
  for (std::size_t at = 0; at < lines.size();) {
    const std::size_t end = std::min(lines.find('\n', at), lines.size());
    text += "    " + lines.substr(at, end - at) + "\n";
    at = end + 1;
  }
  return text;
}

Json place_json(const Location& where) {
  if (where.file.empty()) return nullptr;
  return to_string(where);
}

Json rules_json(const std::vector<PlannedRule>& rules) {
  Json list = Json::array();
  for (const PlannedRule& r : rules)
    list.push_back({{"what", r.what}, {"value", r.value}, {"line", place_json(r.where)}});
  return list;
}

}  // namespace

std::string levels_text(const PlannedHierarchy& p) {
  std::string text = level_table(p);
  if (p.known && p.uniform_updates() > 0)
    text += fmt::format(
        "  {}a coarse step has {} updates: {} of the {} that a uniform fine grid needs\n",
        p.adaptive ? "at the start " : "", human_count(static_cast<std::int64_t>(p.updates())),
        percent(p.updates() / p.uniform_updates()),
        human_count(static_cast<std::int64_t>(p.uniform_updates())));
  else
    text +=
        "  the finer levels are known when the run starts: the coarsest level is too large to be "
        "flagged in a plan\n";
  if (p.adaptive && p.criteria.empty())
    text += "  the deck has no criterion for finer levels\n";
  else if (p.adaptive)
    text += "\n" + rule_table("refined by", "where", p.criteria);
  text += "\n" + rule_table("levels", "", p.rules);
  text += fmt::format("  {}\n", p.stepping);
  return text + indented(p.cycle);
}

Json levels_json(const PlannedHierarchy& p) {
  Json levels = Json::array();
  for (const PlannedLevel& l : p.levels) {
    const IntVec3 r = l.level.ratio, t = l.tile;
    Json cells = nullptr, boxes = nullptr;
    if (p.known || l.level.index == 0) {
      cells = l.level.cell_count();
      boxes = l.level.boxes.size();
    }
    levels.push_back({{"ratio", {r.x, r.y, r.z}},
                      {"tile", {t.x, t.y, t.z}},
                      {"cells", cells},
                      {"boxes", boxes},
                      {"domain_cells", l.level.domain.volume()},
                      {"substeps", l.substeps}});
  }
  Json updates = nullptr, uniform = nullptr;
  if (p.known) {
    updates = p.updates();
    uniform = p.uniform_updates();
  }
  return {{"adaptive", p.adaptive},
          {"levels", levels},
          {"updates_per_coarse_step", updates},
          {"uniform_updates", uniform},
          {"stepping", p.stepping},
          {"cycle", p.cycle},
          {"criteria", rules_json(p.criteria)},
          {"rules", rules_json(p.rules)}};
}

}  // namespace sluice
