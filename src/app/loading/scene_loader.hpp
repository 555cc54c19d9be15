// From a deck file to a component that can run: load, check, mean; one place for all commands.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/deck/format/switcher.hpp"
#include "framework/run/component/component.hpp"
#include "framework/scene/scene.hpp"

namespace sluice {

// A component of a switcher behind the first.
struct LaterScene {
  Scene scene;
  std::unique_ptr<Component> component;
};

struct LoadedScene {
  Deck deck;
  Scene scene;
  std::unique_ptr<Component> component;
  // Of a switcher, whose first component is that above: the deck of each, and what comes later.
  std::vector<SubDeck> parts;
  std::vector<std::unique_ptr<LaterScene>> later;
};

// What is wrong with a deck that was read without a fault: as a scene and, where it is not large
// (its levels have at most 250,000 cells), with what a run of it would begin with: the state of its
// cells, what it analyses and saves.
std::vector<Fault> scene_faults(const Deck& deck);

// What becomes of the warnings of a deck: refused are they as errors.
enum class Warnings { shown, hidden, refused };
void refuse_warnings(std::vector<Fault>& faults);

// Prints these warnings as loading does: on rank 0, unless they are hidden; InputError where they
// are refused. Collective.
void tell_warnings(std::vector<Fault> faults, Warnings warnings);

// Prints warnings (on rank 0) and throws InputError listing all errors, one a line, when the deck
// is not good.
std::unique_ptr<LoadedScene> load_scene(const std::string& file,
                                        const std::vector<std::string>& overrides,
                                        const SceneOptions& options,
                                        Warnings warnings = Warnings::shown);

}  // namespace sluice
