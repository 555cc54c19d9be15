// What must hold between the tags of an ICE deck: blocks, materials, initial states.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "framework/deck/faults.hpp"
#include "framework/deck/format_tags.hpp"
#include "framework/deck/nearest_name.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"
#include "ice/deck/fluid_laws.hpp"
#include "ice/deck/ice_scene.hpp"
#include "ice/deck/mixed_gas_rules.hpp"
#include "ice/deck/read_fluid.hpp"
#include "ice/deck/schema.hpp"
#include "ice/deck/scheme.hpp"
#include "ice/fluid/material_set.hpp"
#include "models/models.hpp"

namespace sluice {
namespace {

std::vector<std::string> material_names(const DeckNode& root) {
  std::vector<std::string> names;
  for (const DeckNode* material : ice_materials(root)) {
    names.push_back(material->attribute("name").value_or(""));
  }
  return names;
}

// Models, analyses and <save> find materials by name.
void check_names(const std::vector<const DeckNode*>& materials, std::vector<Fault>& faults) {
  std::map<std::string, const DeckNode*> known;
  for (const DeckNode* material : materials) {
    const std::string name = material->attribute("name").value_or("");
    if (name.empty()) continue;
    const auto [at, fresh] = known.emplace(name, material);
    if (!fresh)
      add_error(faults, material->where,
                fmt::format("a second material {}; the first is at {}", in_quotes(name),
                            to_string(at->second->where)),
                "give each a different name");
  }
}

// Under gravity the pressure at the start balances the weight of one material: of which one.
void check_surrounding(const DeckNode& root, const std::vector<const DeckNode*>& materials,
                       std::vector<Fault>& faults) {
  std::vector<const DeckNode*> marked;
  for (const DeckNode* material : materials)
    if (is_true(material, "isSurroundingMatl")) marked.push_back(material);
  if (marked.size() > 1)
    add_error(faults, marked[1]->child("isSurroundingMatl")->where,
              fmt::format("<isSurroundingMatl> is true for {} materials; it may be true for one",
                          marked.size()),
              "write false for the others");
  const auto gravity = vector_of(root.child("PhysicalConstants"), "gravity");
  const DeckNode* ice = root.find("CFD/ICE");
  const DeckNode* balanced = ice == nullptr ? nullptr : ice->child("applyHydrostaticPressure");
  const bool off = balanced != nullptr && balanced->text == "false";
  if (materials.size() < 2 || !marked.empty() || !gravity || *gravity == Vec3{} || off) return;
  add_error(
      faults, root.find("PhysicalConstants/gravity")->where,
      "<gravity> is not zero, and no material is marked to determine the hydrostatic pressure",
      "write <isSurroundingMatl>true</isSurroundingMatl> in one material, or "
      "<applyHydrostaticPressure>false</applyHydrostaticPressure>");
}

// Materials named by index in <save> and <analyze>.
void check_material_indices(const DeckNode& root, int count, std::vector<Fault>& faults) {
  if (count == 0) return;
  const auto check = [&](const DeckNode& node, const char* name) {
    const auto set = parse_index_set(node.attribute(name).value_or(""));
    if (!set) return;
    for (const IndexInterval& interval : *set.value) {
      if (interval.low >= 0 && interval.high < count) continue;
      const std::string fault =
          fmt::format("<{} {}>: there is no material {}: the deck has {}, counted from 0",
                      node.name, name, interval.low < 0 ? interval.low : interval.high, count);
      // Public decks with solids save of materials that they once had.
      if (solid_material_count(root) > 0 && interval.low >= 0)
        add_warning(faults, node.where, fault + "; nothing is saved of it");
      else
        add_error(faults, node.where, fault);
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
      add_warning(
          faults, save->where,
          fmt::format("<save levels>: there is no level {}: the deck has {}, counted from 0",
                      missing, count),
          "remove the attribute levels to save on all levels");
    }
  }
}

void check_pressure(const ice::Fluid& fluid, const DeckNode& object, std::vector<Fault>& faults) {
  const auto density = real_of(&object, "density");
  const auto temperature = real_of(&object, "temperature");
  const auto pressure = real_of(&object, "pressure");
  if (!density || !temperature || !pressure) return;
  // A value out of range is a fault of its own, and a pressure from it says nothing.
  if (!(*density > 0) || !(*temperature > 0)) return;
  const double used =
      fluid.pressure(*density, fluid.energy_from_temperature(*density, *temperature));
  // What the pressure does when the last of the digits that decks write changes.
  const double unsure = ice::last_written_digit * std::abs(fluid.bulk_modulus(*density, used));
  if (std::abs(used - *pressure) <=
      std::max(ice::written_pressure_tolerance * std::abs(used), unsure))
    return;
  std::string advice = "remove it, or change density and temperature";
  if (fluid.gamma_law() != nullptr)
    advice = fmt::format(
        "pressure = (gamma - 1) density specific_heat temperature; for {:.6g} "
        "write temperature {:.6g}",
        *pressure, *temperature * *pressure / used);
  add_warning(
      faults, object.child("pressure")->where,
      fmt::format("<pressure> {:.6g} contradicts density and temperature, which give {:.6g}; it "
                  "is not used",
                  *pressure, used),
      advice);
}

// The law leaves no such state: temperature below its cold curve, density beyond its pole.
void check_start(const ice::Fluid& fluid, const DeckNode& object, std::vector<Fault>& faults) {
  const auto density = real_of(&object, "density");
  const auto temperature = real_of(&object, "temperature");
  if (!density || !temperature || !(*density > 0) || !(*temperature > 0)) return;
  const double rho_e = fluid.energy_from_temperature(*density, *temperature);
  if (fluid.admissible(*density, rho_e)) return;
  add_error(
      faults, object.where,
      fmt::format("density {:g} and temperature {:g} are inadmissible for the equation of state: "
                  "pressure {:g} (must be above {:g}), sound speed squared must be above 0",
                  *density, *temperature, fluid.pressure(*density, rho_e), fluid.lowest_pressure()),
      "see the range of the equation of state in docs/theory_eos.md");
}

// A linear solver is for implicit steps.
void check_solver(const DeckNode& root, const DeckNode* ice, std::vector<Fault>& faults) {
  const DeckNode* solver = root.child("Solver");
  if (solver == nullptr) return;
  if (ice == nullptr || ice->child("ImplicitSolver") == nullptr)
    add_warning(faults, solver->where,
                "<Solver> has no effect: without <ImplicitSolver> nothing is solved", "remove it");
}

}  // namespace

void drop_foreign_eos_tags(DeckNode& root, std::vector<Fault>& faults) {
  const std::string path = "MaterialProperties/ICE/material/EOS";
  for (const auto& properties : root.children) {
    DeckNode* ice = properties->name == "MaterialProperties" ? properties->child("ICE") : nullptr;
    if (ice == nullptr) continue;
    for (const auto& material : ice->children) {
      DeckNode* eos = material->child("EOS");
      const ice::LawEntry* law =
          eos == nullptr ? nullptr : ice::find_law(eos->attribute("type").value_or(""));
      if (law == nullptr) continue;
      std::string dropped;
      const auto foreign = [&](const std::unique_ptr<DeckNode>& child) {
        if (child->name == "gas_constant" || ice::has_tag(*law, child->name)) return false;
        // Some decks give products of detonation a Cv of their own, which nothing reads.
        if (child->name != "Cv" && !ice::tag_of_any_law(child->name) &&
            !known_to_format(path, child->name))
          return false;
        dropped += (dropped.empty() ? "<" : ", <") + child->name + ">";
        return true;
      };
      std::erase_if(eos->children, foreign);
      if (dropped.empty()) continue;
      add_warning(
          faults, eos->where,
          fmt::format("{} belong to other equations of state than {}; dropped", dropped, law->type),
          "remove them");
    }
  }
}

void check_ice_blocks(const DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_ice(root)) return;
  if (root.find("CFD/ICE") == nullptr) {
    const DeckNode* fluid = root.child("CFD");
    add_error(faults, (fluid == nullptr ? root : *fluid).where,
              "an ice deck needs the block <CFD><ICE>", "see sluice help CFD/ICE");
  }
  if (ice_materials(root).empty()) {
    const DeckNode* properties = root.child("MaterialProperties");
    add_error(faults, (properties == nullptr ? root : *properties).where,
              "an ice deck needs a material in <MaterialProperties><ICE>",
              "see sluice help MaterialProperties/ICE/material");
  }
  const DeckNode* constants = root.child("PhysicalConstants");
  if (constants == nullptr) {
    add_error(faults, root.where,
              "an ice deck needs <PhysicalConstants> with gravity and reference_pressure",
              "see sluice help PhysicalConstants");
  } else if (constants->child("reference_pressure") == nullptr) {
    add_error(faults, constants->where,
              "an ice deck needs <reference_pressure> in <PhysicalConstants>");
  }
  const DeckNode* ice = root.find("CFD/ICE");
  if (is_true(ice, "ClampSpecificVolume")) {
    add_warning(faults, ice->child("ClampSpecificVolume")->where,
                "<ClampSpecificVolume> has no effect: there are no clamps", "remove it");
  }
  check_solver(root, ice, faults);
}

void check_ice_materials(const DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_ice(root)) return;
  const auto materials = ice_materials(root);
  check_names(materials, faults);
  check_surrounding(root, materials, faults);
  constexpr std::size_t most = ice::max_materials;
  if (materials.size() > most)
    add_error(faults, materials[most]->where,
              fmt::format("{} materials; a deck may have at most {}", materials.size(), most),
              "combine materials with the same equation of state");
  for (const DeckNode* material : materials) {
    const DeckNode* work = material->child("includeFlowWork");
    if (work != nullptr && work->text == "false") {
      add_warning(
          faults, work->where,
          "<includeFlowWork> false has no effect: the work of the pressure is part of the energy",
          "remove it");
    }
  }
  check_material_indices(root, solid_material_count(root) + static_cast<int>(materials.size()),
                         faults);
  check_saved_levels(root, faults);
  const auto names = material_names(root);
  const auto count = static_cast<int>(materials.size());
  const DeckNode* analysis = root.child("DataAnalysis");
  if (analysis == nullptr || count == 0) return;
  for (const DeckNode* module : analysis->all("Module")) {
    const DeckNode* name = module->child("material");
    if (name != nullptr && std::find(names.begin(), names.end(), name->text) == names.end()) {
      add_error(faults, name->where, fmt::format("there is no material {}", in_quotes(name->text)),
                suggest_name(name->text, names));
    }
    const auto index = integer_of(module, "materialIndex");
    if (index && *index >= count) {
      add_error(
          faults, module->child("materialIndex")->where,
          fmt::format("there is no material {}: the deck has {}, counted from 0", *index, count));
    }
  }
}

void check_ice_models(const DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_ice(root)) return;
  models::check_models(root, {material_names(root), names_of_solids(root)}, faults);
  const DeckNode* models = root.child("Models");
  if (models == nullptr || !models::all_built(root)) return;
  const ice::SchemeRow& scheme = ice::scheme_of(root);
  for (const DeckNode* model : models->all("Model")) {
    const bool mixes = models::mixes_gas(model->attribute("type").value_or(""));
    if (mixes) check_mixed_gas(root, *model, material_names(root), faults);
    if (!scheme.transports_scalars && models::transports_scalar(*model))
      add_not_built(faults, model->where,
                    fmt::format("a transported scalar with <scheme> {}", scheme.word),
                    "remove <scheme>");
  }
}

void check_ice_fluids(const DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_ice(root)) return;
  const DeckNode* node = root.find("CFD/ICE/scheme");
  const ice::SchemeRow& scheme = ice::scheme_of(root);
  if (!scheme.several_materials && ice_materials(root).size() > 1)
    add_error(faults, node->where,
              fmt::format("<scheme> {} is for one material; this deck has {}", scheme.word,
                          ice_materials(root).size()),
              "remove <scheme>");
  for (const DeckNode* material : ice_materials(root)) {
    const ice::Fluid fluid = ice::read_fluid(*material, faults);
    const DeckNode* eos = material->child("EOS");
    const auto conductivity = real_of(material, "thermal_conductivity");
    if (!scheme.conducts_heat && conductivity && *conductivity > 0)
      add_error(
          faults, material->child("thermal_conductivity")->where,
          fmt::format("<scheme> {} conducts no heat; this deck has a thermal_conductivity of {:g}",
                      scheme.word, *conductivity),
          "remove <scheme>, or write 0");
    if (scheme.several_materials || eos == nullptr || fluid.gamma_law() != nullptr) continue;
    add_error(
        faults, node->where,
        fmt::format(
            "<scheme> {} is for one ideal gas with constant specific heat; this "
            "deck has {}{}",
            scheme.word, eos->attribute("type").value_or("none"),
            material->child("SpecificHeatModel") != nullptr ? " with <SpecificHeatModel>" : ""),
        "remove <scheme>");
  }
}

void check_ice_fill(const DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_ice(root)) return;
  const auto materials = ice_materials(root);
  const DeckNode* density = root.find("CFD/ICE/customInitialization/formula/density");
  if (density != nullptr && materials.size() > 1)
    add_error(faults, density->where, "with several materials a formula cannot give a <density>",
              "give densities in the geometry objects");
  const DeckNode* formula = root.find("CFD/ICE/customInitialization/formula");
  if (formula != nullptr && formula->has("density") && formula->has("pressure") &&
      formula->has("temperature"))
    add_error(faults, formula->child("temperature")->where,
              "<formula> gives density, pressure and temperature; two of them determine the third",
              "remove one of them");
  const auto mixed = mixed_material(root, material_names(root));
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const DeckNode* material = materials[m];
    const std::optional<ice::Fluid> fluid = ice::readable_fluid(*material);
    for (const DeckNode* object : material->all("geom_object")) {
      if (fluid) {
        // The pressure of a mixture follows from a scalar too.
        if (mixed != m) check_pressure(*fluid, *object, faults);
        check_start(*fluid, *object, faults);
      }
      const auto share = real_of(object, "volumeFraction");
      if (share && *share != 1 && materials.size() == 1)
        add_warning(faults, object->child("volumeFraction")->where,
                    "<volumeFraction> has no effect: one material fills its cells", "remove it");
      const bool has_piece =
          std::any_of(object->children.begin(), object->children.end(),
                      [](const auto& child) { return is_geometry_piece(child->name); });
      if (!has_piece) {
        add_error(faults, object->where, "<geom_object> has no geometry piece",
                  "add a <box>, <sphere>, ...; see sluice help geom_object");
      }
    }
  }
}

}  // namespace sluice
