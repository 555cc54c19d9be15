// What must hold of a run: bounds on what its report and its archive say.
//
// Kinds, by the first entry of the JSON object:
//   {"quantity": "total energy", "drift_at_most": 1e-6}     |drift| of a conserved quantity
//   {"quantity": "total energy", "grows_at_most": 0.01}     its drift upwards
//   {"lost_energy_at_most": 0.1}                            |what transfer, integration and contact
//                                                           took and did not heat| over the scale
//   {"variable": "press_CC", "material": 0, "component": 0, extremes of a saved label of cells or
//    "at_least": 0, "at_most": 6e4, "when": "end"}          particles; "always": in every output
//   {"error_of": "rho_CC", "norm": "l1", "at_most": 0.05}   against the deck's exact solution
//   {"event": "step redone with a smaller one", "at_most": 0}
#pragma once
#include <memory>
#include <string>

#include "app/process/json_file.hpp"

namespace sluice {

struct Evidence {
  const Json& report;          // run.json of a run
  const std::string& archive;  // its folder; empty: there is none
};

struct Finding {
  bool held = true;
  double value = 0;   // what was found, in the unit of the bound
  std::string place;  // where and when; empty: of the whole run
};

class Requirement {
 public:
  virtual ~Requirement() = default;
  virtual std::string text() const = 0;  // "press_CC of material 0 between 0 and 6e4 at the end"
  // InputError where the run does not say what is asked for (a label that is not saved, say).
  virtual Finding check(const Evidence& evidence) const = 0;
};

// `object`: an entry of "must_hold" of the file.
std::shared_ptr<const Requirement> read_requirement(const JsonFile& file, const Json& object);

// The drift upwards of a conserved quantity is at most this share of its scale.
std::shared_ptr<const Requirement> growth_requirement(const std::string& quantity, double most);

}  // namespace sluice
