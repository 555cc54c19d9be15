// Short ways to read a deck's values and to collect what is wrong with them.
#include "framework/scene/deck_values.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/value_text.hpp"

namespace sluice {

bool any_error(const std::vector<Fault>& faults) {
  return std::any_of(faults.begin(), faults.end(),
                     [](const Fault& f) { return f.severity == Severity::error; });
}

double real_or(const DeckNode& node, std::string_view child, double fallback) {
  const DeckNode* c = node.child(child);
  return c != nullptr ? c->as_real() : fallback;
}
int integer_or(const DeckNode& node, std::string_view child, int fallback) {
  const DeckNode* c = node.child(child);
  return c != nullptr ? c->as_integer() : fallback;
}
bool boolean_or(const DeckNode& node, std::string_view child, bool fallback) {
  const DeckNode* c = node.child(child);
  return c != nullptr ? c->as_boolean() : fallback;
}
Vec3 vector_or(const DeckNode& node, std::string_view child, Vec3 fallback) {
  const DeckNode* c = node.child(child);
  return c != nullptr ? c->as_vector() : fallback;
}
IntVec3 int_vector_or(const DeckNode& node, std::string_view child, IntVec3 fallback) {
  const DeckNode* c = node.child(child);
  return c != nullptr ? c->as_int_vector() : fallback;
}
std::string text_or(const DeckNode& node, std::string_view child, std::string_view fallback) {
  const DeckNode* c = node.child(child);
  return c != nullptr ? c->text : std::string(fallback);
}

namespace {

template <class T>
std::optional<T> attribute_value(const DeckNode& node, std::string_view name,
                                 ParsedValue<T> (*parse)(std::string_view)) {
  const std::optional<std::string> text = node.attribute(name);
  if (!text) return std::nullopt;
  ParsedValue<T> parsed = parse(*text);
  if (!parsed)
    throw InputError(fmt::format("<{}>: attribute {}: {}", node.name, name, parsed.problem));
  return std::move(parsed.value);
}

}  // namespace

std::optional<double> real_attribute(const DeckNode& node, std::string_view name) {
  return attribute_value<double>(node, name, parse_real);
}
std::optional<int> integer_attribute(const DeckNode& node, std::string_view name) {
  return attribute_value<int>(node, name, parse_integer);
}
bool true_attribute(const DeckNode& node, std::string_view name) {
  return attribute_value<bool>(node, name, parse_boolean).value_or(false);
}

std::optional<Vec3> vector_attribute(const DeckNode& node, std::string_view name) {
  const std::optional<std::vector<double>> numbers =
      attribute_value<std::vector<double>>(node, name, parse_reals);
  if (!numbers) return std::nullopt;
  if (numbers->size() != 3)
    throw InputError(fmt::format("<{}>: attribute {} has {} numbers; expected three, as \"0 0 0\"",
                                 node.name, name, numbers->size()));
  return Vec3{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

}  // namespace sluice
