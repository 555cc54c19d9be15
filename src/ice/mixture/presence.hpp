// Step 1 with several materials: who is where.
#pragma once
#include "ice/mixture/tasks.hpp"

namespace sluice::ice::mixture {

void add_presence(TaskList& list, const PresenceInput& v, const SchemeOptions& o, int effect);

}  // namespace sluice::ice::mixture
