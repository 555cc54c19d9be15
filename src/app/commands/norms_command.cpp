// sluice norms A B: L1, L2 and Linf of the difference, per label, material, level and time.
// sluice norms A B C: the observed order of three resolutions.
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "app/command/command_line.hpp"
#include "app/process/text_sink.hpp"
#include "framework/archive/compare/norms.hpp"
#include "framework/archive/compare/observed_order.hpp"
#include "framework/base/console.hpp"
#include "framework/base/error.hpp"
#include "framework/base/json.hpp"

namespace sluice {
namespace {

using Align = TextTable::Align;

struct NormsRequest {
  std::string first, second, third, only, ignore, csv, json;
  std::vector<std::string> same;
  NormsOptions options;
};

constexpr const char* order_norms[3] = {"L1", "L2", "Linf"};

std::string level_text(int level) {
  return level == all_levels ? "all" : std::to_string(level);
}

std::string csv_of(const std::vector<NormsRow>& rows) {
  std::string text = "time,level,material,label,points,L1,L2,Linf\n";
  for (const NormsRow& r : rows)
    text += fmt::format("{:.17g},{},{},{},{},{:.17g},{:.17g},{:.17g}\n", r.time,
                        level_text(r.level), r.material, r.label, r.points, r.l1, r.l2, r.linf);
  return text;
}

Json json_of(const std::vector<NormsRow>& rows) {
  Json list = Json::array();
  // JSON knows no NaN: it becomes null.
  for (const NormsRow& r : rows)
    list.push_back({{"time", r.time},
                    {"level", r.level == all_levels ? Json("all") : Json(r.level)},
                    {"material", r.material},
                    {"label", r.label},
                    {"points", r.points},
                    {"L1", r.l1},
                    {"L2", r.l2},
                    {"Linf", r.linf}});
  return list;
}

void print_table(const std::vector<NormsRow>& rows) {
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
    table.row({fmt::format("{:.10g}", r.time), level_text(r.level), std::to_string(r.material),
               r.label, std::to_string(r.points), number(r.l1), number(r.l2), number(r.linf)});
  fmt::print("{}", table.text());
}

// ------------------------------------------------------------------ three archives

std::string csv_of(const OrderResult& result) {
  std::string text = "time,material,label,points,norm,coarse_middle,middle_fine,order,error\n";
  for (const OrderRow& r : result.rows)
    for (std::size_t k = 0; k < 3; ++k)
      text += fmt::format("{:.17g},{},{},{},{},{:.17g},{:.17g},{:.17g},{:.17g}\n", r.time,
                          r.material, r.label, r.points, order_norms[k], r.norms[k].coarse,
                          r.norms[k].fine, r.norms[k].order, r.norms[k].error);
  return text;
}

Json json_of(const OrderResult& result, const std::array<std::string, 3>& names) {
  Json rows = Json::array(), archives = Json::array();
  for (const std::size_t n : result.sorted) archives.push_back(names[n]);
  for (const OrderRow& r : result.rows) {
    Json row{{"time", r.time}, {"material", r.material}, {"label", r.label}, {"points", r.points}};
    for (std::size_t k = 0; k < 3; ++k)
      row[order_norms[k]] = {{"coarse_middle", r.norms[k].coarse},
                             {"middle_fine", r.norms[k].fine},
                             {"order", r.norms[k].order},
                             {"error", r.norms[k].error}};
    rows.push_back(row);
  }
  return {{"archives", archives}, {"cells", result.cells}, {"orders", rows}};
}

void print_orders(const OrderResult& result, const std::array<std::string, 3>& names) {
  for (std::size_t n = 0; n < 3; ++n)
    fmt::print("{:<8} {} (cells of {:g} m)\n",
               n == 0   ? "coarse:"
               : n == 1 ? "middle:"
                        : "fine:",
               names[result.sorted[n]], result.cells[n]);
  TextTable table({{"time", Align::right},
                   {"material", Align::right},
                   {"label"},
                   {"points", Align::right},
                   {"L1 coarse-middle", Align::right},
                   {"middle-fine", Align::right},
                   {"order", Align::right},
                   {"in L2", Align::right},
                   {"in Linf", Align::right},
                   {"L1 error of fine", Align::right}});
  const auto order = [](double p) { return std::isnan(p) ? "-" : fmt::format("{:.2f}", p); };
  for (const OrderRow& r : result.rows)
    table.row({fmt::format("{:.10g}", r.time), std::to_string(r.material), r.label,
               std::to_string(r.points), fmt::format("{:.4e}", r.norms[0].coarse),
               fmt::format("{:.4e}", r.norms[0].fine), order(r.norms[0].order),
               order(r.norms[1].order), order(r.norms[2].order),
               std::isnan(r.norms[0].error) ? "-" : fmt::format("{:.2e}", r.norms[0].error)});
  fmt::print("{}", table.text());
}

// ------------------------------------------------------------------ both

void print_notes(const std::vector<std::string>& notes, const std::vector<std::string>& skipped) {
  for (const std::string& note : notes) fmt::print(stderr, "sluice norms: note: {}\n", note);
  for (const std::string& name : skipped)
    fmt::print(stderr, "sluice norms: note: another archive does not have {}\n", name);
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
}

void orders(const NormsRequest& r) {
  const std::array<std::string, 3> names = {r.first, r.second, r.third};
  const Archive a = Archive::open(r.first), b = Archive::open(r.second), c = Archive::open(r.third);
  const OrderResult result = observed_orders({&a, &b, &c}, r.options);
  if (!r.csv.empty()) write_text(r.csv, csv_of(result));
  if (!r.json.empty()) write_text(r.json, json_of(result, names).dump(2) + "\n");
  if (r.csv.empty() && r.json.empty()) print_orders(result, names);
  print_notes(result.notes, result.skipped);
}

void norms(NormsRequest& r) {
  r.options.labels = {split_names(r.only), split_names(r.ignore)};
  for (const std::string& text : r.same) r.options.names.push_back(parse_label_name(text));
  if (r.csv == "-" && r.json == "-")
    throw InputError("--csv - and --json - cannot both go to standard output");
  if (!r.third.empty()) return orders(r);
  const NormsResult result =
      difference_norms(Archive::open(r.first), Archive::open(r.second), r.options);
  print_times(result);
  if (!r.csv.empty()) write_text(r.csv, csv_of(result.rows));
  if (!r.json.empty()) write_text(r.json, json_of(result.rows).dump(2) + "\n");
  if (r.csv.empty() && r.json.empty()) print_table(result.rows);
  print_notes(result.notes, result.skipped);
}

}  // namespace

void declare_norms_command(Command& command) {
  auto r = std::make_shared<NormsRequest>();
  command
      .option("A", r->first,
              "An archive, at whose points values are compared; where resolutions or levels "
              "differ, means on the coarser grid are")
      .required();
  command.option("B", r->second, "An archive whose domain holds that of A").required();
  command.option("C", r->third,
                 "A third resolution (in any order): prints the observed order of convergence");
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
