// Materials that a model names.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/deck/deck.hpp"

namespace sluice::models {

// By name or, where none has this name, by index.
std::optional<int> find_material(const std::string& name,
                                 const std::vector<std::string>& materials);

// The material that the child names; a fault lists those that there are.
std::optional<int> check_material(const DeckNode& parent, const char* child,
                                  const std::vector<std::string>& materials,
                                  std::vector<Fault>& faults);

// Of a deck that has been checked.
int read_material(const DeckNode& parent, const char* child,
                  const std::vector<std::string>& materials);

}  // namespace sluice::models
