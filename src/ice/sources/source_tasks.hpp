// What sources need in the graph of a step: rows to act on, an account, labels.
#pragma once
#include "ice/sources/sources.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

// Where the exact sums of sources stand among those of a step, from
// BudgetOptions::source_sums: the mass of each material, then these.
struct SourceSums {
  enum {
    momentum = 0,
    total_energy = 3,
    heat,
    exchanged_mass,
    exchanged_energy,
    burned_mass,
    released_heat,
    common_sum_count
  };
  static constexpr int count(int materials) { return materials + common_sum_count; }
};

// The graph of one material: adds to its new state. Nothing without sources.
struct SourceHandles {
  Out change;
};
SourceHandles declare_sources(TaskBuilder& task, VariableId source_change, const SchemeOptions& o);
void add_sources_of_one(const Row& row, const SourceHandles& h, const SchemeOptions& o, Out mass,
                        Out momentum, Out energy);

// Sums over the uncovered cells; absent without sources.
void add_source_budget(TaskList&, VariableId source_change, const SchemeOptions&, int effect);
// modelMass_src and its like, zero without sources.
// `of_sources`: without sources any variable of cells.
void declare_source_labels(TaskList&, VariableId of_sources, const SchemeOptions&, int effect);

}  // namespace sluice::ice
