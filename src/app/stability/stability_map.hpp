// The map of hard cases: where each holds, the margin of its default, what failed first; and what
// changed since a recorded map.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/stability/stability_run.hpp"

namespace sluice {

struct CaseMap {
  StabilityCase hard;
  std::vector<StabilityResult> results;  // in the order of points_of; the default first

  const StabilityResult& at_default() const { return results.front(); }
  // The run of a value of a sweep: the default run for the default value.
  const StabilityResult& at(int sweep, int value) const;
  // Is within the scheme's limit.
  bool counts(const StabilityPoint& point) const;
  // Of a sweep whose values are numbers: the largest one up to which all from the default on are
  // green, over the default; 0 where the default is not green. Nothing for words.
  std::optional<double> margin(int sweep) const;
  // All values that count are green up to the largest: the margin is at least what margin() says.
  bool never_failed_above(int sweep) const;
};

// "block_moves, multiplier 0.8" or "block_moves, default".
std::string run_name(const CaseMap& map, const StabilityPoint& point);

struct MapTotals {
  int cases = 0, defaults_held = 0;
  int points = 0, points_held = 0;  // that count, default runs among them
  double seconds = 0;               // of all runs
};
MapTotals totals_of(const std::vector<CaseMap>& maps);

std::string map_table(const std::vector<CaseMap>& maps);
// Runs that are not green, one or two lines each.
std::string failures_text(const std::vector<CaseMap>& maps);
// Everything, with the program's version, host and date.
Json map_json(const std::vector<CaseMap>& maps);
// The verdicts alone, to be kept and compared with.
Json verdicts_json(const std::vector<CaseMap>& maps);

// Verdicts that differ from those of a recorded map (JSON of either kind), one line each. Only runs
// that both have are compared. JsonError where the record is no such map.
struct MapChanges {
  std::vector<std::string> worse, better;
};
MapChanges changes_since(const Json& recorded, const std::vector<CaseMap>& maps);

}  // namespace sluice
