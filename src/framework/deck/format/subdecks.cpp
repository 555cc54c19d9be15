// The decks of a switcher's components, each made complete by the deck of the run.
#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/faults.hpp"
#include "framework/deck/format/switcher.hpp"
#include "framework/deck/load_deck.hpp"

namespace sluice {
namespace {

constexpr const char* blocks_of_run[] = {"Meta", "Grid", "DataArchiver"};
// Of <Time>, in all spellings: when the run ends. The rest limits the steps of a component.
constexpr const char* times_of_run[] = {"initTime",
                                        "maxTime",
                                        "max_Timesteps",
                                        "max_Timestep",
                                        "max_iterations",
                                        "max_wall_time",
                                        "end_at_max_time_exactly",
                                        "end_on_max_time_exactly",
                                        "clamp_time_to_output",
                                        "clamp_timesteps_to_output"};

// Children of these names become those that the deck of the run has.
template <std::size_t n>
void take_children(DeckNode& to, const DeckNode& run, const char* const (&names)[n]) {
  const auto is_of_run = [&](const std::unique_ptr<DeckNode>& child) {
    return std::find(std::begin(names), std::end(names), child->name) != std::end(names);
  };
  std::erase_if(to.children, is_of_run);
  for (const auto& child : run.children)
    if (is_of_run(child)) to.children.push_back(copy_of(*child));
}

void complete(DeckNode& root, const DeckNode& run) {
  take_children(root, run, blocks_of_run);
  DeckNode* time = root.child("Time");
  const DeckNode* time_of_run = run.child("Time");
  if (time_of_run == nullptr) return;
  if (time != nullptr)
    take_children(*time, *time_of_run, times_of_run);
  else
    root.children.push_back(copy_of(*time_of_run));
}

// Only solids alone carry all of their state with particles. False: nothing else of the deck is
// worth telling.
bool check_component(const Deck& deck, const DeckNode& part, std::vector<Fault>& faults) {
  const DeckNode* own = deck.root->child("SimulationComponent");
  if (own == nullptr) return true;  // told with the rest of the deck
  std::string type = own->attribute("type").value_or("");
  if (type == "MPM" || type == "IMPM") type = type == "MPM" ? "mpm" : "impm";
  if (type == "switcher") {
    add_error(faults, own->where,
              fmt::format("a switcher inside the switcher of {}", to_string(part.where)),
              "name the decks of its components in the outer switcher");
    return false;
  }
  if (type != "mpm" && type != "impm") {
    add_not_built(faults, own->where, fmt::format("the component '{}' in a switcher", type),
                  "supported in a switcher: mpm, impm");
    return false;
  }
  const DeckNode* named = part.child("SimulationComponent");
  if (named == nullptr || named->attribute("type") == type) return true;
  add_error(faults, named->where,
            fmt::format("<SimulationComponent type=\"{}\">, but the deck of this component says "
                        "'{}' ({})",
                        named->attribute("type").value_or(""), type, to_string(own->where)),
            "name the component of the deck, or another deck");
  return false;
}

Deck read_subdeck(const DeckNode& part, const DeckNode& run, const Schema& schema) {
  Deck deck = read_deck(find_subdeck(part.need("input_file")));
  if (deck.root == nullptr) return deck;
  std::vector<Fault> faults;
  if (!check_component(deck, part, faults)) {
    deck.faults = std::move(faults);
    return deck;
  }
  complete(*deck.root, run);
  return check_deck(std::move(deck), {}, schema);
}

}  // namespace

std::vector<SubDeck> read_subdecks(const DeckNode& root, const Schema& schema) {
  std::vector<SubDeck> parts;
  int after = 0;
  for (const DeckNode* part : root.need("SimulationComponent").all("subcomponent")) {
    SubDeck sub{read_subdeck(*part, root, schema), part->need("input_file").where, after};
    if (const DeckNode* criterion = part->child("SwitchCriteria"))
      after = criterion->integer("timestep");
    parts.push_back(std::move(sub));
  }
  return parts;
}

}  // namespace sluice
