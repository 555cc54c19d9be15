// The blocks of a deck that belong to solids: MPM, AMR/MPM, MaterialProperties/MPM, PhysicalBC.
#pragma once
#include <string>
#include <vector>

#include "framework/deck/schema.hpp"

namespace sluice::mpm {

// Tags and rules; the framework's own tags must be there already.
void add_mpm_tags(Schema& schema);

// Whether the deck runs solids, as far as can be seen: alone, or with a fluid too.
bool runs_mpm(const DeckNode& root);
// The component sfmpm: all materials have one velocity at a node.
bool runs_single_field(const DeckNode& root);
bool runs_solids(const DeckNode& root);
// Flags of <MPM> for which the midpoint transfer has no form.
inline constexpr const char* without_midpoint[] = {"total_lagrangian", "UsePrescribedDeformation"};
// The <material> nodes of MPM, in index order.
std::vector<const DeckNode*> mpm_materials(const DeckNode& root);

// The blocks, one file each: flag_tags, material_tags, contact_tags, load_tags.
TagSpec flags_tag();       // <MPM>
TagSpec refinement_tag();  // <AMR><MPM>
TagSpec material_tag();
TagSpec contact_tag();
TagSpec thermal_contact_tag();
TagSpec diffusion_interface_tag();
TagSpec cohesive_zone_tag();
TagSpec loads_tag();  // <PhysicalBC>

// Changes before checking: what solids never read is dropped with a warning that names its line.
void read_old_words(DeckNode& root, std::vector<Fault>& faults);
void drop_stray_blocks(DeckNode& root, std::vector<Fault>& faults);
void drop_stray_flags(DeckNode& root, std::vector<Fault>& faults);
void drop_stray_state(DeckNode& root, std::vector<Fault>& faults);
// p.X+ is what a step makes of p.X: what is saved is that in any case.
void rename_new_labels(DeckNode& root, std::vector<Fault>& faults);

// Rules over several tags; each does nothing when no solids run.
void check_solid_blocks(const DeckNode& root, std::vector<Fault>& faults);
void check_flags(const DeckNode& root, std::vector<Fault>& faults);
void check_transfer(const DeckNode& root, std::vector<Fault>& faults);
void check_solid_materials(const DeckNode& root, std::vector<Fault>& faults);
void check_contacts(const DeckNode& root, std::vector<Fault>& faults);
void check_cohesive_zones(const DeckNode& root, std::vector<Fault>& faults);
void check_grains(const DeckNode& root, std::vector<Fault>& faults);
void check_loads(const DeckNode& root, std::vector<Fault>& faults);
void check_solid_faces(const DeckNode& root, std::vector<Fault>& faults);

}  // namespace sluice::mpm
