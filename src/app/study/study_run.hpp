// One run of a study: `sluice run` as a process of its own, its error and its time.
//
// The time that counts is that of the steps: start-up and writing the archive (which waits for the
// disk) do not depend on the setting and would hide what small runs cost.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/study/study.hpp"
#include "exact/base/error_norms.hpp"
#include "framework/base/json.hpp"

namespace sluice {

struct StudyResult {
  StudyPoint point;
  std::string status = "failed";  // as the run's JSON says; "done" is good
  std::string message;            // why it is not done
  std::string command;            // repeats the run
  int steps = 0;
  double seconds = 0;       // of the steps alone, median of the repeats
  double wall_seconds = 0;  // with start and output, median of the repeats
  double spread = 0;        // of the repeats, relative; 0 of a single one
  int repeats = 0;
  exact::ErrorNorms norms;
  double error = 0;  // in the study's norm: unit of the variable; none of relative_l1, lost energy

  bool done() const { return status == "done"; }
  // Timing too uneven, or not repeated.
  bool noisy() const { return repeats < 2 || spread > 0.05; }
};

struct StudyRunner {
  std::filesystem::path executable;  // sluice
  std::filesystem::path folder;      // for archives and logs; archives are removed when measured
  int repeats = 7;                   // at most; stops when the spread falls to 5 %
  double patience = 20;              // no more repeats once they took so many seconds in all

  // Before run(), of a study with a reference: its run, whose archive stays in the folder. Throws
  // InputError if it does not come to its end. Its error is that of a run with half of its cells
  // against it, 0 where there is none: the error of the reference is less if refinement helps.
  StudyResult run_reference(const Study& study);
  StudyResult run(const Study& study, const StudyPoint& point) const;
  // All that the result of a run depends on, as text: for the journal of a study.
  std::string key_of(const Study& study, const StudyPoint& point) const;

 private:
  struct Once;
  Once must_run(const Study& study, const StudyPoint& point, bool measure_error) const;
  Once run_once(const Study& study, const StudyPoint& point, bool measure_error) const;

  std::optional<std::filesystem::path> reference_;  // archive
};

// For the journal of a study. JsonError where it is no result.
Json to_json(const StudyResult& result);
StudyResult result_from_json(const Json& json, const Study& study, const StudyPoint& point);

// Middle of the values (s), and (third quartile - first quartile) / middle, a ratio.
struct Timing {
  double median = 0, spread = 0;
};
Timing timing_of(std::vector<double> seconds);

}  // namespace sluice
