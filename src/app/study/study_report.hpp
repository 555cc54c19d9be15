// What a study found: observed orders, the Pareto front, the cheapest way to an error; as tables,
// CSV and JSON.
#pragma once
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "app/study/study.hpp"
#include "app/study/study_run.hpp"

namespace sluice {

struct StudyReport {
  Study study;
  std::vector<StudyResult> results;           // in the order of points_of
  std::optional<StudyResult> reference = {};  // with its own error, if the study has one

  // Order from the next coarser run of the same setting: log(e1/e2) / log(N2/N1).
  std::optional<double> observed_order(std::size_t result) const;
  // No other run is at once as fast and as accurate.
  bool on_front(std::size_t result) const;
};

// What a setting needs for a relative error: between two rungs of its ladder by a power law.
struct Cost {
  std::string setting;
  bool is_default = false;
  double cells = 0, seconds = 0;  // along the longest direction; of the steps
  bool measured = false;          // the coarsest run has it already: cells and seconds are its own
};
// Settings that reach the target, cheapest first.
std::vector<Cost> costs_of_target(const StudyReport& report, double target);

std::string runs_table(const StudyReport& report);
std::string targets_table(const StudyReport& report);
void write_csv(std::ostream& out, const StudyReport& report);
std::string json_text(const StudyReport& report);

}  // namespace sluice
