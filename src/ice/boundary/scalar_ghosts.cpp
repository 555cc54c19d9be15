// Ghosts of scalars.
#include "ice/boundary/scalar_ghosts.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sluice::ice::scalars {

std::vector<GhostRule> make_rules(const BoundaryRegion& region,
                                  std::span<const models::TransportedScalar> scalars) {
  std::vector<GhostRule> rules;
  for (const models::TransportedScalar& s : scalars) {
    GhostRule rule;
    if (const Condition* c = region.find(s.variable(), s.material)) {
      if (c->kind == ConditionKind::dirichlet) {
        rule = {GhostRule::Kind::fixed, c->value};
      } else if (c->kind == ConditionKind::neumann) {
        if (!c->zero_gradient()) rule = {GhostRule::Kind::gradient, c->value};
      } else if (c->kind != ConditionKind::symmetry && c->kind != ConditionKind::open_face) {
        throw InputError(fmt::format(
            "{}: boundary condition {} of {} is not supported; supported are Dirichlet, Neumann, "
            "symmetry and LODI",
            to_string(c->where), c->kind_name, c->variable));
      }
    } else if (s.plain_name && rules.back().kind != GhostRule::Kind::copy) {
      rule.kind = GhostRule::Kind::of_fraction;  // which stands before it
    }
    rules.push_back(rule);
  }
  return rules;
}

bool all_copied(const std::vector<GhostRule>& rules) {
  return std::all_of(rules.begin(), rules.end(),
                     [](const GhostRule& r) { return r.kind == GhostRule::Kind::copy; });
}

void fill(const GhostRule& rule, const RealView& scalar, bool there, IntVec3 ghost, IntVec3 source,
          bool mirrored, double distance) {
  double& at = scalar(ghost);
  double value = 0;
  if (there) {
    value = scalar(source);
    if (rule.kind == GhostRule::Kind::fixed)
      value = mirrored ? 2.0 * rule.value - value : rule.value;
    else if (rule.kind == GhostRule::Kind::gradient)
      value -= rule.value * distance;
  }
  // What is there already is not written: memory of absent materials stays untouched.
  if (at != value) at = value;
}

}  // namespace sluice::ice::scalars
