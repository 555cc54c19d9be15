// What must hold for the faces that carry boundary conditions: one shape each, with its numbers.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "framework/deck/faults.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/rule_tools.hpp"

namespace sluice {
namespace {

struct Shape {
  const char* name;
  std::vector<const char*> points;
  std::vector<const char*> lengths;
};

const std::vector<Shape>& shapes() {
  static const std::vector<Shape> all = {
      {"side", {}, {}},
      {"circle", {"origin"}, {"radius"}},
      {"annulus", {"origin"}, {"inner_radius", "outer_radius"}},
      {"ellipse", {"origin"}, {"major_radius", "minor_radius"}},
      {"rectangle", {"lower", "upper"}, {}},
      {"rectangulus", {"inner_lower", "inner_upper", "outer_lower", "outer_upper"}, {}},
  };
  return all;
}

// The side a face lies on; empty after a fault.
std::string side_of(const DeckNode& face, const Shape*& shape, std::vector<Fault>& faults) {
  std::vector<std::string> present;
  std::string side;
  for (const Shape& candidate : shapes()) {
    const auto value = face.attribute(candidate.name);
    if (!value) continue;
    present.emplace_back(candidate.name);
    side = *value;
    shape = &candidate;
  }
  if (present.size() == 1) return side;
  if (present.empty()) {
    add_error(faults, face.where, "<Face> has no position",
              "give one of side, circle, annulus, ellipse, rectangle, rectangulus, as side=\"x-\"");
  } else {
    add_error(faults, face.where,
              fmt::format("<Face> has several shapes: {}", fmt::join(present, ", ")),
              "give each its own <Face>");
  }
  return {};
}

void check_shape(const DeckNode& face, const Shape& shape, std::vector<Fault>& faults) {
  for (const char* name : shape.points) {
    const auto text = face.attribute(name);
    if (!text) {
      add_error(faults, face.where,
                fmt::format("<Face {}> needs the attribute {}", shape.name, name),
                "a point, as \"0.0 0.5 0.0\"");
      continue;
    }
    const auto numbers = parse_reals(*text);
    if (numbers && numbers.value->size() != 3) {
      add_error(
          faults, face.where,
          fmt::format("<Face {}>: {} is not a point of three numbers", name, in_quotes(*text)));
    }
  }
  for (const char* name : shape.lengths) {
    if (!face.attribute(name)) {
      add_error(faults, face.where,
                fmt::format("<Face {}> needs the attribute {}", shape.name, name));
    }
  }
}

void check_conditions(const DeckNode& face, std::vector<Fault>& faults) {
  for (const DeckNode* condition : face.all("BCType")) {
    if (condition->attribute("value") && condition->child("value") != nullptr) {
      add_error(faults, condition->where,
                "<BCType> has both the attribute value and the tag <value>", "keep one of them");
    }
    if (condition->attribute("id") && condition->attribute("ids")) {
      add_error(faults, condition->where, "<BCType> has both id and ids", "keep one of them");
    }
  }
}

// What a condition says, beside the variable and the material that it is for.
bool same_values(const DeckNode& a, const DeckNode& b) {
  const auto kind = a.attribute("var");
  if (kind != b.attribute("var")) return false;
  if (kind == "symmetry" || kind == "computeFromDensity") return true;  // they take no value
  const auto text_of = [](const DeckNode& condition) {
    return collapse_blanks(condition_value(condition).text.value_or(""));
  };
  const std::string one = text_of(a), other = text_of(b);
  if (const auto x = parse_real(one), y = parse_real(other); x && y) return *x.value == *y.value;
  if (const auto x = parse_vector(one), y = parse_vector(other); x && y)
    return *x.value == *y.value;
  return one == other;
}

// "all", the indices, or nothing where the deck does not say it: what messages call them.
std::vector<std::string> materials_of(const DeckNode& condition) {
  const auto id = condition.attribute("id"), ids = condition.attribute("ids");
  if (!id && !ids) return {""};
  const auto list = parse_integers(id ? *id : *ids);
  if (!list) return {collapse_blanks(id ? *id : *ids)};
  std::vector<std::string> names;
  for (const int index : *list.value) names.push_back(std::to_string(index));
  return names;
}

// The first of several conditions for one variable and material is the one that holds. One for a
// single material beside one for all is no repetition: it is the exception.
void check_repetitions(const DeckNode& face, const std::string& face_name,
                       std::vector<Fault>& faults) {
  std::map<std::pair<std::string, std::string>, const DeckNode*> known;
  for (const DeckNode* condition : face.all("BCType")) {
    const std::string label = condition->attribute("label").value_or("");
    for (const std::string& material : materials_of(*condition)) {
      const auto [first, fresh] = known.try_emplace({label, material}, condition);
      if (fresh) continue;
      const DeckNode& before = *first->second;
      const std::string whose = material.empty()    ? ""
                                : material == "all" ? " of all materials"
                                                    : " of material " + material;
      const std::string what =
          fmt::format("second condition for {}{} on {}", label, whose, face_name);
      if (same_values(before, *condition)) {
        add_warning(faults, condition->where,
                    fmt::format("{}; it repeats the first, at {}", what, to_string(before.where)),
                    "remove one of them");
      } else {
        add_error(
            faults, condition->where,
            fmt::format("{}, which differs from the first, at {}", what, to_string(before.where)),
            "keep one of them");
      }
    }
  }
}

}  // namespace

void check_faces(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* grid = root.child("Grid");
  const DeckNode* conditions = grid == nullptr ? nullptr : grid->child("BoundaryConditions");
  if (conditions == nullptr) return;
  const auto periodic = periodic_directions(*grid);
  std::set<std::string> whole_sides;
  std::map<std::string, const DeckNode*> pieces;
  for (const DeckNode* face : conditions->all("Face")) {
    const Shape* shape = nullptr;
    const std::string side = side_of(*face, shape, faults);
    check_conditions(*face, faults);
    const auto at = std::find(std::begin(side_names), std::end(side_names), side);
    if (at == std::end(side_names)) continue;
    check_shape(*face, *shape, faults);
    if (shape == &shapes().front()) {
      whole_sides.insert(side);
    } else {
      pieces.try_emplace(side, face);
    }
    const auto direction = static_cast<std::size_t>(at - std::begin(side_names)) / 2;
    if (periodic[direction]) {
      add_warning(faults, face->where,
                  fmt::format("<Face> on {} has no effect: {} is periodic", side,
                              direction_names[direction]),
                  "remove the face, or set periodic to 0 there");
    } else {
      check_repetitions(*face, fmt::format("{} {}", shape->name, side), faults);
    }
  }
  for (const auto& [side, face] : pieces) {
    if (whole_sides.count(side) > 0) continue;
    add_error(faults, face->where,
              fmt::format("a part of side {} has conditions, the rest has none", side),
              fmt::format("add <Face side=\"{}\">", side));
  }
}

}  // namespace sluice
