#include "ice/conditions/open_face.hpp"

#include "framework/deck/faults.hpp"
#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "ice/conditions/face_conditions.hpp"

namespace sluice::ice {
namespace {

TagSpec lodi_tag() {
  return tag("LODI", "far-field state of open faces: conditions of kind LODI")
      .with_children(
          {tag("press_infinity", "far-field pressure").once().real().above(0).unit("pressure"),
           tag("sigma", "coefficient of the relaxation of the pressure to it")
               .real()
               .at_least(0)
               .by_default("0.27"),
           tag("Li_scale", "factor of all incoming waves").real().at_least(0).by_default("1"),
           tag("vel_infinity",
               "far-field velocity, with rho_infinity: advects outgoing waves, and is the target "
               "of incoming ones; absent: advection with face averages, no relaxation")
               .vector(),
           tag("rho_infinity", "density to which inflow relaxes").real().above(0),
           tag("material", "accepted without effect").text(),
           tag("ice_material_index", "accepted without effect").integer()});
}

void check_block(const DeckNode& lodi, std::vector<Fault>& faults) {
  const DeckNode *velocity = lodi.child("vel_infinity"), *rho = lodi.child("rho_infinity");
  if ((velocity == nullptr) == (rho == nullptr)) return;
  add_error(faults, (velocity != nullptr ? *velocity : *rho).where,
            "<LODI>: vel_infinity and rho_infinity belong together; one of them is missing",
            "give both, or none");
}

LodiSettings read_lodi(const DeckNode& block) {
  LodiSettings s;
  s.press_infinity = block.real("press_infinity");
  s.sigma = real_or(block, "sigma", s.sigma);
  s.scale = real_or(block, "Li_scale", s.scale);
  if (block.child("vel_infinity") != nullptr)
    s.velocity_infinity = vector_or(block, "vel_infinity", {});
  if (const DeckNode* rho = block.child("rho_infinity")) s.rho_infinity = rho->as_real();
  s.where = block.where;
  return s;
}

}  // namespace

FaceCondition open_face_condition() {
  return {
      .word = "LODI",
      .variables = {"Pressure", "Density", "Temperature", "Velocity"},
      .block = lodi_tag(),
      .check_block = check_block,
      .read_settings = [](const DeckNode& block, FlowConditions& c) { c.lodi = read_lodi(block); },
      .apply =
          [](const Condition& c, int /*normal*/, const FlowConditions& settings, GhostRule& rule) {
            if (!settings.lodi) throw_missing_block(c, "LODI");
            rule.waves = true;
          }};
}

}  // namespace sluice::ice
