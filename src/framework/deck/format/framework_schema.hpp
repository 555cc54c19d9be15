// The blocks of a deck that belong to the framework, whatever component runs.
#pragma once
#include "framework/deck/schema.hpp"

namespace sluice {

// A component as decks name it.
struct ComponentWord {
  std::string word;                    // <SimulationComponent type>
  std::vector<std::string> spellings;  // other spellings of it
  bool in_turn = false;                // whether a switcher can run it
};

// All of the blocks below, with their rules. `components`: those that there are; none: the schema
// takes any word for one.
void add_framework_tags(Schema& schema, const std::vector<ComponentWord>& components = {});

// Meta, SimulationComponent, Time, PhysicalConstants, ...
void add_run_tags(Schema& schema, const std::vector<ComponentWord>& components);
void add_output_tags(Schema& schema);      // DataArchiver
void add_geometry_tags(Schema& schema);    // the group "geometry_piece"
void add_grid_tags(Schema& schema);        // Grid with its BoundaryConditions and Levels
void add_refinement_tags(Schema& schema);  // AMR, LoadBalancer
void add_analysis_tags(Schema& schema);    // DataAnalysis
// The labels that the modules of a deck make and that can be saved.
std::vector<std::string> labels_of_analyses(const DeckNode& root);

// Rules over several tags; each reads the tree and takes nothing for granted.
void check_time(const DeckNode& root, std::vector<Fault>& faults);
void check_boxes(const DeckNode& root, std::vector<Fault>& faults);
void check_periodicity(const DeckNode& root, std::vector<Fault>& faults);
void check_faces(const DeckNode& root, std::vector<Fault>& faults);
void check_refinement(const DeckNode& root, std::vector<Fault>& faults);
void check_checkpoint(const DeckNode& root, std::vector<Fault>& faults);
void check_analyses(const DeckNode& root, std::vector<Fault>& faults);
void check_saves(const DeckNode& root, std::vector<Fault>& faults);
void check_filebase(const DeckNode& root, std::vector<Fault>& faults);
void check_pieces(const DeckNode& root, std::vector<Fault>& faults);

// What a deck leaves to be told elsewhere.
void fill_in_from_other_decks(DeckNode& root, std::vector<Fault>& faults);
// Names of materials in <Models> and <DataAnalysis>, written in other capitals.
void settle_material_names(DeckNode& root, std::vector<Fault>& faults);

// Each face once, with all its conditions; each condition with its material.
void settle_faces(DeckNode& root, std::vector<Fault>& faults);
// A piece that names another by its label becomes a copy of it.
void resolve_piece_labels(DeckNode& root, std::vector<Fault>& faults);

// Whether a tag of this name is a geometry piece or an operator that joins pieces.
bool is_geometry_piece(std::string_view name);

// Labels that <analyze> and its like may name. A label that is neither built nor known to the
// format is refused with the nearest valid one.
struct FieldLabels {
  std::vector<std::string> built;
  std::vector<std::string> not_built;  // known to the format
};
DeckRule check_analysed_labels(FieldLabels labels);
// What is saved must be known to somebody: to `known`, or to the format. What a run does not
// compute is told when its component is there.
DeckRule check_saved_labels(std::function<std::vector<std::string>(const DeckNode& root)> known);

}  // namespace sluice
