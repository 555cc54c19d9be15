// Maps as JSON, and compared with recorded ones.
#include <fmt/format.h>
#include <sys/utsname.h>

#include <map>

#include "app/stability/stability_map.hpp"
#include "framework/base/utc_time.hpp"
#include "sluice_version.hpp"

namespace sluice {
namespace {

// Which value of which sweep a run is; the default run is none.
void name_value(const CaseMap& map, const StabilityPoint& point, Json& row) {
  if (point.sweep < 0) return;
  const StabilityCase::Sweep& sweep = map.hard.sweeps[point.sweep];
  row["sweep"] = sweep.name;
  row["value"] = sweep.values[point.value].name;
}

Json run_json(const CaseMap& map, const StabilityResult& r) {
  Json row = to_json(r);
  row["counts"] = map.counts(r.point);
  name_value(map, r.point, row);
  return row;
}

Json to_json(const CaseMap& map) {
  const StabilityCase& hard = map.hard;
  Json sweeps = Json::array();
  for (std::size_t s = 0; s < hard.sweeps.size(); ++s) {
    Json names = Json::array();
    for (const auto& value : hard.sweeps[s].values) names.push_back(value.name);
    const auto margin = map.margin(static_cast<int>(s));
    sweeps.push_back({{"name", hard.sweeps[s].name},
                      {"default", hard.sweeps[s].default_value},
                      {"values", std::move(names)},
                      {"margin", margin ? Json(*margin) : Json()},
                      {"never_failed_above", map.never_failed_above(static_cast<int>(s))}});
  }
  Json must_hold = Json::array();
  for (const auto& requirement : hard.must_hold) must_hold.push_back(requirement->text());
  Json runs = Json::array();
  for (const StabilityResult& r : map.results) runs.push_back(run_json(map, r));
  return {{"name", hard.name},
          {"title", hard.title},
          {"why", hard.why},
          {"source", hard.source},
          {"component", hard.component},
          {"traits", hard.traits},
          {"deck", hard.deck},
          {"must_hold", std::move(must_hold)},
          {"sweeps", std::move(sweeps)},
          {"runs", std::move(runs)}};
}

// "case, sweep value" of a run in a recorded map.
std::string recorded_name(const Json& hard, const Json& run) {
  const auto name = hard.at("name").get<std::string>();
  if (!run.contains("sweep")) return name + ", default";
  return fmt::format("{}, {} {}", name, run.at("sweep").get<std::string>(),
                     run.at("value").get<std::string>());
}

int rank_of(const std::string& verdict) {
  return verdict == "green" ? 0 : verdict == "amber" ? 1 : 2;
}

}  // namespace

Json map_json(const std::vector<CaseMap>& maps) {
  utsname machine{};
  ::uname(&machine);
  Json cases = Json::array();
  for (const CaseMap& map : maps) cases.push_back(to_json(map));
  const MapTotals totals = totals_of(maps);
  return {{"program", std::string("sluice ") + version::kText},
          {"host", machine.nodename},
          {"date", utc_now()},
          {"defaults_held", totals.defaults_held},
          {"points", totals.points},
          {"points_held", totals.points_held},
          {"seconds", totals.seconds},
          {"cases", std::move(cases)}};
}

Json verdicts_json(const std::vector<CaseMap>& maps) {
  Json cases = Json::array();
  for (const CaseMap& map : maps) {
    Json runs = Json::array();
    for (const StabilityResult& r : map.results) {
      Json run = {{"verdict", to_string(r.verdict)}};
      name_value(map, r.point, run);
      runs.push_back(std::move(run));
    }
    cases.push_back({{"name", map.hard.name}, {"runs", std::move(runs)}});
  }
  return {{"cases", std::move(cases)}};
}

MapChanges changes_since(const Json& recorded, const std::vector<CaseMap>& maps) {
  std::map<std::string, std::string> before;
  for (const Json& hard : recorded.at("cases").entries())
    for (const Json& run : hard.at("runs").entries())
      before[recorded_name(hard, run)] = run.at("verdict").get<std::string>();
  MapChanges changes;
  for (const CaseMap& map : maps) {
    for (const StabilityResult& r : map.results) {
      const auto found = before.find(run_name(map, r.point));
      if (found == before.end() || found->second == to_string(r.verdict)) continue;
      const bool worse = rank_of(to_string(r.verdict)) > rank_of(found->second);
      (worse ? changes.worse : changes.better)
          .push_back(fmt::format("{}: {}, was {}{}", found->first, to_string(r.verdict),
                                 found->second, r.message.empty() ? "" : "; " + r.message));
    }
  }
  return changes;
}

}  // namespace sluice
