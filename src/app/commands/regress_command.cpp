// sluice regress: short runs against golden results, restarts, splits and ranks.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "app/command/command_line.hpp"
#include "app/process/data_folder.hpp"
#include "app/process/study_process.hpp"
#include "app/regress/regress_case.hpp"
#include "framework/base/console.hpp"
#include "framework/base/error.hpp"
#include "framework/base/json.hpp"
#include "framework/base/temporary_folder.hpp"
#include "framework/deck/nearest_name.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;
struct RegressRequest {
  std::string file, mpiexec = "mpiexec", folder, against;
  std::vector<std::string> names;
  bool bless = false, json = false, list = false;
};

std::vector<RegressCase> select(std::vector<RegressCase> all,
                                const std::vector<std::string>& names) {
  if (names.empty()) return all;
  std::vector<RegressCase> chosen;
  for (const std::string& name : names) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.name == name; });
    if (found != all.end()) {
      chosen.push_back(*found);
      continue;
    }
    std::vector<std::string> known;
    for (const RegressCase& c : all) known.push_back(c.name);
    throw InputError(fmt::format("there is no case '{}' ({})", name, suggest_name(name, known)));
  }
  return chosen;
}

void print_table(const std::vector<RegressResult>& results) {
  TextTable table({{"case"},
                   {"golden"},
                   {"restart"},
                   {"boxes"},
                   {"ranks"},
                   {"against"},
                   {"time", TextTable::Align::right}});
  std::string messages;
  for (const RegressResult& r : results) {
    std::vector<std::string> row = {r.name};
    for (const RegressCheck& c : r.checks) {
      row.emplace_back(to_string(c.verdict));
      if (!c.message.empty()) messages += fmt::format("{}, {}: {}\n", r.name, c.name, c.message);
    }
    row.resize(6, "-");
    row.push_back(human_duration(r.seconds));
    table.row(std::move(row));
  }
  fmt::print("{}{}", table.text(), messages);
}

void print_json(const std::vector<RegressResult>& results) {
  Json list = Json::array();
  for (const RegressResult& r : results) {
    Json checks = Json::object();
    for (const RegressCheck& c : r.checks)
      checks[c.name] = {{"verdict", to_string(c.verdict)}, {"message", c.message}};
    list.push_back(
        {{"name", r.name}, {"good", r.status() == 0}, {"seconds", r.seconds}, {"checks", checks}});
  }
  fmt::print("{}\n", Json{{"cases", list}}.dump(2));
}

int regress(const RegressRequest& o) {
  const fs::path list =
      o.file.empty() ? data_folder() / "regression" / "golden" / "cases.json" : fs::path(o.file);
  const std::vector<RegressCase> cases = select(read_regress_cases(list), o.names);
  if (o.list) {
    for (const RegressCase& c : cases) fmt::print("{}\n", c.name);
    return 0;
  }
  std::optional<TemporaryFolder> temporary;
  if (o.folder.empty()) temporary.emplace(TemporaryFolder::Place::disk);
  RegressRunner runner;
  runner.executable = own_executable();
  runner.against = o.against;
  if (!o.against.empty() && !fs::exists(o.against))
    throw InputError(fmt::format("--against {}: there is no such file", o.against));
  runner.folder = temporary ? temporary->path() : fs::path(o.folder);
  runner.mpiexec = o.mpiexec;
  runner.bless = o.bless;
  std::vector<RegressResult> results;
  for (const RegressCase& c : cases) results.push_back(runner.run(c));
  if (o.json)
    print_json(results);
  else
    print_table(results);
  int status = 0;
  for (const RegressResult& r : results) status = std::max(status, r.status());
  return status;
}

}  // namespace

void declare_regress_command(Command& command) {
  auto o = std::make_shared<RegressRequest>();
  command.option("CASES", o->names, "Names of cases; all when none is given");
  command.option("--cases", o->file, "List of cases (JSON); default: those of sluice");
  command.option("--against", o->against,
                 "Another build of sluice, whose outputs must be equal to the bit");
  command.option("--folder", o->folder, "Keep the archives of the runs in this folder");
  command.option("--mpiexec", o->mpiexec, "Launcher for runs on ranks");
  command.flag("--bless", o->bless, "Store the results as golden results");
  command.flag("--json", o->json, "As JSON, for scripts");
  command.flag("--list", o->list, "Print the names of the cases");
  command.action([o] { return regress(*o); });
}

}  // namespace sluice
