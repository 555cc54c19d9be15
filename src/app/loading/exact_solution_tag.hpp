// How decks name their exact solution: <Meta><exact_solution type="riemann"> with its parameters.
#pragma once
#include "framework/deck/schema.hpp"

namespace sluice {

// Adds the tag and the rule that the solution can be made from what it says.
void describe_exact_solution(Schema& schema);

}  // namespace sluice
