// The blocks of solids, put together.
#include "mpm/deck/read_mpm_scene.hpp"

#include <algorithm>
#include <cctype>
#include <string>

#include "framework/deck/faults.hpp"
#include "framework/scene/deck_values.hpp"
#include "framework/scene/geometry_reader.hpp"
#include "mpm/deck/pore_water.hpp"
#include "mpm/deck/readers.hpp"
#include "mpm/deck/schema.hpp"
#include "mpm/material/elastic/rigid.hpp"

namespace sluice::mpm {

// What particles that carry their corners cannot be, and what objects say in vain of parts at their
// surfaces, as corners are moved onto these.
static void check_carried_corners(const MpmScene& s, std::vector<Fault>& faults) {
  if (!s.carries_corners()) return;
  if (s.refine_particles)
    add_not_built(faults, s.splits.front().where, "<refine_particles> with a fluid");
  for (const SolidMaterial& material : s.materials)
    for (const SeedObject& object : material.objects)
      if (object.cut_cells || object.filling_levels != 1)
        add_warning(faults, object.where,
                    "<cut_cells> and <numLevelsParticleFilling> have no effect with the "
                    "interpolator carried_corners: corners are moved onto the surface",
                    "remove them");
}

namespace {

// The components rmpmice and rigidmpmice: solids go with their own velocity, whatever their law.
void make_all_rigid(const DeckNode& root, MpmScene& s) {
  const DeckNode* component = root.child("SimulationComponent");
  std::string type = component == nullptr ? "" : component->attribute("type").value_or("");
  std::transform(type.begin(), type.end(), type.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (type != "rmpmice" && type != "rigidmpmice") return;
  for (SolidMaterial& m : s.materials) {
    m.rigid = true;
    if (m.law != nullptr) m.law = make_rigid(m.law->bulk_modulus());
  }
}

// The component sfmpm. Rules of masters act on what all share; others have nothing to act on.
void share_velocities(MpmScene& s, std::vector<Fault>& faults) {
  std::erase_if(s.contacts, [&](const ContactRule& c) {
    const bool by_master = c.kind == ContactKind::specified;
    if (!by_master && c.kind != ContactKind::single_velocity)
      add_warning(
          faults, c.where,
          "<contact> " + c.type + " has no effect: all materials of sfmpm have one velocity");
    return !by_master;
  });
  if (s.materials.size() < 2) return;
  ContactRule all;
  all.kind = ContactKind::single_velocity;
  all.type = "single_velocity";
  s.contacts.insert(s.contacts.begin(), all);
}

}  // namespace

MpmScene read_mpm_scene(const Deck& deck, const Scene& scene, std::vector<Fault>& faults) {
  MpmScene s;
  s.moves_along = scene.grid.levels.front().active;
  const DeckNode& root = *deck.root;
  const GeometryReader geometry(root, faults);
  // Materials of solids come first among those of the scene.
  for (const DeckNode* node : mpm_materials(root))
    s.materials.push_back(read_material(*node, static_cast<int>(s.materials.size()),
                                        scene.constants, runs_pore_water(root), geometry, faults));
  make_all_rigid(root, s);
  read_flags(root, s, faults);
  check_carried_corners(s, faults);
  const bool zones = boolean_or(root.child("MPM") != nullptr ? *root.child("MPM") : root,
                                "use_cohesive_zones", false);
  for (const DeckNode* properties : root.all("MaterialProperties"))
    if (const DeckNode* block = properties->child("MPM")) {
      read_contacts(*block, s, faults);
      if (zones) read_cohesive_zones(*block, s, faults);
    }
  read_grains(root, s, faults);
  if (runs_single_field(root)) share_velocities(s, faults);
  // All that deforms has one velocity at a node: what is left are rigid bodies.
  if (s.implicit) {
    std::erase_if(s.contacts,
                  [](const ContactRule& c) { return c.kind != ContactKind::specified; });
    s.rigid_contacts = std::move(s.contacts);
    s.contacts.clear();
  }
  read_loads(root, geometry, s, faults);
  read_boundaries(scene, s, faults);
  read_lost_energy(root, s, faults);
  return s;
}

}  // namespace sluice::mpm
