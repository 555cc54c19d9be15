// The schema of every deck that Sluice reads: the framework's tags and those of each component.
#pragma once
#include "framework/deck/schema.hpp"

namespace sluice {

Schema sluice_schema();

}  // namespace sluice
