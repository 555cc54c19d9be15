// Reading regression cases, running them and judging what came out.
#include "app/regress/regress_case.hpp"

#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <set>

#include "app/process/study_process.hpp"
#include "app/regress/golden.hpp"
#include "framework/archive/compare/compare.hpp"
#include "framework/base/error.hpp"
#include "framework/base/json.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, const std::string& where, const std::string& what) {
  throw InputError(fmt::format("{}: {}: {}", file.string(), where, what));
}

RegressCase read_case(const fs::path& file, const Json& json, std::size_t number) {
  std::string where = fmt::format("case {}", number + 1);
  if (!json.is_object()) refuse(file, where, "not an object");
  static const std::set<std::string> known = {"name",      "deck",    "set",   "variables",
                                              "tolerance", "restart", "boxes", "ranks"};
  for (const auto& [key, value] : json.members())
    if (known.count(key) == 0)
      refuse(file, where,
             fmt::format("unknown entry '{}' (known: {})", key, fmt::join(known, ", ")));
  RegressCase c;
  try {
    c.name = json.at("name").get<std::string>();
    where = "case '" + c.name + "'";
    c.deck = (file.parent_path() / json.at("deck").get<std::string>()).lexically_normal();
    c.variables = json.at("variables").get<std::vector<std::string>>();
    c.overrides = json.value("set", std::vector<std::string>{});
    c.tolerance = json.value("tolerance", c.tolerance);
    c.restart = json.value("restart", 0);
    c.ranks = json.value("ranks", 0);
    c.boxes = json.value("boxes", std::string());
  } catch (const JsonError& problem) {
    refuse(file, where, problem.what());
  }
  if (c.name.empty() || c.name.find('/') != c.name.npos)
    refuse(file, where, "the name cannot be used as a file name");
  if (c.variables.empty()) refuse(file, where, "no variables to compare");
  if (!(c.tolerance >= 0)) refuse(file, where, "tolerance must be at least 0");
  if (c.restart != 0 && c.restart < 3)
    refuse(file, where, "restart must be the number of a step, at least 3");
  if (c.ranks < 0) refuse(file, where, "ranks must be at least 0");
  if (c.ranks > 0 && c.boxes.empty())
    refuse(file, where, "ranks needs boxes, at least as many as there are ranks");
  if (!fs::exists(c.deck)) refuse(file, where, "there is no deck " + c.deck.string());
  c.golden = file.parent_path() / (c.name + ".csv");
  return c;
}

// Empty when all outputs of both archives hold the same bits.
std::string difference(const Archive& a, const Archive& b) {
  const CompareResult result = compare(a, b, {});
  if (!result.not_comparable.empty()) return result.not_comparable.front();
  if (const auto largest = result.largest())
    return fmt::format("{} of {} values; the largest: {}", result.differing, result.values,
                       to_string(*largest));
  return {};
}

RegressCheck judged(const char* name, const std::string& message) {
  return {name, message.empty() ? CaseVerdict::same : CaseVerdict::different, message};
}

}  // namespace

const char* to_string(CaseVerdict v) {
  switch (v) {
    case CaseVerdict::same:
      return "same";
    case CaseVerdict::different:
      return "DIFFERENT";
    case CaseVerdict::blessed:
      return "blessed";
    case CaseVerdict::skipped:
      return "-";
  }
  return "";
}

bool RegressResult::good() const {
  for (const RegressCheck& c : checks)
    if (c.verdict == CaseVerdict::different) return false;
  return true;
}

std::vector<RegressCase> read_regress_cases(const fs::path& file) {
  std::ifstream in(file);
  if (!in)
    throw InputError(fmt::format(
        "{}: there is no such file; name the list of cases with --cases FILE", file.string()));
  Json json;
  try {
    json = Json::parse({std::istreambuf_iterator<char>(in), {}}, Json::Comments::skipped);
  } catch (const JsonError& problem) {
    throw InputError(fmt::format("{}: {}", file.string(), problem.what()));
  }
  if (!json.is_object() || !json.contains("cases") || !json.at("cases").is_array())
    throw InputError(fmt::format("{}: expected {{\"cases\": [...]}}", file.string()));
  std::vector<RegressCase> cases;
  std::set<std::string> names;
  for (std::size_t n = 0; n < json.at("cases").size(); ++n) {
    cases.push_back(read_case(file, json.at("cases").at(n), n));
    if (!names.insert(cases.back().name).second)
      refuse(file, "case '" + cases.back().name + "'", "the name occurs twice");
  }
  return cases;
}

// A run that has ended: its archive, or why there is none.
struct RegressRunner::Run {
  fs::path archive;
  std::string problem;
};

RegressRunner::Run RegressRunner::run_deck(const RegressCase& c, const std::string& name,
                                           const std::vector<std::string>& options,
                                           int ranks) const {
  return run_with(executable, c, name, options, ranks);
}

// The end of every run is an output.
RegressRunner::Run RegressRunner::run_with(const fs::path& program, const RegressCase& c,
                                           const std::string& name,
                                           const std::vector<std::string>& options,
                                           int ranks) const {
  const fs::path here = folder / c.name / name;
  fs::create_directories(here);
  ProcessRequest request;
  if (ranks > 1)
    request.words = {"/usr/bin/env",    mpiexec, "--allow-run-as-root",
                     "--oversubscribe", "-np",   std::to_string(ranks)};
  for (const std::string& word :
       {program.string(), std::string("run"), c.deck.string(), std::string("-o"), here.string(),
        std::string("--json"), (here / "run.json").string(), std::string("--progress"),
        std::string("none"), std::string("--quiet"), std::string("--set"),
        std::string("DataArchiver/outputLastTimestep=true")})
    request.words.push_back(word);
  for (const std::string& o : c.overrides) {
    request.words.emplace_back("--set");
    request.words.push_back(o);
  }
  request.words.insert(request.words.end(), options.begin(), options.end());
  request.output = here / "run.log";
  const int status = run_process(request);
  std::ifstream in(here / "run.json");
  const Json report = Json::parse_or_null({std::istreambuf_iterator<char>(in), {}});
  if (status != 0 || !report.is_object() || !report.contains("archive") ||
      !report.at("archive").is_text())
    return {{},
            fmt::format("the {} run ended with status {} and no archive: {}", name, status,
                        last_lines(request.output, 5))};
  return {report.at("archive").get<std::string>(), {}};
}

RegressCheck RegressRunner::check_golden(const RegressCase& c, const Run& plain) const {
  Golden now;
  try {
    now = golden_of(Archive::open(plain.archive), c.variables);
  } catch (const InputError& problem) {
    return {"golden", CaseVerdict::different, problem.what()};  // other cases go on
  }
  if (bless) {
    write_golden(now, c.golden);
    return {"golden", CaseVerdict::blessed, ""};
  }
  if (!fs::exists(c.golden))
    return {"golden", CaseVerdict::different,
            fmt::format("{} does not exist; sluice regress {} --bless writes it", c.golden.string(),
                        c.name)};
  return judged("golden", golden_difference(read_golden(c.golden), now, c.tolerance));
}

RegressCheck RegressRunner::check_restart(const RegressCase& c, const Run& plain) const {
  if (c.restart == 0) return {"restart", CaseVerdict::skipped, ""};
  // Checkpoints by steps come in steps 1 + n interval. One step more than the checkpoint is done,
  // so that the restart has something to forget.
  const std::string interval = std::to_string(c.restart - 1);
  const Run stopped = run_deck(c, "stopped",
                               {"--set", "DataArchiver/checkpoint/@timestepInterval=" + interval,
                                "--max-steps", std::to_string(c.restart + 1)},
                               1);
  if (!stopped.problem.empty()) return judged("restart", stopped.problem);
  const Run resumed =
      run_deck(c, "resumed",
               {"--restart", stopped.archive.string(), "--step", std::to_string(c.restart)}, 1);
  if (!resumed.problem.empty()) return judged("restart", resumed.problem);
  return judged("restart",
                difference(Archive::open(plain.archive), Archive::open(resumed.archive)));
}

RegressCheck RegressRunner::check_split(const RegressCase& c, const Run& plain, int ranks) const {
  const char* name = ranks == 1 ? "boxes" : "ranks";
  if (c.boxes.empty() || ranks == 0) return {name, CaseVerdict::skipped, ""};
  const Run other = run_deck(c, name, {"--boxes", c.boxes}, ranks);
  if (!other.problem.empty()) return judged(name, other.problem);
  return judged(name, difference(Archive::open(plain.archive), Archive::open(other.archive)));
}

RegressCheck RegressRunner::check_against(const RegressCase& c, const Run& plain) const {
  if (against.empty()) return {"against", CaseVerdict::skipped, ""};
  const Run other = run_with(against, c, "against", {}, 1);
  if (!other.problem.empty()) return judged("against", other.problem);
  return judged("against", difference(Archive::open(plain.archive), Archive::open(other.archive)));
}

RegressResult RegressRunner::run(const RegressCase& c) const {
  const auto start = std::chrono::steady_clock::now();
  RegressResult result;
  result.name = c.name;
  const Run plain = run_deck(c, "plain", {}, 1);
  if (plain.problem.empty())
    result.checks = {check_golden(c, plain), check_restart(c, plain), check_split(c, plain, 1),
                     check_split(c, plain, c.ranks), check_against(c, plain)};
  else
    result.checks = {judged("golden", plain.problem)};
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace sluice
