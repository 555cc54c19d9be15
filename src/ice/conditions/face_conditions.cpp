#include "ice/conditions/face_conditions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/base/error.hpp"
#include "ice/conditions/inlet_profile.hpp"
#include "ice/conditions/sine.hpp"
#include "ice/conditions/travelling_vortices.hpp"

namespace sluice::ice {

bool FaceCondition::is_for(std::string_view variable) const {
  return variables.empty() ||
         std::find(variables.begin(), variables.end(), variable) != variables.end();
}

const std::vector<FaceCondition>& face_conditions() {
  static const std::vector<FaceCondition> all = {
      {.word = "Dirichlet"},
      {.word = "Neumann"},
      {.word = "symmetry", .wall = true},
      {.word = "FreeSlipWall", .variables = {"Velocity"}, .wall = true},
      {.word = "computeFromDensity", .variables = {"SpecificVol"}},
      open_face_condition(),
      sine_condition(),
      power_law_condition(),
      log_law_condition(),
      slip_condition(),
      creep_condition(),
      travelling_vortices_condition(),
  };
  return all;
}

const FaceCondition* face_condition(std::string_view word) {
  for (const FaceCondition& c : face_conditions())
    if (c.word == word) return &c;
  return nullptr;
}

std::string known_face_conditions() {
  std::string text;
  const auto& all = face_conditions();
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (n > 0) text += n + 1 < all.size() ? ", " : " and ";
    text += all[n].word;
  }
  return text;
}

void throw_missing_block(const Condition& condition, std::string_view block) {
  throw InputError(fmt::format("{}: {} of {} needs the block <{}> in <BoundaryConditions>",
                               to_string(condition.where), condition.kind_name, condition.variable,
                               block));
}

void apply_flow(const Condition& c, int /*normal*/, const FlowConditions& settings,
                GhostRule& rule) {
  const std::shared_ptr<const PrescribedFlow> flow = settings.flow(c.kind_name);
  if (flow == nullptr) {
    const FaceCondition* kind = face_condition(c.kind_name);
    if (kind != nullptr && kind->block) throw_missing_block(c, kind->block->name);
    throw InputError(fmt::format("{}: {} of {}: the deck does not define this prescribed flow",
                                 to_string(c.where), c.kind_name, c.variable));
  }
  if (c.variable == "Pressure") rule.pressure_flow = flow;
  if (c.variable != "Velocity") return;
  rule.velocity_kind = GhostRule::Velocity::flow;
  rule.velocity_flow = flow;
}

std::shared_ptr<const PrescribedFlow> FlowConditions::flow(const std::string& kind) const {
  for (const Flow& f : flows)
    if (f.kind == kind) return f.flow;
  return nullptr;
}

FlowConditions read_flow_conditions(const DeckNode& root) {
  FlowConditions c;
  const DeckNode* conditions = root.find("Grid/BoundaryConditions");
  for (const FaceCondition& kind : face_conditions()) {
    if (kind.read_flow != nullptr)
      if (auto flow = kind.read_flow(root)) c.flows.push_back({std::string(kind.word), flow});
    if (kind.read_settings == nullptr || conditions == nullptr) continue;
    if (const DeckNode* block = conditions->child(kind.block->name)) kind.read_settings(*block, c);
  }
  return c;
}

}  // namespace sluice::ice
