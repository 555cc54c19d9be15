// The variables that a run can save, known from its component alone: no cell is made.
#pragma once
#include <set>
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/run/component/component.hpp"
#include "framework/scene/scene.hpp"

namespace sluice {

class RunLabels {
 public:
  // `histories`: names of those that the component keeps.
  RunLabels(const Component& component, std::vector<std::string> histories);
  bool has(const std::string& name) const;
  std::vector<std::string> names() const;

 private:
  std::vector<std::string> histories_;
  std::set<Label> labels_;
};

// Takes out of `output` what this run does not compute: with a warning where the format knows the
// variable, else with an error; with an error too when nothing is left to save. What particles have
// in other scenes alone has been told by their component. All labels of the program must have been
// declared.
void settle_saves(OutputSettings& output, const Component& component, const RunLabels& labels,
                  std::vector<Fault>& faults);

}  // namespace sluice
