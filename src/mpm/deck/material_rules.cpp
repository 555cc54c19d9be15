// What must hold between the materials of a deck of solids, their contacts and loads.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "framework/deck/faults.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/rule_tools.hpp"
#include "mpm/deck/schema.hpp"

namespace sluice::mpm {
namespace {

constexpr std::string_view no_velocity = "[0,0,0]";

// Blocks <MPM> of materials: one, unless a deck repeats <MaterialProperties>.
std::vector<const DeckNode*> material_blocks(const DeckNode& root) {
  std::vector<const DeckNode*> blocks;
  for (const DeckNode* properties : root.all("MaterialProperties"))
    if (const DeckNode* mpm = properties->child("MPM")) blocks.push_back(mpm);
  return blocks;
}

// Outputs and analyses find materials by name, the first of each.
void check_names(const std::vector<const DeckNode*>& materials, std::vector<Fault>& faults) {
  std::map<std::string, std::vector<const DeckNode*>> known;
  for (const DeckNode* material : materials)
    if (const auto name = material->attribute("name"); name && !name->empty())
      known[*name].push_back(material);
  for (const auto& [name, same] : known)
    if (same.size() > 1)
      add_warning(faults, same[1]->where,
                  fmt::format("{} materials are called '{}'; the name refers to the first, at {}",
                              same.size(), name, to_string(same[0]->where)),
                  "give each a different name");
}

void check_index(const DeckNode& parent, const char* name, int count, std::vector<Fault>& faults) {
  const auto index = integer_of(&parent, name);
  if (!index || *index < count || count == 0) return;
  add_error(faults, parent.child(name)->where,
            fmt::format("<{}>: there is no material {}: the deck has {}, counted from 0", name,
                        *index, count));
}

void check_object(const DeckNode& object, std::vector<Fault>& faults) {
  int pieces = 0;
  const DeckNode* file = nullptr;
  for (const auto& child : object.children) {
    if (!is_geometry_piece(child->name)) continue;
    ++pieces;
    if (child->name == "file") file = child.get();
  }
  if (file != nullptr && pieces > 1)
    add_error(faults, file->where,
              "<file> cannot be combined with other pieces in one <geom_object>: its points are "
              "the particles",
              "give it a separate <geom_object>");
  const auto levels = integer_of(&object, "numLevelsParticleFilling");
  if (is_true(&object, "cut_cells") && levels && (*levels < 0 || *levels > 1))
    add_error(faults, object.child("cut_cells")->where,
              "<cut_cells> and <numLevelsParticleFilling> both fill the surface",
              "remove one of them");
}

// Which equation of state a cell of the format sees, that fluids and solids share. Here they meet
// at the faces of particles, and the pressure in a cell is the fluid's alone.
void tell_of_cell_pressures(const DeckNode& material, std::vector<Fault>& faults) {
  const DeckNode* law = material.child("constitutive_model");
  if (law == nullptr) return;
  for (const char* name :
       {"useModifiedEOS", "useJWLEOS", "useJWLCEOS", "useMurnaghanEOS", "useBirchMurnaghanEOS"})
    if (is_true(law, name))
      add_warning(
          faults, law->child(name)->where,
          fmt::format("<{}> true has no effect: no solid shares the pressure of a cell", name),
          "solids act on the fluid by their stress, at their faces");
}

// Public decks name materials that they do not have.
void check_list(const DeckNode& list, const std::string& type, int count,
                std::vector<Fault>& faults) {
  const auto indices = parse_integers(list.text);
  if (!indices || count == 0 || type == "null") return;
  int known = 0;
  for (const int index : *indices.value) {
    known += index < count;
    if (index < count) continue;
    add_warning(faults, list.where,
                fmt::format("<materials>: there is no material {}: the deck has {}, counted from 0",
                            index, count),
                "remove it from the list");
  }
  // A master alone still moves as prescribed.
  if (known >= 2 || count == 1 || type.rfind("specified", 0) == 0) return;
  add_warning(
      faults, list.where,
      fmt::format("<contact> {} acts on {} material: there is no second material", type, known),
      "name two or more, or remove the block");
}

void check_contact(const DeckNode& contact, int count, std::vector<Fault>& faults) {
  const std::string type = contact.child("type") == nullptr ? "" : contact.child("type")->text;
  if (const DeckNode* list = contact.child("materials")) check_list(*list, type, count, faults);
  for (const char* name : {"master_material", "ExcludeMaterial"})
    check_index(contact, name, count, faults);
  const bool rubs = type.rfind("friction", 0) == 0 || type == "approach";
  if (rubs && type != "friction_LRVar" && contact.child("mu") == nullptr)
    add_error(faults, contact.where, fmt::format("<contact> {} needs <mu>", type),
              "write 0 for no friction");
  if (type == "friction_LRVar" && contact.child("variable_friction") == nullptr)
    add_error(faults, contact.where, "<contact> friction_LRVar needs <variable_friction>");
  // The default is what the deck of an archive writes.
  if (contact.has("velocity_after_stop") && contact.child("stop_time") == nullptr &&
      contact.child("velocity_after_stop")->text != no_velocity)
    add_warning(faults, contact.child("velocity_after_stop")->where,
                "<velocity_after_stop> has no effect without <stop_time>", "give the time");
}

// Times of a curve rise.
void check_curve(const DeckNode& curve, int count, std::vector<Fault>& faults) {
  check_index(curve, "material", count, faults);
  std::optional<double> before;
  for (const DeckNode* point : curve.all("time_point")) {
    const auto time = real_of(point, "time");
    if (time && before && !(*time > *before))
      add_error(
          faults, point->where,
          fmt::format("<time_point>: time {:g} is not after the one before, {:g}", *time, *before),
          "list points by increasing time");
    before = time;
  }
}

}  // namespace

void check_solid_materials(const DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_solids(root)) return;
  const auto materials = mpm_materials(root);
  check_names(materials, faults);
  bool filled = materials.empty();
  for (const DeckNode* material : materials) {
    const auto on = real_of(material, "activation_time"),
               off = real_of(material, "deactivation_time");
    if (on && off && *off <= *on)
      add_error(
          faults, material->child("deactivation_time")->where,
          fmt::format("<deactivation_time> {:g} is not after <activation_time> {:g}", *off, *on));
    const DeckNode* active = material->child("is_active");
    const bool sleeps = active != nullptr && active->text == "false";
    if (sleeps && !runs_mpm(root))
      add_not_built(faults, active->where, "<is_active> false with a fluid");
    constexpr double of_silent_decks = 1e8;
    if (off && *off < of_silent_decks && !runs_mpm(root))
      add_not_built(faults, material->child("deactivation_time")->where,
                    "<deactivation_time> with a fluid");
    if (is_true(material, "is_force_transmitting_material") && !runs_mpm(root))
      add_not_built(faults, material->child("is_force_transmitting_material")->where,
                    "<is_force_transmitting_material> with a fluid");
    if (on && *on > 0 && !sleeps)
      add_warning(faults, material->child("activation_time")->where,
                  fmt::format("<activation_time> {:g} has no effect: the material is active from "
                              "the start",
                              *on),
                  "add <is_active>false</is_active>");
    tell_of_cell_pressures(*material, faults);
    for (const DeckNode* object : material->all("geom_object")) check_object(*object, faults);
    filled = filled || material->child("geom_object") != nullptr;
  }
  if (!filled)
    add_error(faults, materials.front()->where,
              "no material has a <geom_object>: there would be no particle");
}

void check_contacts(const DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_solids(root)) return;
  const int count = static_cast<int>(mpm_materials(root).size());
  for (const DeckNode* block : material_blocks(root))
    for (const DeckNode* contact : block->all("contact")) check_contact(*contact, count, faults);
}

void check_loads(const DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_solids(root)) return;
  const int count = static_cast<int>(mpm_materials(root).size());
  const DeckNode* loads = root.find("PhysicalBC/MPM");
  const bool used = is_true(root.child("MPM"), "use_load_curves");
  if (loads == nullptr) {
    if (used)
      add_warning(faults, root.find("MPM/use_load_curves")->where,
                  "<use_load_curves> is true, and the deck has no <PhysicalBC><MPM>",
                  "remove the flag, or give loads");
    return;
  }
  if (!used && !loads->children.empty())
    add_warning(faults, loads->where, "<PhysicalBC> has no effect: <use_load_curves> is not true",
                "write <use_load_curves>true</use_load_curves> in <MPM>");
  std::map<int, const DeckNode*> ids;
  for (const auto& load : loads->children) {
    const DeckNode* curve = load->child("load_curve");
    if (curve == nullptr) continue;
    check_curve(*curve, count, faults);
    const auto id = integer_of(curve, "id");
    if (!id) continue;
    const auto [first, fresh] = ids.emplace(*id, curve);
    if (!fresh)
      add_error(faults, curve->child("id")->where,
                fmt::format("a second load curve {}; the first is at {}", *id,
                            to_string(first->second->where)),
                "number them one by one");
  }
}

}  // namespace sluice::mpm
