// What decks of implicit steps may not ask for.
#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/faults.hpp"
#include "framework/deck/rule_tools.hpp"
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
  one_of("interpolator", {"linear", "gimp", "3rdorderBS", "4thorderBS"});
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
                fmt::format("<contact> {} has no form with implicit steps: all "
                            "that deforms has "
                            "one velocity at a node",
                            type->text),
                "valid: null, single_velocity, rigid");
      continue;
    }
    if (is_true(contact, "normal_only"))
      refuse_implicit(*contact->child("normal_only"), "<normal_only> true", faults);
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
    if (const DeckNode* block = properties->child("MPM")) check_contacts_of(*block, faults);
  check_implicit_levels(root, faults);
}

}  // namespace sluice::mpm
