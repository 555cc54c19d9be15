// A hard case: which deck, what must hold, over which sweeps of step, resolution and stiffness.
//
// A .stability file is JSON with // comments:
//   {
//     "title": "Block that moves and vibrates",
//     "why": "Half-filled cells lower the stable step.",     why it is hard
//     "source": "Wallstedt and Guilkey (2008)",
//     "component": "solids",                    fluid, solids, coupled, reactions
//     "traits": ["levels", "implicit"],         may be missing
//     "quick": true,                            belongs to the quick subset
//     "deck": "../../inputs/mpm/block.ups",     from the file's folder, else from here
//     "set": ["Time/maxTime=0.1"],              for every run
//     "redone_at_most": 0.01,                   share of redone steps in a run that is green
//     "must_hold": [...],                       see requirement.hpp
//     "sweeps": [{"name": "multiplier", "default": "0.4", "limit": 0.9,
//                 "values": {"0.2": "Time/timestep_multiplier=0.2",
//                            "0.4": "Time/timestep_multiplier=0.4"}}]
//   }
// Each value of each sweep is a run, with all else as in the default run. Values above "limit", the
// scheme's own, are run and drawn, but they need not hold.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/stability/requirement.hpp"

namespace sluice {

struct StabilityCase {
  struct Value {
    std::string name;
    std::vector<std::string> overrides;  // PATH=VALUE
    bool counts = true;                  // within the scheme's limit
  };
  struct Sweep {
    std::string name, default_value;
    std::vector<Value> values;  // in the order of the file
  };

  std::string file, name, title, why, source;
  std::string component = "fluid";
  std::vector<std::string> traits;
  bool quick = false;
  std::string deck;
  std::vector<std::string> overrides;
  double redone_at_most = 0.01;  // share of the steps
  std::vector<std::shared_ptr<const Requirement>> must_hold;
  std::vector<Sweep> sweeps;
};

// One run of a case.
struct StabilityPoint {
  int sweep = -1;  // -1: the default run, which stands in every sweep
  int value = -1;
  std::vector<std::string> overrides;
};

// The default run first.
std::vector<StabilityPoint> points_of(const StabilityCase& hard);

// The number that a name of a value is; nothing for words.
std::optional<double> number_of(const std::string& value_name);

// InputError with file and entry on what is not JSON, unknown, missing or out of range.
StabilityCase read_stability_case(const std::string& file);

// All of a folder, by name.
std::vector<StabilityCase> read_stability_cases(const std::string& folder);

}  // namespace sluice
