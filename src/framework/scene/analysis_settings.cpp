// The deck's <DataAnalysis>.
#include "framework/scene/analysis_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/deck/nearest_name.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice {

namespace {

int material_named(const std::string& name, const std::vector<std::string>& materials) {
  const auto found = std::find(materials.begin(), materials.end(), name);
  if (found == materials.end())
    throw InputError(
        fmt::format("<Module>: no material is named '{}' {}", name, suggest_name(name, materials)));
  return static_cast<int>(found - materials.begin());
}

void check_material(int index, const std::vector<std::string>& materials) {
  if (index < 0 || index >= static_cast<int>(materials.size()))
    throw InputError(fmt::format("material {} does not exist; the deck has {} (from 0)", index,
                                 materials.size()));
}

Weighting weighting_of(const std::string& word) {
  return word == "nCells" ? Weighting::cells : word == "mass" ? Weighting::mass : Weighting::none;
}

AnalysedVariable read_variable(const DeckNode& node, int default_material,
                               const std::vector<std::string>& materials) {
  AnalysedVariable v;
  v.where = node.where;
  v.label = node.attribute("label").value_or("");
  if (v.label.empty()) throw InputError("<analyze>: no label; name the variable");
  v.material = integer_attribute(node, "matl").value_or(default_material);
  check_material(v.material, materials);
  v.levels = read_index_set(node.attribute("level").value_or(""));
  v.weighting = weighting_of(node.attribute("weighting").value_or("none"));
  v.reynolds_stress = true_attribute(node, "computeReynoldsStress");
  v.fluid_velocity = node.attribute("fluidVelocityLabel").has_value() &&
                     node.attribute("fluidVelocityLabel") != "false";
  return v;
}

int normal_of(const std::string& orientation) {
  return orientation == "YZ" ? 0 : orientation == "XZ" ? 1 : 2;
}

AnalysisModule::AverageWhere average_where(const std::string& word) {
  using Where = AnalysisModule::AverageWhere;
  return word == "interior"     ? Where::interior
         : word == "boundaries" ? Where::boundaries
                                : Where::everywhere;
}

void read_averages(const DeckNode& node, const std::vector<std::string>& materials,
                   AnalysisModule& m, std::vector<Fault>& faults) {
  m.plane_normal = normal_of(text_or(node, "planeOrientation", "XY"));
  if (const DeckNode* weight = node.child("weight"))
    m.weight = weight->attribute("label").value_or("");
  if (const DeckNode* velocity = node.child("velocity"))
    collect(faults, velocity->where,
            [&] { m.velocity = read_variable(*velocity, m.material, materials); });
}

void read_module(const DeckNode& node, const std::vector<std::string>& materials, AnalysisModule& m,
                 std::vector<Fault>& faults) {
  m.where = node.where;
  m.name = node.attribute("name").value_or("");
  m.material_name = text_or(node, "material", "");
  m.material = m.material_name.empty() ? integer_or(node, "materialIndex", 0)
                                       : material_named(m.material_name, materials);
  check_material(m.material, materials);
  m.sampling_frequency = real_or(node, "samplingFrequency", 0);
  m.time_start = real_or(node, "timeStart", 0);
  m.time_stop = real_or(node, "timeStop", std::numeric_limits<double>::max());
  if (m.sampling_frequency < 0) throw InputError("<Module>: samplingFrequency must be at least 0");
  if (const DeckNode* variables = node.child("Variables"))
    for (const DeckNode* v : variables->all("analyze"))
      collect(faults, v->where,
              [&] { m.variables.push_back(read_variable(*v, m.material, materials)); });
  m.higher_order = boolean_or(node, "computeHigherOrderStats", false);
  m.energy_factor = real_or(node, "engy_convt_factor", 1);
  m.colour_threshold = real_or(node, "colorThreshold", 0);
  read_averages(node, materials, m, faults);
  m.average_cells = int_vector_or(node, "avgBoxCells", {1, 1, 1});
  m.average_where = average_where(text_or(node, "domain", "everywhere"));
  read_analysis_places(node, m, faults);
}

}  // namespace

AnalysisSettings read_analysis_settings(const DeckNode* node,
                                        const std::vector<std::string>& materials,
                                        std::vector<Fault>& faults) {
  AnalysisSettings a;
  if (node == nullptr) return a;
  for (const DeckNode* module : node->all("Module"))
    collect(faults, module->where, [&] {
      AnalysisModule m;
      read_module(*module, materials, m, faults);
      a.modules.push_back(std::move(m));
    });
  return a;
}

}  // namespace sluice
