// Histories of solids: sums over all particles, a number for each step, in the unit of its label.
#pragma once
#include "framework/run/component/component.hpp"
#include "mpm/budgets/history_sums.hpp"

namespace sluice::mpm {

void declare_histories();
// Tells which sums the saved histories are made of.
void need_sums(const Scene& scene, HistorySums& sums);
bool is_history(Label label);
// std::logic_error where the label is none of these.
double history_of(Label label, const Totals& totals, const HistorySums& sums);
Vec3 vector_history_of(Label label, const Totals& totals, const HistorySums& sums);

}  // namespace sluice::mpm
