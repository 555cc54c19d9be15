// From the deck's conditions of one boundary region to a ghost rule.
#include <fmt/format.h>

#include <cmath>

#include "framework/base/error.hpp"
#include "ice/boundary/region_rules.hpp"
#include "ice/conditions/face_conditions.hpp"

namespace sluice::ice {

namespace {

[[noreturn]] void refuse(const Condition& c) {
  throw InputError(fmt::format("{}: boundary condition {} of {} is not supported; supported are {}",
                               to_string(c.where), c.kind_name, c.variable,
                               known_face_conditions()));
}

class RuleMaker {
 public:
  RuleMaker(const BoundaryRegion& region, int material, int normal,
            const FlowConditions& conditions)
      : region_(region), material_(material), normal_(normal), conditions_(conditions) {}

  GhostRule make() {
    scalar("Density", material_, rule_.fixed_density, rule_.density, rule_.density_gradient);
    scalar("Temperature", material_, rule_.fixed_temperature, rule_.temperature,
           rule_.temperature_gradient);
    // The pressure is common to all materials: its conditions carry index 0.
    scalar("Pressure", 0, rule_.fixed_pressure, rule_.pressure, rule_.pressure_gradient);
    specific_volume();
    WallHeat heat = rule_.heat;
    if (!heat.slip)
      heat = {rule_.fixed_temperature, false, rule_.temperature, rule_.temperature_gradient};
    rule_.heat = {};
    if (const Condition* u = region_.find("Velocity", material_)) {
      velocity(*u);
      if (rule_.mirrored() && u->kind != ConditionKind::symmetry) rule_.heat = heat;
    }
    return rule_;
  }

 private:
  // Kinds that the framework does not know.
  void special(const Condition& c) {
    const FaceCondition* kind = face_condition(c.kind_name);
    if (kind == nullptr || kind->apply == nullptr || !kind->is_for(c.variable)) refuse(c);
    kind->apply(c, normal_, conditions_, rule_);
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
        special(*c);
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

  void velocity(const Condition& u) {
    using Kind = GhostRule::Velocity;
    rule_.velocity = u.vector;
    switch (u.kind) {
      case ConditionKind::dirichlet:
        rule_.velocity_kind = u.vector[normal_] == 0 ? Kind::wall : Kind::prescribed;
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
        special(u);
    }
  }

  const BoundaryRegion& region_;
  int material_, normal_;
  const FlowConditions& conditions_;
  GhostRule rule_;
};

}  // namespace

GhostRule make_rule(const BoundaryRegion& region, int material, int normal,
                    const FlowConditions& conditions) {
  return RuleMaker(region, material, normal, conditions).make();
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
