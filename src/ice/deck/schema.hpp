// The blocks of a deck that belong to ICE: CFD, AMR/ICE, MaterialProperties/ICE, exchange.
#pragma once
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/schema.hpp"

namespace sluice {

// Tags and rules; the framework's own tags must be there already.
void add_ice_tags(Schema& schema);

// Fields that an ICE run can analyse; what stands under not_built is refused by name.
FieldLabels ice_field_labels();

// Rules over several tags of an ICE deck; each does nothing when another component runs.
void check_ice_blocks(const DeckNode& root, std::vector<Fault>& faults);
void check_ice_materials(const DeckNode& root, std::vector<Fault>& faults);
void check_ice_fluids(const DeckNode& root, std::vector<Fault>& faults);
void check_ice_fill(const DeckNode& root, std::vector<Fault>& faults);
void check_ice_conditions(const DeckNode& root, std::vector<Fault>& faults);
void check_ice_coverage(const DeckNode& root, std::vector<Fault>& faults);
// States of sides that contradict themselves, and weight that nothing carries.
void check_ice_states(const DeckNode& root, std::vector<Fault>& faults);
// What kinds of conditions are for, and what they need.
void check_face_conditions(const DeckNode& root, std::vector<Fault>& faults);
void check_slip_conditions(const DeckNode& root, std::vector<Fault>& faults);
void check_criteria(const DeckNode& root, std::vector<Fault>& faults);  // of refinement
void check_ice_models(const DeckNode& root, std::vector<Fault>& faults);
void check_ice_labels(const DeckNode& root, std::vector<Fault>& faults);  // what is analysed

// Tags of other equations of state inside <EOS> are dropped with one warning.
void drop_foreign_eos_tags(DeckNode& root, std::vector<Fault>& faults);

// Whether a condition of a side is for this material. The pressure is common to all: whatever its
// index.
bool applies_to(const DeckNode& condition, int material);

// Whether the deck runs ICE, as far as can be seen.
bool runs_ice(const DeckNode& root);
// Materials of solids in the same deck: they come before those of ICE in all numbering.
int solid_material_count(const DeckNode& root);
std::vector<std::string> names_of_solids(const DeckNode& root);
// The <material> nodes of ICE, in index order.
std::vector<const DeckNode*> ice_materials(const DeckNode& root);

}  // namespace sluice
