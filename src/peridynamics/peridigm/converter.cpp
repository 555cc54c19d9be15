#include "peridynamics/peridigm/converter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "framework/base/error.hpp"
#include "framework/scene/formula.hpp"

namespace sluice::peridynamics {
namespace {

// What has no effect on results here.
void accept(const Parameter& list, std::initializer_list<const char*> names) {
  for (const char* name : names) list.find(name);
}

// Labels of what decks save; "" where nothing here corresponds.
const std::map<std::string, std::string>& labels() {
  static const std::map<std::string, std::string> all = {
      {"Displacement", "p.displacement"},
      {"Velocity", "p.velocity"},
      {"Acceleration", "p.acceleration"},
      {"Force", "p.internalforce"},
      {"Dilatation", "p.dilatation"},
      {"Weighted_Volume", "p.weightedVolume"},
      {"Damage", "p.damage"},
      {"Number_Of_Neighbors", "p.neighborcount"},
      {"Horizon", "p.horizon"},
      {"Volume", "p.volume"},
      {"Stored_Elastic_Energy", "p.strainEnergyDensity"},
      {"Global_Kinetic_Energy", "KineticEnergy"},
      {"Global_Strain_Energy", "StrainEnergy"}};
  return all;
}

}  // namespace

const Parameter* PeridigmReader::need(const Parameter& list, const char* name) {
  const Parameter* p = list.find(name);
  if (p == nullptr)
    add_error(*faults_, list.where,
              fmt::format("'{}' needs '{}'", list.name.empty() ? "the deck" : list.name, name));
  return p;
}

double PeridigmReader::number(const Parameter& list, const char* name, double fallback) {
  const Parameter* p = list.find(name);
  return p == nullptr ? fallback : number_of(*p, *faults_);
}

void PeridigmReader::read() {
  accept(*deck_, {"Verbose"});
  if (const Parameter* list = need(*deck_, "Discretization")) {
    mesh = read_mesh(*list, folder_, *faults_);
    velocity.assign(mesh.points.size(), Vec3{});
    displacement = velocity;
  }
  if (const Parameter* list = need(*deck_, "Materials")) read_materials(*list);
  if (const Parameter* list = deck_->find("Damage Models")) read_damage(*list);
  if (const Parameter* list = need(*deck_, "Blocks")) read_blocks(*list);
  if (const Parameter* list = deck_->find("Boundary Conditions")) read_conditions(*list);
  if (const Parameter* list = need(*deck_, "Solver")) read_solver(*list);
  if (const Parameter* list = deck_->find("Output")) read_output(*list);
  refuse_unknown(*deck_);
}

void PeridigmReader::read_materials(const Parameter& list) {
  for (const Parameter& node : list.children) {
    node.known = true;
    const Parameter* model = need(node, "Material Model");
    if (model == nullptr) continue;
    MaterialOfDeck m;
    m.name = node.name;
    m.bond_based = model->text == "Elastic Bond Based";
    if (model->text != "Elastic" && !m.bond_based) {
      add_not_built(*faults_, model->where, fmt::format("material model '{}'", model->text),
                    "Elastic and Elastic Bond Based are read");
      for (const Parameter& child : node.children) child.known = true;
      continue;
    }
    m.density = number(node, "Density", 0);
    m.bulk = number(node, "Bulk Modulus", 0);
    m.shear = number(node, "Shear Modulus", 0);
    const double E = number(node, "Young's Modulus", 0), nu = number(node, "Poisson's Ratio", 0.25);
    if (E > 0) {
      m.bulk = E / (3 * (1 - 2 * nu));
      m.shear = E / (2 * (1 + nu));
    }
    if (!(m.density > 0) || !(m.bulk > 0) || (!m.bond_based && !(m.shear > 0)))
      add_error(*faults_, node.where,
                fmt::format("material '{}' needs Density, Bulk Modulus and Shear Modulus above 0",
                            node.name));
    const Parameter* correction = node.find("Apply Shear Correction Factor");
    if (correction != nullptr && correction->text == "true")
      add_not_built(*faults_, correction->where, "'Apply Shear Correction Factor'");
    materials[m.name] = m;
  }
}

void PeridigmReader::read_damage(const Parameter& list) {
  for (const Parameter& node : list.children) {
    node.known = true;
    const Parameter* model = need(node, "Damage Model");
    if (model == nullptr) continue;
    if (model->text != "Critical Stretch") {
      add_not_built(*faults_, model->where, fmt::format("damage model '{}'", model->text),
                    "Critical Stretch is read");
      for (const Parameter& child : node.children) child.known = true;
      continue;
    }
    critical_stretches_[node.name] = number(node, "Critical Stretch", 0);
    if (!(critical_stretches_[node.name] > 0))
      add_error(*faults_, node.where, "'Critical Stretch' must be above 0");
  }
}

void PeridigmReader::read_blocks(const Parameter& list) {
  for (const Parameter& node : list.children) {
    node.known = true;
    const Parameter *names = need(node, "Block Names"), *material = need(node, "Material"),
                    *horizon = need(node, "Horizon");
    if (names == nullptr || material == nullptr || horizon == nullptr) continue;
    BlockOfDeck block;
    block.horizon = number_of(*horizon, *faults_);
    const auto found = materials.find(material->text);
    if (found == materials.end())
      add_error(*faults_, material->where,
                fmt::format("there is no material '{}'", material->text));
    else
      block.material = &found->second;
    if (const Parameter* damage = node.find("Damage Model");
        damage != nullptr && damage->text != "None") {
      const auto stretch = critical_stretches_.find(damage->text);
      if (stretch != critical_stretches_.end()) block.critical_stretch = stretch->second;
    }
    std::istringstream text(names->text);
    for (std::string name; text >> name;) {
      if (!name.starts_with("block_") ||
          name.find_first_not_of("0123456789", 6) != std::string::npos || name.size() < 7 ||
          name.size() > 14) {
        add_error(*faults_, names->where, fmt::format("'{}' is no name of a block: block_1", name));
        continue;
      }
      block.number = std::stoi(name.substr(6));
      blocks.push_back(block);
    }
  }
  for (const MeshPoint& p : mesh.points)
    if (std::none_of(blocks.begin(), blocks.end(),
                     [&](const BlockOfDeck& b) { return b.number == p.block; })) {
      add_error(*faults_, list.where, fmt::format("points of block_{} have no material", p.block));
      return;
    }
}

void PeridigmReader::read_conditions(const Parameter& list) {
  for (const Parameter& node : list.children)
    if (node.is_list) {
      node.known = true;
      read_condition(node, list);
    }
}

void PeridigmReader::read_condition(const Parameter& node, const Parameter& all) {
  const Parameter *type = need(node, "Type"), *set = need(node, "Node Set"),
                  *coordinate = need(node, "Coordinate"), *value = need(node, "Value");
  if (type == nullptr || set == nullptr || coordinate == nullptr || value == nullptr) return;
  const bool moves = type->text == "Initial Velocity";
  if (!moves && type->text != "Initial Displacement") {
    all.find(set->text);
    return add_not_built(*faults_, type->where, fmt::format("boundary condition '{}'", type->text),
                         "Initial Velocity and Initial Displacement are read");
  }
  const Parameter* nodes = all.find(set->text);
  if (nodes == nullptr)
    return add_error(*faults_, set->where, fmt::format("there is no node set '{}'", set->text));
  const auto axis = std::string("xyz").find(coordinate->text);
  if (axis == std::string::npos || coordinate->text.size() != 1)
    return add_error(*faults_, coordinate->where,
                     fmt::format("'Coordinate' is '{}', not x, y or z", coordinate->text));
  try {
    const Formula formula(value->text);
    for (const int n :
         read_node_set(*nodes, folder_, static_cast<int>(mesh.points.size()), *faults_)) {
      const std::size_t i = static_cast<std::size_t>(n - 1);
      const double number = formula(mesh.points[i].place);
      if (!std::isfinite(number)) {
        add_error(*faults_, value->where,
                  fmt::format("'{}' is {} at point {}", value->text, number, n));
        return;
      }
      (moves ? velocity : displacement)[i][static_cast<int>(axis)] = number;
    }
    displaced = displaced || !moves;
  } catch (const InputError& e) {
    add_error(*faults_, value->where, e.what());
  }
}

void PeridigmReader::read_solver(const Parameter& list) {
  accept(list, {"Verbose"});
  initial_time = number(list, "Initial Time", 0);
  final_time = number(list, "Final Time", 0);
  const Parameter* verlet = list.find("Verlet");
  for (const Parameter& child : list.children)
    if (child.is_list && child.name != "Verlet") {
      child.known = true;
      for (const Parameter& inside : child.children) inside.known = true;
      add_not_built(*faults_, child.where, fmt::format("solver '{}'", child.name),
                    "Verlet is read");
    }
  if (!(final_time > initial_time))
    add_error(*faults_, list.where, "'Final Time' must be after 'Initial Time'");
  if (verlet == nullptr) return;
  fixed_dt = number(*verlet, "Fixed dt", 0);
  safety_factor = number(*verlet, "Safety Factor", 1);
  if (fixed_dt < 0 || !(safety_factor > 0))
    add_error(*faults_, verlet->where, "'Fixed dt' and 'Safety Factor' must be above 0");
}

void PeridigmReader::read_output(const Parameter& list) {
  accept(list, {"Output File Type", "Output Format", "Parallel Write"});
  if (const Parameter* name = list.find("Output Filename")) output.file = name->text;
  output.frequency = std::max(1, static_cast<int>(number(list, "Output Frequency", 1)));
  const Parameter* variables = list.find("Output Variables");
  if (variables == nullptr) return;
  for (const Parameter& v : variables->children) {
    v.known = true;
    const auto found = labels().find(v.name);
    if (found != labels().end())
      output.labels.push_back(found->second);
    else if (v.name != "Element_Id" && v.name != "ID" && v.name != "Proc_Num")
      add_warning(*faults_, v.where,
                  fmt::format("output variable '{}': nothing is saved of it", v.name));
  }
}

void PeridigmReader::refuse_unknown(const Parameter& list) {
  for (const Parameter& p : list.children) {
    if (!p.known)
      add_error(*faults_, p.where, fmt::format("parameter '{}' is not known", p.name));
    else
      refuse_unknown(p);
  }
}

}  // namespace sluice::peridynamics
