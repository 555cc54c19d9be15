// Which effects a scene calls for, and why.
#include <fmt/format.h>

#include <algorithm>

#include "ice/fluid_part.hpp"
#include "ice/step/scheme_options.hpp"

namespace sluice::ice {

bool matches_fluxes(const Scene& scene, const IceScene& ice) {
  return !ice.internal_energy_form || scene.refinement.reflux;
}

namespace {

std::string called(const IceMaterial& m) {
  return m.name.empty() ? fmt::format("material {}", m.index) : m.name;
}

// A coefficient that each material has: on where one of them is above zero.
Effect by_material(const char* effect, const char* tag, const IceScene& ice,
                   double IceMaterial::*value, Location IceMaterial::*where) {
  std::string reason;
  const IceMaterial* first = nullptr;
  for (const IceMaterial& m : ice.materials) {
    if (first == nullptr && m.*value > 0) first = &m;
    reason +=
        reason.empty() ? fmt::format("{} is {:g}", tag, m.*value) : fmt::format(", {:g}", m.*value);
    if (ice.materials.size() > 1) reason += fmt::format(" ({})", called(m));
  }
  const IceMaterial& shown = first != nullptr ? *first : ice.materials.front();
  return {effect, first != nullptr, reason, shown.*where};
}

Effect viscous_stress(const IceScene& ice) {
  Effect e = by_material("viscous stress", "dynamic_viscosity", ice, &IceMaterial::viscosity,
                         &IceMaterial::viscosity_where);
  const bool several = ice.materials.size() > 1;
  for (const IceMaterial& m : ice.materials) {
    const ViscosityModels& models = m.viscosity_models;
    if (!models.any()) continue;
    e.line = models.where;
    e.on = true;
    const std::string of = several ? fmt::format(" ({})", called(m)) : "";
    if (models.sutherland)
      e.reason = several ? e.reason + ", Sutherland's law" + of : "Sutherland's law";
    if (!models.sponges.empty())
      e.reason += fmt::format(", {} sponge layer{}{}", models.sponges.size(),
                              models.sponges.size() == 1 ? "" : "s", of);
  }
  if (ice.turbulence) e.reason += ", subgrid viscosity";
  if (!ice.wall_shear.empty())
    e.reason += fmt::format(", wall law on {} side{}", ice.wall_shear.size(),
                            ice.wall_shear.size() == 1 ? "" : "s");
  if (!e.on && ice.materials.front().subgrid) {
    e.on = true;
    e.line = ice.turbulence ? ice.turbulence->where : ice.wall_shear.front().where;
  }
  return e;
}

Effect conduction(const IceScene& ice) {
  Effect e = by_material("heat conduction", "thermal_conductivity", ice, &IceMaterial::conductivity,
                         &IceMaterial::conductivity_where);
  const auto& x = ice.exchange.convective;
  if (x && ice.materials.size() > 1 && std::min(x->fluid, x->solid) >= ice.solids) {
    if (!e.on) e.line = x->where;
    e.on = true;
    e.reason += fmt::format(", convective exchange of materials {} and {}", x->fluid, x->solid);
  }
  for (const models::TransportedScalar& s : ice.models.scalars) {
    if (!ice.models.mixed || !ice.models.mixed->is_fraction(s.name) || s.diffusivity == 0) continue;
    if (!e.on) e.line = s.diffusivity_where;
    e.on = true;
    e.reason += fmt::format(", enthalpy transported by diffusion of {}", s.name);
  }
  if (!ice.turbulence) return e;
  if (!e.on) e.line = ice.turbulence->where;
  e.on = true;
  e.reason += fmt::format(", subgrid heat flux of Prandtl number {:g}", ice.turbulence->prandtl);
  return e;
}

Effect turbulence(const IceScene& ice) {
  if (!ice.turbulence) return {"turbulence", false, "no <turbulence> in the deck", {}};
  const Turbulence& t = *ice.turbulence;
  return {"turbulence", true,
          t.dynamic ? "Germano: the constant from the flow"
                    : fmt::format("Smagorinsky with C_s = {:g}", t.constant),
          t.where};
}

// The coefficients of all pairs, "1e+10 (0-1), 0 (0-2)".
std::string pairs_text(const PairCoefficients& k) {
  std::string text;
  for (int m = 0; m < k.materials(); ++m)
    for (int n = m + 1; n < k.materials(); ++n)
      text += fmt::format("{}{:g} ({}-{})", text.empty() ? "" : ", ", k(m, n), m, n);
  return text;
}

Effect exchange(const char* effect, const PairCoefficients& k, const IceScene& ice,
                const Location& where) {
  const char* grows = k.varies() ? ", larger between unequal masses" : "";
  const ExchangeSettings& x = ice.exchange;
  if (ice.materials.size() < 2)
    return {effect, false,
            x.written ? "one material: the coefficients have no effect" : "one material", x.where};
  if (!x.written) return {effect, false, "no <exchange_coefficients> in the deck", {}};
  return {effect, k.any(), fmt::format("coefficients {}{}", pairs_text(k), grows), where};
}

void add_exchange(const IceScene& ice, EffectList& e) {
  const std::size_t count = ice.materials.size();
  const bool several = count > 1;
  e.add({"pressure equilibration", several,
         several ? fmt::format("{} materials: common pressure where they share a cell", count)
                 : std::string("one material: its own equation of state"),
         several ? ice.materials[1].where : ice.materials.front().where});
  const std::optional<MultiVelocityExchange>& slip = ice.exchange.slip;
  const auto name_of = [&](int m) { return called(ice.materials[m]); };
  Effect momentum =
      exchange("momentum exchange", ice.exchange.momentum, ice, ice.exchange.momentum_location);
  if (momentum.on && ice.one_velocity())
    momentum.reason += fmt::format("; all at least {:g}: one velocity, nothing to compute",
                                   one_velocity_coefficient);
  if (!ice.one_velocity()) {
    momentum.on = true;
    momentum.reason += fmt::format("; not all at least {:g}: one velocity per material{}",
                                   one_velocity_coefficient,
                                   ice.solids > 0 ? ", but a common velocity in cut cells" : "");
  }
  if (several && slip && slip->use_slip_coefficients)
    momentum.reason +=
        fmt::format("; {} slips along {}", name_of(slip->fluid), name_of(slip->solid));
  e.add(momentum);
  Effect heat = exchange("heat exchange", ice.exchange.heat, ice, ice.exchange.heat_location);
  if (heat.on) heat.reason += ", in the update";
  e.add(heat);
}

// What adds mass, momentum or energy to cells. It acts in the update; its task is the account.
Effect sources(const IceScene& ice) {
  std::string reason;
  Location where = ice.models.where;
  bool on = false;
  const auto name = [&](const std::string& text, bool acts, const Location& place) {
    reason += (reason.empty() ? "" : ", ") + text;
    if (acts && !on) where = place;
    on = on || acts;
  };
  const auto material = [&](int m) { return called(ice.materials[m]); };
  for (const models::MassExchange& x : ice.models.mass_exchanges)
    if (x.by_pressure)
      name(fmt::format("{} burns to {} above {:g} Pa", material(x.from), material(x.to),
                       x.by_pressure->threshold_pressure),
           x.by_pressure->G > 0, x.where);
    else if (x.by_front)
      name(fmt::format("{} burns to {} behind a front at {:g} m/s", material(x.from),
                       material(x.to), x.by_front->D),
           true, x.where);
    else
      name(fmt::format("{} becomes {} at {:g}/s", material(x.from), material(x.to), x.rate),
           x.rate > 0, x.where);
  for (const models::FixedValues& f : ice.models.fixed_values)
    name(fmt::format("{} held at given values in a region", material(f.material)), true, f.where);
  for (const models::AddedHeat& h : ice.added_heat)
    name(fmt::format("{:g} W/kg to {}", h.power, material(h.material)), h.power != 0, h.where);
  if (ice.models.mixed && !ice.models.mixed->released.empty())
    name(fmt::format("{} releases heat where it mixes", material(ice.models.mixed->material)), true,
         ice.models.mixed->where);
  if (ice.models.mixed && ice.models.mixed->species)
    name(fmt::format("{} reactions of {} species",
                     ice.models.mixed->species->gas->mechanism().reactions.size(),
                     ice.models.mixed->species->gas->count()),
         ice.models.mixed->species->reacts, ice.models.mixed->where);
  if (reason.empty())
    reason = ice.models.where.line > 0 ? "no <Model> adds a source" : "no <Models>, no <ADD_HEAT>";
  else if (on)
    reason += ", in the update";
  return {"model sources", on, reason, where};
}

void add_scalars(const std::vector<models::TransportedScalar>& scalars, EffectList& e) {
  if (scalars.empty()) {
    e.add({"scalars", false, "no model of the deck brings any", {}});
    return;
  }
  std::string names;
  for (const models::TransportedScalar& s : scalars)
    names +=
        fmt::format("{}{} (diffusivity {:g})", names.empty() ? "" : ", ", s.name, s.diffusivity);
  e.add({"scalars", true, "advected with the mass: " + names, scalars.front().where});
}

// They are moved once a step is accepted, outside the graph.
Effect tracers(const IceScene& ice) {
  if (ice.models.tracers.empty())
    return {"tracer particles", false, "no <TracerParticles> in the deck", {}};
  std::string names;
  for (const models::TracerParticles& t : ice.models.tracers)
    names += fmt::format("{}{} in {}", names.empty() ? "" : ", ", t.name,
                         called(ice.materials[t.material]));
  return {"tracer particles", true, names + ", moved after each step",
          ice.models.tracers.front().where};
}

// Sound crosses many cells in a step, or it must not cross one.
Effect pressure_solve(const IceScene& ice) {
  if (!ice.implicit)
    return {"pressure solve", false, "no <ImplicitSolver>: steps are limited by sound", {}};
  const ImplicitSettings& s = *ice.implicit;
  return {"pressure solve", true,
          fmt::format("<ImplicitSolver>: {}, relative volume errors to {:g} in at most {} passes",
                      describe(s.linear), s.tolerance, s.max_passes),
          s.where};
}

// Strong shocks along the grid need it where rows lie beside each other.
Effect shock_shear(const Scene& scene, const IceScene& ice) {
  constexpr const char* name = "shear along shocks";
  if (shears_shocks(scene, ice))
    return {name, true,
            "more than one active direction: acts where pressure jumps by more than rho c^2/3 from "
            "cell to cell",
            ice.advection_where};
  if (!ice.shears_shocks)
    return {
        name, false,
        "shearAlongShocks=\"false\" in <advection>: a strong shock along the grid may break into "
        "rows",
        ice.advection_where};
  if (ice.internal_energy_form) return {name, false, "classic scheme", ice.scheme_where};
  if (ice.implicit) return {name, false, "with <ImplicitSolver>", ice.implicit->where};
  return {name, false, "one active direction: no face is tangential to a shock", {}};
}

}  // namespace

EffectList find_effects(const Scene& scene, const IceScene& ice) {
  EffectList e;
  const bool gravity = !(scene.constants.gravity == Vec3{});
  e.add({"flow", true,
         ice.internal_energy_form ? "classic scheme: one stage, internal energy"
                                  : "conservative scheme: Lagrangian phase and remap",
         ice.scheme_where});
  e.add({ice.third_order ? "third order" : "second order", ice.second_order,
         ice.third_order    ? "<advection type=\"ThirdOrder\">: parabolas in all cells"
         : ice.second_order ? "<advection type=\"SecondOrder\">"
                            : "<advection type=\"FirstOrder\">",
         ice.advection_where});
  e.add({"gravity", gravity, gravity ? "<gravity> is not zero" : "<gravity> is zero",
         ice.gravity_where});
  e.add(viscous_stress(ice));
  bool open = false;
  const Level& level = scene.grid.levels.front();
  for (std::size_t d = 0; d < 3; ++d) open = open || (level.active[d] && !level.periodic[d]);
  e.add({"boundary account",
         open,
         !open ? "every active direction is periodic"
               : "fluxes through the boundary are recorded for the conservation report",
         {}});
  const bool refined = scene.grid.levels.size() > 1;
  const bool unequal = refined && !matches_fluxes(scene, ice);
  e.add({"flux record", refined && !unequal,
         unequal   ? "do_Refluxing is false, and the scheme classic: levels do not conserve"
         : refined ? "several levels: the fluxes between them are matched"
                   : "one level",
         unequal ? scene.refinement.reflux_where : Location{}});
  e.add({"saved intermediates", true, "only in steps that save them", scene.output.where});
  e.add({"diagnostics", true, "only in steps that save or analyse", scene.output.where});
  e.add(conduction(ice));
  add_exchange(ice, e);
  e.add(turbulence(ice));
  add_scalars(ice.models.scalars, e);
  const DrivingForce& f = ice.driving_force;
  e.add({"driving force", f.on(),
         f.on() ? fmt::format("<fixedPressureGradient> is [{:g}, {:g}, {:g}]", f.force.x, f.force.y,
                              f.force.z)
         : f.where.line > 0 ? "<fixedPressureGradient> is zero"
                            : "no <fixedPressureGradient> in the deck",
         f.where});
  e.add(sources(ice));
  e.add({"reactions", false,
         ice.models.where.line > 0 ? "no <Model> of a reaction" : "no <Models> in the deck",
         ice.models.where});
  e.add(tracers(ice));
  e.add(pressure_solve(ice));
  e.add(shock_shear(scene, ice));
  return e;
}

Effect open_faces(const IceScene& ice, const BoundaryFill& boundary) {
  if (boundary.wave_directions() == 0) return {"open faces", false, "no LODI face", {}};
  const int faces = boundary.open_faces();
  const LodiSettings& lodi = *ice.conditions.lodi;
  return {"open faces", true,
          faces > 0 ? fmt::format("LODI without vel_infinity: means over {} open part{} of faces, "
                                  "summed in a separate reduction",
                                  faces, faces == 1 ? "" : "s")
          : lodi.velocity_infinity ? "LODI with vel_infinity"
                                   : "LODI in one dimension: no velocity along the faces",
          lodi.where};
}

}  // namespace sluice::ice
