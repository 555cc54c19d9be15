#include "ice/step/mixed_fraction.hpp"

#include <algorithm>

#include "models/transported_scalar.hpp"

namespace sluice::ice {

const models::TransportedScalar& fraction_of(const SchemeOptions& o) {
  return *std::find_if(o.scalars.begin(), o.scalars.end(),
                       [&](const auto& s) { return s.name == o.mixed->fraction; });
}

VariableId old_fraction(TaskList& list, const SchemeOptions& o) {
  const models::TransportedScalar& f = fraction_of(o);
  return list.old_state(f.state(), f.material, 1);
}

}  // namespace sluice::ice
