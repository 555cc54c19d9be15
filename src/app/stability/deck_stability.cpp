#include "app/stability/deck_stability.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "app/loading/deck_scaling.hpp"
#include "app/loading/sluice_schema.hpp"

namespace sluice {
namespace {

constexpr double most_growth = 0.01;    // of the total energy, over that of the deck's own run
constexpr double widest_bracket = 1.1;  // of the factor of the step
constexpr double longest_step = 4;      // factor; beyond it is far enough
constexpr double step_is_taken = 0.8;   // of the factor that was asked for

class Sweeper {
 public:
  Sweeper(const std::string& file, const std::vector<std::string>& overrides, double budget,
          const RunPoint& run)
      : deck_(load_good_deck(file, overrides)), budget_(budget), run_(run) {
    StabilityCase& hard = found_.map.hard;
    hard.file = hard.deck = file;
    hard.name = std::filesystem::path(file).stem().string();
    const DeckNode* title = root().find("Meta/title");
    hard.title = title == nullptr ? hard.name : title->text;
    hard.component = root().find("SimulationComponent") == nullptr
                         ? "deck"
                         : root().find("SimulationComponent")->attribute("type").value_or("deck");
    hard.overrides = overrides;
  }

  DeckStability all() {
    run_default();
    if (found_.map.at_default().verdict != StabilityVerdict::green) return std::move(found_);
    step();
    resolution();
    stiffness();
    return std::move(found_);
  }

 private:
  const DeckNode& root() const { return *deck_.root; }

  void run_default() {
    StabilityResult result = run_(found_.map.hard, {-1, -1, found_.map.hard.overrides});
    const Json& told = result.report;
    if (told.is_object() && told.contains("conservation") &&
        told.at("conservation").contains("total energy")) {
      const Json& told_drift = told.at("conservation").at("total energy").at("drift");
      const double drift = told_drift.is_number() ? told_drift.get<double>() : 0;
      found_.map.hard.must_hold = {
          growth_requirement("total energy", std::max(drift, 0.0) + most_growth)};
    }
    found_.map.results.push_back(std::move(result));
  }

  // A new sweep, with the deck's own value.
  DistanceToFailure& begin(const std::string& name) {
    found_.map.hard.sweeps.push_back({name, "1", {{"1", {}, true}}});
    found_.distances.push_back({name, 1, 0, {}, {}});
    return found_.distances.back();
  }

  bool affordable(double cost) {
    if (spent_ + cost > budget_) return false;
    spent_ += cost;
    return true;
  }

  // Runs a value of the present sweep; cost: of a run, in those of the deck's own.
  const StabilityResult& at(double factor, const std::vector<std::string>& overrides) {
    StabilityCase& hard = found_.map.hard;
    StabilityCase::Sweep& sweep = hard.sweeps.back();
    sweep.values.push_back({fmt::format("{:.3g}", factor), overrides, true});
    StabilityPoint point{static_cast<int>(hard.sweeps.size()) - 1,
                         static_cast<int>(sweep.values.size()) - 1, hard.overrides};
    point.overrides.insert(point.overrides.end(), overrides.begin(), overrides.end());
    found_.map.results.push_back(run_(hard, point));
    return found_.map.results.back();
  }

  // The factor of the step between 1, which holds, and what does not.
  void step() {
    DistanceToFailure& distance = begin("step");
    const int own_steps = found_.map.at_default().steps;
    double factor = longest_step;
    while (distance.failed == 0 || distance.failed > widest_bracket * distance.held) {
      if (!affordable(1 / factor)) {
        distance.note = "the budget ended before the bracket was narrow";
        return;
      }
      const StabilityResult& result = at(factor, step_overrides(root(), factor));
      if (result.verdict == StabilityVerdict::green) {
        distance.held = factor;
        const double taken = own_steps / std::max(1.0, static_cast<double>(result.steps));
        if (factor == longest_step && taken < step_is_taken * factor) {
          distance.held = std::max(1.0, taken);
          distance.note = fmt::format("longer steps are not taken: {}", limits_of(result));
          return;
        }
      } else {
        distance.failed = factor;
        distance.message = result.message;
      }
      if (distance.held == longest_step) return;
      factor = std::sqrt(distance.held * distance.failed);
    }
  }

  // "delt_max" or what else the report says set most steps.
  static std::string limits_of(const StabilityResult& result) {
    if (!result.report.is_object() || !result.report.contains("step_limit")) return "a limit";
    const Json& limit = result.report.at("step_limit");
    return limit.is_text() ? limit.get<std::string>() : limit.dump();
  }

  void resolution() {
    DistanceToFailure& distance = begin("resolution");
    for (const double factor : {0.75, 0.5}) {
      const auto overrides = resolution_overrides(root(), factor);
      if (overrides.empty()) {
        distance.note = "the grid of this deck cannot be scaled";
        return;
      }
      try_factor(distance, factor, overrides, factor);
    }
  }

  void stiffness() {
    const std::string name = stiffness_name(root());
    DistanceToFailure& distance = begin(name.empty() ? "stiffness" : name);
    if (name.empty()) {
      distance.note = "no solids and no exchange of momentum: nothing to stiffen";
      return;
    }
    // Waves are faster by the root of the moduli's factor, exchange costs nothing.
    const bool moduli = name == "moduli of the solids";
    for (const double factor : {2.0, 4.0})
      try_factor(distance, factor, stiffness_overrides(root(), factor),
                 moduli ? std::sqrt(factor) : 1);
  }

  // One value of a sweep away from 1; what the deck refuses is no failure.
  void try_factor(DistanceToFailure& distance, double factor,
                  const std::vector<std::string>& overrides, double cost) {
    if (distance.failed != 0) return;
    if (!affordable(cost)) {
      distance.note =
          fmt::format("factor {:g} and beyond were not tried: the budget ended", factor);
      return;
    }
    const StabilityResult& result = at(factor, overrides);
    if (result.status == "refused") {
      distance.note = fmt::format("factor {:g}: {}", factor, result.message);
      found_.map.hard.sweeps.back().values.pop_back();
      found_.map.results.pop_back();
    } else if (result.verdict == StabilityVerdict::green) {
      distance.held = factor;
    } else {
      distance.failed = factor;
      distance.message = result.message;
    }
  }

  Deck deck_;
  double budget_, spent_ = 1;
  const RunPoint& run_;
  DeckStability found_;
};

}  // namespace

std::string DistanceToFailure::text() const {
  std::string text;
  if (failed == 0)
    text = held == 1
               ? name + ": nothing is known"
               : fmt::format("{}: holds up to factor {:.3g}, the last that was tried", name, held);
  else
    text = fmt::format("{}: factor {:.2f} from failing (holds at {:.3g}, not at {:.3g}: {})", name,
                       std::sqrt(held * failed), held, failed, message);
  if (!note.empty()) text += "; " + note;
  return text;
}

Json deck_stability_json(const DeckStability& found) {
  Json json = map_json({found.map});
  Json distances = Json::array();
  for (const DistanceToFailure& d : found.distances) {
    Json row = {{"name", d.name}, {"held", d.held}};
    row["failed"] = d.failed == 0 ? Json() : Json(d.failed);
    if (!d.note.empty()) row["note"] = d.note;
    if (!d.message.empty()) row["message"] = d.message;
    distances.push_back(std::move(row));
  }
  json["distances"] = std::move(distances);
  return json;
}

DeckStability sweep_deck(const std::string& deck, const std::vector<std::string>& overrides,
                         double budget, const RunPoint& run) {
  return Sweeper(deck, overrides, budget, run).all();
}

}  // namespace sluice
