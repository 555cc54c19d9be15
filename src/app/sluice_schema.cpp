// The tags of the framework and of all components put together.
#include "app/sluice_schema.hpp"

#include "app/components.hpp"
#include "app/exact_solution_tag.hpp"
#include "framework/deck/framework_schema.hpp"
#include "framework/solve/solver_tags.hpp"

namespace sluice {

Schema sluice_schema() {
  Schema schema;
  add_framework_tags(schema);
  solve::add_solver_tag(schema);
  for (const ComponentKind& kind : component_kinds())
    if (kind.add_tags != nullptr) kind.add_tags(schema);
  describe_exact_solution(schema);
  return schema;
}

}  // namespace sluice
