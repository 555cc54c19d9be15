#include "models/deck/reactant.hpp"

#include <fmt/format.h>

#include "framework/deck/faults.hpp"
#include "models/deck/material_name.hpp"

namespace sluice::models {

std::vector<std::string> MaterialNames::all() const {
  std::vector<std::string> names = solids;
  names.insert(names.end(), fluids.begin(), fluids.end());
  return names;
}

void check_reactant(const DeckNode& parameters, const MaterialNames& names,
                    std::vector<Fault>& faults) {
  const std::vector<std::string> all = names.all();
  const auto from = check_material(parameters, "fromMaterial", all, faults);
  const auto to = check_material(parameters, "toMaterial", all, faults);
  if (!from || !to) return;
  const Location& where = parameters.child("toMaterial")->where;
  if (*from == *to)
    add_error(faults, where, "<toMaterial> is <fromMaterial>: there would be no exchange",
              "name two materials");
  else if (*to < static_cast<int>(names.solids.size()))
    add_error(faults, where, "<toMaterial> is a solid: the product of a model is a fluid",
              "name a material of <ICE>");
}

void check_solid_reactant(const DeckNode& parameters, const MaterialNames& names,
                          std::vector<Fault>& faults) {
  check_reactant(parameters, names, faults);
  const DeckNode* node = parameters.child("fromMaterial");
  if (node == nullptr) return;
  const auto from = find_material(node->text, names.all());
  if (from && *from >= static_cast<int>(names.solids.size()))
    add_error(faults, node->where,
              fmt::format("<{}> burns the surface of a solid, and <fromMaterial> is a fluid",
                          parameters.name),
              "name a material of <MPM>, in a run of mpmice");
}

void check_fluid_reactant(const DeckNode& parameters, const MaterialNames& names,
                          std::vector<Fault>& faults) {
  check_reactant(parameters, names, faults);
  const DeckNode* node = parameters.child("fromMaterial");
  if (node == nullptr) return;
  const auto from = find_material(node->text, names.all());
  if (from && *from < static_cast<int>(names.solids.size()))
    add_not_built(faults, node->where, fmt::format("<{}> of a solid", parameters.name));
}

Reactant read_reactant(const DeckNode& parameters, const MaterialNames& names) {
  const std::vector<std::string> all = names.all();
  const auto solids = static_cast<int>(names.solids.size());
  Reactant r;
  r.from = read_material(parameters, "fromMaterial", all);
  r.solid = r.from < solids;
  if (!r.solid) r.from -= solids;
  r.to = read_material(parameters, "toMaterial", all) - solids;
  return r;
}

}  // namespace sluice::models
