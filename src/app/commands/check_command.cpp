// sluice check DECK...: all faults of the decks in one pass; exit status 0 good, 2 bad.
#include <fmt/format.h>

#include <memory>

#include "app/command/command_line.hpp"
#include "app/command/option_values.hpp"
#include "app/loading/scene_loader.hpp"
#include "app/loading/sluice_schema.hpp"
#include "app/process/text_sink.hpp"
#include "framework/base/json.hpp"
#include "framework/deck/load_deck.hpp"

namespace sluice {
namespace {

struct CheckRequest {
  std::vector<std::string> files;
  std::vector<std::string> overrides;
  std::string json;  // empty: none
  bool quiet = false;
  bool strict = false;
};

const char* kind_of(const Fault& fault) {
  if (fault.not_built) return "not_built";
  return fault.severity == Severity::error     ? "error"
         : fault.severity == Severity::warning ? "warning"
                                               : "note";
}

Json to_json(const Deck& deck) {
  Json faults = Json::array();
  for (const Fault& fault : deck.faults) {
    faults.push_back({{"kind", kind_of(fault)},
                      {"file", fault.where.file},
                      {"line", fault.where.line},
                      {"column", fault.where.column},
                      {"message", fault.message},
                      {"suggestion", fault.suggestion}});
  }
  return {{"deck", deck.file}, {"good", deck.good()}, {"faults", faults}};
}

void print(const Deck& deck, bool quiet) {
  std::size_t errors = 0;
  std::size_t others = 0;
  for (const Fault& fault : deck.faults) {
    (fault.severity == Severity::error ? errors : others) += 1;
    if (!quiet || fault.severity == Severity::error) fmt::print("{}\n", to_string(fault));
  }
  if (deck.good() && quiet) return;
  fmt::print("{}: {}, {} error{}, {} warning{}\n", deck.file, deck.good() ? "good" : "bad", errors,
             errors == 1 ? "" : "s", others, others == 1 ? "" : "s");
}

int check(const CheckRequest& options) {
  const Schema schema = sluice_schema();
  Json reports = Json::array();
  bool all_good = true;
  for (const std::string& file : options.files) {
    Deck deck = load_deck(file, options.overrides, schema);
    if (deck.good())
      for (Fault& fault : scene_faults(deck)) deck.faults.push_back(std::move(fault));
    if (options.strict) refuse_warnings(deck.faults);
    all_good = all_good && deck.good();
    if (!options.json.empty()) reports.push_back(to_json(deck));
    if (options.json != "-") print(deck, options.quiet);
  }
  if (!options.json.empty())
    write_text(options.json, Json{{"good", all_good}, {"decks", reports}}.dump(2) + "\n");
  return all_good ? 0 : 2;
}

}  // namespace

void declare_check_command(Command& command) {
  auto options = std::make_shared<CheckRequest>();
  command.option("DECK", options->files, "Deck files (.ups)").required();
  add_deck_changes(command, options->overrides);
  command.json(options->json, "Report as JSON");
  command.flag("--quiet", options->quiet, "Errors only");
  command.flag("--strict", options->strict, "Treat every warning as an error");
  command.action([options] { return check(*options); });
}

}  // namespace sluice
