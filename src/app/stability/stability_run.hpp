// One run of a hard case as a process of its own, and its verdict.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "app/stability/stability_case.hpp"

namespace sluice {

// Green: what must hold held, and few steps were redone. Amber: it held, but more steps were redone
// than the case allows. Red: something did not hold, or the run did not come to its end.
enum class StabilityVerdict { green, amber, red };
const char* to_string(StabilityVerdict verdict);

struct StabilityResult {
  StabilityPoint point;
  StabilityVerdict verdict = StabilityVerdict::red;
  std::string status;   // as the run's report says
  std::string message;  // what failed first, with cell or particle, material and task
  std::string command;  // repeats the run
  int steps = 0;
  std::int64_t redone = 0;  // steps that were attempted again
  double seconds = 0;       // wall time of the steps
  Json report;              // run.json; null where there is none

  // The bounds of the case, in its order; empty where the run did not come to its end.
  struct Check {
    std::string text;
    Finding finding;
  };
  std::vector<Check> checks;
};

struct StabilityRunner {
  std::filesystem::path executable;  // sluice
  std::filesystem::path folder;      // for archives and logs, which are removed when judged

  // `number`: of the run, for the name of its folder: several threads may run at once. Where the
  // deck is refused, or a bound asks for what the run does not say: InputError for the default run;
  // a run of a sweep is red, of status "refused".
  StabilityResult run(const StabilityCase& hard, const StabilityPoint& point, int number) const;
  // All that the result depends on, as text.
  std::string key_of(const StabilityCase& hard, const StabilityPoint& point) const;
};

// Without the report and the point.
Json to_json(const StabilityResult& result);
// JsonError where it is none.
StabilityResult result_from_json(const Json& json, const StabilityPoint& point);

}  // namespace sluice
