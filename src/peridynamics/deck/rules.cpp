// Rules over several tags of peridynamic solids.
#include <fmt/format.h>

#include <cmath>

#include "framework/deck/faults.hpp"
#include "framework/scene/deck_values.hpp"
#include "peridynamics/deck/schema.hpp"

namespace sluice::peridynamics {
namespace {

void check_moduli(const DeckNode& model, std::vector<Fault>& faults) {
  const std::string type = model.attribute("type").value_or("");
  const bool E = model.has("young_modulus"), nu = model.has("poisson_ratio");
  const bool K = model.has("bulk_modulus"), G = model.has("shear_modulus");
  if (type == "linear_elastic_bond") {
    if (E == K)
      add_error(faults, model.where,
                "<material_model type=\"linear_elastic_bond\"> needs one of <young_modulus> and "
                "<bulk_modulus>");
    return;
  }
  if (type != "linear_elastic_state") return;
  if (!(E && nu && !K && !G) && !(K && G && !E && !nu))
    add_error(faults, model.where,
              "<material_model type=\"linear_elastic_state\"> needs <bulk_modulus> and "
              "<shear_modulus>, or <young_modulus> and <poisson_ratio>");
}

void check_damage(const DeckNode& model, std::vector<Fault>& faults) {
  const std::string type = model.attribute("type").value_or("");
  const bool G = model.has("G_Ic"), s0 = model.has("s0");
  if (type == "spherical_strain_energy" && !G)
    add_error(faults, model.where, "<damage_model type=\"spherical_strain_energy\"> needs <G_Ic>");
  if (type == "spherical_strain_energy" && s0)
    add_error(faults, model.need("s0").where,
              "<s0> belongs to <damage_model type=\"critical_stretch\">");
  if (type == "critical_stretch" && G == s0)
    add_error(faults, model.where,
              "<damage_model type=\"critical_stretch\"> needs one of <s0> and <G_Ic>");
}

// Of point files: other components would read it in vain.
void refuse_displacements(const DeckNode& node, std::vector<Fault>& faults) {
  if (node.name == "var" && node.text == "p.displacement")
    add_error(faults, node.where,
              "<var> p.displacement of a point file is read by the component peridynamics only");
  for (const auto& child : node.children) refuse_displacements(*child, faults);
}

}  // namespace

void check_blocks(const DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_peridynamics(root)) {
    if (const DeckNode* solids = root.find("MaterialProperties/MPM"))
      refuse_displacements(*solids, faults);
    if (const DeckNode* block = root.find("MaterialProperties/Peridynamics"))
      add_error(faults, block->where,
                "<MaterialProperties><Peridynamics> belongs to the component peridynamics; other "
                "components run no peridynamic solids",
                "<SimulationComponent type=\"peridynamics\"/>, or remove the block");
    return;
  }
  for (const char* kind : {"MPM", "ICE"})
    if (const DeckNode* block = root.find(fmt::format("MaterialProperties/{}", kind)))
      add_error(faults, block->where,
                fmt::format("peridynamic solids together with materials of {} in one deck are not "
                            "supported",
                            kind),
                fmt::format("remove <MaterialProperties><{}>", kind));
  if (materials_of(root).empty())
    add_error(faults, root.child("SimulationComponent")->where,
              "the component peridynamics needs <MaterialProperties><Peridynamics><material>");
}

void check_materials(const DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_peridynamics(root)) return;
  for (const DeckNode* material : materials_of(root)) {
    if (const DeckNode* model = material->child("material_model")) check_moduli(*model, faults);
    if (const DeckNode* model = material->child("damage_model")) check_damage(*model, faults);
  }
}

}  // namespace sluice::peridynamics
