// What a component lets a run save: labels of a state, histories, and when it saves more.
#pragma once
#include <vector>

#include "framework/base/vec3.hpp"
#include "framework/field/label.hpp"
#include "framework/scene/output_switch.hpp"
#include "framework/task/task.hpp"

namespace sluice {

struct Totals;

class OutputFacet {
 public:
  virtual ~OutputFacet() = default;

  // Tasks that compute saved labels from a state alone (read as old state, with ghosts).
  virtual void declare_diagnostics(TaskList& /*list*/, int /*level*/) const {}
  // Labels of .dat histories and their values, in the units of the labels. Throws std::logic_error
  // for a label without one.
  virtual double history_value(Label label, const Totals& totals) const;
  virtual Vec3 history_vector(Label label, const Totals& totals) const;
  // New intervals of outputs that the scene may come to, and whether a step with these sums has
  // come to the n-th.
  virtual std::vector<OutputSwitch> switches() const { return {}; }
  virtual bool passes_switch(std::size_t /*n*/, const std::vector<double>& /*sums*/) const {
    return false;
  }
};

}  // namespace sluice
