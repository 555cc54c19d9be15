// Rows of effects for people.
#include "app/command/effect_table.hpp"

#include <fmt/format.h>

#include "framework/base/console.hpp"

namespace sluice {

namespace {

using Align = TextTable::Align;

// `last_cost`: title and cells of the column that differs.
std::string effect_table(const std::vector<EffectCost>& effects, const std::string& last_cost,
                         const std::vector<std::string>& cells) {
  TextTable table({{"effect"},
                   {"on"},
                   {"tasks", Align::right},
                   {"bytes/cell", Align::right},
                   {last_cost, Align::right},
                   {"deck line"},
                   {"because"}});
  for (std::size_t n = 0; n < effects.size(); ++n) {
    const EffectCost& e = effects[n];
    table.row({e.effect.name, e.effect.on ? "on" : "off",
               e.tasks > 0 ? std::to_string(e.tasks) : "",
               e.bytes_per_cell > 0 ? fmt::format("{:.0f}", e.bytes_per_cell) : "", cells[n],
               short_place(e.effect.line), e.effect.reason});
  }
  return table.text("  ");
}

}  // namespace

std::string short_place(const Location& where) {
  if (where.file.empty()) return {};
  Location brief = where;
  brief.file = where.file.substr(where.file.find_last_of('/') + 1);
  brief.column = 0;
  return to_string(brief);
}

std::string measured_effect_table(const std::vector<EffectCost>& effects) {
  double total = 0;
  for (const EffectCost& e : effects) total += e.seconds;
  std::vector<std::string> shares;
  for (const EffectCost& e : effects)
    shares.push_back(e.seconds > 0 ? fmt::format("{:.1f} %", 100 * e.seconds / total) : "");
  return effect_table(effects, "time", shares);
}

std::string planned_effect_table(const std::vector<EffectCost>& effects,
                                 const std::vector<int>& fields) {
  std::vector<std::string> counts;
  for (int n : fields) counts.push_back(n > 0 ? std::to_string(n) : "");
  return effect_table(effects, "fields", counts);
}

}  // namespace sluice
