#include "app/accuracy/deck_accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/base/console.hpp"

namespace sluice {
namespace {

constexpr std::size_t most_lines = 6;  // of a picture

std::string cells_text(const Rung& rung) {
  std::string text;
  for (int d = 0; d < 3; ++d)
    if (rung.cells[d] > 1) text += fmt::format("{}{}", text.empty() ? "" : " x ", rung.cells[d]);
  return text.empty() ? "1" : text;
}

const Rung* own_rung(const DeckAccuracy& accuracy) {
  for (const Rung& rung : accuracy.rungs)
    if (rung.factor == 1) return &rung;
  return nullptr;
}

std::string order_text(const ErrorBar& error) {
  if (error.diverges) return "diverges";
  return error.order ? fmt::format("{:.2f}", *error.order) : "-";
}

}  // namespace

double DeckAccuracy::bar(const QuantityBar& of, const Rung& rung) const {
  return of.error.at_spacing(rungs.back().factor / rung.factor);
}

DeckAccuracy measure_accuracy(DeckLadder& ladder, const std::string& deck) {
  for (const double factor : factors_for(ladder.fewest_cells())) ladder.run(factor);
  return {deck, ladder.title(), ladder.rungs(), ladder.bars(),
          ladder.predicted_seconds(2 * ladder.rungs().back().factor)};
}

std::string accuracy_table(const DeckAccuracy& accuracy) {
  using Align = TextTable::Align;
  TextTable runs({{"cells"}, {"steps", Align::right}, {"time", Align::right}});
  for (const Rung& rung : accuracy.rungs)
    runs.row({cells_text(rung) + (rung.factor == 1 ? " (the deck's)" : ""),
              std::to_string(rung.steps), human_duration(rung.seconds)});
  std::vector<TextTable::Column> columns = {
      {"quantity"}, {"mean size", Align::right}, {"order", Align::right}};
  for (const Rung& rung : accuracy.rungs)
    columns.push_back({"error at " + cells_text(rung), Align::right});
  TextTable bars(columns);
  for (const QuantityBar& q : accuracy.bars) {
    std::vector<std::string> row = {
        q.quantity.text(), fmt::format("{:.3g} {}", q.size, q.quantity.unit), order_text(q.error)};
    for (const Rung& rung : accuracy.rungs) row.push_back(human_percent(accuracy.bar(q, rung)));
    bars.row(std::move(row));
  }
  return fmt::format(
      "{}\n{}\nWith half the cell size the run would take about {} and have the errors of the last "
      "column divided by 2^order.\n",
      runs.text(), bars.text(), human_duration(accuracy.halved_seconds));
}

Json accuracy_json(const DeckAccuracy& accuracy) {
  Json runs = Json::array(), bars = Json::array();
  for (const Rung& rung : accuracy.rungs)
    runs.push_back({{"factor", rung.factor},
                    {"cells", {rung.cells.x, rung.cells.y, rung.cells.z}},
                    {"steps", rung.steps},
                    {"seconds", rung.seconds},
                    {"command", rung.command}});
  for (const QuantityBar& q : accuracy.bars) {
    Json relative = Json::array();
    for (const Rung& rung : accuracy.rungs) relative.push_back(accuracy.bar(q, rung));
    bars.push_back({{"quantity", q.quantity.text()},
                    {"name", q.quantity.name},
                    {"material", q.quantity.material},
                    {"unit", q.quantity.unit},
                    {"mean_size", q.size},
                    {"order", q.error.order ? Json(*q.error.order) : Json()},
                    {"diverges", q.error.diverges},
                    {"relative_error_bars", std::move(relative)}});
  }
  Json json = {{"deck", accuracy.deck},
               {"title", accuracy.title},
               {"runs", std::move(runs)},
               {"quantities", std::move(bars)},
               {"seconds_at_half_the_cell_size", accuracy.halved_seconds}};
  json["rows"] = accuracy_rows(accuracy);
  return json;
}

Json accuracy_rows(const DeckAccuracy& accuracy) {
  Json rows = Json::array();
  const Rung* own = own_rung(accuracy);
  for (std::size_t n = 0; n < std::min(most_lines, accuracy.bars.size()); ++n) {
    const QuantityBar& q = accuracy.bars[n];
    for (const Rung& rung : accuracy.rungs)
      rows.push_back({{"setting", q.quantity.text()},
                      {"cells", cells_text(rung)},
                      {"seconds", rung.seconds},
                      {"error", accuracy.bar(q, rung)},
                      {"status", "done"},
                      {"default", &rung == own && n == 0}});
  }
  return rows;
}

}  // namespace sluice
