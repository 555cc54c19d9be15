// What the labels of a step read of each material of a mixture.
#pragma once
#include "ice/mixture/variables.hpp"
#include "ice/outputs/step_labels.hpp"

namespace sluice::ice::mixture {

MaterialsOfStep materials_of_step(TaskList&, const Variables&, const SchemeOptions&);

}  // namespace sluice::ice::mixture
