#include "ice/step/laws_of_cells.hpp"

#include <algorithm>

#include "models/transported_scalar.hpp"

namespace sluice::ice {

LawsOfCells::LawsOfCells(TaskBuilder& task, TaskList& list, const SchemeOptions& o, When when,
                         Stencil stencil)
    : fluids_(o.mixture ? o.fluids : std::vector{o.fluid}),
      first_(o.mixture ? 0 : static_cast<std::size_t>(o.material)),
      gas_(o.mixed) {
  if (gas_ == nullptr) return;
  fraction_ =
      task.read(when == When::old_state ? old_fraction(list, o) : new_fraction(list, o), stencil);
}

const models::TransportedScalar& fraction_of(const SchemeOptions& o) {
  return *std::find_if(o.scalars.begin(), o.scalars.end(),
                       [&](const auto& s) { return s.name == o.mixed->fraction; });
}

VariableId old_fraction(TaskList& list, const SchemeOptions& o) {
  const models::TransportedScalar& f = fraction_of(o);
  return list.old_state(f.state(), f.material, 1);
}

VariableId new_fraction(TaskList& list, const SchemeOptions& o) {
  const models::TransportedScalar& f = fraction_of(o);
  return list.new_state(f.state(), f.material, 1);
}

}  // namespace sluice::ice
