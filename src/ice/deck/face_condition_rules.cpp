// Conditions of an ICE deck's boundary against the table of their kinds: that each is for its
// variable, and that the deck gives what it needs.
#include <fmt/format.h>

#include "framework/deck/faults.hpp"
#include "framework/deck/rule_tools.hpp"
#include "ice/conditions/face_conditions.hpp"
#include "ice/deck/schema.hpp"

namespace sluice {
namespace {

void check_condition(const DeckNode& root, const DeckNode& conditions, const DeckNode& condition,
                     std::vector<Fault>& faults) {
  const std::string word = condition.attribute("var").value_or("");
  const std::string label = condition.attribute("label").value_or("");
  const ice::FaceCondition* kind = ice::face_condition(word);
  if (kind == nullptr) return;
  if (!kind->is_for(label))
    add_error(
        faults, condition.where,
        fmt::format("{} is for {}, not for {}", word, fmt::join(kind->variables, ", "), label));
  if (kind->block && conditions.child(kind->block->name) == nullptr)
    add_error(faults, condition.where,
              fmt::format("{} of {} needs the block <{}> in <BoundaryConditions>", word, label,
                          kind->block->name),
              fmt::format("see sluice help Grid/BoundaryConditions/{}", kind->block->name));
  const ConditionValue value = condition_value(condition);
  if (kind->gives_velocity && label == "Velocity" && (!value.text || !parse_vector(*value.text)))
    add_error(faults, value.where,
              fmt::format("{} needs a <value> that is a vector, as [1.0, 0.0, 0.0]", word));
  if (kind->check != nullptr) kind->check(root, condition, faults);
}

}  // namespace

void check_face_conditions(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* conditions = root.find("Grid/BoundaryConditions");
  if (!runs_ice(root) || conditions == nullptr) return;
  for (const DeckNode* face : conditions->all("Face"))
    for (const DeckNode* condition : face->all("BCType"))
      check_condition(root, *conditions, *condition, faults);
  for (const ice::FaceCondition& kind : ice::face_conditions()) {
    if (kind.check_block == nullptr) continue;
    if (const DeckNode* block = conditions->child(kind.block->name))
      kind.check_block(*block, faults);
  }
}

}  // namespace sluice
