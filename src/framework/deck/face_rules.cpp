// What must hold for the faces that carry boundary conditions: one shape each, with its numbers.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "framework/deck/faults.hpp"
#include "framework/deck/framework_schema.hpp"
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
    add_error(faults, face.where, "<Face> does not say where it lies",
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
      add_error(faults, condition->where, "<BCType> has the attribute value and the tag <value>",
                "keep one of them");
    }
    if (condition->attribute("id") && condition->attribute("ids")) {
      add_error(faults, condition->where, "<BCType> has both id and ids", "keep one of them");
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
    }
  }
  for (const auto& [side, face] : pieces) {
    if (whole_sides.count(side) > 0) continue;
    add_error(faults, face->where,
              fmt::format("a piece of side {} has conditions, the rest has none", side),
              fmt::format("add <Face side=\"{}\">", side));
  }
}

}  // namespace sluice
