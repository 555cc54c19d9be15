#include "app/regress/gold_checks.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <set>

#include "framework/archive/archive.hpp"
#include "framework/archive/compare/compare.hpp"
#include "framework/archive/compare/history_table.hpp"
#include "framework/base/console.hpp"
#include "framework/base/error.hpp"
#include "framework/base/json.hpp"
#include "framework/field/component_name.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

// ------------------------------------------------------------------ outputs and checkpoints

Moved moved_of(const Difference& d) {
  Moved m;
  m.label = d.components > 1 ? fmt::format("{}.{} of material {}", d.label,
                                           component_name(d.components, d.component), d.material)
                             : fmt::format("{} of material {}", d.label, d.material);
  m.where = d.particle >= 0
                ? fmt::format("particle {}", d.particle)
                : fmt::format("level {} at [{}, {}, {}]", d.level, d.index.x, d.index.y, d.index.z);
  m.time = d.time;
  m.before = d.a;
  m.after = d.b;
  return m;
}

// The largest difference of each label, material and level over all steps.
void add_largest(const CompareResult& result, std::vector<Moved>& moved) {
  std::map<std::string, Difference> largest;
  for (const FieldDifference& f : result.fields) {
    const Difference& d = f.largest;
    const std::string key = fmt::format("{} {} {}", d.label, d.material, d.level);
    const auto [at, is_new] = largest.try_emplace(key, d);
    if (!is_new && d.size() > at->second.size()) at->second = d;
  }
  for (const auto& [key, d] : largest) moved.push_back(moved_of(d));
}

void add_missing_times(const std::vector<StepEntry>& gold, const CompareResult& result,
                       const char* kind, std::vector<std::string>& problems) {
  std::string times;
  std::size_t missing = 0;
  for (const StepEntry& g : gold) {
    const bool paired = std::any_of(result.paired.begin(), result.paired.end(),
                                    [&](const StepPair& p) { return p.first.step == g.step; });
    if (!paired && ++missing <= 3)
      times += fmt::format("{}{:g}", times.empty() ? "" : ", ", g.time);
  }
  if (missing > 0)
    problems.push_back(fmt::format("{} of {} {}s of the gold have none at their time (t = {}{})",
                                   missing, gold.size(), kind, times, missing > 3 ? ", ..." : ""));
}

// Labels with a tolerance of their own are compared one by one, the others together.
RegressCheck check_states(const RegressCase& c, const Archive& gold, const Archive& now,
                          bool checkpoints) {
  RegressCheck check{checkpoints ? "checkpoints" : "outputs", CaseVerdict::skipped, ""};
  const auto& entries = checkpoints ? gold.checkpoints() : gold.outputs();
  if (entries.empty() || (checkpoints && gold.format() != now.format())) return check;
  CompareOptions options;
  options.absolute = c.absolute;
  options.relative = c.tolerance;
  options.checkpoints = checkpoints;
  options.common_times = gold.format() == now.format();
  options.labels.ignore = c.exclude;
  for (const auto& [label, tolerance] : c.tolerances) options.labels.ignore.push_back(label);
  std::vector<std::string> problems;
  std::int64_t values = 0, differing = 0;
  const auto add = [&](const CompareResult& result) {
    problems.insert(problems.end(), result.not_comparable.begin(), result.not_comparable.end());
    add_largest(result, check.moved);
    values += result.values;
    differing += result.differing;
  };
  const CompareResult all = compare(gold, now, options);
  add(all);
  add_missing_times(entries, all, checkpoints ? "checkpoint" : "output", problems);
  for (const auto& [label, tolerance] : c.tolerances) {
    options.relative = tolerance;
    options.labels = {{label}, {}};
    const CompareResult one = compare(gold, now, options);
    if (one.values > 0) add(one);
  }
  check.verdict = problems.empty() && differing == 0 ? CaseVerdict::same : CaseVerdict::different;
  if (differing > 0)
    problems.insert(problems.begin(), fmt::format("{} of {} values differ", human_count(differing),
                                                  human_count(values)));
  check.message = fmt::format("{}", fmt::join(problems, "; "));
  return check;
}

// ------------------------------------------------------------------ histories

// The .dat files that a folder holds, by name.
std::set<std::string> histories_in(const fs::path& folder) {
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".dat") files.insert(entry.path().filename().string());
  return files;
}

// "TotalMass_1.dat" is of the label TotalMass.
std::string label_of_history(const std::string& file) {
  std::string label = file.substr(0, file.size() - 4);
  const std::size_t mark = label.rfind('_');
  if (mark != label.npos && label.find_first_not_of("0123456789", mark + 1) == label.npos)
    label.resize(mark);
  return label;
}

struct HistoryPair {
  fs::path gold, now;
  std::string file;
};

// Adds what has moved, or why the two cannot be compared.
void check_history(const RegressCase& c, const HistoryPair& pair, RegressCheck& check,
                   std::vector<std::string>& problems) {
  const auto own = c.tolerances.find(label_of_history(pair.file));
  const double relative = own != c.tolerances.end() ? own->second : c.tolerance;
  const HistoryTable before = read_history(pair.gold), after = read_history(pair.now);
  const HistoryDifferences found = compare_history(before, after, c.absolute, relative);
  if (!found.not_comparable.empty()) problems.push_back(pair.file + ": " + found.not_comparable);
  const int components = static_cast<int>(before.values.size());
  for (const HistoryDifference& d : found.columns) {
    Moved m;
    m.label = pair.file;
    m.where = components > 1 ? component_name(components, d.column) : "";
    if (found.interpolated)
      m.where += fmt::format("{}{} and {} lines, between lines", m.where.empty() ? "" : ", ",
                             before.times.size(), after.times.size());
    m.time = d.time;
    m.before = d.a;
    m.after = d.b;
    m.largest = d.scale;
    check.moved.push_back(m);
  }
}

RegressCheck check_histories(const RegressCase& c, const fs::path& archive) {
  RegressCheck check{"histories", CaseVerdict::skipped, ""};
  if (c.gold_histories.empty()) return check;
  const std::set<std::string> gold = histories_in(c.gold_histories), now = histories_in(archive);
  if (gold.empty()) return check;
  std::vector<std::string> problems;
  int compared = 0;
  for (const std::string& file : gold) {
    if (std::find(c.exclude.begin(), c.exclude.end(), label_of_history(file)) != c.exclude.end())
      continue;
    if (!now.contains(file)) {
      problems.push_back("only the gold has " + file);
      continue;
    }
    check_history(c, {c.gold_histories / file, archive / file, file}, check, problems);
    ++compared;
  }
  const bool good = problems.empty() && check.moved.empty();
  check.verdict = good ? CaseVerdict::same : CaseVerdict::different;
  std::set<std::string> moved;
  for (const Moved& m : check.moved) moved.insert(m.label);
  if (!moved.empty())
    problems.insert(problems.begin(),
                    fmt::format("{} of {} histories differ", moved.size(), compared));
  check.message = fmt::format("{}", fmt::join(problems, "; "));
  return check;
}

// ------------------------------------------------------------------ time and memory

struct GoldCost {
  std::string machine;
  double seconds = 0, bytes = 0;
};

std::string this_machine() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

Json json_of_file(const fs::path& file) {
  std::ifstream in(file);
  return Json::parse_or_null({std::istreambuf_iterator<char>(in), {}});
}

std::optional<GoldCost> cost_of_run(const fs::path& archive) {
  const Json report = json_of_file(archive / "run.json");
  if (!report.is_object() || !report.contains("wall_s") || !report.contains("peak_memory_bytes"))
    return std::nullopt;
  return GoldCost{this_machine(), report.at("wall_s").get<double>(),
                  report.at("peak_memory_bytes").get<double>()};
}

fs::path cost_file(const RegressCase& c) {
  return c.deck.parent_path() / (c.deck.stem().string() + ".cost.json");
}

std::optional<GoldCost> recorded_cost(const RegressCase& c) {
  const Json kept = json_of_file(cost_file(c));
  if (!kept.is_object() || !kept.contains("machine") || !kept.contains("seconds") ||
      !kept.contains("peak_memory_bytes"))
    return std::nullopt;
  return GoldCost{kept.at("machine").get<std::string>(), kept.at("seconds").get<double>(),
                  kept.at("peak_memory_bytes").get<double>()};
}

// Seconds depend on what else a machine does: they are told. Memory does not: more by a tenth and
// by 8 MiB, on the same machine, is a difference.
RegressCheck check_cost(const RegressCase& c, const fs::path& archive) {
  RegressCheck check{"cost", CaseVerdict::skipped, ""};
  const auto now = cost_of_run(archive), before = recorded_cost(c);
  if (!now || !before) return check;
  constexpr double share = 1.1, bytes = 8.0 * 1024 * 1024;
  const bool comparable = now->machine == before->machine;
  const bool more =
      comparable && now->bytes > share * before->bytes && now->bytes > before->bytes + bytes;
  check.verdict = more         ? CaseVerdict::different
                  : comparable ? CaseVerdict::same
                               : CaseVerdict::skipped;
  check.message =
      fmt::format("{} and {} on {}; gold {} and {} on {}", human_duration(now->seconds),
                  human_bytes(now->bytes), now->machine, human_duration(before->seconds),
                  human_bytes(before->bytes), before->machine);
  return check;
}

}  // namespace

std::vector<RegressCheck> gold_checks(const RegressCase& c, const fs::path& archive) {
  std::vector<RegressCheck> checks;
  const Archive now = Archive::open(archive);
  try {
    if (!c.gold_archive.empty()) {
      const Archive gold = Archive::open(c.gold_archive);
      checks.push_back(check_states(c, gold, now, false));
      checks.push_back(check_states(c, gold, now, true));
    }
    checks.push_back(check_histories(c, now.folder()));
  } catch (const InputError& problem) {  // the gold is damaged; other cases go on
    checks.push_back({"gold", CaseVerdict::invalid, problem.what()});
  }
  if (c.gold_archive.empty() && c.gold_histories.empty() && c.variables.empty())
    checks.push_back({"gold", CaseVerdict::different,
                      fmt::format("there is no gold beside {}; --bless stores this run as gold",
                                  c.deck.string())});
  checks.push_back(check_cost(c, now.folder()));
  return checks;
}

RegressCheck bless_gold(const RegressCase& c, const fs::path& archive) {
  const fs::path gold = c.gold_archive.empty()
                            ? c.deck.parent_path() / (c.deck.stem().string() + ".uda")
                            : c.gold_archive;
  std::error_code error;
  if (fs::exists(gold, error) && Archive::open(gold).format() != ArchiveFormat::hdf5)
    throw InputError(fmt::format(
        "{} is an archive of another program: --bless does not replace it; remove it first",
        gold.string()));
  const fs::path beside = gold.string() + ".partial";
  fs::remove_all(beside, error);
  fs::copy(fs::canonical(archive), beside, fs::copy_options::recursive, error);
  if (!error) fs::remove_all(gold, error);
  if (!error) fs::rename(beside, gold, error);
  if (error) throw SystemError(fmt::format("cannot write {}: {}", gold.string(), error.message()));
  if (const auto cost = cost_of_run(gold)) {
    std::ofstream out(cost_file(c));
    out << Json{{"machine", cost->machine},
                {"seconds", cost->seconds},
                {"peak_memory_bytes", cost->bytes}}
               .dump(2)
        << '\n';
    if (!out.flush()) throw SystemError(fmt::format("cannot write {}", cost_file(c).string()));
  }
  return {"outputs", CaseVerdict::blessed, gold.string()};
}

}  // namespace sluice
