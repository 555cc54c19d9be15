// sluice norms A B: L1, L2 and Linf of the difference, per label, material, level and time.
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "app/command/command_line.hpp"
#include "app/process/text_sink.hpp"
#include "framework/archive/compare/norms.hpp"
#include "framework/base/console.hpp"
#include "framework/base/json.hpp"

namespace sluice {
namespace {

struct NormsRequest {
  std::string first, second, only, ignore, csv, json;
  std::vector<std::string> same;
  NormsOptions options;
};

void write_csv(const std::string& target, const std::vector<NormsRow>& rows) {
  TextSink sink(target);
  sink.write("time,level,material,label,points,L1,L2,Linf\n");
  for (const NormsRow& r : rows)
    sink.write(fmt::format("{:.17g},{},{},{},{},{:.17g},{:.17g},{:.17g}\n", r.time, r.level,
                           r.material, r.label, r.points, r.l1, r.l2, r.linf));
  sink.close();
}

void write_json(const std::string& target, const std::vector<NormsRow>& rows) {
  Json list = Json::array();
  // JSON knows no NaN: it becomes null.
  for (const NormsRow& r : rows)
    list.push_back({{"time", r.time},
                    {"level", r.level},
                    {"material", r.material},
                    {"label", r.label},
                    {"points", r.points},
                    {"L1", r.l1},
                    {"L2", r.l2},
                    {"Linf", r.linf}});
  TextSink sink(target);
  sink.write(list.dump(2) + "\n");
  sink.close();
}

void print_table(const std::vector<NormsRow>& rows) {
  using Align = TextTable::Align;
  TextTable table({{"time", Align::right},
                   {"level", Align::right},
                   {"material", Align::right},
                   {"label"},
                   {"points", Align::right},
                   {"L1", Align::right},
                   {"L2", Align::right},
                   {"Linf", Align::right}});
  auto number = [](double x) { return fmt::format("{:.6e}", x); };
  for (const NormsRow& r : rows)
    table.row({fmt::format("{:.10g}", r.time), std::to_string(r.level), std::to_string(r.material),
               r.label, std::to_string(r.points), number(r.l1), number(r.l2), number(r.linf)});
  fmt::print("{}", table.text());
}

// Where the times of the two archives differ.
void print_times(const NormsResult& result) {
  double told = std::nan("");
  for (const NormsRow& row : result.rows)
    if (row.time != row.other_time && row.time != told) {
      fmt::print(stderr,
                 "sluice norms: note: time {:.10g} of the first and {:.10g} of the second\n",
                 row.time, row.other_time);
      told = row.time;
    }
  for (const std::string& note : result.notes) fmt::print(stderr, "sluice norms: note: {}\n", note);
}

void norms(NormsRequest& r) {
  r.options.labels = {split_names(r.only), split_names(r.ignore)};
  for (const std::string& text : r.same) r.options.names.push_back(parse_label_name(text));
  const NormsResult result =
      difference_norms(Archive::open(r.first), Archive::open(r.second), r.options);
  print_times(result);
  if (!r.csv.empty()) write_csv(r.csv, result.rows);
  if (!r.json.empty()) write_json(r.json, result.rows);
  if (r.csv.empty() && r.json.empty()) print_table(result.rows);
  for (const std::string& name : result.skipped)
    fmt::print(stderr, "sluice norms: note: the second archive does not have {}\n", name);
}

}  // namespace

void declare_norms_command(Command& command) {
  auto r = std::make_shared<NormsRequest>();
  command.option("A", r->first, "An archive, at whose points values are compared").required();
  command.option("B", r->second, "An archive that has values at the same points").required();
  command.option("--vars", r->only, "Only these labels: a,b,c");
  command.option("--ignore", r->ignore, "All labels but these: a,b,c");
  command.option("--time", r->options.time,
                 "Only this output: last, first, a time, #N; absent: all outputs");
  command
      .option("--time-tolerance", r->options.time_tolerance,
              "Pair outputs of nearest times, at most this far apart (s). Archives of two formats "
              "are always paired by nearest time")
      .at_least_zero();
  command.option("--same", r->same, label_names_help().c_str()).quietly_repeatable();
  command.option("--csv", r->csv, "Write CSV to a file, - for standard output");
  command.option("--json", r->json, "Write JSON to a file, - for standard output");
  command.action([r] {
    norms(*r);
    return 0;
  });
}

}  // namespace sluice
