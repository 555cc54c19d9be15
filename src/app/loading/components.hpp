// The components that a deck may name: a new one is a row of this table.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "framework/deck/schema.hpp"
#include "framework/run/component/component.hpp"
#include "framework/scene/scene.hpp"

namespace sluice {

struct ComponentKind {
  const char* type;                  // <SimulationComponent type>, as the schema spells it
  void (*add_tags)(Schema& schema);  // its part of the schema; null: another's
  // From a deck without faults and its scene, which the component keeps a reference to. Faults that
  // reading finds are added; with errors among them there is no component.
  std::unique_ptr<Component> (*make)(const Deck& deck, const Scene& scene,
                                     std::vector<Fault>& faults);
  // Names of the histories that it keeps; null: none.
  std::vector<std::string> (*histories)(const DeckNode& root) = nullptr;
  bool takes_gaps = false;  // the coarsest level may be other than a rectangular block
};

std::span<const ComponentKind> component_kinds();

// The one that the deck names; null: none of the table.
const ComponentKind* component_kind(const Deck& deck);

}  // namespace sluice
