// sluice regress: short runs against golden results, restarts, splits and ranks.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "app/command/command_line.hpp"
#include "app/process/data_folder.hpp"
#include "app/process/study_process.hpp"
#include "app/process/text_sink.hpp"
#include "app/regress/regress_case.hpp"
#include "app/regress/regress_folder.hpp"
#include "app/regress/regress_keys.hpp"
#include "app/regress/regress_page.hpp"
#include "framework/base/console.hpp"
#include "framework/base/error.hpp"
#include "framework/base/json.hpp"
#include "framework/base/temporary_folder.hpp"
#include "framework/deck/nearest_name.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;
struct RegressRequest {
  std::string file, mpiexec = "mpiexec", folder, against, html;
  std::vector<std::string> names;
  std::string json;
  bool bless = false, list = false;
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
  const std::vector<std::string> names = check_names(results);
  std::vector<TextTable::Column> columns = {{"case"}};
  for (const std::string& name : names) columns.push_back({name});
  columns.push_back({"time", TextTable::Align::right});
  TextTable table(columns);
  std::string messages;
  for (const RegressResult& r : results) {
    std::vector<std::string> row = {r.name};
    for (const std::string& name : names) {
      const auto check = std::find_if(r.checks.begin(), r.checks.end(),
                                      [&](const RegressCheck& c) { return c.name == name; });
      row.emplace_back(check == r.checks.end() ? "-" : to_string(check->verdict));
    }
    for (const RegressCheck& c : r.checks)
      if (!c.message.empty()) messages += fmt::format("{}, {}: {}\n", r.name, c.name, c.message);
    row.push_back(human_duration(r.seconds));
    table.row(std::move(row));
  }
  fmt::print("{}{}", table.text(), messages);
}

// A folder of decks is named alone; everything else is names of cases.
bool names_folder(const RegressRequest& o) {
  return o.file.empty() && o.names.size() == 1 && fs::is_directory(o.names.front());
}

std::vector<RegressCase> cases_of(const RegressRequest& o) {
  if (names_folder(o)) return read_regress_folder(o.names.front());
  const fs::path list =
      o.file.empty() ? data_folder() / "regression" / "golden" / "cases.json" : fs::path(o.file);
  return select(read_regress_cases(list), o.names);
}

int regress(const RegressRequest& o) {
  const std::vector<RegressCase> cases = cases_of(o);
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
  // Opened before the runs: a path that cannot be written must not cost them.
  std::optional<TextSink> page;
  if (!o.html.empty()) page.emplace(o.html);
  std::vector<RegressResult> results;
  for (const RegressCase& c : cases) results.push_back(runner.run(c));
  if (page) {
    page->write(regress_page(results));
    page->close();
  }
  if (!o.json.empty()) write_text(o.json, regress_json(results).dump(2) + "\n");
  if (o.json != "-") print_table(results);
  int status = 0;
  for (const RegressResult& r : results) status = std::max(status, r.status());
  return status;
}

}  // namespace

void declare_regress_command(Command& command) {
  auto o = std::make_shared<RegressRequest>();
  command.option("CASES", o->names,
                 "Names of cases, all when none is given; or a folder of decks with the gold "
                 "(archives NAME.uda, or .dat files) beside them");
  command.option("--cases", o->file, "List of cases (JSON); default: those of sluice");
  command.option("--against", o->against,
                 "Another build of sluice, whose outputs must be equal to the bit");
  command.option("--folder", o->folder, "Keep the archives of the runs in this folder");
  command.option("--mpiexec", o->mpiexec, "Launcher for runs on ranks");
  command.flag("--bless", o->bless, "Store the results as golden results");
  command.option("--html", o->html, "Write a page of what has moved to this file");
  command.json(o->json, "As JSON, for scripts");
  command.flag("--list", o->list, "Print the names of the cases");
  command.closing_text(regress_keys_help());
  command.action([o] { return regress(*o); });
}

}  // namespace sluice
