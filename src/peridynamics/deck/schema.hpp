// The blocks of a deck that belong to peridynamic solids: <Peridynamics> and
// <MaterialProperties><Peridynamics>.
#pragma once
#include <vector>

#include "framework/deck/schema.hpp"

namespace sluice::peridynamics {

void add_tags(Schema& schema);

bool runs_peridynamics(const DeckNode& root);
// The <material> nodes, in index order.
std::vector<const DeckNode*> materials_of(const DeckNode& root);

// Rules over several tags; each does nothing where another component runs.
void check_blocks(const DeckNode& root, std::vector<Fault>& faults);
void check_materials(const DeckNode& root, std::vector<Fault>& faults);

}  // namespace sluice::peridynamics
