// Rows of effects for people.
#include "app/effect_table.hpp"

#include <fmt/format.h>

#include "framework/base/console.hpp"

namespace sluice {

std::string effect_table(const std::vector<EffectCost>& effects, bool measured) {
  using Align = TextTable::Align;
  std::vector<TextTable::Column> columns = {
      {"effect"}, {"on"}, {"tasks", Align::right}, {"bytes/cell", Align::right}};
  if (measured) columns.push_back({"time", Align::right});
  columns.push_back({"because"});
  columns.push_back({"deck line"});
  TextTable table(columns);
  double total = 0;
  for (const EffectCost& e : effects) total += e.seconds;
  for (const EffectCost& e : effects) {
    std::vector<std::string> row = {
        e.effect.name, e.effect.on ? "on" : "off", e.tasks > 0 ? std::to_string(e.tasks) : "",
        e.bytes_per_cell > 0 ? fmt::format("{:.0f}", e.bytes_per_cell) : ""};
    if (measured)
      row.push_back(e.seconds > 0 ? fmt::format("{:.1f} %", 100 * e.seconds / total) : "");
    row.push_back(e.effect.reason);
    row.push_back(e.effect.line.file.empty() ? "" : to_string(e.effect.line));
    table.row(std::move(row));
  }
  return table.text("  ");
}

}  // namespace sluice
