// Scalars outside the domain.
//
//   Dirichlet   the value; behind a wall 2 value - q of the mirrored cell, so that the value is on
//               the wall itself
//   Neumann     the nearest cell of the domain minus the gradient along the inward normal times the
//               distance (0: a copy)
//   others      (symmetry, LODI, none) a copy, or the mirrored cell where the flow is mirrored
// The released heat of a mixed gas needs no condition: where its fraction is given, what lies
// outside has given all the heat of that fraction. A ghost that holds nothing of the material holds
// nothing of the scalar.
#pragma once
#include <span>

#include "framework/field/array_view.hpp"
#include "framework/scene/boundary.hpp"
#include "models/scalars/transported_scalar.hpp"

namespace sluice::ice::scalars {

struct GhostRule {
  enum class Kind { copy, fixed, gradient, of_fraction };
  Kind kind = Kind::copy;
  double value = 0;  // of the scalar, in its unit; of Kind::gradient per m
};

// Of one region, for each scalar. InputError for conditions that are not built.
std::vector<GhostRule> make_rules(const BoundaryRegion& region,
                                  std::span<const models::TransportedScalar> scalars);

bool all_copied(const std::vector<GhostRule>& rules);

struct GhostViews {
  RealView scalar, mass;
};

// One ghost cell; `there`: it holds some of the material; `source`: the cell that it looks at,
// `distance`: between their centres, m.
void fill(const GhostRule& rule, const RealView& scalar, bool there, IntVec3 ghost, IntVec3 source,
          bool mirrored, double distance);

}  // namespace sluice::ice::scalars
