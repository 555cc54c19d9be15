// The components' tags put together; a new component adds one line.
#include "app/sluice_schema.hpp"

#include "app/exact_solution_tag.hpp"
#include "framework/deck/framework_schema.hpp"
#include "ice/deck/schema.hpp"

namespace sluice {

Schema sluice_schema() {
  Schema schema;
  add_framework_tags(schema);
  add_ice_tags(schema);
  describe_exact_solution(schema);
  return schema;
}

}  // namespace sluice
