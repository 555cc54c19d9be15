// The components that a deck may name: a new one is a row of this table.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "framework/deck/format/framework_schema.hpp"
#include "framework/run/component/component.hpp"
#include "framework/scene/scene.hpp"

namespace sluice {

struct ComponentKind {
  const char* type = "";                    // <SimulationComponent type>
  std::vector<const char*> spellings = {};  // other spellings of it
  // Its part of the schema; null: another row's.
  void (*add_tags)(Schema& schema) = nullptr;
  // From a deck without faults and its scene, which the component keeps a reference to. Faults that
  // reading finds are added; with errors among them there is no component.
  std::unique_ptr<Component> (*make)(const Deck& deck, const Scene& scene,
                                     std::vector<Fault>& faults) = nullptr;
  // Names of the histories that it keeps; null: none.
  std::vector<std::string> (*histories)(const DeckNode& root) = nullptr;
  // Declares its labels, for the page of labels and the words of <save>; null: another row does.
  void (*declare_labels)() = nullptr;
  bool takes_gaps = false;  // the coarsest level may be other than a rectangular block
  bool in_turn = false;     // whether a switcher can run it
  // What decks of it leave to the component is written into them, with a warning; null: nothing.
  void (*complete)(DeckNode& root, std::vector<Fault>& faults) = nullptr;
};

std::span<const ComponentKind> component_kinds();
// The words of decks for them.
std::vector<ComponentWord> component_words();
// Declares the labels of the framework and of all components.
void declare_all_labels();

// The one that the deck names; null: none of the table.
const ComponentKind* component_kind(const DeckNode& root);

}  // namespace sluice
