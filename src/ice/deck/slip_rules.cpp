// Walls with slip in an ICE deck: that they are walls, of one gas, with a temperature that counts.
#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/faults.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"
#include "ice/conditions/face_conditions.hpp"
#include "ice/deck/schema.hpp"
#include "models/models.hpp"

namespace sluice {
namespace {

using Conditions = std::vector<const DeckNode*>;

// A face of the deck with conditions of slip.
struct SlipFace {
  std::string side;
  std::size_t normal = 0;
  Conditions velocity, temperature;  // of kind slip or creep
  const DeckNode* any_velocity = nullptr;
};

SlipFace slip_face(const DeckNode& face) {
  SlipFace found;
  found.side = side_of_face(face);
  const auto at = std::find(std::begin(side_names), std::end(side_names), found.side);
  if (at == std::end(side_names)) return {};  // told by other rules
  found.normal = static_cast<std::size_t>(at - std::begin(side_names)) / 2;
  for (const DeckNode* condition : face.all("BCType")) {
    const std::string kind = condition->attribute("var").value_or("");
    const std::string label = condition->attribute("label").value_or("");
    if (label == "Velocity" && found.any_velocity == nullptr) found.any_velocity = condition;
    const ice::FaceCondition* row = ice::face_condition(kind);
    if (row == nullptr || !row->rarefied) continue;
    if (label == "Velocity") found.velocity.push_back(condition);
    if (label == "Temperature") found.temperature.push_back(condition);
  }
  return found;
}

class SlipRules {
 public:
  SlipRules(const DeckNode& root, std::vector<Fault>& faults) : faults_(faults) {
    for (const DeckNode* material : ice_materials(root)) materials_.push_back(material);
    using models::Coefficient;
    conductivity_ = largest(root, "thermal_conductivity", Coefficient::conductivity);
    viscosity_ = largest(root, "dynamic_viscosity", Coefficient::viscosity);
    for (const DeckNode* material : materials_)
      if (const DeckNode* laws = material->child("dynamicViscosityModels"))
        for (const DeckNode* law : laws->all("Model"))
          viscosity_ = std::max(viscosity_, real_of(law, "a").value_or(0.0));  // Sutherland's
  }

  void check(const DeckNode& face) {
    const SlipFace slip = slip_face(face);
    for (const Conditions* list : {&slip.velocity, &slip.temperature})
      for (const DeckNode* condition : *list) check_gas(*condition);
    for (const DeckNode* condition : slip.velocity) check_velocity(slip, *condition);
    for (const DeckNode* condition : slip.temperature) check_temperature(slip, *condition);
  }

 private:
  double largest(const DeckNode& root, std::string_view tag, models::Coefficient of_model) const {
    double value = 0;
    if (const DeckNode* models = root.child("Models"))
      for (const DeckNode* model : models->all("Model"))
        if (const auto own = models::own_coefficient(*model, of_model)) return *own;
    for (const DeckNode* material : materials_)
      value = std::max(value, real_of(material, tag).value_or(0.0));
    return value;
  }

  void check_gas(const DeckNode& condition) {
    if (told_of_gas_ || materials_.empty()) return;
    const std::string kind = condition.attribute("var").value_or("");
    const DeckNode* eos = materials_.front()->child("EOS");
    const std::string law = eos == nullptr ? "" : eos->attribute("type").value_or("");
    told_of_gas_ = true;
    if (materials_.size() > 1) {
      add_not_built(faults_, condition.where, fmt::format("{} with several materials", kind),
                    "write Dirichlet");
    } else if (!law.empty() && law != "ideal_gas") {
      add_error(faults_, condition.where,
                fmt::format("{} needs the mean free path of a gas, and {} has none", kind, law),
                "write Dirichlet, or take ideal_gas");
    } else {
      told_of_gas_ = false;
    }
  }

  void check_velocity(const SlipFace& face, const DeckNode& condition) {
    const auto [text, where] = condition_value(condition);
    const std::string kind = condition.attribute("var").value_or("");
    const auto velocity = parse_vector(text.value_or(""));
    if (!velocity) {
      add_error(faults_, where,
                fmt::format(
                    "{} of Velocity needs the velocity of the wall as <value>, as [0.0, 0.0, 0.0]",
                    kind));
      return;
    }
    const auto normal = static_cast<int>(face.normal);
    if ((*velocity.value)[normal] != 0)
      add_error(
          faults_, where,
          fmt::format("{} on side {} has a velocity of {:g} across the wall; nothing passes a wall",
                      kind, face.side, (*velocity.value)[normal]),
          fmt::format("write 0 for {}, or Dirichlet for an inlet", direction_names[face.normal]));
    if (viscosity_ > 0 || told_of_viscosity_) return;
    told_of_viscosity_ = true;
    add_warning(faults_, condition.where,
                fmt::format("{} of Velocity without viscosity: the wall exerts no friction", kind),
                "give the material a <dynamic_viscosity>, or write FreeSlipWall");
  }

  void check_temperature(const SlipFace& face, const DeckNode& condition) {
    const auto [text, where] = condition_value(condition);
    const auto number = parse_real(text.value_or(""));
    if (!number) {
      add_error(faults_, where,
                fmt::format("slip of Temperature needs the temperature of the wall as <value>"));
    } else if (*number.value < 0 || (*number.value == 0 && conductivity_ > 0)) {
      add_error(
          faults_, where,
          fmt::format("slip of Temperature on side {}: the wall has {:g} K; it must be above 0",
                      face.side, *number.value));
    } else if (*number.value == 0 && !told_adiabatic_) {
      told_adiabatic_ = true;
      add_warning(faults_, where,
                  "slip of Temperature with 0 K and no heat conduction: walls are adiabatic",
                  "write Neumann with 0, or give the material a <thermal_conductivity>");
    }
    if (face.any_velocity != nullptr && !is_wall(face, *face.any_velocity))
      add_error(
          faults_, condition.where,
          fmt::format("slip of Temperature on side {}, which is not a wall: its Velocity is {}",
                      face.side, face.any_velocity->attribute("var").value_or("missing")),
          "set Velocity to slip, creep, or a Dirichlet value without a component normal to "
          "the side");
  }

  static bool is_wall(const SlipFace& face, const DeckNode& condition) {
    const std::string kind = condition.attribute("var").value_or("");
    const auto velocity = parse_vector(condition_value(condition).text.value_or(""));
    if (kind == "Dirichlet")
      return velocity && (*velocity.value)[static_cast<int>(face.normal)] == 0;
    const ice::FaceCondition* row = ice::face_condition(kind);
    return row != nullptr && row->wall;
  }

  std::vector<Fault>& faults_;
  Conditions materials_;
  double conductivity_ = 0, viscosity_ = 0;
  bool told_of_gas_ = false, told_of_viscosity_ = false, told_adiabatic_ = false;
};

}  // namespace

void check_slip_conditions(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* conditions = root.find("Grid/BoundaryConditions");
  if (!runs_ice(root) || conditions == nullptr) return;
  SlipRules rules(root, faults);
  for (const DeckNode* face : conditions->all("Face")) rules.check(*face);
}

}  // namespace sluice
