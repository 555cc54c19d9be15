// Saved labels of friction and conduction that only exist inside a step.
#pragma once
#include "ice/outputs/step_labels.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

// tau_X_FC, tau_Y_FC, tau_Z_FC, viscous_src_CC, heatCond_src_CC; zero where there is none.
void declare_transport_outputs(TaskList& list, const OutputInput& v, const SchemeOptions& o);

}  // namespace sluice::ice
