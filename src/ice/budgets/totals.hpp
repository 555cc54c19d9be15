// Totals over the cells of a rank, what a step added to them, and the histories made of them.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "framework/run/component/budget_facet.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

// Adds mass of each material, momentum, energies and amounts of scalars (kg, kg m/s, J) of the
// cells that no finer level covers.
void add_totals(const Warehouse& state, const LevelCoverage& coverage, const SchemeOptions& options,
                Totals& totals);

// What came in through the boundary, and what forces and models did; `sums`: of the step, as
// StepSlots numbers them. Without
// `start` forces count only where their sums are among these. `dt`: s.
StepBalance balance(const SchemeOptions& options, const std::vector<double>& sums,
                    const StepStart* start, double dt);

// What models add: mass, momentum, total energy; what passes between materials. kg, kg m/s and J
// of the step that has these sums, in the order of the names.
std::vector<std::string> tracked_names(const SchemeOptions& options);
std::vector<double> tracked_totals(const SchemeOptions& options, const std::vector<double>& sums);

// One value of a history at the end of a step: kg, kg m/s or J, as its label says.
double history_value(const SchemeOptions& options, Label label, const Totals& totals);
Vec3 history_vector(Label label, const Totals& totals);

}  // namespace sluice::ice
