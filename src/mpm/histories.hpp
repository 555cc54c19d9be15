// Histories of solids: sums over all particles, a number a step.
#pragma once
#include "framework/run/component.hpp"

namespace sluice::mpm {

void declare_histories();
// std::logic_error where the label is none of these.
double history_of(Label label, const Totals& totals);
Vec3 vector_history_of(Label label, const Totals& totals);

}  // namespace sluice::mpm
