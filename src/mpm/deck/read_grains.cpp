// DoGranularMPM: which materials exchange particles, and when their grains have lost touch.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "framework/deck/faults.hpp"
#include "framework/scene/deck_values.hpp"
#include "mpm/deck/readers.hpp"
#include "mpm/deck/schema.hpp"

namespace sluice::mpm {
namespace {

using Key = std::pair<std::string, std::string>;  // MatTypeIdx and type of the law

Key key_of(const DeckNode& material) {
  const DeckNode* law = material.child("constitutive_model");
  return {text_or(material, "MatTypeIdx", ""),
          law == nullptr ? "" : law->attribute("type").value_or("")};
}

bool is_held(const MpmScene& s, int material) {
  return std::any_of(s.contacts.begin(), s.contacts.end(), [&](const ContactRule& c) {
    const bool by_master =
        c.kind == ContactKind::specified || c.kind == ContactKind::specified_friction;
    return by_master && c.master == material;
  });
}

// What a material says of itself beside where its particles are, tag by tag.
std::map<std::string, std::string> says(const DeckNode& material) {
  std::map<std::string, std::string> said;
  for (const auto& child : material.children)
    if (child->name != "geom_object" && child->name != "is_active" &&
        child->name != "activation_time" && child->name != "applied_contact_model")
      said[child->name] = to_xml(*child);
  return said;
}

// A particle has the law and the constants of the material in which it is.
void warn_of_differences(const std::vector<const DeckNode*>& nodes, const std::vector<int>& members,
                         std::vector<Fault>& faults) {
  const auto first = says(*nodes[members.front()]);
  for (const int m : members) {
    const DeckNode& node = *nodes[m];
    const auto own = says(node);
    if (own == first) continue;
    std::string tags;
    for (const auto& both : {first, own})
      for (const auto& [name, text] : both) {
        const auto a = first.find(name), b = own.find(name);
        const bool same = a != first.end() && b != own.end() && a->second == b->second;
        if (!same && tags.find("<" + name + ">") == std::string::npos)
          tags += (tags.empty() ? "<" : ", <") + name + ">";
      }
    add_warning(faults, node.where,
                fmt::format("materials {} and {} exchange particles (DoGranularMPM) and differ in "
                            "{}: a particle follows the material to which it belongs",
                            members.front(), m, tags),
                "give both the same value, or give them different <MatTypeIdx>");
    return;
  }
}

// Rules of contact leave those alone of which the deck says so.
void leave_alone(MpmScene& s, const std::vector<bool>& meets) {
  if (std::find(meets.begin(), meets.end(), false) == meets.end()) return;
  for (ContactRule& rule : s.contacts) {
    if (rule.materials.empty())
      for (int m = 0; m < static_cast<int>(meets.size()); ++m) rule.materials.push_back(m);
    std::erase_if(rule.materials, [&](int m) { return !meets[m]; });
  }
  std::erase_if(s.contacts, [](const ContactRule& rule) { return rule.materials.empty(); });
}

GrainFamily family_of(const MpmScene& s, std::vector<int> members) {
  GrainFamily family;
  const auto meets = [&](int m) {
    return std::any_of(s.contacts.begin(), s.contacts.end(),
                       [&](const ContactRule& rule) { return rule.takes(m); });
  };
  const auto rest = std::stable_partition(members.begin(), members.end(), meets);
  family.in_contact = rest - members.begin();
  family.members = std::move(members);
  return family;
}

}  // namespace

void read_grains(const DeckNode& root, MpmScene& s, std::vector<Fault>& faults) {
  const DeckNode* flags = root.child("MPM");
  s.granular = flags != nullptr && boolean_or(*flags, "DoGranularMPM", false);
  if (!s.granular) return;
  const double product = real_or(*flags, "GranularMPMVcrix", 1.04) *
                         real_or(*flags, "GranularMPMVcriy", 1.04) *
                         real_or(*flags, "GranularMPMVcriz", 1.0);
  const std::vector<const DeckNode*> nodes = mpm_materials(root);
  std::map<Key, std::vector<int>> alike;
  std::vector<bool> meets;
  for (std::size_t m = 0; m < nodes.size(); ++m) {
    SolidMaterial& material = s.materials[m];
    const DeckNode& node = *nodes[m];
    const double critical = real_or(node, "critical_density", 0);
    material.loosest = critical > 0 ? material.constants.density / critical : product;
    material.loose_have_no_stress = boolean_or(node, "stress_free", false);
    meets.push_back(boolean_or(node, "applied_contact_model", true));
    const auto number = static_cast<int>(m);
    if (boolean_or(node, "allow_DWIndex_correction", true) && !material.rigid &&
        !is_held(s, number))
      alike[key_of(node)].push_back(number);
  }
  leave_alone(s, meets);
  for (const auto& [key, members] : alike) {
    if (members.size() < 2) continue;
    warn_of_differences(nodes, members, faults);
    s.grains.push_back(family_of(s, members));
    std::vector<SeedObject> guests;
    for (const int m : members) {
      const auto& own = s.materials[m].objects;
      guests.insert(guests.end(), own.begin(), own.end());
    }
    for (const int m : members) s.materials[m].guests = guests;
  }
  if (s.grains.empty())
    add_warning(faults, flags->need("DoGranularMPM").where,
                "<DoGranularMPM> has no effect: no two materials can exchange particles",
                "add materials with the same constitutive model, without <geom_object>, one for "
                "each cluster");
}

}  // namespace sluice::mpm
