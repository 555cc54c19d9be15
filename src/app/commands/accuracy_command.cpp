// sluice accuracy STUDY|DECK: error against time over ladders of resolution and settings, and error
// bars of a user's own deck.
//
// Each run is a process of `sluice run` of its own; its time is that of the steps.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include "app/accuracy/deck_accuracy.hpp"
#include "app/command/command_line.hpp"
#include "app/command/option_values.hpp"
#include "app/process/data_folder.hpp"
#include "app/process/python_tool.hpp"
#include "app/process/run_journal.hpp"
#include "app/process/study_process.hpp"
#include "app/process/text_sink.hpp"
#include "app/study/study.hpp"
#include "app/study/study_measure.hpp"
#include "app/study/study_report.hpp"
#include "app/study/study_run.hpp"
#include "framework/base/console.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

struct AccuracyRequest {
  std::string study, folder, json, csv, picture, only;
  std::vector<std::string> overrides;
  int repeats = 7;
};

template <class Write>
void write_file(const fs::path& path, Write&& write) {
  std::ofstream out(path);
  write(out);
  if (!out.flush()) {
    throw SystemError(
        fmt::format("cannot write {}: is the disk full or the folder read-only?", path.string()));
  }
}

// The work-precision picture; a message instead of a failure when Python cannot draw it, because
// table, CSV and JSON are complete without.
void draw(const fs::path& json, const fs::path& picture, const std::string& title,
          const std::string& error_label, const fs::path& log) try {
  const int status = run_python_tool({"workprecision", json.string(), "-o", picture.string(),
                                      "--title", title, "--error-label", error_label},
                                     log);
  if (status == 0)
    fmt::print("picture: {}\n", picture.string());
  else
    fmt::print(stderr, "sluice: warning: no picture: {}\n", last_lines(log, 3));
  fs::remove(log);
} catch (const SystemError& missing) {
  fmt::print(stderr, "sluice: warning: no picture: {}\n", missing.what());
}

StudyReport measure(const Study& study, const AccuracyRequest& request, const fs::path& folder) {
  StudyReport report{study, {}, {}};
  StudyRunner runner;
  runner.executable = own_executable();
  runner.folder = folder;
  runner.repeats = request.repeats;
  const auto points = points_of(study);
  RunJournal journal(folder);
  if (journal.size() > 0)
    fmt::print("{} runs are taken from {}: a study that did not come to its end\n", journal.size(),
               folder.string());
  if (study.reference) {
    report.reference = runner.run_reference(study);
    const StudyResult& r = *report.reference;
    fmt::print("reference, N {}: {}{}\n", r.point.cells(), human_duration(r.seconds),
               r.error > 0 ? fmt::format(", its own error below {:.3e}", r.error) : "");
    std::fflush(stdout);
  }
  std::size_t number = 0;
  for (const StudyPoint& point : points) {
    ++number;
    if (!request.only.empty() && !matches(point, request.only)) continue;
    const std::string key = runner.key_of(study, point);
    if (const auto found = journal.find(key)) {
      report.results.push_back(result_from_json(*found, study, point));
    } else {
      report.results.push_back(runner.run(study, point));
      journal.add(key, to_json(report.results.back()));
    }
    const StudyResult& r = report.results.back();
    fmt::print("[{}/{}] {}, N {}: {}\n", number, points.size(), point.setting, point.cells(),
               r.done() ? fmt::format("error {:.3e}, {}{}", r.error, human_duration(r.seconds),
                                      r.noisy() ? " (noisy)" : "")
                        : r.status + ": " + r.message);
    std::fflush(stdout);
  }
  journal.finish();
  if (report.results.empty()) {
    throw InputError(fmt::format("--only {} matches none of the {} runs; the first is \"{}, N {}\"",
                                 request.only, points.size(), points[0].setting,
                                 points[0].cells()));
  }
  return report;
}

// Error bars of a deck from its own ladder of resolutions.
int accuracy_of_deck(const AccuracyRequest& request) {
  const std::string stem = fs::path(request.study).stem().string();
  const fs::path folder = request.folder.empty() ? stem + ".accuracy" : request.folder;
  DeckLadder ladder(own_executable(), request.study, request.overrides, folder);
  make_output_folder(folder);
  const DeckAccuracy found = measure_accuracy(ladder, request.study);
  fmt::print("{}: error bars from runs at several resolutions, relative to the mean size\n\n{}\n",
             found.title, accuracy_table(found));
  for (const Rung& rung : found.rungs) fs::remove_all(rung.archive.parent_path());
  const fs::path json = request.json.empty() ? folder / (stem + ".json") : fs::path(request.json);
  write_file(json, [&](std::ostream& out) { out << accuracy_json(found).dump(2) << "\n"; });
  fmt::print("numbers: {}\n", json.string());
  draw(json, folder / (stem + ".png"), found.title, "relative error bar", folder / "picture.log");
  return static_cast<int>(ExitStatus::good);
}

int accuracy(const AccuracyRequest& request) {
  if (fs::path(request.study).extension() == ".ups") return accuracy_of_deck(request);
  if (!request.overrides.empty())
    throw InputError("--set goes with a deck; a study says itself what it sets");
  const Study study = read_study(find_data(request.study, "regression/accuracy", ".study"));
  require_measurable(study);
  const std::string stem = fs::path(request.study).stem().string();
  const fs::path folder = request.folder.empty() ? stem + ".accuracy" : request.folder;
  make_output_folder(folder);
  fmt::print("{}: {} of {}, {}\n", study.title, study.norm, study.variable, study.deck);
  const StudyReport report = measure(study, request, folder);
  fmt::print("\n{}\n{}\n", runs_table(report), targets_table(report));

  const fs::path json = request.json.empty() ? folder / (stem + ".json") : fs::path(request.json);
  const fs::path csv = request.csv.empty() ? folder / (stem + ".csv") : fs::path(request.csv);
  write_file(json, [&](std::ostream& out) { out << json_text(report); });
  write_file(csv, [&](std::ostream& out) { write_csv(out, report); });
  fmt::print("numbers: {} and {}\n", json.string(), csv.string());
  draw(json, folder / (stem + ".png"), study.title,
       fmt::format("{} error of {}", study.norm, study.variable), folder / "picture.log");
  for (const StudyResult& r : report.results) {
    if (!r.done()) return static_cast<int>(ExitStatus::failed);
  }
  return static_cast<int>(ExitStatus::good);
}

}  // namespace

void declare_accuracy_command(Command& command) {
  auto request = std::make_shared<AccuracyRequest>();
  command
      .option("STUDY", request->study,
              "Study file (.study), the name of a study of regression/accuracy (sod), or a deck "
              "(.ups): error bars of all that it saves, from runs at several resolutions")
      .required();
  command.option("-o", request->folder, "Folder for the results (STUDY.accuracy)");
  command.option("--json", request->json, "JSON file (in the folder)");
  command.option("--csv", request->csv, "CSV file (in the folder)");
  command.option("--repeat", request->repeats, "Largest number of runs of each point, for its time")
      .between(1, 1000);
  command.option("--only", request->only,
                 "Only runs whose \"setting, N cells\" contains this text or matches this pattern");
  add_deck_changes(command, request->overrides, " of a deck");
  command.action([request] { return accuracy(*request); });
}

}  // namespace sluice
