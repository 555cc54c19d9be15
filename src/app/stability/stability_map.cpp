#include "app/stability/stability_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "framework/base/console.hpp"
#include "framework/base/text.hpp"

namespace sluice {
namespace {

// Numbers with the verdicts of their runs, ascending.
std::map<double, StabilityVerdict> verdicts_by_number(const CaseMap& map, int sweep) {
  std::map<double, StabilityVerdict> verdicts;
  const StabilityCase::Sweep& s = map.hard.sweeps[sweep];
  for (std::size_t v = 0; v < s.values.size(); ++v) {
    const auto number = number_of(s.values[v].name);
    if (!number) return {};
    verdicts[*number] = map.at(sweep, static_cast<int>(v)).verdict;
  }
  return verdicts;
}

// "0.2 0.4* [0.8] (1.2)": the default has a star, red values are in brackets, amber ones in round.
std::string sweep_text(const CaseMap& map, int sweep) {
  const StabilityCase::Sweep& s = map.hard.sweeps[sweep];
  std::string text = s.name + ":";
  for (std::size_t v = 0; v < s.values.size(); ++v) {
    const StabilityVerdict verdict = map.at(sweep, static_cast<int>(v)).verdict;
    std::string value = s.values[v].name + (s.values[v].name == s.default_value ? "*" : "");
    if (verdict == StabilityVerdict::red) value = "[" + value + "]";
    if (verdict == StabilityVerdict::amber) value = "(" + value + ")";
    text += " " + value + (s.values[v].counts ? "" : "†");
  }
  return text;
}

std::string margin_text(const CaseMap& map, int sweep) {
  const auto margin = map.margin(sweep);
  if (!margin) return {};
  return fmt::format(" (margin {}{:.3g})", map.never_failed_above(sweep) ? "over " : "", *margin);
}

}  // namespace

std::string run_name(const CaseMap& map, const StabilityPoint& point) {
  if (point.sweep < 0) return map.hard.name + ", default";
  const StabilityCase::Sweep& sweep = map.hard.sweeps[point.sweep];
  return fmt::format("{}, {} {}", map.hard.name, sweep.name, sweep.values[point.value].name);
}

const StabilityResult& CaseMap::at(int sweep, int value) const {
  for (const StabilityResult& r : results)
    if (r.point.sweep == sweep && r.point.value == value) return r;
  return at_default();
}

bool CaseMap::counts(const StabilityPoint& point) const {
  return point.sweep < 0 || hard.sweeps[point.sweep].values[point.value].counts;
}

std::optional<double> CaseMap::margin(int sweep) const {
  const auto verdicts = verdicts_by_number(*this, sweep);
  const auto start = number_of(hard.sweeps[sweep].default_value);
  if (verdicts.empty() || !start || !(*start > 0)) return std::nullopt;
  double reached = 0;
  for (auto at = verdicts.find(*start);
       at != verdicts.end() && at->second == StabilityVerdict::green; ++at)
    reached = at->first;
  return reached / *start;
}

bool CaseMap::never_failed_above(int sweep) const {
  const auto verdicts = verdicts_by_number(*this, sweep);
  const auto reached = margin(sweep);
  const auto start = number_of(hard.sweeps[sweep].default_value);
  return reached && start && *reached * *start >= verdicts.rbegin()->first * (1 - 1e-12);
}

MapTotals totals_of(const std::vector<CaseMap>& maps) {
  MapTotals totals;
  for (const CaseMap& map : maps) {
    ++totals.cases;
    totals.defaults_held += map.at_default().verdict == StabilityVerdict::green;
    for (const StabilityResult& r : map.results) {
      totals.seconds += r.seconds;
      if (!map.counts(r.point)) continue;
      ++totals.points;
      totals.points_held += r.verdict == StabilityVerdict::green;
    }
  }
  return totals;
}

std::string map_table(const std::vector<CaseMap>& maps) {
  using Align = TextTable::Align;
  TextTable table({{"case"},
                   {"default"},
                   {"steps", Align::right},
                   {"time", Align::right},
                   {"sweeps (* default, [red], (amber), † beyond the scheme's limit)"}});
  for (const CaseMap& map : maps) {
    std::string sweeps;
    for (std::size_t s = 0; s < map.hard.sweeps.size(); ++s)
      sweeps += (s > 0 ? "; " : "") + sweep_text(map, static_cast<int>(s)) +
                margin_text(map, static_cast<int>(s));
    const StabilityResult& r = map.at_default();
    table.row({map.hard.name, to_string(r.verdict), std::to_string(r.steps),
               human_duration(r.seconds), sweeps});
  }
  return table.text();
}

std::string failures_text(const std::vector<CaseMap>& maps) {
  std::string text;
  for (const CaseMap& map : maps)
    for (const StabilityResult& r : map.results)
      if (r.verdict != StabilityVerdict::green)
        text += fmt::format("{}{}: {}\n  {}\n  repeat: {}\n", run_name(map, r.point),
                            map.counts(r.point) ? "" : " (beyond the scheme's limit)",
                            to_string(r.verdict), r.message, r.command);
  return text;
}

}  // namespace sluice
