#include "app/stability/stability_run.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/process/deck_process.hpp"
#include "app/process/run_journal.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace {

// How often a step was attempted again, whatever for.
std::int64_t redone_steps(const Json& report) {
  std::int64_t redone = 0;
  for (const auto& [name, event] : report.at("events").members())
    if (name.starts_with("step redone")) redone += event.at("count").get<std::int64_t>();
  return redone;
}

void check_bounds(const StabilityCase& hard, const DeckOutcome& outcome, StabilityResult& result) {
  const std::string archive = outcome.archive();
  const Evidence evidence{outcome.report, archive};
  for (const auto& requirement : hard.must_hold) {
    result.checks.push_back({requirement->text(), requirement->check(evidence)});
    const auto& [text, finding] = result.checks.back();
    if (finding.held || !result.message.empty()) continue;
    result.message = fmt::format("{}: found {:.4g}{}", text, finding.value,
                                 finding.place.empty() ? "" : " at " + finding.place);
  }
}

DeckRequest request_of(const StabilityRunner& runner, const StabilityCase& hard,
                       const StabilityPoint& point, const std::string& folder) {
  return {
      runner.executable, hard.deck, point.overrides, {"--threads", "1"}, runner.folder / folder};
}

StabilityVerdict verdict_of(const std::string& text) {
  return text == "green"   ? StabilityVerdict::green
         : text == "amber" ? StabilityVerdict::amber
                           : StabilityVerdict::red;
}

}  // namespace

const char* to_string(StabilityVerdict verdict) {
  return verdict == StabilityVerdict::green   ? "green"
         : verdict == StabilityVerdict::amber ? "amber"
                                              : "red";
}

StabilityResult StabilityRunner::run(const StabilityCase& hard, const StabilityPoint& point,
                                     int number) const try {
  const DeckRequest request{executable,
                            hard.deck,
                            point.overrides,
                            {"--threads", "1"},
                            folder / fmt::format("run_{}", number)};
  StabilityResult result;
  result.point = point;
  result.command = shell_text(run_words(request));
  const DeckOutcome outcome = run_deck(request);
  result.status = outcome.status();
  result.message = outcome.message;
  result.report = outcome.report;
  if (outcome.report.is_object()) {
    result.steps = outcome.report.value("steps", 0);
    result.seconds = outcome.report.value("stepping_s", 0.0);
    result.redone = redone_steps(outcome.report);
    if (const auto told = outcome.report.value("message", std::string()); !told.empty())
      result.message = told;
  }
  if (result.status == "done") {
    check_bounds(hard, outcome, result);
    const bool many = static_cast<double>(result.redone) > hard.redone_at_most * result.steps;
    result.verdict = !result.message.empty() ? StabilityVerdict::red
                     : many                  ? StabilityVerdict::amber
                                             : StabilityVerdict::green;
    if (result.verdict == StabilityVerdict::amber)
      result.message = fmt::format("{} of {} steps were redone; at most {:g} of them may be",
                                   result.redone, result.steps, hard.redone_at_most);
  }
  std::filesystem::remove_all(request.folder);
  return result;
} catch (const InputError& fault) {
  if (point.sweep < 0) throw InputError(fmt::format("{}: {}", hard.file, fault.what()));
  StabilityResult refused;
  refused.point = point;
  refused.status = "refused";
  refused.message = fault.what();
  refused.command = shell_text(run_words(request_of(*this, hard, point, "")));
  return refused;
}

std::string StabilityRunner::key_of(const StabilityCase& hard, const StabilityPoint& point) const {
  std::vector<std::string> words = run_words(request_of(*this, hard, point, ""));
  words.push_back(fmt::format("redone at most {}", hard.redone_at_most));
  for (const auto& requirement : hard.must_hold) words.push_back(requirement->text());
  return RunJournal::key_of(words, hard.deck);
}

Json to_json(const StabilityResult& r) {
  Json checks = Json::array();
  for (const auto& c : r.checks)
    checks.push_back({{"must_hold", c.text},
                      {"held", c.finding.held},
                      {"found", c.finding.value},
                      {"place", c.finding.place}});
  return {{"verdict", to_string(r.verdict)},
          {"status", r.status},
          {"message", r.message},
          {"steps", r.steps},
          {"redone", r.redone},
          {"seconds", r.seconds},
          {"command", r.command},
          {"checks", std::move(checks)}};
}

StabilityResult result_from_json(const Json& json, const StabilityPoint& point) {
  StabilityResult r;
  r.point = point;
  r.verdict = verdict_of(json.at("verdict").get<std::string>());
  r.status = json.at("status").get<std::string>();
  r.message = json.at("message").get<std::string>();
  r.steps = json.at("steps").get<int>();
  r.redone = json.at("redone").get<std::int64_t>();
  r.seconds = json.at("seconds").get<double>();
  r.command = json.at("command").get<std::string>();
  for (const Json& c : json.at("checks").entries())
    r.checks.push_back(
        {c.at("must_hold").get<std::string>(),
         {c.at("held").get<bool>(), c.at("found").is_number() ? c.at("found").get<double>() : NAN,
          c.at("place").get<std::string>()}});
  return r;
}

}  // namespace sluice
