// From the deck's conditions of one boundary region to a ghost rule.
#include <fmt/format.h>

#include <cmath>

#include "framework/base/error.hpp"
#include "ice/boundary/ghost_rule.hpp"

namespace sluice::ice {

bool GhostRule::plain() const {
  return (velocity_kind == Velocity::mirror ||
          (velocity_kind == Velocity::copy && velocity_gradient == Vec3{})) &&
         !fixed_density && !fixed_pressure && !fixed_temperature && density_gradient == 0 &&
         pressure_gradient == 0 && temperature_gradient == 0 && !sine_pressure &&
         !vortex_pressure && !waves;
}

SideKind GhostRule::side_kind() const {
  if (mirrored()) return SideKind::wall;
  if (waves) return SideKind::open;
  if (vortex_pressure) return SideKind::pressure;  // and the velocity: as between cells
  if (velocity_kind != Velocity::copy) return SideKind::velocity;
  const bool given =
      fixed_pressure || sine_pressure || vortex_pressure || (fixed_density && fixed_temperature);
  return given ? SideKind::pressure : SideKind::copied;
}

namespace {

[[noreturn]] void refuse(const Condition& c) {
  throw InputError(fmt::format(
      "{}: boundary condition {} of {} is not supported yet; supported are Dirichlet, Neumann, "
      "symmetry, FreeSlipWall, computeFromDensity, LODI, Sine, powerLawProfile, logLawProfile, "
      "MMS_1, slip and creep",
      to_string(c.where), c.kind_name, c.variable));
}

class RuleMaker {
 public:
  RuleMaker(const BoundaryRegion& region, int material, const FlowConditions& conditions)
      : region_(region), material_(material), conditions_(conditions) {}

  GhostRule make(int normal) {
    scalar("Density", material_, rule_.fixed_density, rule_.density, rule_.density_gradient);
    scalar("Temperature", material_, rule_.fixed_temperature, rule_.temperature,
           rule_.temperature_gradient);
    // The pressure is common to all materials: its conditions carry index 0.
    scalar("Pressure", 0, rule_.fixed_pressure, rule_.pressure, rule_.pressure_gradient);
    specific_volume();
    WallHeat heat{rule_.fixed_temperature, false, rule_.temperature, rule_.temperature_gradient};
    if (slip_temperature_) heat = {true, true, *slip_temperature_, 0};
    if (const Condition* u = region_.find("Velocity", material_)) {
      velocity(*u, normal);
      if (rule_.mirrored() && u->kind != ConditionKind::symmetry) rule_.heat = heat;
    }
    return rule_;
  }

 private:
  template <class Block>
  void need(const std::optional<Block>& block, const Condition& c, const char* tag) const {
    if (!block)
      throw InputError(fmt::format("{}: {} of {} needs the block <{}> in <BoundaryConditions>",
                                   to_string(c.where), c.kind_name, c.variable, tag));
  }
  // LODI, Sine: what kind of condition has no value of its own.
  bool special(const Condition& c) {
    if (c.kind_name == "LODI") {
      need(conditions_.lodi, c, "LODI");
      rule_.waves = true;
    } else if (c.kind_name == "Sine") {
      need(conditions_.sine, c, "SINE_BC");
      // The temperature follows from pressure and density.
      if (c.variable == "Pressure") rule_.sine_pressure = true;
      if (c.variable == "Density") refuse(c);
    } else if (c.kind_name == "MMS_1" && c.variable != "Density") {
      if (!conditions_.vortices)
        throw InputError(
            fmt::format("{}: MMS_1 of {} needs <manufacturedSolution type=\"mms_1\"> in "
                        "<customInitialization>",
                        to_string(c.where), c.variable));
      if (c.variable == "Pressure") rule_.vortex_pressure = true;
    } else if (c.kind_name == "slip" && c.variable == "Temperature") {
      need(conditions_.slip, c, "microSlip");
      slip_temperature_ = c.value;
    } else {
      return false;
    }
    return true;
  }

  // Dirichlet or Neumann of a scalar into (fixed, value, gradient); symmetry leaves a mirror.
  void scalar(const char* variable, int material, bool& fixed, double& value, double& gradient) {
    const Condition* c = region_.find(variable, material);
    if (c == nullptr) return;
    switch (c->kind) {
      case ConditionKind::dirichlet:
        fixed = true;
        value = c->value;
        return;
      case ConditionKind::neumann:
        gradient = c->value;
        return;
      case ConditionKind::symmetry:
        return;
      default:
        if (!special(*c)) refuse(*c);
    }
  }

  // It follows from the density and what fills the cell, unless a value stands beside a density.
  void specific_volume() {
    const Condition* c = region_.find("SpecificVol", material_);
    if (c == nullptr || c->kind == ConditionKind::compute_from_density ||
        c->kind == ConditionKind::symmetry)
      return;
    const bool copied = c->kind == ConditionKind::neumann && c->value == 0;
    if (copied) return;
    if (c->kind == ConditionKind::neumann)
      throw InputError(
          fmt::format("{}: SpecificVol has the gradient {:g}, but it follows from the density; "
                      "write computeFromDensity, and the gradient at Density",
                      to_string(c->where), c->value));
    if (c->kind != ConditionKind::dirichlet) refuse(*c);
    if (!rule_.fixed_density)
      throw InputError(fmt::format(
          "{}: SpecificVol is given without the Density of the same material; add the Density, or "
          "write computeFromDensity",
          to_string(c->where)));
    rule_.specific_volume = c->value;
  }

  void velocity(const Condition& u, int normal) {
    using Kind = GhostRule::Velocity;
    rule_.velocity = u.vector;
    switch (u.kind) {
      case ConditionKind::dirichlet:
        rule_.velocity_kind = u.vector[normal] == 0 ? Kind::wall : Kind::prescribed;
        // No wave passes a wall.
        if (rule_.mirrored()) rule_.waves = false;
        return;
      case ConditionKind::neumann:
        rule_.velocity_gradient = u.vector;
        return;
      case ConditionKind::symmetry:
      case ConditionKind::free_slip_wall:
        // What a wall does to the gas does not depend on its density, and on its temperature
        // through conduction only.
        rule_ = {};
        rule_.velocity_kind = Kind::mirror;
        return;
      default:
        break;
    }
    if (u.kind_name == "powerLawProfile" || u.kind_name == "logLawProfile") {
      need(conditions_.profile, u, "inletVelocity");
      rule_.velocity_kind = u.kind_name == "powerLawProfile" ? Kind::power_law : Kind::log_law;
      if (rule_.velocity_kind == Kind::log_law && !(conditions_.profile->roughness > 0))
        throw InputError(
            fmt::format("{}: a logLawProfile needs <roughness> above 0", to_string(u.where)));
      return;
    }
    if (u.kind_name == "slip" || u.kind_name == "creep") {
      need(conditions_.slip, u, "microSlip");
      if (u.vector[normal] != 0)
        throw InputError(fmt::format(
            "{}: {} is for walls, but this velocity has {:g} across the face; write 0 there",
            to_string(u.where), u.kind_name, u.vector[normal]));
      rule_.velocity_kind = Kind::slip;
      rule_.creep = conditions_.slip->creep || u.kind_name == "creep";
      rule_.waves = false;
      return;
    }
    if (!special(u)) refuse(u);
    if (u.kind_name == "Sine") rule_.velocity_kind = Kind::sine;
    if (u.kind_name == "MMS_1") rule_.velocity_kind = Kind::vortices;
  }

  const BoundaryRegion& region_;
  int material_;
  const FlowConditions& conditions_;
  GhostRule rule_;
  std::optional<double> slip_temperature_;  // of the wall
};

}  // namespace

GhostRule make_rule(const BoundaryRegion& region, int material, int normal,
                    const FlowConditions& conditions) {
  return RuleMaker(region, material, conditions).make(normal);
}

GhostRule make_gas_rule(const BoundaryRegion& region, int material, int normal,
                        const FlowConditions& conditions) {
  const GhostRule rule = make_rule(region, material, normal, conditions);
  const double filled = rule.density * rule.specific_volume;
  if (rule.specific_volume > 0 && !(std::fabs(filled - 1.0) <= unfilled))
    throw InputError(fmt::format(
        "{}: {}: the only material fills {:.9g} of a cell, not all of it: SpecificVol is not "
        "1/Density; write computeFromDensity",
        to_string(region.where), region.name, filled));
  return rule;
}

}  // namespace sluice::ice
