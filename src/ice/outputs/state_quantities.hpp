// Cell variables that are functions of a state alone, ready to be saved or to be read with ghosts.
#pragma once
#include <string>
#include <vector>

#include "framework/task/task.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

struct DiagnosticQuantity {
  Label label;
  int material = 0;
  int components = 1;
  VariableId variable;  // old state, or a temporary that is computed when somebody reads it
};

// Declares the tasks that compute them from the old state.
std::vector<DiagnosticQuantity> declare_quantities(TaskList& list, const SchemeOptions& options);

// The one of a name and material that must be among them, else std::logic_error.
const DiagnosticQuantity& quantity(const std::vector<DiagnosticQuantity>& quantities,
                                   const std::string& label, int material);

}  // namespace sluice::ice
