// From the deck's conditions of one boundary region to a ghost rule.
#include <fmt/format.h>

#include "framework/base/error.hpp"
#include "ice/boundary/ghost_rule.hpp"

namespace sluice::ice {

bool GhostRule::plain() const {
  return (velocity_kind == Velocity::mirror ||
          (velocity_kind == Velocity::copy && velocity_gradient == Vec3{})) &&
         !fixed_density && !fixed_pressure && !fixed_temperature && density_gradient == 0 &&
         pressure_gradient == 0 && temperature_gradient == 0;
}

namespace {

[[noreturn]] void refuse(const Condition& c) {
  throw InputError(fmt::format(
      "{}: boundary condition {} of {} is not built yet; built are Dirichlet, Neumann, symmetry, "
      "FreeSlipWall and computeFromDensity",
      to_string(c.where), c.kind_name, c.variable));
}

// Dirichlet or Neumann of a scalar into (fixed, value, gradient); symmetry leaves a mirror.
void scalar(const BoundaryRegion& region, int material, const char* variable, bool& fixed,
            double& value, double& gradient) {
  const Condition* c = region.find(variable, material);
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
      refuse(*c);
  }
}

}  // namespace

namespace {

// What a wall does to the gas does not depend on its density and temperature (no conduction yet).
GhostRule wall(GhostRule::Velocity kind, Vec3 velocity) {
  GhostRule rule;
  rule.velocity_kind = kind;
  rule.velocity = velocity;
  return rule;
}

}  // namespace

GhostRule make_rule(const BoundaryRegion& region, int material, int normal) {
  GhostRule rule;
  scalar(region, material, "Density", rule.fixed_density, rule.density, rule.density_gradient);
  scalar(region, material, "Temperature", rule.fixed_temperature, rule.temperature,
         rule.temperature_gradient);
  // The pressure is common to all materials: its conditions carry index 0.
  scalar(region, 0, "Pressure", rule.fixed_pressure, rule.pressure, rule.pressure_gradient);
  const Condition* u = region.find("Velocity", material);
  if (u == nullptr) return rule;
  switch (u->kind) {
    case ConditionKind::dirichlet:
      rule.velocity = u->vector;
      rule.velocity_kind =
          u->vector[normal] == 0 ? GhostRule::Velocity::wall : GhostRule::Velocity::prescribed;
      return rule;
    case ConditionKind::neumann:
      rule.velocity_gradient = u->vector;
      return rule;
    case ConditionKind::symmetry:
    case ConditionKind::free_slip_wall:
      return wall(GhostRule::Velocity::mirror, {});
    default:
      refuse(*u);
  }
}

}  // namespace sluice::ice
