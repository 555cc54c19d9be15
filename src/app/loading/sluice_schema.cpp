// The tags of the framework and of all components put together.
#include "app/loading/sluice_schema.hpp"

#include "app/loading/components.hpp"
#include "app/loading/exact_solution_tag.hpp"
#include "app/loading/label_reference.hpp"
#include "framework/deck/faults.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/field/label.hpp"
#include "framework/solve/solver_tags.hpp"
#include "models/models.hpp"

namespace sluice {
namespace {

// Of any component, and of the models of this deck.
std::vector<std::string> labels_for(const DeckNode& root) {
  std::vector<std::string> names = models::save_labels(root);
  for (const Label label : all_labels()) names.push_back(label.name());
  return names;
}

std::unique_ptr<DeckNode> make_node(const char* name, const Location& where, const char* text) {
  auto node = std::make_unique<DeckNode>();
  node->name = name;
  node->text = text;
  node->where = where;
  return node;
}

// Decks of poisson3 leave it to the component that its levels step together.
void step_levels_together(DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* component = root.child("SimulationComponent");
  const DeckNode* grid = root.child("Grid");
  if (component == nullptr || component->attribute("type") != "poisson3" || grid == nullptr ||
      grid->all("Level").size() < 2)
    return;
  if (root.child("AMR") == nullptr) root.children.push_back(make_node("AMR", component->where, ""));
  DeckNode& amr = *root.child("AMR");
  if (amr.child("useLockStep") != nullptr) return;
  amr.children.push_back(make_node("useLockStep", amr.where, "true"));
  add_warning(faults, amr.where, "no <useLockStep> in <AMR>: the levels of poisson3 step together");
}

void check_labels(const DeckNode& root, std::vector<Fault>& faults) {
  if (models::all_built(root)) check_saved_labels(labels_for)(root, faults);
}

}  // namespace

Schema sluice_schema() {
  // Once: the component that a deck makes afterwards claims names, and the last claim holds.
  static const bool declared = (declare_all_labels(), true);
  (void)declared;
  Schema schema;
  add_framework_tags(schema);
  solve::add_solver_tag(schema);
  for (const ComponentKind& kind : component_kinds())
    if (kind.add_tags != nullptr) kind.add_tags(schema);
  describe_exact_solution(schema);
  schema.rewrites.emplace_back(step_levels_together);
  schema.rules.emplace_back(check_labels);
  return schema;
}

}  // namespace sluice
