// Does a run fit into the memory that there is: asked before it starts.
#pragma once
#include "app/loading/scene_loader.hpp"
#include "framework/base/vec3.hpp"

namespace sluice {

class Communicator;

// InputError with both numbers where the peak that is planned, of all ranks on a machine, is more
// than is available there. Collective.
void require_memory(const LoadedScene& loaded, Communicator& ranks, int threads, IntVec3 block);

}  // namespace sluice
