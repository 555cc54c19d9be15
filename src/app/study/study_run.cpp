#include "app/study/study_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "app/loading/archive_error.hpp"
#include "app/process/deck_process.hpp"
#include "app/process/run_journal.hpp"
#include "app/study/study_measure.hpp"
#include "framework/base/error.hpp"
#include "framework/base/json.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

DeckRequest request_of(const StudyRunner& runner, const Study& study, const StudyPoint& point) {
  return {runner.executable, study.deck, point.overrides, {}, runner.folder / "run"};
}

exact::ErrorNorms lost_energy_of(const Study& study, const Json& report) try {
  const double share = lost_energy(report);
  return {share, share, share, share};
} catch (const InputError& fault) {
  throw InputError(fmt::format("{}: {}: {}", study.file, study.deck, fault.what()));
}

}  // namespace

// What one process gave.
struct StudyRunner::Once {
  std::string status = "failed", message;
  int steps = 0;
  double seconds = 0, wall_seconds = 0;
  exact::ErrorNorms norms;
  std::string archive;  // empty: none was written
};

Timing timing_of(std::vector<double> seconds) {
  if (seconds.empty()) return {};
  std::sort(seconds.begin(), seconds.end());
  const auto at = [&](double share) {  // linear between the sorted values
    const double place = share * static_cast<double>(seconds.size() - 1);
    const auto low = static_cast<std::size_t>(place);
    const std::size_t high = std::min(low + 1, seconds.size() - 1);
    return seconds[low] + (place - static_cast<double>(low)) * (seconds[high] - seconds[low]);
  };
  const double median = at(0.5);
  return {median, median > 0 ? (at(0.75) - at(0.25)) / median : 0};
}

StudyRunner::Once StudyRunner::run_once(const Study& study, const StudyPoint& point,
                                        bool measure_error) const {
  const DeckOutcome outcome = run_deck(request_of(*this, study, point));
  Once once;
  once.message = outcome.message;
  const Json& told = outcome.report;
  if (!told.is_object()) return once;
  once.status = outcome.status();
  once.steps = told.value("steps", 0);
  once.wall_seconds = told.value("wall_s", 0.0);
  once.seconds = told.value("stepping_s", once.wall_seconds);
  if (once.status != "done") return once;
  once.archive = outcome.archive();
  if (once.archive.empty())
    throw InputError(fmt::format("{}: the run of {} wrote no archive", study.file, study.deck));
  if (measure_error)
    once.norms = is_of_energy(study) ? lost_energy_of(study, told)
                                     : measured_error(study, once.archive, reference_);
  return once;
}

StudyRunner::Once StudyRunner::must_run(const Study& study, const StudyPoint& point,
                                        bool measure_error) const {
  Once once = run_once(study, point, measure_error);
  if (once.status != "done")
    throw InputError(
        fmt::format("{}: the reference is {}: {}", study.file, once.status, once.message));
  return once;
}

StudyResult StudyRunner::run_reference(const Study& study) {
  StudyResult result;
  result.point = reference_point(study);
  const Once once = must_run(study, result.point, false);
  reference_ = folder / "reference";
  fs::remove_all(*reference_);
  fs::rename(once.archive, *reference_);
  result.status = once.status;
  result.steps = once.steps;
  result.seconds = once.seconds;
  result.wall_seconds = once.wall_seconds;
  if (const auto coarser = coarser_reference_point(study)) {
    result.norms = must_run(study, *coarser, true).norms;
    result.error = in_norm(result.norms, study.norm);
  }
  fs::remove_all(folder / "run");
  return result;
}

StudyResult StudyRunner::run(const Study& study, const StudyPoint& point) const {
  StudyResult result;
  result.point = point;
  result.command = shell_text(run_words(request_of(*this, study, point)));
  std::vector<double> seconds, wall_seconds;
  double spent = 0;
  Timing timing;
  for (int repeat = 0; repeat < std::max(1, repeats); ++repeat) {
    const Once once = run_once(study, point, repeat == 0);
    if (repeat == 0) {
      result.status = once.status;
      result.message = once.message;
      result.steps = once.steps;
      result.norms = once.norms;
      result.error = in_norm(once.norms, study.norm);
    }
    seconds.push_back(once.seconds);
    wall_seconds.push_back(once.wall_seconds);
    spent += once.wall_seconds;
    timing = timing_of(seconds);
    if (!result.done() || spent > patience) break;
    if (repeat >= 2 && timing.spread <= 0.05) break;
  }
  result.seconds = timing.median;
  result.wall_seconds = timing_of(wall_seconds).median;
  result.spread = timing.spread;
  result.repeats = static_cast<int>(seconds.size());
  fs::remove_all(folder / "run");
  return result;
}

std::string StudyRunner::key_of(const Study& study, const StudyPoint& point) const {
  std::vector<std::string> words = run_words(request_of(*this, study, point));
  words.push_back(fmt::format("{} {} of {}.{}, material {}, {} repeats", study.file, study.norm,
                              study.variable, study.component, study.material, repeats));
  return RunJournal::key_of(words, study.deck);
}

Json to_json(const StudyResult& r) {
  return {{"status", r.status},
          {"message", r.message},
          {"command", r.command},
          {"steps", r.steps},
          {"seconds", r.seconds},
          {"wall_s", r.wall_seconds},
          {"spread", r.spread},
          {"repeats", r.repeats},
          {"norms", {r.norms.l1, r.norms.l2, r.norms.linf, r.norms.relative_l1}},
          {"points", r.norms.points}};
}

StudyResult result_from_json(const Json& json, const Study& study, const StudyPoint& point) {
  StudyResult r;
  r.point = point;
  r.status = json.at("status").get<std::string>();
  r.message = json.at("message").get<std::string>();
  r.command = json.at("command").get<std::string>();
  r.steps = json.at("steps").get<int>();
  r.seconds = json.at("seconds").get<double>();
  r.wall_seconds = json.at("wall_s").get<double>();
  r.spread = json.at("spread").get<double>();
  r.repeats = json.at("repeats").get<int>();
  const auto norm = [&](std::size_t n) {  // what is not finite is null
    const Json& value = json.at("norms").at(n);
    return value.is_number() ? value.get<double>() : NAN;
  };
  r.norms = {norm(0), norm(1), norm(2), norm(3), json.at("points").get<std::size_t>()};
  r.error = in_norm(r.norms, study.norm);
  return r;
}

}  // namespace sluice
