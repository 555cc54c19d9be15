#include "ice/conditions/inlet_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/deck/faults.hpp"
#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "ice/conditions/face_conditions.hpp"

namespace sluice::ice {

double PowerLawFlow::share(const GhostPlace& at) const {
  const double whole = profile_.height.value_or(at.domain_size[profile_.vertical]);
  return std::pow(std::clamp(at.height[profile_.vertical] / whole, 0.0, 1.0), profile_.exponent);
}

double LogLawFlow::share(const GhostPlace& at) const {
  const double h = at.height[profile_.vertical];
  return std::max(0.0, std::log(h / profile_.roughness)) / profile_.von_karman;
}

namespace {

TagSpec profile_tag() {
  return tag("inletVelocity", "conditions of kind powerLawProfile and logLawProfile")
      .attribute(
          attribute("type", "accepted without effect: the kind of each condition determines it")
              .text())
      .with_children(
          {tag("verticalDirection", "direction of the height, from the low side of the domain")
               .integer()
               .at_least(0)
               .at_most(2)
               .by_default("1"),
           tag("exponent", "power law: value times min(height/maxHeight, 1)^exponent")
               .real()
               .at_least(0),
           tag("maxHeight", "height of the profile; absent: height of the domain")
               .real()
               .above(0)
               .unit("length"),
           tag("roughness", "log law: value times ln(height/roughness)/vonKarmanConstant")
               .real()
               .above(0)
               .unit("length"),
           tag("vonKarmanConstant", "von Karman constant of the log law")
               .real()
               .above(0)
               .by_default("0.4"),
           tag("material", "accepted without effect").text()});
}

const DeckNode* profile_of(const DeckNode& root) {
  return root.find("Grid/BoundaryConditions/inletVelocity");
}

// `wanted`: the parameter without which the law says nothing.
void check_profile(const DeckNode& root, const DeckNode& condition, const char* wanted,
                   std::vector<Fault>& faults) {
  const DeckNode* profile = profile_of(root);
  if (profile != nullptr && profile->child(wanted) == nullptr)
    add_error(faults, profile->where,
              fmt::format("a {} needs <{}>", condition.attribute("var").value_or(""), wanted));
}

template <class Flow>
std::shared_ptr<const PrescribedFlow> read_profile(const DeckNode& root) {
  const DeckNode* node = profile_of(root);
  if (node == nullptr) return nullptr;
  InletProfile s;
  s.vertical = integer_or(*node, "verticalDirection", s.vertical);
  s.exponent = real_or(*node, "exponent", s.exponent);
  if (const DeckNode* height = node->child("maxHeight")) s.height = height->as_real();
  s.roughness = real_or(*node, "roughness", s.roughness);
  s.von_karman = real_or(*node, "vonKarmanConstant", s.von_karman);
  return std::make_shared<Flow>(s);
}

}  // namespace

FaceCondition power_law_condition() {
  return {.word = "powerLawProfile",
          .variables = {"Velocity"},
          .block = profile_tag(),
          .check =
              [](const DeckNode& root, const DeckNode& condition, std::vector<Fault>& faults) {
                check_profile(root, condition, "exponent", faults);
              },
          .gives_velocity = true,
          .read_flow = read_profile<PowerLawFlow>,
          .apply = apply_flow};
}

FaceCondition log_law_condition() {
  return {.word = "logLawProfile",
          .variables = {"Velocity"},
          .block = profile_tag(),
          .check =
              [](const DeckNode& root, const DeckNode& condition, std::vector<Fault>& faults) {
                check_profile(root, condition, "roughness", faults);
              },
          .gives_velocity = true,
          .read_flow = read_profile<LogLawFlow>,
          .apply = apply_flow};
}

}  // namespace sluice::ice
