// sluice compare A B: exit status 0 equal, 1 different, 2 not comparable.
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "app/command/command_line.hpp"
#include "app/process/text_sink.hpp"
#include "framework/archive/compare/compare.hpp"
#include "framework/base/console.hpp"
#include "framework/base/json.hpp"
#include "framework/field/component_name.hpp"

namespace sluice {
namespace {

struct CompareRequest {
  std::string first, second, only, ignore, json;
  std::vector<std::string> same;
  CompareOptions options;
  bool quiet = false, histories = false;
};

constexpr std::size_t listed = 20;
constexpr const char* verdicts[] = {"equal", "different", "not comparable"};

// Times of two programs do not meet: both are printed.
void print_pairs(const CompareResult& result) {
  for (const auto& [a, b] : result.paired)
    fmt::print("step {} at time {:.10g} and step {} at time {:.10g}: {:.3g} apart\n", a.step,
               a.time, b.step, b.time, std::abs(a.time - b.time));
}

// "step 10, y of [3, 0, 0]"
std::string place_text(const Difference& d) {
  const std::string component = component_name(d.components, d.component);
  const std::string at =
      d.particle >= 0
          ? fmt::format("particle {}", d.particle)
          : fmt::format("[{}, {}, {}]{}", d.index.x, d.index.y, d.index.z,
                        d.of_second ? fmt::format(" of level {} of the second", d.level) : "");
  return fmt::format("step {}, {}{}{}", d.step, component, component.empty() ? "" : " of ", at);
}

std::string level_text(const FieldDifference& f) {
  return f.means ? "all" : std::to_string(f.first.level);
}

// One row a label, material and level, over all steps.
void print_rows(const std::vector<FieldDifference>& rows) {
  using Align = TextTable::Align;
  TextTable table({{"label"},
                   {"material", Align::right},
                   {"level", Align::right},
                   {"differ", Align::right},
                   {"of", Align::right},
                   {"largest", Align::right},
                   {"where"},
                   {"relative", Align::right},
                   {"where"}});
  for (std::size_t n = 0; n < std::min(rows.size(), listed); ++n) {
    const FieldDifference& f = rows[n];
    table.row(
        {f.first.label, std::to_string(f.first.material), level_text(f), human_count(f.differing),
         human_count(f.values), fmt::format("{:.3g}", f.largest.size()), place_text(f.largest),
         fmt::format("{:.3g}", f.largest_relative.relative()), place_text(f.largest_relative)});
  }
  fmt::print("{}", table.text());
  if (rows.size() > listed) fmt::print("... and {} more labels\n", rows.size() - listed);
}

void print_result(const CompareRequest& r, const CompareResult& result) {
  for (const std::string& note : result.notes) fmt::print("note: {}\n", note);
  for (const std::string& why : result.not_comparable) fmt::print("not comparable: {}\n", why);
  if (const auto first = result.first()) {
    print_rows(differences_by_label(result));
    fmt::print("first:   {}\n", to_string(*first));
    fmt::print("largest: {}\n", to_string(*result.largest()));
  }
  fmt::print("{}: {} values in {} steps compared, {} differ (abs {:g}, rel {:g})\n",
             verdicts[result.exit_status()], human_count(result.values), result.steps(),
             human_count(result.differing), r.options.absolute, r.options.relative);
}

void print_result(const HistoryComparison& result) {
  for (const std::string& why : result.not_comparable) fmt::print("not comparable: {}\n", why);
  for (std::size_t n = 0; n < std::min(result.differences.size(), listed); ++n)
    fmt::print("{}\n", result.differences[n]);
  fmt::print("histories: {} numbers compared, {} differ\n", human_count(result.values),
             human_count(result.differing));
}

Json json_of(const Difference& d) {
  Json found{{"step", d.step},
             {"time", d.time},
             {"component", component_name(d.components, d.component)},
             {"first", d.a},
             {"second", d.b},
             {"difference", d.size()},
             {"relative", d.relative()}};
  if (d.particle >= 0) {
    found["particle"] = d.particle;
  } else {
    found["level"] = d.level;
    found["index"] = std::vector<int>{d.index.x, d.index.y, d.index.z};
    if (d.of_second) found["of"] = "second";
  }
  return found;
}

Json json_of(const CompareResult& result) {
  Json labels = Json::array(), pairs = Json::array();
  for (const FieldDifference& f : differences_by_label(result))
    labels.push_back({{"label", f.first.label},
                      {"material", f.first.material},
                      {"level", f.means ? Json("all") : Json(f.first.level)},
                      {"differing", f.differing},
                      {"values", f.values},
                      {"largest", json_of(f.largest)},
                      {"largest_relative", json_of(f.largest_relative)}});
  for (const auto& [a, b] : result.paired)
    pairs.push_back({{"steps", std::vector<int>{a.step, b.step}},
                     {"times", std::vector<double>{a.time, b.time}}});
  return {{"verdict", verdicts[result.exit_status()]},
          {"values", result.values},
          {"differing", result.differing},
          {"pairs", pairs},
          {"labels", labels},
          {"not_comparable", result.not_comparable},
          {"notes", result.notes}};
}

int compare_archives(CompareRequest& r) {
  r.options.labels = {split_names(r.only), split_names(r.ignore)};
  r.options.means = true;
  const Archive a = Archive::open(r.first), b = Archive::open(r.second);
  for (const std::string& text : r.same) r.options.names.push_back(parse_label_name(text));
  const CompareResult result = compare(a, b, r.options);
  const bool by_nearest = a.format() != b.format() || r.options.time_tolerance.has_value();
  const bool printed = !r.quiet && r.json != "-";
  if (printed && by_nearest) print_pairs(result);
  if (printed) print_result(r, result);
  Json report = json_of(result);
  int status = result.exit_status();
  if (r.histories) {
    const HistoryComparison histories = compare_histories(a, b, r.options);
    if (printed) print_result(histories);
    report["histories"] = {{"values", histories.values},
                           {"differing", histories.differing},
                           {"differences", histories.differences},
                           {"not_comparable", histories.not_comparable}};
    status = std::max(status, histories.exit_status());
  }
  if (!r.json.empty()) write_text(r.json, report.dump(2) + "\n");
  return status;
}

}  // namespace

void declare_compare_command(Command& command) {
  auto r = std::make_shared<CompareRequest>();
  command.option("A", r->first, "An archive, of Sluice or in Uintah's raw layout").required();
  command
      .option("B", r->second,
              "Another archive, with any boxes and ranks; where resolutions or levels differ, "
              "means on the coarser grid are compared")
      .required();
  command.option("--abs", r->options.absolute, "Absolute differences up to this are ignored")
      .at_least_zero();
  command.option("--rel", r->options.relative, "Differences up to this times the value are ignored")
      .at_least_zero();
  command.option("--vars", r->only, "Only these labels: a,b,c");
  command.option("--ignore", r->ignore, "All labels but these: a,b,c");
  command.flag("--checkpoint,--checkpoints", r->options.checkpoints,
               "Compare checkpoints, not outputs");
  command.flag("--common-times", r->options.common_times,
               "Compare only times that both archives have");
  command
      .option("--time-tolerance", r->options.time_tolerance,
              "Pair outputs of nearest times, at most this far apart (s). Archives of two formats "
              "are always paired by nearest time")
      .at_least_zero();
  command.option("--same", r->same, label_names_help().c_str()).quietly_repeatable();
  command.flag("--histories", r->histories, "Compare the .dat files as well");
  command.flag("--quiet", r->quiet, "Print nothing; give only the exit status");
  command.option("--json", r->json, "Write JSON to a file, - for standard output");
  command.action([r] { return compare_archives(*r); });
}

}  // namespace sluice
