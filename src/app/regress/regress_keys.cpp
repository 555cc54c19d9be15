#include "app/regress/regress_keys.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/base/error.hpp"
#include "framework/base/json.hpp"
#include "framework/deck/nearest_name.hpp"

namespace sluice {
namespace {

constexpr int in_list = static_cast<int>(KeyPlace::list);
constexpr int beside = static_cast<int>(KeyPlace::beside_deck);

void require_key(bool good, const char* text) {
  if (!good) throw InputError(text);
}

void refuse_unknown_keys(const Json& json, KeyPlace place) {
  std::vector<std::string> known;
  for (const RegressKey& key : regress_keys())
    if ((key.places & static_cast<int>(place)) != 0) known.emplace_back(key.name);
  for (const auto& [name, value] : json.members())
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(fmt::format("unknown entry '{}' ({}; known: {})", name,
                                   suggest_name(name, known), fmt::join(known, ", ")));
}

// A step, or true and false.
void read_restart(const Json& json, RegressCase& c) {
  if (!json.contains("restart")) return;
  const Json& value = json.at("restart");
  if (value.kind() == Json::Kind::boolean)
    c.restart_in_the_middle = c.restart_in_the_middle && value.get<bool>();
  else
    c.restart = value.get<int>();
}

}  // namespace

const std::vector<RegressKey>& regress_keys() {
  static const std::vector<RegressKey> keys = {
      {"name", "name of the case", in_list},
      {"deck", "path of the deck, from the folder of the list", in_list},
      {"set", "overrides of the deck, each as after --set", in_list + beside},
      {"variables", "labels whose values at the end are kept as NAME.csv", in_list + beside},
      {"tolerance",
       "relative: of NAME.csv of the largest magnitude of a column (1e-9), of archives and "
       "histories of each value",
       in_list + beside},
      {"tolerances", "the same for single labels: {\"press_CC\": 1e-6}", beside},
      {"absolute", "differences up to this count as none, in the unit of the label (0)", beside},
      {"exclude", "labels that are not compared", beside},
      {"restart",
       "the step after which the run is stopped and restarted; beside a deck: the middle of the "
       "run, and false: no restart",
       in_list + beside},
      {"boxes", "another split into boxes, I,J,K: the same bits", in_list + beside},
      {"ranks",
       "number of ranks: in a list of another run, with the same bits; beside a deck of all runs",
       in_list + beside},
      {"gold", "path of the gold archive, from the deck (NAME.uda, or the only archive beside it)",
       beside},
      {"histories", "folder of gold .dat files, from the deck", beside},
  };
  return keys;
}

std::string regress_keys_help() {
  std::string text = "Keys of a case (L: in a list, D: in NAME.json beside a deck NAME.ups):\n";
  for (const RegressKey& key : regress_keys())
    text += fmt::format("  {:11} {}{}  {}\n", key.name, (key.places & in_list) != 0 ? "L" : " ",
                        (key.places & beside) != 0 ? "D" : " ", key.text);
  return text;
}

void read_regress_keys(const Json& json, KeyPlace place, RegressCase& c) {
  require_key(json.is_object(), "not an object");
  refuse_unknown_keys(json, place);
  c.overrides = json.value("set", std::vector<std::string>{});
  if (place == KeyPlace::list || json.contains("variables"))
    c.variables = json.at("variables").get<std::vector<std::string>>();
  c.tolerance = json.value("tolerance", c.tolerance);
  c.absolute = json.value("absolute", c.absolute);
  c.exclude = json.value("exclude", std::vector<std::string>{});
  c.ranks = json.value("ranks", c.ranks);
  c.boxes = json.value("boxes", std::string());
  if (json.contains("tolerances"))
    for (const auto& [label, value] : json.at("tolerances").members())
      c.tolerances[label] = value.get<double>();
  read_restart(json, c);
  require_key(c.tolerance >= 0, "tolerance must be at least 0");
  require_key(c.absolute >= 0, "absolute must be at least 0");
  for (const auto& [label, value] : c.tolerances)
    require_key(value >= 0, "tolerances must be at least 0");
  require_key(c.ranks >= 0, "ranks must be at least 0");
  if (place == KeyPlace::list) {
    require_key(c.restart == 0 || c.restart >= 3,
                "restart must be the number of a step, at least 3");
    require_key(c.ranks == 0 || !c.boxes.empty(),
                "ranks needs boxes, at least as many as there are ranks");
  } else {
    require_key(c.restart >= 0, "restart must be the number of a step, true or false");
  }
}

}  // namespace sluice
