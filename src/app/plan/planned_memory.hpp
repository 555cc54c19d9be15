// The memory that a rank will have resident at its peak, and what it sends in a step.
//
//   peak = base + states + work fields + step arrays
//          + max(initial fill, stored outputs + scratch + messages)
// where a state is all slots of all local boxes with ghosts, work fields are those of
// StateFacet::work_slots, old and new like the state, step arrays those of StepFacet::array_bytes,
// outputs live from the first step that stores them, and the initial fill holds the primitives of
// the largest box while it is set.
#pragma once
#include <cstdint>
#include <utility>

#include "app/plan/planned_graph.hpp"
#include "app/plan/planned_hierarchy.hpp"

namespace sluice {

// Of the rank that needs most, and the peaks of all ranks added up; bytes.
struct PlannedMemory {
  double particles = 0;  // of a rank, those of the start
  double base = 0, states = 0, outputs = 0, scratch = 0, initial_fill = 0, messages = 0;
  double work_fields = 0, step_arrays = 0;
  double all_ranks = 0;  // what run.json tells as peak_memory_bytes
  double output_doubles_per_cell = 0, state_doubles_per_cell = 0, work_doubles_per_cell = 0;
  double peak() const;
  double field_doubles_per_cell() const {
    return 2 * state_doubles_per_cell + output_doubles_per_cell;
  }
};

// Of the rank that sends most, on the coarsest level.
struct PlannedMessages {
  std::int64_t bytes = 0;
  int neighbour_ranks = 0;
};

struct MemoryRequest {
  const Scene& scene;
  const Component& component;
  const PlannedHierarchy& hierarchy;
  int ranks = 1, threads = 1;
  IntVec3 block{};  // 0: the default of each level
  // Stored in steps that save or analyse them; computed from a state.
  std::set<Label> stored, computed;
  MaterialsOfLabels materials;
};

// How many components are kept of a label: it is for every material that has it.
double stored_components(const MaterialsOfLabels& materials, Label label);

std::pair<PlannedMemory, PlannedMessages> plan_memory(const MemoryRequest& request);

}  // namespace sluice
