// Water in pores: its tags, what must hold between them, and what is read from them.
#include "mpm/deck/pore_water.hpp"
#include "mpm/deck/bases.hpp"

#include <fmt/format.h>

#include <array>

#include "framework/deck/faults.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice::mpm {
namespace {

// All three of a material that holds water.
constexpr std::array<const char*, 3> needed = {"water_density", "porosity", "permeability"};
// Of a material that does.
constexpr std::array<const char*, 2> further = {"water_bulk_modulus", "initial_pore_pressure"};
// Conductivities are measured under it, where the deck has no gravity. m/s^2
constexpr double standard_gravity = 9.80665;

bool says_any(const DeckNode& material) {
  for (const char* name : needed)
    if (material.has(name)) return true;
  return false;
}

// The component with water in pores, whether it is asked to move or not.
bool is_named(const DeckNode& root) {
  const DeckNode* component = root.child("SimulationComponent");
  return component != nullptr && component->attribute("type").value_or("") == "shmpm";
}

void check_dry(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* flags = root.child("MPM");
  if (is_true(flags, "coupled_flow_analysis"))
    add_error(faults, flags->child("coupled_flow_analysis")->where,
              "<coupled_flow_analysis> true: water moves through pores only in the component shmpm",
              "write <SimulationComponent type=\"shmpm\"/>");
  if (is_true(flags, "PorePressureFilter"))
    add_warning(faults, flags->child("PorePressureFilter")->where,
                "<PorePressureFilter> has no effect: no water moves through pores", "remove it");
  for (const DeckNode* material : mpm_materials(root))
    for (const char* name : needed)
      if (material->has(name)) {
        add_warning(faults, material->child(name)->where,
                    fmt::format("<{}> has no effect: no water moves through pores, and <density> "
                                "is that of the material",
                                name),
                    "write <SimulationComponent type=\"shmpm\"/> and "
                    "<coupled_flow_analysis>true</coupled_flow_analysis>");
        break;
      }
}

void check_material(const DeckNode& material, std::vector<Fault>& faults) {
  for (const char* name : needed)
    if (says_any(material) && !material.has(name))
      add_error(faults, material.where, fmt::format("a material with pore water needs <{}>", name),
                "without <water_density>, <porosity> and <permeability> it is dry");
  for (const char* name : further)
    if (!says_any(material) && material.has(name))
      add_warning(faults, material.child(name)->where,
                  fmt::format("<{}> has no effect: the material is dry", name),
                  "give <water_density>, <porosity> and <permeability>");
  const DeckNode* law = material.child("constitutive_model");
  if (says_any(material) && (is_true(&material, "is_rigid") ||
                             (law != nullptr && law->attribute("type").value_or("") == "rigid")))
    add_error(faults, material.child(material.has(needed[0]) ? needed[0] : needed[1])->where,
              "a rigid material has no pores that water could move through",
              "remove <water_density>, <porosity> and <permeability>");
}

void refuse(const DeckNode& flags, const char* name, const char* supported,
            std::vector<Fault>& faults) {
  const DeckNode* flag = flags.child(name);
  if (flag != nullptr && flag->text != supported)
    add_not_built(faults, flag->where, fmt::format("<{}> {} with pore water", name, flag->text));
}

void check_method(const DeckNode& root, const DeckNode& flags, std::vector<Fault>& faults) {
  refuse(flags, "time_integrator", "explicit", faults);
  refuse(flags, "transfer", "flip", faults);
  for (const char* name :
       {"XPIC2", "UseGradientEnhancedVelocityProjection", "total_lagrangian", "axisymmetric",
        "UsePrescribedDeformation", "refine_particles", "DoGranularMPM"})
    refuse(flags, name, "false", faults);
  for (const char* name : {"solid_damping_coef", "water_damping_coef"})
    if (real_of(&flags, name).value_or(0) != 0)
      add_not_built(faults, flags.child(name)->where, fmt::format("<{}> other than 0", name));
  const DeckNode* basis = flags.child("interpolator");
  if (basis != nullptr && !basis_of(flags).pore_water)
    add_not_built(faults, basis->where,
                  fmt::format("<interpolator> {} with pore water", basis->text));
  const DeckNode* grid = root.child("Grid");
  if ((grid != nullptr && grid->all("Level").size() > 1) || root.find("AMR/Regridder") != nullptr)
    add_not_built(faults, grid->where, "pore water on several levels");
}

}  // namespace

std::vector<TagSpec> pore_water_flags() {
  return {tag("coupled_flow_analysis",
              "component shmpm: water moves through the pores of materials with pore water; false: "
              "all are dry")
              .boolean()
              .by_default("false"),
          tag("PorePressureFilter",
              "component shmpm: the pore pressure used is interpolated from nodes (mass-weighted "
              "means) to the particles; the particles' own pressures are not filtered")
              .boolean()
              .by_default("false"),
          tag("solid_damping_coef", "component shmpm: only 0 is supported").real().by_default("0"),
          tag("water_damping_coef", "component shmpm: only 0 is supported").real().by_default("0")};
}

std::vector<TagSpec> pore_water_tags() {
  return {
      tag("water_density", "component shmpm: density of the water in its pores")
          .real()
          .above(0)
          .unit("density"),
      tag("porosity",
          "component shmpm: initial porosity, with saturated pores; <density> is that of the "
          "grains")
          .real()
          .above(0)
          .at_most(0.99),
      tag("permeability",
          "component shmpm: hydraulic conductivity, the flow (volume per area and time) under a "
          "hydraulic gradient of one")
          .real()
          .above(0)
          .unit("velocity"),
      tag("water_bulk_modulus", "component shmpm: bulk modulus of the pore water; absent: 2.2e9")
          .real()
          .above(0)
          .unit("pressure"),
      tag("initial_pore_pressure", "component shmpm: initial pressure of the pore water; absent: 0")
          .real()
          .unit("pressure")};
}

bool runs_pore_water(const DeckNode& root) {
  return is_named(root) && is_true(root.child("MPM"), "coupled_flow_analysis");
}

std::optional<PoreWaterConstants> read_pore_water(const DeckNode& material, Vec3 gravity) {
  if (!says_any(material)) return std::nullopt;
  PoreWaterConstants w;
  w.density = material.real("water_density");
  w.porosity = material.real("porosity");
  w.conductivity = material.real("permeability");
  w.bulk_modulus = real_or(material, "water_bulk_modulus", w.bulk_modulus);
  w.initial_pressure = real_or(material, "initial_pore_pressure", 0);
  const double g = std::sqrt(dot(gravity, gravity));
  w.drag_of_velocity = (g > 0 ? g : standard_gravity) / w.conductivity;
  return w;
}

void check_pore_water(const DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_solids(root)) return;
  if (!runs_pore_water(root)) {
    check_dry(root, faults);
    if (is_named(root))
      add_warning(faults, root.child("SimulationComponent")->where,
                  "component shmpm without <coupled_flow_analysis> true: all materials are dry, "
                  "as in the component mpm");
    return;
  }
  bool any = false;
  for (const DeckNode* material : mpm_materials(root)) {
    check_material(*material, faults);
    any |= says_any(*material);
  }
  const DeckNode& flags = *root.child("MPM");
  if (!any)
    add_error(faults, flags.child("coupled_flow_analysis")->where,
              "<coupled_flow_analysis> true, but no material contains water",
              "give a material <water_density>, <porosity> and <permeability>");
  check_method(root, flags, faults);
}

}  // namespace sluice::mpm
