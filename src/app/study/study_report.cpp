#include "app/study/study_report.hpp"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "framework/base/console.hpp"
#include "framework/base/json.hpp"
#include "framework/base/text.hpp"
#include "framework/base/utc_time.hpp"
#include "sluice_version.hpp"

namespace sluice {
namespace {

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

// What this setting needs for the target; nothing when no two of its runs enclose it.
std::optional<Cost> cost_of(const std::vector<const StudyResult*>& runs, double target) {
  Cost cost;
  cost.setting = runs.front()->point.setting;
  cost.is_default = runs.front()->point.is_default;
  const StudyResult* coarser = nullptr;
  for (const StudyResult* run : runs) {
    if (!run->done() || !(run->seconds > 0)) continue;
    const double error = run->norms.relative_l1, cells = run->point.cells();
    if (error <= target && !coarser) {
      cost.cells = cells;
      cost.seconds = run->seconds;
      cost.measured = true;
      return cost;
    }
    if (error <= target) {
      const double share = std::log(coarser->norms.relative_l1 / target) /
                           std::log(coarser->norms.relative_l1 / error);
      cost.cells = coarser->point.cells() * std::pow(cells / coarser->point.cells(), share);
      cost.seconds = coarser->seconds * std::pow(run->seconds / coarser->seconds, share);
      return cost;
    }
    coarser = run;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> StudyReport::observed_order(std::size_t result) const {
  const StudyResult& fine = results[result];
  if (result == 0 || !fine.done()) return std::nullopt;
  const StudyResult& coarse = results[result - 1];
  if (!coarse.done() || coarse.point.setting != fine.point.setting) return std::nullopt;
  if (coarse.point.cells() == fine.point.cells() || !(fine.error > 0)) return std::nullopt;
  return std::log(coarse.error / fine.error) /
         std::log(static_cast<double>(fine.point.cells()) / coarse.point.cells());
}

bool StudyReport::on_front(std::size_t result) const {
  const StudyResult& mine = results[result];
  if (!mine.done()) return false;
  for (const StudyResult& other : results) {
    if (!other.done()) continue;
    const bool no_worse = other.error <= mine.error && other.seconds <= mine.seconds;
    if (no_worse && (other.error < mine.error || other.seconds < mine.seconds)) return false;
  }
  return true;
}

std::vector<Cost> costs_of_target(const StudyReport& report, double target) {
  std::vector<Cost> costs;
  std::vector<const StudyResult*> runs;
  for (std::size_t i = 0; i < report.results.size(); ++i) {
    runs.push_back(&report.results[i]);
    const bool last = i + 1 == report.results.size() ||
                      report.results[i + 1].point.setting != report.results[i].point.setting;
    if (!last) continue;
    if (auto cost = cost_of(runs, target)) costs.push_back(*cost);
    runs.clear();
  }
  std::stable_sort(costs.begin(), costs.end(),
                   [](const Cost& a, const Cost& b) { return a.seconds < b.seconds; });
  return costs;
}

std::string runs_table(const StudyReport& report) {
  using Align = TextTable::Align;
  TextTable table({{"setting"},
                   {"N", Align::right},
                   {"steps", Align::right},
                   {"error", Align::right},
                   {"relative", Align::right},
                   {"order", Align::right},
                   {"time", Align::right},
                   {"spread", Align::right},
                   {"best", Align::left}});
  for (std::size_t i = 0; i < report.results.size(); ++i) {
    const StudyResult& r = report.results[i];
    const std::string setting = r.point.setting + (r.point.is_default ? " (default)" : "");
    if (!r.done()) {
      table.row({setting, std::to_string(r.point.cells()), std::to_string(r.steps), r.status, "",
                 "", human_duration(r.seconds), "", ""});
      continue;
    }
    const auto order = report.observed_order(i);
    const std::string spread = r.repeats < 2 ? "one run" : human_percent(r.spread);
    table.row({setting, std::to_string(r.point.cells()), std::to_string(r.steps),
               fmt::format("{:.3e}", r.error), human_percent(r.norms.relative_l1),
               order ? fmt::format("{:.2f}", *order) : "", human_duration(r.seconds),
               spread + (r.repeats >= 2 && r.noisy() ? " noisy" : ""),
               report.on_front(i) ? "*" : ""});
  }
  return table.text();
}

std::string targets_table(const StudyReport& report) {
  using Align = TextTable::Align;
  TextTable table({{"error", Align::right},
                   {"cheapest setting"},
                   {"N", Align::right},
                   {"time", Align::right},
                   {"default takes", Align::right}});
  for (const double target : report.study.targets) {
    const auto costs = costs_of_target(report, target);
    if (costs.empty()) {
      table.row({human_percent(target), "not reached by any run", "", "", ""});
      continue;
    }
    const auto text = [](const Cost& c, const std::string& value) {
      return (c.measured ? "<= " : "") + value;
    };
    const Cost& best = costs.front();
    std::string by_default = "not reached";
    for (const Cost& cost : costs) {
      if (cost.is_default) by_default = text(cost, human_duration(cost.seconds));
    }
    table.row({human_percent(target), best.setting, text(best, fmt::format("{:.0f}", best.cells)),
               text(best, human_duration(best.seconds)), by_default});
  }
  return table.text();
}

void write_csv(std::ostream& out, const StudyReport& report) {
  if (report.reference && report.reference->error > 0)
    out << fmt::format("# the error of the reference is below {}, relative {}\n",
                       exact_text(report.reference->error),
                       exact_text(report.reference->norms.relative_l1));
  out << "setting,default,cells,nx,ny,nz,steps,error,l1,l2,linf,relative_l1,order,seconds,wall_s,"
         "spread,repeats,pareto,status\n";
  for (std::size_t i = 0; i < report.results.size(); ++i) {
    const StudyResult& r = report.results[i];
    const auto order = report.observed_order(i);
    const auto number = [&](double value) { return r.done() ? exact_text(value) : ""; };
    out << fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_text(r.point.setting),
        r.point.is_default ? 1 : 0, r.point.cells(), r.point.resolution.x, r.point.resolution.y,
        r.point.resolution.z, r.steps, number(r.error), number(r.norms.l1), number(r.norms.l2),
        number(r.norms.linf), number(r.norms.relative_l1), order ? exact_text(*order) : "",
        exact_text(r.seconds), exact_text(r.wall_seconds), exact_text(r.spread), r.repeats,
        report.on_front(i) ? 1 : 0, r.status);
  }
}

namespace {

Json rows_of(const StudyReport& report) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < report.results.size(); ++i) {
    const StudyResult& r = report.results[i];
    const IntVec3 n = r.point.resolution;
    Json row = {{"setting", r.point.setting}, {"default", r.point.is_default},
                {"cells", r.point.cells()},   {"resolution", {n.x, n.y, n.z}},
                {"status", r.status},         {"steps", r.steps},
                {"seconds", r.seconds},       {"wall_s", r.wall_seconds},
                {"spread", r.spread},         {"repeats", r.repeats},
                {"noisy", r.noisy()},         {"pareto", report.on_front(i)},
                {"command", r.command}};
    const auto order = report.observed_order(i);
    row["error"] = r.done() ? Json(r.error) : Json();
    row["order"] = order ? Json(*order) : Json();
    if (r.done()) {
      row["norms"] = {{"l1", r.norms.l1},
                      {"l2", r.norms.l2},
                      {"linf", r.norms.linf},
                      {"relative_l1", r.norms.relative_l1}};
    } else {
      row["message"] = r.message;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

std::string json_text(const StudyReport& report) {
  utsname machine{};
  ::uname(&machine);
  const Study& study = report.study;
  Json json = {{"study", study.file},
               {"title", study.title},
               {"deck", study.deck},
               {"variable", study.variable},
               {"component", study.component},
               {"material", study.material},
               {"norm", study.norm},
               {"part", study.part},
               {"program", std::string("sluice ") + version::kText},
               {"host", machine.nodename},
               {"date", utc_now()}};
  if (study.reference) {
    const StudyPoint finer = reference_point(study);
    const IntVec3 n = finer.resolution;
    Json settings = Json::array();
    for (const std::string& one : finer.overrides) settings.push_back(one);
    json["reference"] = {{"resolution", {n.x, n.y, n.z}}, {"set", std::move(settings)}};
    if (report.reference && report.reference->error > 0) {
      json["reference"]["error"] = report.reference->error;
      json["reference"]["relative_l1"] = report.reference->norms.relative_l1;
    }
  }
  json["rows"] = rows_of(report);
  Json targets = Json::array();
  for (const double target : study.targets) {
    Json costs = Json::array();
    for (const Cost& cost : costs_of_target(report, target)) {
      costs.push_back({{"setting", cost.setting},
                       {"default", cost.is_default},
                       {"cells", cost.cells},
                       {"seconds", cost.seconds},
                       {"measured", cost.measured}});
    }
    targets.push_back({{"error", target}, {"costs", std::move(costs)}});
  }
  json["targets"] = std::move(targets);
  return json.dump(2) + "\n";
}

}  // namespace sluice
