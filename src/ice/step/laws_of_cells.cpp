#include "ice/step/laws_of_cells.hpp"

#include <algorithm>

#include "models/scalars/transported_scalar.hpp"

namespace sluice::ice {

LawsOfCells::LawsOfCells(TaskBuilder& task, TaskList& list, const SchemeOptions& o, When when,
                         Stencil stencil)
    : fluids_(o.materials.mixture ? o.materials.fluids : std::vector{o.materials.fluid}),
      first_(o.materials.mixture ? 0 : o.materials.index),
      gas_(o.materials.mixed) {
  if (gas_ == nullptr) return;
  for (const models::TransportedScalar* f : fractions_of(o))
    fractions_.push_back(task.read(when == When::old_state
                                       ? list.old_state(f->state(), f->material, 1)
                                       : list.new_state(f->state(), f->material, 1),
                                   stencil));
}

std::vector<const models::TransportedScalar*> fractions_of(const SchemeOptions& o) {
  std::vector<const models::TransportedScalar*> all;
  for (const std::string& name : o.materials.mixed->fractions)
    all.push_back(&*std::find_if(o.materials.scalars.begin(), o.materials.scalars.end(),
                                 [&](const auto& s) { return s.name == name; }));
  return all;
}

const models::TransportedScalar& fraction_of(const SchemeOptions& o) {
  return *fractions_of(o).front();
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
