// Which effects a scene calls for, and why.
#include <fmt/format.h>

#include "ice/ice.hpp"

namespace sluice::ice {

bool matches_fluxes(const Scene& scene, const IceScene& ice) {
  return !ice.classic || scene.refinement.reflux;
}

EffectList find_effects(const Scene& scene, const IceScene& ice) {
  EffectList e;
  const IceMaterial& m = ice.materials.front();
  const bool gravity = !(scene.constants.gravity == Vec3{});
  e.add({"flow", true,
         ice.classic ? "classic scheme: one stage, internal energy"
                     : "conservative scheme: Lagrangian phase and remap",
         ice.scheme_where});
  e.add({"second order", ice.second_order,
         ice.second_order ? "<advection type=\"SecondOrder\">" : "<advection type=\"FirstOrder\">",
         ice.advection_where});
  e.add({"gravity", gravity, gravity ? "<gravity> is not zero" : "<gravity> is zero",
         ice.gravity_where});
  e.add({"viscous stress", m.viscosity > 0, fmt::format("dynamic_viscosity is {:g}", m.viscosity),
         m.viscosity_where});
  bool open = false;
  const Level& level = scene.grid.levels.front();
  for (std::size_t d = 0; d < 3; ++d) open = open || (level.active[d] && !level.periodic[d]);
  e.add({"boundary account",
         open,
         !open ? "every active direction is periodic"
               : "what passes through the boundary is counted for the conservation report",
         {}});
  const bool refined = scene.grid.levels.size() > 1;
  const bool unequal = refined && !matches_fluxes(scene, ice);
  e.add({"flux record", refined && !unequal,
         unequal   ? "do_Refluxing is false, and the scheme classic: levels do not conserve"
         : refined ? "levels meet: what passes their faces is made equal"
                   : "one level",
         unequal ? scene.refinement.reflux_where : Location{}});
  e.add({"saved intermediates", true, "only in steps that save them", scene.output.where});
  e.add({"diagnostics", true, "only in steps that save or analyse", scene.output.where});
  e.add({"heat conduction", false, "thermal_conductivity is zero", {}});
  e.add({"pressure equilibration", false, "one material: its own equation of state", m.where});
  e.add({"momentum exchange", false,
         ice.exchange_written ? "one material: the coefficients have nobody to act on"
                              : "one material",
         ice.exchange_where});
  e.add({"heat exchange", false,
         ice.exchange_written ? "one material: the coefficients have nobody to act on"
                              : "one material",
         ice.exchange_where});
  e.add({"turbulence", false, "no <turbulence> in the deck", {}});
  e.add({"scalars", false, "no <Models> in the deck", {}});
  e.add({"reactions", false, "no <Models> in the deck", {}});
  return e;
}

}  // namespace sluice::ice
