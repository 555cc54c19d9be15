// What a flow should be: the exact (or reference) solution of a case at any point and time.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "exact/solution_parameters.hpp"
#include "framework/base/vec3.hpp"

namespace sluice::exact {

// State of an ideal gas at one point.
struct State {
  double density = 0;
  Vec3 velocity;
  double pressure = 0;
  double gamma = 1.4;  // ratio of specific heats of the gas that is there

  // Specific internal energy p / ((gamma - 1) rho); temperature is this over the specific heat.
  double internal_energy() const { return pressure / ((gamma - 1) * density); }
  double temperature(double specific_heat) const { return internal_energy() / specific_heat; }
};

class ExactSolution {
 public:
  virtual ~ExactSolution() = default;
  // The state at point x and time t >= 0. Reference solutions march to t on the first call of a
  // time and keep the result, so ask for all points of one time before the next.
  virtual State at(Vec3 x, double t) const = 0;
};

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
