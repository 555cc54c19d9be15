// Ways to compute a cell variable from others, for labels that are functions of a state.
//
// Each is a temporary: nothing is computed unless a saved label or a criterion of refinement asks
// for it. Gradients are central differences, (q_{i+1} - q_{i-1})/(2 dx), along active directions;
// next to the boundary they use the ghost states.
#pragma once
#include <cmath>
#include <utility>
#include <vector>

#include "ice/fluid/labels.hpp"
#include "ice/outputs/state_quantities.hpp"
#include "ice/step/effect_ids.hpp"

namespace sluice::ice {

class QuantityList {
 public:
  QuantityList(TaskList& list, const SchemeOptions& options) : list_(list), o_(options) {}

  TaskList& list() { return list_; }
  const SchemeOptions& options() const { return o_; }
  std::vector<DiagnosticQuantity> all() && { return std::move(all_); }
  const std::vector<DiagnosticQuantity>& so_far() const { return all_; }

  void add(Label label, int material, VariableId variable) {
    all_.push_back({label, material, component_count(label.info().type), variable});
  }
  VariableId fresh(Label label, int material) {
    const VariableId v = list_.temporary(name(label, material), component_count(label.info().type));
    add(label, material, v);
    return v;
  }
  TaskBuilder task(Label label, int material) {
    return list_.task("compute " + name(label, material), effect_diagnostics);
  }

  // u = m/rho, by level direction.
  VariableId velocity(VariableId rho, VariableId momentum);
  // f of two cell variables.
  template <class F>
  VariableId of(VariableId first, VariableId second, Label label, int material, F f) {
    return row_variable(
        first, second, label, material,
        [f](int n, const double* __restrict x, const double* __restrict y, double* __restrict to) {
          for (int i = 0; i < n; ++i) to[i] = f(x[i], y[i]);
        });
  }
  // Of rows of n cells: f(n, first, second, result).
  template <class F>
  VariableId row_variable(VariableId first, VariableId second, Label label, int material, F f) {
    const VariableId v = fresh(label, material);
    TaskBuilder t = task(label, material);
    const In a = t.read(first), b = t.read(second);
    const Out out = t.write(v);
    t.kernel([=](const Row& row) { f(row.count(), row(a), row(b), row(out)); });
    return v;
  }
  // The length of a vector over a speed.
  void mach(VariableId velocity, VariableId sound, int material);
  // Root of the sum over the axes of the squared slope along each: of a number, the magnitude of
  // its gradient; of a vector, each component along its own axis.
  void slopes(VariableId of, Label label, int material, bool vector = false);
  void vorticity(VariableId velocity, int material);

 private:
  std::string name(Label label, int material) const {
    return o_.materials.fluids.size() == 1 ? label.name()
                                           : label.name() + " " + std::to_string(material);
  }

  TaskList& list_;
  const SchemeOptions& o_;
  std::vector<DiagnosticQuantity> all_;
};

// Mass, momentum, energy and volume of each material in a cell, from what the list has.
// (amounts.cpp)
void declare_amounts(QuantityList& quantities);

}  // namespace sluice::ice
