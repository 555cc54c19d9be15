// Named problems of two materials in one dimension: states, domain, time and what errors to allow.
//
// The errors are those of a one-dimensional prototype of the multi-material scheme (mean
// |q - exact| over the cells, exact values at cell centres, Courant number 0.4) with 200 and 800
// cells on a domain of length 1.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "exact/material_solutions.hpp"

namespace sluice::exact {

struct MaterialProblem {
  std::string name, title;
  MaterialSide left, right;  // at the start, of the interface
  double low = 0, high = 1;  // domain
  double interface = 0.5, time = 0;
  double courant = 0.4;

  // A shock in the left material; its position is at t = 0.
  struct Shock {
    double pressure = 0, position = 0;
  };
  std::optional<Shock> shock;

  // Mean errors at 200 and 800 cells.
  struct Errors {
    std::array<double, 2> density{}, velocity{}, pressure{};
  };
  Errors prototype;
  // Whether place and time are those of the prototype; where not, its errors tell the size only.
  bool as_prototype = true;

  // Mirrored: in the middle of the domain, so that material 0 lies on the right.
  std::unique_ptr<ExactSolution> solution(bool mirrored = false) const;

  // The waves of the interface, and the time and place where they start: at once, or when the shock
  // has come.
  struct Waves {
    MaterialRiemann riemann;
    double time = 0, position = 0;
  };
  Waves waves() const;
};

// gas_sod, gas_strong, water_dense_air, water_air, air_hits_water, shock_reflects_20,
// shock_reflects_200.
const std::vector<MaterialProblem>& material_problems();
// InputError on an unknown name.
const MaterialProblem& material_problem(const std::string& name);

// The error that a scheme is allowed: 1.25 times the prototype's.
inline constexpr double allowed_share_of_prototype = 1.25;

}  // namespace sluice::exact
