#include "exact/material_problems.hpp"

#include <fmt/format.h>

#include "framework/base/error.hpp"

namespace sluice::exact {
namespace {

MaterialSide gas(double gamma, double specific_heat, double density, double velocity,
                 double pressure) {
  const eos::IdealGas law{.gamma = gamma, .specific_heat = specific_heat};
  return {law, state_of_pressure(law, density, velocity, pressure)};
}
MaterialSide air(double density, double velocity, double pressure) {
  return gas(1.4, 717.5, density, velocity, pressure);
}
MaterialSide water(double pressure) {
  const eos::StiffenedGas law{{.gamma = 4.4, .pinf = 6e8, .q = 0, .specific_heat = 1816}};
  return {law, state_of_pressure(law, 1000, 0, pressure)};
}

MaterialProblem problem(const char* name, const char* title, const MaterialSide& left,
                        const MaterialSide& right, double interface, double time,
                        const MaterialProblem::Errors& prototype) {
  MaterialProblem out;
  out.name = name;
  out.title = title;
  out.left = left;
  out.right = right;
  out.interface = interface;
  out.time = time;
  out.prototype = prototype;
  return out;
}

// A shock of this pressure ratio in air at rest; place and time are ours.
MaterialProblem reflection(const char* name, const char* title, double ratio, double time,
                           const MaterialProblem::Errors& prototype) {
  MaterialProblem out = problem(name, title, air(1.2, 0, 1e5), water(1e5), 0.6, time, prototype);
  out.shock = {ratio * 1e5, 0.3};
  out.as_prototype = false;
  return out;
}

std::vector<MaterialProblem> all_problems() {
  std::vector<MaterialProblem> all;
  all.push_back(problem("gas_sod", "Sod's tube with two gases", gas(1.4, 1, 1, 0, 1),
                        gas(1.667, 1, .125, 0, .1), .5, .2,
                        {{2.34e-3, 6.24e-4}, {5.35e-3, 1.56e-3}, {2.41e-3, 6.46e-4}}));
  all.push_back(problem("gas_strong", "Two gases, pressures 500 and 0.2", gas(1.4, 1, 1, 0, 500),
                        gas(1.667, 1, 1, 0, .2), .5, .01,
                        {{1.60e-2, 5.35e-3}, {9.08e-2, 3.10e-2}, {1.50, .484}}));
  all.push_back(problem("water_dense_air", "Water at 1 GPa and dense air", water(1e9),
                        air(50, 0, 1e5), .7, 2.4e-4,
                        {{2.50, .696}, {2.68, .710}, {2.54e6, 6.35e5}}));
  all.push_back(problem("water_air", "Water at 1 GPa and air", water(1e9), air(1.2, 0, 1e5), .7,
                        1.2e-4, {{1.67, .504}, {2.63, .635}, {2.55e6, 6.30e5}}));
  all.push_back(problem("air_hits_water", "Dense air at 1000 m/s hits water", air(6.26, 1000, 2e6),
                        water(1e5), .4, 3e-4, {{2.06, .452}, {4.12, .659}, {3.52e4, 5.4e3}}));
  all.push_back(reflection("shock_reflects_20", "A shock of ratio 20 in air meets water", 20, 4e-4,
                           {{.62, .563}, {3.33, 1.03}, {1.53e5, 3.37e4}}));
  all.push_back(reflection("shock_reflects_200", "A shock of ratio 200 in air meets water", 200,
                           2e-4, {{1.80, .271}, {13.3, 2.98}, {1.15e6, 2.88e5}}));
  return all;
}

ShockMeetsInterface shock_flow(const MaterialProblem& p) {
  return {p.left, p.right, p.shock->pressure, p.shock->position, p.interface};
}

}  // namespace

std::unique_ptr<ExactSolution> MaterialProblem::solution(bool mirrored) const {
  // A mirrored point x is at low + high - x of the flow.
  Placement place;
  place.direction = {mirrored ? -1.0 : 1.0, 0, 0};
  const double shift = mirrored ? -(low + high) : 0.0;
  if (shock) {
    place.position = shift;
    return std::make_unique<ShockAtInterface>(shock_flow(*this), place);
  }
  place.position = shift + interface;
  return std::make_unique<TwoMaterials>(MaterialRiemann(left, right), place);
}

MaterialProblem::Waves MaterialProblem::waves() const {
  if (!shock) return {MaterialRiemann(left, right), 0, interface};
  const ShockMeetsInterface flow = shock_flow(*this);
  return {flow.after(), flow.arrival_time(), flow.arrival_position()};
}

const std::vector<MaterialProblem>& material_problems() {
  static const std::vector<MaterialProblem> all = all_problems();
  return all;
}

const MaterialProblem& material_problem(const std::string& name) {
  std::string known;
  for (const MaterialProblem& one : material_problems()) {
    if (one.name == name) return one;
    known += (known.empty() ? "" : ", ") + one.name;
  }
  throw InputError(
      fmt::format("there is no problem of two materials '{}'; known are: {}", name, known));
}

}  // namespace sluice::exact
