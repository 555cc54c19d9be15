// sluice drive DECK: one particle of a material along a path of deformation.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/command/command_line.hpp"
#include "app/process/python_tool.hpp"
#include "app/process/text_sink.hpp"
#include "framework/base/console.hpp"
#include "framework/base/error.hpp"
#include "framework/base/json.hpp"
#include "framework/base/temporary_folder.hpp"
#include "mpm/material/material_driver.hpp"

namespace sluice {
namespace {

struct DriveRequest {
  std::string deck, csv, json, picture;
  std::vector<std::string> overrides;
};

std::string csv_of(const mpm::DriverTable& table) {
  std::string text = fmt::format("{}\n", fmt::join(table.columns, ","));
  for (const std::vector<double>& row : table.rows) {
    for (std::size_t k = 0; k < row.size(); ++k)
      text += fmt::format("{}{:.17g}", k == 0 ? "" : ",", row[k]);
    text += '\n';
  }
  return text;
}

std::string json_of(const mpm::DriverDeck& deck, const mpm::DriverTable& table) {
  Json rows = Json::array();
  for (const std::vector<double>& row : table.rows) {
    Json object = Json::object();
    for (std::size_t k = 0; k < row.size(); ++k) object[table.columns[k]] = row[k];
    rows.push_back(std::move(object));
  }
  return Json{{"title", deck.title}, {"material", deck.law}, {"rows", rows}}.dump(2) + "\n";
}

// The end of the path, and some states on the way.
void print_table(const mpm::DriverTable& table) {
  using Align = TextTable::Align;
  const std::vector<std::string> shown = {
      "time",     "stress_xx",         "stress_yy", "stress_zz",  "stress_xy",
      "pressure", "equivalent_stress", "energy",    "temperature"};
  std::vector<TextTable::Column> heads;
  std::vector<std::size_t> at;
  for (const std::string& name : shown) {
    heads.push_back({name, Align::right});
    at.push_back(static_cast<std::size_t>(
        std::find(table.columns.begin(), table.columns.end(), name) - table.columns.begin()));
  }
  TextTable text(heads);
  const std::size_t rows = table.rows.size(), most = 11,
                    stride = std::max<std::size_t>(1, (rows - 1) / (most - 1));
  for (std::size_t n = 0; n < rows; ++n) {
    if (n % stride != 0 && n + 1 != rows) continue;
    std::vector<std::string> cells;
    for (const std::size_t k : at) cells.push_back(fmt::format("{:.6g}", table.rows[n][k]));
    text.row(cells);
  }
  fmt::print("{}", text.text());
}

int draw(const std::string& picture, const std::string& title, const std::string& csv) {
  const TemporaryFolder folder;
  const std::string file = (folder / "path.csv").string();
  write_text(file, csv);
  return run_python_tool({"materialpath", file, "-o", picture, "--title", title});
}

int drive(const DriveRequest& r) {
  std::vector<Fault> faults;
  const auto deck = mpm::read_driver_deck(r.deck, r.overrides, faults);
  for (const Fault& fault : faults) fmt::print(stderr, "{}\n", to_string(fault));
  if (!deck) return static_cast<int>(ExitStatus::bad_input);
  const mpm::DriverTable table = mpm::drive(*deck);
  const std::string csv = csv_of(table);
  if (!r.csv.empty()) write_text(r.csv, csv);
  if (!r.json.empty()) write_text(r.json, json_of(*deck, table));
  if (r.csv.empty() && r.json.empty()) print_table(table);
  if (r.picture.empty()) return 0;
  return draw(r.picture, deck->title.empty() ? deck->law : deck->title, csv);
}

}  // namespace

void declare_drive_command(Command& command) {
  auto r = std::make_shared<DriveRequest>();
  command.option("DECK", r->deck, "Deck with <MaterialDriver>").required();
  command
      .option("--set", r->overrides,
              "Change the deck: MaterialDriver/material/density=8930; may be repeated")
      .repeatable();
  command.option("--csv", r->csv, "Write CSV to a file, - for standard output");
  command.option("--json", r->json, "Write JSON to a file, - for standard output");
  command.option("-o,--output", r->picture, "Picture: .png, .svg or .pdf");
  command.action([r] { return drive(*r); });
}

}  // namespace sluice
