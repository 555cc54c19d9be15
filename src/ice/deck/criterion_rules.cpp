// What criteria of refinement may name: cell variables that are functions of the state, materials
// that there are.
#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/faults.hpp"
#include "framework/deck/format_labels.hpp"
#include "framework/deck/nearest_name.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"
#include "ice/deck/schema.hpp"
#include "ice/fluid/labels.hpp"

namespace sluice {
namespace {

bool listed(const std::vector<std::string>& list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

// Cell variables that follow from a state alone.
const std::vector<std::string>& usable_variables() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> found;
    for (const Label label : ice::state_functions()) found.push_back(label.name());
    return found;
  }();
  return names;
}

// The same in every cell as long as one material has constant properties.
bool constant(std::string_view name) {
  const ice::Labels& l = ice::labels();
  for (const Label label :
       {l.volume_fraction, l.gradient_volume_fraction, l.volume_of_cell, l.compressibility_share,
        l.viscosity, l.thermal_conductivity, l.gamma, l.specific_heat})
    if (label.name() == name) return true;
  return false;
}

Fault refusal(const DeckNode& node, std::string_view name) {
  Fault fault{Severity::error, node.where, "",
              "name a cell variable of the state, as rho_CC, press_CC, temp_CC or vel_CC"};
  const std::string in = fmt::format("<{}>: {} ", node.name, name);
  const std::optional<Label> label = find_label(name);
  if (label && label->name().find('.') == std::string::npos) {
    const Centring centring = label->info().centring;
    if (face_direction(centring) >= 0)
      fault.message = in + "is on faces; a refinement criterion needs one value per cell";
    else if (centring == Centring::reduction)
      fault.message =
          in + "is one number per step; a refinement criterion needs one value per cell";
    else if (*label == ice::labels().refine_flag)
      fault.message = in + "is the result of the refinement criteria";
    else
      fault.message =
          in + "exists only within a step; a refinement criterion needs a function of the state";
  } else if (const ForeignLabel* foreign = find_foreign_label(name)) {
    fault.message = fmt::format("<{}>: {}", node.name, refusal_of(*foreign, name));
    fault.not_built = true;
  } else if (listed(ice_field_labels().not_built, name)) {
    fault.message = fmt::format("<{}>: variable {} is known to the format, but not supported yet",
                                node.name, in_quotes(name));
    fault.not_built = true;
  } else {
    fault.message = fmt::format("<{}>: there is no variable {}", node.name, in_quotes(name));
    fault.suggestion = suggest_name(name, usable_variables());
  }
  return fault;
}

void check_variable(const DeckNode& node, std::string_view attribute, int count,
                    std::vector<Fault>& faults) {
  const std::optional<std::string> name = node.attribute(attribute);
  if (!name) return;  // told by the schema
  if (!listed(usable_variables(), *name))
    faults.push_back(refusal(node, *name));
  else if (count < 2 && constant(*name))
    add_warning(
        faults, node.where,
        fmt::format(
            "<{}>: {} is the same in all cells of this deck; the criterion never flags a cell",
            node.name, *name),
        "remove it");
}

void check_material(const DeckNode& node, int count, std::vector<Fault>& faults) {
  const std::string text = node.attribute("matl").value_or("all");
  if (text == "all" || count == 0) return;
  const auto index = parse_integer(text);
  if (index && *index.value >= 0 && *index.value < count) return;
  add_error(faults, node.where,
            fmt::format("<{}>: there is no material {}: the deck has {}, counted from 0", node.name,
                        text, count),
            "write an index or all");
}

}  // namespace

void check_criteria(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* amr = root.child("AMR");
  if (!runs_ice(root) || amr == nullptr) return;
  const auto count = solid_material_count(root) + static_cast<int>(ice_materials(root).size());
  for (const DeckNode* node : amr->all("ErrorEstimate"))
    check_variable(*node, "variable", count, faults);
  for (const DeckNode* node : amr->all("MaterialInterface")) {
    check_material(*node, count, faults);
    if (count < 2)
      add_warning(faults, node->where,
                  "<MaterialInterface> has no effect: a single material has no interfaces",
                  "remove it");
  }
  const DeckNode* list = amr->find("ICE/Refinement_Criteria_Thresholds");
  if (list == nullptr) return;
  for (const DeckNode* node : list->all("Variable")) {
    check_variable(*node, "name", count, faults);
    check_material(*node, count, faults);
  }
}

}  // namespace sluice
