// sluice compare A B: exit status 0 equal, 1 different, 2 not comparable.
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "app/command/command_line.hpp"
#include "framework/archive/compare/compare.hpp"
#include "framework/base/console.hpp"

namespace sluice {
namespace {

struct CompareRequest {
  std::string first, second, only, ignore;
  std::vector<std::string> same;
  CompareOptions options;
  bool quiet = false, histories = false;
};

constexpr std::size_t listed_fields = 20;

// Times of two programs do not meet: both are printed.
void print_pairs(const CompareResult& result) {
  for (const auto& [a, b] : result.paired)
    fmt::print("step {} at time {:.10g} and step {} at time {:.10g}: {:.3g} apart\n", a.step,
               a.time, b.step, b.time, std::abs(a.time - b.time));
  for (const std::string& note : result.notes) fmt::print("note: {}\n", note);
}

void print_result(const CompareRequest& r, const CompareResult& result) {
  for (const std::string& why : result.not_comparable) fmt::print("not comparable: {}\n", why);
  for (std::size_t n = 0; n < std::min(result.fields.size(), listed_fields); ++n) {
    const FieldDifference& f = result.fields[n];
    fmt::print("{} of {} values differ: {}\n", human_count(f.differing), human_count(f.values),
               to_string(f.largest));
  }
  if (result.fields.size() > listed_fields)
    fmt::print("... and {} more labels and times\n", result.fields.size() - listed_fields);
  if (const auto first = result.first()) {
    fmt::print("first:   {}\n", to_string(*first));
    fmt::print("largest: {}\n", to_string(*result.largest()));
  }
  constexpr const char* verdicts[] = {"equal", "different", "not comparable"};
  fmt::print("{}: {} values in {} steps compared, {} differ (abs {:g}, rel {:g})\n",
             verdicts[result.exit_status()], human_count(result.values), result.steps(),
             human_count(result.differing), r.options.absolute, r.options.relative);
}

void print_result(const HistoryComparison& result) {
  for (const std::string& why : result.not_comparable) fmt::print("not comparable: {}\n", why);
  for (std::size_t n = 0; n < std::min(result.differences.size(), listed_fields); ++n)
    fmt::print("{}\n", result.differences[n]);
  fmt::print("histories: {} numbers compared, {} differ\n", human_count(result.values),
             human_count(result.differing));
}

int compare_archives(CompareRequest& r) {
  r.options.labels = {split_names(r.only), split_names(r.ignore)};
  const Archive a = Archive::open(r.first), b = Archive::open(r.second);
  for (const std::string& text : r.same) r.options.names.push_back(parse_label_name(text));
  const CompareResult result = compare(a, b, r.options);
  const bool by_nearest = a.format() != b.format() || r.options.time_tolerance.has_value();
  if (!r.quiet && by_nearest) print_pairs(result);
  if (!r.quiet) print_result(r, result);
  if (!r.histories) return result.exit_status();
  const HistoryComparison histories = compare_histories(a, b, r.options);
  if (!r.quiet) print_result(histories);
  return std::max(result.exit_status(), histories.exit_status());
}

}  // namespace

void declare_compare_command(Command& command) {
  auto r = std::make_shared<CompareRequest>();
  command.option("A", r->first, "An archive, of Sluice or in Uintah's raw layout").required();
  command.option("B", r->second, "Another archive, with any boxes and ranks").required();
  command.option("--abs", r->options.absolute, "Absolute differences up to this are ignored")
      .at_least_zero();
  command.option("--rel", r->options.relative, "Differences up to this times the value are ignored")
      .at_least_zero();
  command.option("--vars", r->only, "Only these labels: a,b,c");
  command.option("--ignore", r->ignore, "All labels but these: a,b,c");
  command.flag("--checkpoints", r->options.checkpoints, "Compare checkpoints, not outputs");
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
  command.action([r] { return compare_archives(*r); });
}

}  // namespace sluice
