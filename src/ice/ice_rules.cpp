// What must hold between the tags of an ICE deck: blocks, materials, initial states.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/deck/format_tags.hpp"
#include "framework/deck/nearest_name.hpp"
#include "framework/deck/rule_tools.hpp"
#include "ice/ice_schema.hpp"

namespace sluice {
namespace {

// Relative difference from which a written pressure counts as contradicting the state.
constexpr double pressure_tolerance = 1e-3;

void fault(std::vector<Fault>& faults, const DeckNode& node, std::string message,
           std::string suggestion = {}) {
  faults.push_back({Severity::error, node.where, std::move(message), std::move(suggestion)});
}

void not_built(std::vector<Fault>& faults, const DeckNode& node, const std::string& what,
               std::string suggestion = {}) {
  fault(faults, node, what + " is known to the format, but not built yet", std::move(suggestion));
  faults.back().not_built = true;
}

void warn(std::vector<Fault>& faults, const DeckNode& node, std::string message,
          std::string suggestion = {}) {
  faults.push_back({Severity::warning, node.where, std::move(message), std::move(suggestion)});
}

bool is_true(const DeckNode* parent, std::string_view name) {
  const DeckNode* child = parent == nullptr ? nullptr : parent->child(name);
  return child != nullptr && child->text == "true";
}

std::vector<std::string> material_names(const DeckNode& root) {
  std::vector<std::string> names;
  for (const DeckNode* material : ice_materials(root)) {
    names.push_back(material->attribute("name").value_or(""));
  }
  return names;
}

// Materials named by index in <save> and <analyze>.
void check_material_indices(const DeckNode& root, int count, std::vector<Fault>& faults) {
  if (count == 0) return;
  const auto check = [&](const DeckNode& node, const char* name) {
    const auto set = parse_index_set(node.attribute(name).value_or(""));
    if (!set) return;
    for (const IndexInterval& interval : *set.value) {
      if (interval.low >= 0 && interval.high < count) continue;
      fault(faults, node,
            fmt::format("<{} {}>: there is no material {}: the deck has {}, counted from 0",
                        node.name, name, interval.low < 0 ? interval.low : interval.high, count));
    }
  };
  if (const DeckNode* archiver = root.child("DataArchiver")) {
    for (const DeckNode* save : archiver->all("save")) check(*save, "material");
  }
  const DeckNode* analysis = root.child("DataAnalysis");
  if (analysis == nullptr) return;
  for (const DeckNode* module : analysis->all("Module")) {
    const DeckNode* variables = module->child("Variables");
    if (variables == nullptr) continue;
    for (const DeckNode* variable : variables->all("analyze")) check(*variable, "matl");
  }
}

// Levels named in <save>; -1 is the finest, -2 the next coarser one.
void check_saved_levels(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* grid = root.child("Grid");
  const DeckNode* archiver = root.child("DataArchiver");
  if (grid == nullptr || archiver == nullptr) return;
  const auto refined = integer_of(root.find("AMR/Regridder"), "max_levels");
  const int count = std::max(static_cast<int>(grid->all("Level").size()), refined.value_or(1));
  for (const DeckNode* save : archiver->all("save")) {
    const auto set = parse_index_set(save->attribute("levels").value_or(""));
    if (!set) continue;
    for (const IndexInterval& interval : *set.value) {
      if (interval.low >= -count && interval.high < count) continue;
      const int missing = interval.high < count ? interval.low : interval.high;
      warn(faults, *save,
           fmt::format("<save levels>: there is no level {}: the deck has {}, counted from 0",
                       missing, count),
           "remove levels to save on all");
    }
  }
}

void check_pressure(const DeckNode& material, const DeckNode& object, std::vector<Fault>& faults) {
  const auto gamma = real_of(&material, "gamma");
  const auto cv = real_of(&material, "specific_heat");
  const auto density = real_of(&object, "density");
  const auto temperature = real_of(&object, "temperature");
  const auto pressure = real_of(&object, "pressure");
  if (!gamma || !cv || !density || !temperature || !pressure) return;
  // A value out of range is a fault of its own, and a pressure from it says nothing.
  if (!(*gamma > 1) || !(*cv > 0) || !(*density > 0) || !(*temperature > 0)) return;
  const double used = (*gamma - 1.0) * *density * *cv * *temperature;
  if (std::abs(used - *pressure) <= pressure_tolerance * std::abs(used)) return;
  warn(faults, *object.child("pressure"),
       fmt::format("<pressure> {:.6g} contradicts density and temperature, which give {:.6g}; it "
                   "is not used",
                   *pressure, used),
       fmt::format("pressure = (gamma - 1) density specific_heat temperature; for {:.6g} write "
                   "temperature {:.6g}",
                   *pressure, *pressure / ((*gamma - 1.0) * *density * *cv)));
}

}  // namespace

void drop_foreign_eos_tags(DeckNode& root, std::vector<Fault>& faults) {
  for (const auto& properties : root.children) {
    DeckNode* ice = properties->name == "MaterialProperties" ? properties->child("ICE") : nullptr;
    if (ice == nullptr) continue;
    for (const auto& material : ice->children) {
      DeckNode* eos = material->child("EOS");
      if (eos == nullptr || eos->attribute("type") != "ideal_gas") continue;
      std::string dropped;
      const auto foreign = [&](const std::unique_ptr<DeckNode>& child) {
        if (child->name == "gas_constant") return false;
        if (!known_to_format("MaterialProperties/ICE/material/EOS", child->name)) return false;
        dropped += (dropped.empty() ? "<" : ", <") + child->name + ">";
        return true;
      };
      std::erase_if(eos->children, foreign);
      if (dropped.empty()) continue;
      warn(faults, *eos,
           fmt::format("{} belong to other equations of state than ideal_gas; dropped", dropped),
           "remove them");
    }
  }
}

void check_ice_blocks(const DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_ice(root)) return;
  if (root.find("CFD/ICE") == nullptr) {
    const DeckNode* fluid = root.child("CFD");
    fault(faults, fluid == nullptr ? root : *fluid, "an ice deck needs the block <CFD><ICE>",
          "see sluice help CFD/ICE");
  }
  if (ice_materials(root).empty()) {
    const DeckNode* properties = root.child("MaterialProperties");
    fault(faults, properties == nullptr ? root : *properties,
          "an ice deck needs a material in <MaterialProperties><ICE>",
          "see sluice help MaterialProperties/ICE/material");
  }
  const DeckNode* constants = root.child("PhysicalConstants");
  if (constants == nullptr) {
    fault(faults, root, "an ice deck needs <PhysicalConstants> with gravity and reference_pressure",
          "see sluice help PhysicalConstants");
  } else if (constants->child("reference_pressure") == nullptr) {
    fault(faults, *constants, "an ice deck needs <reference_pressure> in <PhysicalConstants>");
  }
  const DeckNode* ice = root.find("CFD/ICE");
  if (is_true(ice, "ClampSpecificVolume")) {
    warn(faults, *ice->child("ClampSpecificVolume"),
         "<ClampSpecificVolume> has no effect: there are no clamps", "remove it");
  }
}

void check_ice_materials(const DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_ice(root)) return;
  const auto materials = ice_materials(root);
  if (materials.size() > 1) {
    not_built(faults, *materials[1], "more than one ICE material", "keep one material");
  }
  for (const DeckNode* material : materials) {
    const DeckNode* work = material->child("includeFlowWork");
    if (work != nullptr && work->text == "false") {
      not_built(faults, *work, "<includeFlowWork> false", "write true");
    }
    const auto conductivity = real_of(material, "thermal_conductivity");
    if (conductivity && *conductivity > 0) {
      not_built(faults, *material->child("thermal_conductivity"), "heat conduction",
                "write 0 to run without it");
    }
  }
  check_material_indices(root, static_cast<int>(materials.size()), faults);
  check_saved_levels(root, faults);
  const auto names = material_names(root);
  const auto count = static_cast<int>(materials.size());
  const DeckNode* analysis = root.child("DataAnalysis");
  if (analysis == nullptr || count == 0) return;
  for (const DeckNode* module : analysis->all("Module")) {
    const DeckNode* name = module->child("material");
    if (name != nullptr && std::find(names.begin(), names.end(), name->text) == names.end()) {
      fault(faults, *name, fmt::format("there is no material {}", in_quotes(name->text)),
            suggest_name(name->text, names));
    }
    const auto index = integer_of(module, "materialIndex");
    if (index && *index >= count) {
      fault(faults, *module->child("materialIndex"),
            fmt::format("there is no material {}: the deck has {}, counted from 0", *index, count));
    }
  }
}

void check_ice_gas(const DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_ice(root)) return;
  for (const DeckNode* material : ice_materials(root)) {
    const DeckNode* eos = material->child("EOS");
    const auto gamma = real_of(material, "gamma");
    if (eos == nullptr || eos->attribute("type") != "ideal_gas" || !gamma || *gamma > 1) continue;
    fault(faults, *material->child("gamma"),
          fmt::format("<gamma> {} is out of range for an ideal gas", *gamma),
          "expected real number greater than 1");
  }
}

void check_ice_fill(const DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_ice(root)) return;
  for (const DeckNode* material : ice_materials(root)) {
    const DeckNode* eos = material->child("EOS");
    const bool ideal = eos != nullptr && eos->attribute("type") == "ideal_gas";
    for (const DeckNode* object : material->all("geom_object")) {
      if (ideal) check_pressure(*material, *object, faults);
      const bool has_piece =
          std::any_of(object->children.begin(), object->children.end(),
                      [](const auto& child) { return is_geometry_piece(child->name); });
      if (!has_piece) {
        fault(faults, *object, "<geom_object> has no geometry piece",
              "add a <box>, <sphere>, ...; see sluice help geom_object");
      }
    }
  }
}

}  // namespace sluice
