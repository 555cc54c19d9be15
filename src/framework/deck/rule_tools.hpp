// Reading values in rules, on trees that may be faulty: what cannot be read is simply absent.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "framework/deck/deck.hpp"
#include "framework/deck/value_text.hpp"

namespace sluice {

template <class T>
std::optional<T> parsed_child(const DeckNode* parent, std::string_view name,
                              ParsedValue<T> (*parse)(std::string_view)) {
  const DeckNode* child = parent == nullptr ? nullptr : parent->child(name);
  return child == nullptr ? std::nullopt : parse(child->text).value;
}

inline std::optional<double> real_of(const DeckNode* parent, std::string_view name) {
  return parsed_child<double>(parent, name, parse_real);
}
inline std::optional<int> integer_of(const DeckNode* parent, std::string_view name) {
  return parsed_child<int>(parent, name, parse_integer);
}
inline std::optional<Vec3> vector_of(const DeckNode* parent, std::string_view name) {
  return parsed_child<Vec3>(parent, name, parse_vector);
}
inline std::optional<IntVec3> int_vector_of(const DeckNode* parent, std::string_view name) {
  return parsed_child<IntVec3>(parent, name, parse_int_vector);
}

inline bool is_true(const DeckNode* parent, std::string_view name) {
  const DeckNode* child = parent == nullptr ? nullptr : parent->child(name);
  return child != nullptr && child->text == "true";
}

// What <periodic> of the first level of a <Grid> says.
inline std::array<bool, 3> periodic_directions(const DeckNode& grid) {
  const auto levels = grid.all("Level");
  const auto flags = levels.empty() ? std::nullopt : int_vector_of(levels[0], "periodic");
  if (!flags) return {};
  return {flags->x != 0, flags->y != 0, flags->z != 0};
}

// What a <BCType> gives as its value, a tag or an attribute; `where`: the line of messages.
struct ConditionValue {
  std::optional<std::string> text;
  Location where;
};

inline ConditionValue condition_value(const DeckNode& condition) {
  if (const DeckNode* tag = condition.child("value")) return {tag->text, tag->where};
  return {condition.attribute("value"), condition.where};
}

// Attributes of a <Face> that give its shape; their values are the side that it lies on.
inline constexpr std::array<std::string_view, 6> face_shapes = {
    "side", "circle", "annulus", "ellipse", "rectangle", "rectangulus"};

// "x-" of a side, a circle and so on; empty where the <Face> gives none.
inline std::string side_of_face(const DeckNode& face) {
  for (const std::string_view shape : face_shapes)
    if (const auto side = face.attribute(shape)) return *side;
  return "";
}

inline constexpr std::string_view direction_names[3] = {"x", "y", "z"};
inline constexpr std::string_view side_names[6] = {"x-", "x+", "y-", "y+", "z-", "z+"};

}  // namespace sluice
