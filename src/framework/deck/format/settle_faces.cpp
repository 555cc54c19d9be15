// Faces as everybody after this sees them: each place once, with all its conditions, each condition
// with its material.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "framework/deck/faults.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/value_text.hpp"

namespace sluice {
namespace {

// Where a face lies: its attributes in rising order of name, numbers as numbers.
struct Place {
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::string> texts;

  auto operator<=>(const Place&) const = default;
  bool empty() const { return numbers.empty() && texts.empty(); }
};

Place place_of(const DeckNode& face) {
  Place place;
  for (const auto& [name, text] : face.attributes) {
    if (name == "name" || name == "type") continue;
    if (const auto numbers = parse_reals(text)) {
      place.numbers[name] = *numbers.value;
    } else {
      place.texts[name] = collapse_blanks(text);
    }
  }
  return place;
}

std::string side_text(const Place& place) {
  return place.texts.empty()
             ? ""
             : fmt::format(" {}=\"{}\"", place.texts.begin()->first, place.texts.begin()->second);
}

void merge_faces(DeckNode& conditions, std::vector<Fault>& faults) {
  std::map<Place, DeckNode*> known;
  const auto joins_an_earlier_one = [&](const std::unique_ptr<DeckNode>& face) {
    if (face->name != "Face") return false;
    const Place place = place_of(*face);
    if (place.empty()) return false;
    const auto [first, fresh] = known.try_emplace(place, face.get());
    if (fresh) return false;
    add_warning(faults, face->where,
                fmt::format("second <Face{}>; merged with the first at {}", side_text(place),
                            to_string(first->second->where)),
                "write all conditions of a face in one <Face>");
    std::move(face->children.begin(), face->children.end(),
              std::back_inserter(first->second->children));
    return true;
  };
  std::erase_if(conditions.children, joins_an_earlier_one);
}

void give_default_material(DeckNode& conditions) {
  const DeckNode* material = conditions.child("DefaultMaterial");
  if (material == nullptr) return;
  for (const auto& face : conditions.children)
    for (const auto& condition : face->children)
      if (condition->name == "BCType" && !condition->attribute("id") &&
          !condition->attribute("ids"))
        condition->attributes.emplace_back("id", material->text);
}

}  // namespace

void settle_faces(DeckNode& root, std::vector<Fault>& faults) {
  DeckNode* grid = root.child("Grid");
  DeckNode* conditions = grid == nullptr ? nullptr : grid->child("BoundaryConditions");
  if (conditions == nullptr) return;
  merge_faces(*conditions, faults);
  give_default_material(*conditions);
}

}  // namespace sluice
