// What decks of implicit steps may not ask for.
#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/faults.hpp"
#include "framework/deck/rule_tools.hpp"
#include "mpm/deck/bases.hpp"
#include "mpm/deck/implicit.hpp"

namespace sluice::mpm {
namespace {

void refuse_implicit(const DeckNode& node, const std::string& what, std::vector<Fault>& faults) {
  add_not_built(faults, node.where, what + " with implicit steps");
}

void check_flags_of(const DeckNode& flags, std::vector<Fault>& faults) {
  constexpr const char* off[] = {"axisymmetric",
                                 "artificial_viscosity",
                                 "DoPressureStabilization",
                                 "use_cohesive_zones",
                                 "use_CBDI_boundary_condition",
                                 "UsePrescribedDeformation",
                                 "InsertParticles",
                                 "refine_particles",
                                 "XPIC2",
                                 "UseGradientEnhancedVelocityProjection",
                                 "do_contact_friction_heating",
                                 "full_first_kick"};
  for (const char* name : off)
    if (is_true(&flags, name))
      refuse_implicit(*flags.child(name), fmt::format("<{}> true", name), faults);
  const auto one_of = [&](const char* name, std::initializer_list<const char*> words) {
    const DeckNode* node = flags.child(name);
    if (node == nullptr || std::any_of(words.begin(), words.end(),
                                       [&](const char* word) { return node->text == word; }))
      return;
    refuse_implicit(*node, fmt::format("<{}> {}", name, node->text), faults);
  };
  if (!basis_of(flags).implicit)
    refuse_implicit(*flags.child("interpolator"),
                    fmt::format("<interpolator> {}", basis_of(flags).word), faults);
  one_of("transfer", {"flip"});
  one_of("minimum_subcycles_for_F", {"1"});
  if (const auto damping = real_of(&flags, "artificial_damping_coeff"); damping && *damping != 0)
    refuse_implicit(*flags.child("artificial_damping_coeff"), "<artificial_damping_coeff>", faults);
}

// Whatever deforms has one velocity at a node.
void check_contacts_of(const DeckNode& block, std::vector<Fault>& faults) {
  for (const DeckNode* contact : block.all("contact")) {
    const DeckNode* type = contact->child("type");
    if (type == nullptr || type->text == "null" || type->text == "single_velocity") continue;
    if (type->text != "specified") {
      add_error(faults, type->where,
                fmt::format("<contact> {} is not supported with implicit steps: all deforming "
                            "materials have one velocity at a node",
                            type->text),
                "valid: null, single_velocity, rigid");
      continue;
    }
    for (const char* name : {"normal_only", "include_rotation"})
      if (is_true(contact, name))
        refuse_implicit(*contact->child(name), fmt::format("<{}> true", name), faults);
    for (const char* name : {"filename", "ExcludeMaterial"})
      if (const DeckNode* node = contact->child(name); node != nullptr && !node->text.empty())
        refuse_implicit(*node, fmt::format("<{}>", name), faults);
  }
  for (const DeckNode* material : block.all("material")) {
    if (is_true(material, "is_force_transmitting_material"))
      refuse_implicit(*material->child("is_force_transmitting_material"),
                      "<is_force_transmitting_material> true", faults);
    for (const char* name : {"is_active", "deactivation_time"}) {
      const DeckNode* node = material->child(name);
      if (node == nullptr || node->text == "true") continue;
      if (const auto end = real_of(material, name); end && *end >= 1e8) continue;
      refuse_implicit(*node, fmt::format("<{}>", name), faults);
    }
  }
}

bool is_rigid(const DeckNode& material) {
  const DeckNode* law = material.child("constitutive_model");
  return is_true(&material, "is_rigid") ||
         (law != nullptr && law->attribute("type").value_or("") == "rigid");
}

// Rigid materials say how nodes move, where a rule says so; nothing else does.
void warn_of_idle_bodies(const DeckNode& block, std::vector<Fault>& faults) {
  bool ruled = false;
  for (const DeckNode* contact : block.all("contact")) {
    const DeckNode* type = contact->child("type");
    ruled |= type != nullptr && type->text == "specified";
  }
  bool any = false;
  for (const DeckNode* material : block.all("material")) {
    any |= is_rigid(*material);
    if (is_rigid(*material) && !ruled)
      add_warning(faults, material->where,
                  "a rigid material without <contact> of type rigid: it passes through the others");
  }
  if (ruled && !any)
    add_warning(faults, block.where,
                "<contact> rigid has no effect: no material is rigid, and in implicit steps only "
                "rigid materials prescribe the motion of nodes");
}

void check_heat_of_sides(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* conditions = root.find("Grid/BoundaryConditions");
  if (conditions == nullptr) return;
  for (const DeckNode* face : conditions->all("Face"))
    for (const DeckNode* type : face->all("BCType")) {
      const auto value = real_of(type, "value");
      if (type->attribute("label").value_or("") != "Temperature") continue;
      if (type->attribute("var").value_or("") == "Neumann" && value && *value != 0)
        refuse_implicit(*type, "a gradient of the temperature on a side", faults);
      const std::string id = type->attribute("id").value_or("all");
      if (id != "all" && mpm_materials(root).size() > 1)
        refuse_implicit(*type, "a temperature of one material on a side", faults);
    }
}

void check_implicit_levels(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* grid = root.child("Grid");
  if (grid != nullptr && grid->all("Level").size() > 1)
    refuse_implicit(*grid->all("Level")[1], "several <Level>s", faults);
  if (const DeckNode* regridder = root.find("AMR/Regridder"))
    refuse_implicit(*regridder, "<Regridder>", faults);
}

}  // namespace

void check_implicit(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* flags = root.child("MPM");
  const DeckNode* integrator = flags == nullptr ? nullptr : flags->child("time_integrator");
  const bool named = integrator != nullptr && integrator->text == "implicit";
  if (!runs_implicit(root)) {
    if (named && runs_solids(root))
      add_not_built(faults, integrator->where,
                    fmt::format("<time_integrator> implicit of the component {}",
                                root.child("SimulationComponent")->attribute("type").value_or("")));
    return;
  }
  if (flags != nullptr) check_flags_of(*flags, faults);
  for (const DeckNode* properties : root.all("MaterialProperties"))
    if (const DeckNode* block = properties->child("MPM")) {
      check_contacts_of(*block, faults);
      warn_of_idle_bodies(*block, faults);
    }
  if (flags != nullptr && is_true(flags, "DoImplicitHeatConduction"))
    check_heat_of_sides(root, faults);
  check_implicit_levels(root, faults);
}

}  // namespace sluice::mpm
