// The tags of the framework and of all components put together.
#include "app/loading/sluice_schema.hpp"

#include "app/loading/components.hpp"
#include "app/loading/exact_solution_tag.hpp"
#include "framework/base/error.hpp"
#include "framework/deck/faults.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/load_deck.hpp"
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

// What decks leave to their component.
void complete_for_component(DeckNode& root, std::vector<Fault>& faults) {
  const ComponentKind* kind = component_kind(root);
  if (kind != nullptr && kind->complete != nullptr) kind->complete(root, faults);
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
  add_framework_tags(schema, component_words());
  solve::add_solver_tag(schema);
  for (const ComponentKind& kind : component_kinds())
    if (kind.add_tags != nullptr) kind.add_tags(schema);
  describe_exact_solution(schema);
  schema.rewrites.emplace_back(complete_for_component);
  schema.rules.emplace_back(check_labels);
  return schema;
}

Deck load_good_deck(const std::string& file, const std::vector<std::string>& overrides) {
  Deck deck = load_deck(file, overrides, sluice_schema());
  if (deck.good()) return deck;
  std::string faults;
  for (const Fault& fault : deck.faults)
    if (fault.severity == Severity::error)
      faults += (faults.empty() ? "" : "\n") + to_string(fault);
  throw InputError(faults);
}

}  // namespace sluice
