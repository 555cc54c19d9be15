// Fields that particles have on nodes, for analyses that sample fields.
#pragma once
#include <vector>

#include "framework/analysis/sampler.hpp"
#include "framework/run/levels/hierarchy.hpp"

namespace sluice {

// Is it such a label of the particles of this run.
bool is_of_nodes(const Hierarchy& hierarchy, Label label);
// The quantity, of a material that has particles; DeckError.
AnalysedQuantity node_quantity(const Hierarchy& hierarchy, const AnalysedVariable& v, Label label);
// Those among the quantities, into the outputs of all levels. Collective.
void store_node_quantities(Hierarchy& hierarchy, const std::vector<AnalysedQuantity>& quantities);

}  // namespace sluice
