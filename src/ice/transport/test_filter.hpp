// The test filter of the dynamic model: the trapezoid (1, 2, 1)/4 along every axis.
#pragma once
#include <string>

#include "ice/transport/viscosity.hpp"

namespace sluice::ice {

// Filters `components` of a cell variable; needs one more layer around a cell. Over the first two
// axes in one sum, in which neither comes first.
VariableId add_test_filter(const TransportTask& task, VariableId variable, int components,
                           const std::string& name);

}  // namespace sluice::ice
