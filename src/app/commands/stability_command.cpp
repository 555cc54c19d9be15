// sluice stability [CASE...|DECK.ups]: where hard cases hold, and how far a deck is from failing.
//
// Each run is a process of `sluice run` of its own, on one thread; several run at once.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <thread>

#include "app/command/command_line.hpp"
#include "app/command/option_values.hpp"
#include "app/process/data_folder.hpp"
#include "app/process/python_tool.hpp"
#include "app/process/study_process.hpp"
#include "app/process/text_sink.hpp"
#include "app/stability/deck_stability.hpp"
#include "app/stability/stability_series.hpp"
#include "framework/base/console.hpp"
#include "framework/base/error.hpp"
#include "framework/deck/nearest_name.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

constexpr double deck_budget = 8;  // cost of all runs of a user's deck, in those of its own

struct StabilityRequest {
  std::vector<std::string> names, overrides;
  std::string folder = "stability", cases, record, against;
  bool quick = false, list = false, no_picture = false;
  int jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));

  fs::path cases_folder() const {
    return cases.empty() ? data_folder() / "regression" / "stability" : fs::path(cases);
  }
};

bool is_deck(const std::string& name) {
  return fs::path(name).extension() == ".ups";
}

bool is_case_file(const std::string& name) {
  return fs::path(name).extension() == ".stability";
}

std::vector<StabilityCase> chosen_cases(const StabilityRequest& o) {
  std::vector<StabilityCase> chosen;
  std::vector<std::string> known;
  // Files that are named need no folder of cases.
  std::vector<StabilityCase> all;
  if (o.names.empty() || !std::all_of(o.names.begin(), o.names.end(), is_case_file))
    all = read_stability_cases(o.cases_folder().string());
  for (const StabilityCase& hard : all) known.push_back(hard.name);
  for (const std::string& name : o.names) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.name == name; });
    if (found != all.end())
      chosen.push_back(*found);
    else if (is_case_file(name))
      chosen.push_back(read_stability_case(name));
    else
      throw InputError(
          fmt::format("there is no case '{}' ({}); a deck ends with .ups, a case of "
                      "your own with .stability",
                      name, suggest_name(name, known)));
  }
  if (o.names.empty()) chosen = all;
  if (o.quick) std::erase_if(chosen, [](const StabilityCase& hard) { return !hard.quick; });
  return chosen;
}

void write_json(const fs::path& path, const Json& json) {
  write_text(path.string(), json.dump(1) + "\n");
}

// Picture and page; a message where Python cannot draw, because table and JSON are complete.
void draw(const fs::path& folder) try {
  const fs::path log = folder / "picture.log";
  const int status = run_python_tool(
      {"stability", (folder / "stability.json").string(), "-o", (folder / "stability.png").string(),
       "--page", (folder / "stability.html").string()},
      log);
  if (status == 0)
    fmt::print("picture and page: {} and {}\n", (folder / "stability.png").string(),
               (folder / "stability.html").string());
  else
    fmt::print(stderr, "sluice: warning: no picture: {}\n", last_lines(log, 3));
  fs::remove(log);
} catch (const SystemError& missing) {
  fmt::print(stderr, "sluice: warning: no picture: {}\n", missing.what());
}

void tell(std::size_t done, std::size_t all, const CaseMap& map, const StabilityResult& r) {
  fmt::print("[{}/{}] {}: {}, {} steps, {}{}\n", done, all, run_name(map, r.point),
             to_string(r.verdict), r.steps, human_duration(r.seconds),
             r.verdict == StabilityVerdict::green ? "" : "; " + r.message);
  std::fflush(stdout);
}

// The map this one is compared with; null where there is none.
Json recorded_map(const StabilityRequest& o) {
  const fs::path file =
      o.against.empty() ? o.cases_folder() / "recorded.json" : fs::path(o.against);
  std::ifstream in(file);
  if (!in && o.against.empty()) return {};
  if (!in) throw InputError(fmt::format("{}: cannot be read; name a recorded map", file.string()));
  try {
    return Json::parse({std::istreambuf_iterator<char>(in), {}});
  } catch (const JsonError& problem) {
    throw InputError(fmt::format("{}: this is not JSON: {}", file.string(), problem.what()));
  }
}

// The number of runs that became worse; nothing where there is no recorded map.
std::optional<std::size_t> print_changes(const StabilityRequest& o,
                                         const std::vector<CaseMap>& maps) {
  const Json recorded = recorded_map(o);
  if (recorded.is_null()) return std::nullopt;
  MapChanges changes;
  try {
    changes = changes_since(recorded, maps);
  } catch (const JsonError& problem) {
    throw InputError(fmt::format("the recorded map is none: {}", problem.what()));
  }
  for (const std::string& line : changes.worse) fmt::print("worse: {}\n", line);
  for (const std::string& line : changes.better) fmt::print("better: {}\n", line);
  if (changes.worse.empty() && changes.better.empty())
    fmt::print("no verdict differs from the recorded map\n");
  return changes.worse.size();
}

int run_all(const StabilityRequest& o) {
  const auto cases = chosen_cases(o);
  if (o.list) {
    for (const StabilityCase& hard : cases)
      fmt::print("{:32} {:10} {}\n", hard.name, hard.component, hard.title);
    return static_cast<int>(ExitStatus::good);
  }
  RunJournal journal(o.folder);
  if (journal.size() > 0)
    fmt::print("{} runs are taken from {}: a series that did not come to its end\n", journal.size(),
               o.folder);
  const auto maps = run_cases(cases, {own_executable(), o.folder}, o.jobs, journal, tell);
  journal.finish();
  fmt::print("\n{}\n{}", map_table(maps), failures_text(maps));
  const MapTotals totals = totals_of(maps);
  fmt::print(
      "{} of {} defaults hold; {} of {} runs within the limits of their schemes ({:.1f} %); "
      "{} of stepping\n",
      totals.defaults_held, totals.cases, totals.points_held, totals.points,
      100.0 * totals.points_held / std::max(1, totals.points), human_duration(totals.seconds));
  write_json(fs::path(o.folder) / "stability.json", map_json(maps));
  if (!o.record.empty()) write_json(o.record, verdicts_json(maps));
  if (!o.no_picture) draw(o.folder);
  // What a recorded map knows to fail is no news.
  const auto worse = print_changes(o, maps);
  const bool bad = worse ? *worse > 0 : totals.defaults_held < totals.cases;
  return static_cast<int>(bad ? ExitStatus::failed : ExitStatus::good);
}

int run_deck_sweep(const StabilityRequest& o) {
  if (o.names.size() > 1)
    throw InputError("one deck at a time: its runs are compared with its own");
  const StabilityRunner runner{own_executable(), o.folder};
  int number = 0;
  const auto found = sweep_deck(o.names[0], o.overrides, deck_budget,
                                [&](const StabilityCase& hard, const StabilityPoint& point) {
                                  StabilityResult result = runner.run(hard, point, number++);
                                  const CaseMap map{hard, {}};
                                  fmt::print("{}: {}, {} steps, {}\n", run_name(map, point),
                                             to_string(result.verdict), result.steps,
                                             human_duration(result.seconds));
                                  std::fflush(stdout);
                                  return result;
                                });
  const CaseMap& map = found.map;
  fmt::print("\n{}\n{}", map_table({map}), failures_text({map}));
  if (found.distances.empty())
    fmt::print("the deck does not hold at its own settings: {}\n", map.at_default().message);
  for (const DistanceToFailure& distance : found.distances) fmt::print("{}\n", distance.text());
  write_json(fs::path(o.folder) / "stability.json", deck_stability_json(found));
  if (!o.no_picture) draw(o.folder);
  return static_cast<int>(found.distances.empty() ? ExitStatus::failed : ExitStatus::good);
}

int stability(const StabilityRequest& o) {
  const bool of_deck = std::any_of(o.names.begin(), o.names.end(), is_deck);
  if (!of_deck && !o.overrides.empty())
    throw InputError("--set goes with a deck; a case says itself what it sets");
  if (!o.list) make_output_folder(o.folder);
  return of_deck ? run_deck_sweep(o) : run_all(o);
}

}  // namespace

void declare_stability_command(Command& command) {
  auto request = std::make_shared<StabilityRequest>();
  command.option("CASE", request->names,
                 "Cases of regression/stability by name (all), files of your own (.stability), or "
                 "one deck (.ups): how far it is from failing");
  command.flag("--quick", request->quick, "Only the cases of the quick subset");
  command.flag("--list", request->list, "Name the cases, run nothing");
  command.option("-o", request->folder, "Folder for map, picture and page (stability)");
  command.option("--jobs", request->jobs, "Runs at once (as many as there are cores)")
      .between(1, 1024);
  add_deck_changes(command, request->overrides, " of a deck");
  command.option("--cases", request->cases, "Another folder of cases");
  command.option("--against", request->against,
                 "Compare with this map (recorded.json beside the cases)");
  command.option("--record", request->record, "Write the verdicts into this file");
  command.flag("--no-picture", request->no_picture, "Table and JSON alone");
  command.action([request] { return stability(*request); });
}

}  // namespace sluice
