// Short ways to read a deck's values, in the units that decks have, and to collect what is wrong
// with them.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/deck/deck.hpp"
#include "framework/deck/faults.hpp"

namespace sluice {

bool any_error(const std::vector<Fault>& faults);

// Runs f; an InputError that it throws becomes a fault at `where`.
template <class F>
void collect(std::vector<Fault>& faults, const Location& where, F&& f) {
  try {
    f();
  } catch (const InputError& e) {
    add_error(faults, where, e.what());
  }
}

// Value of a child, or the fallback when it is neither written nor defaulted.
double real_or(const DeckNode& node, std::string_view child, double fallback);
int integer_or(const DeckNode& node, std::string_view child, int fallback);
bool boolean_or(const DeckNode& node, std::string_view child, bool fallback);
Vec3 vector_or(const DeckNode& node, std::string_view child, Vec3 fallback);
IntVec3 int_vector_or(const DeckNode& node, std::string_view child, IntVec3 fallback);
std::string text_or(const DeckNode& node, std::string_view child, std::string_view fallback);

// Value of an attribute. InputError names the attribute and what is wrong with it.
std::optional<double> real_attribute(const DeckNode& node, std::string_view name);
std::optional<int> integer_attribute(const DeckNode& node, std::string_view name);
bool true_attribute(const DeckNode& node, std::string_view name);  // present and "true"
// Three numbers, separated by blanks or commas.
std::optional<Vec3> vector_attribute(const DeckNode& node, std::string_view name);

}  // namespace sluice
