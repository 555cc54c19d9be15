// How a deck says ADD_HEAT and fixedPressureGradient.
#include "ice/deck/body_sources.hpp"

#include <fmt/format.h>

#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "ice/deck/schema.hpp"

namespace sluice::ice {
namespace {

constexpr const char* force_tags[3] = {"x_dir", "y_dir", "z_dir"};

}  // namespace

std::vector<TagSpec> body_source_tags() {
  TagSpec force = tag("fixedPressureGradient",
                      "force per volume on the whole mixture, the same everywhere: drives flow "
                      "through periodic channels");
  for (const char* name : force_tags)
    force = force.child(
        tag(name, "component of the force").real().unit("pressure/length").by_default("0"));
  return {tag("ADD_HEAT", "heat source in materials everywhere")
              .with_children(
                  {tag("add_heat_matls", "indices of the materials").once().integers().at_least(0),
                   tag("add_heat_coeff", "power per mass, one number per material")
                       .once()
                       .reals()
                       .unit("power/mass"),
                   tag("add_heat_t_start", "start time").once().real().unit("time"),
                   tag("add_heat_t_final", "until when").once().real().unit("time")}),
          force};
}

void check_body_sources(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* heat = runs_ice(root) ? root.find("CFD/ICE/ADD_HEAT") : nullptr;
  if (heat == nullptr) return;
  const DeckNode *list = heat->child("add_heat_matls"), *powers = heat->child("add_heat_coeff");
  if (list == nullptr || powers == nullptr) return;
  const auto materials = parse_integers(list->text).value;
  const auto coefficients = parse_reals(powers->text).value;
  const auto count = solid_material_count(root) + static_cast<int>(ice_materials(root).size());
  if (!materials || !coefficients || count == 0) return;
  for (const int m : *materials)
    if (m >= count)
      add_error(faults, list->where,
                fmt::format("<add_heat_matls>: there is no material {}: the deck has {}, counted "
                            "from 0",
                            m, count));
  if (materials->size() != coefficients->size())
    add_error(faults, powers->where,
              fmt::format("<add_heat_coeff> has {} number{} for {} material{} of <add_heat_matls>",
                          coefficients->size(), coefficients->size() == 1 ? "" : "s",
                          materials->size(), materials->size() == 1 ? "" : "s"),
              "one number per material, in the same order");
  const auto start = real_of(heat, "add_heat_t_start"), stop = real_of(heat, "add_heat_t_final");
  if (start && stop && *start >= *stop)
    add_error(
        faults, heat->child("add_heat_t_final")->where,
        fmt::format(
            "add_heat_t_final {:g} is not after add_heat_t_start {:g}: no heat would be added",
            *stop, *start));
}

std::vector<models::AddedHeat> read_added_heat(const DeckNode& ice) {
  std::vector<models::AddedHeat> list;
  const DeckNode* node = ice.child("ADD_HEAT");
  if (node == nullptr) return list;
  const auto materials = parse_integers(node->child("add_heat_matls")->text).value;
  const auto powers = parse_reals(node->child("add_heat_coeff")->text).value;
  for (std::size_t i = 0; i < materials->size(); ++i) {
    models::AddedHeat heat;
    heat.material = (*materials)[i];
    heat.power = (*powers)[i];
    heat.when = {node->real("add_heat_t_start"), node->real("add_heat_t_final")};
    heat.where = node->where;
    list.push_back(heat);
  }
  return list;
}

DrivingForce read_driving_force(const DeckNode& ice) {
  DrivingForce force;
  const DeckNode* node = ice.child("fixedPressureGradient");
  if (node == nullptr) return force;
  force.where = node->where;
  for (int d = 0; d < 3; ++d) force.force[d] = real_or(*node, force_tags[d], 0);
  return force;
}

}  // namespace sluice::ice
