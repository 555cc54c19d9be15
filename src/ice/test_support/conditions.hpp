// Boundary conditions as a deck would give them.
#pragma once
#include "framework/scene/boundary.hpp"

namespace sluice::ice {

inline Condition condition(const char* variable, ConditionKind kind, double value = 0,
                           int material = -1) {
  Condition c;
  c.variable = variable;
  c.kind = kind;
  c.material = material;
  c.has_value = true;
  c.value = value;
  c.vector = Vec3::all(value);
  return c;
}

inline Condition velocity(ConditionKind kind, Vec3 value, int material = -1) {
  Condition c = condition("Velocity", kind, 0, material);
  c.is_vector = true;
  c.vector = value;
  return c;
}

}  // namespace sluice::ice
