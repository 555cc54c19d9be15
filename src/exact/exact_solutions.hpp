// The table of exact solutions: how decks name them, their parameters, and how one is made.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "exact/base/exact_solution.hpp"
#include "exact/base/solution_parameters.hpp"

namespace sluice::exact {

// One parameter of a kind of solution, for help texts.
struct ParameterHelp {
  std::string name, meaning;
};
struct SolutionHelp {
  std::string type, meaning;
  std::vector<ParameterHelp> parameters;
};

// Every kind that make_exact_solution knows.
const std::vector<SolutionHelp>& exact_solution_help();

// Builds the solution that a deck names by <Meta><exact_solution type="..."> with its children as
// parameters. Throws InputError on an unknown type, a missing or unknown parameter, or a value
// outside the solution's range.
std::unique_ptr<ExactSolution> make_exact_solution(SolutionParameters parameters);

}  // namespace sluice::exact
