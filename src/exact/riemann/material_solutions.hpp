// The flows of two materials as exact solutions that a deck can name.
//
//   <exact_solution type="two_materials">
//     <left>[1000, 0, 1e9]</left>   <eos_left>StiffenedGas gamma=4.4 pinf=6e8</eos_left>
//     <right>[50, 0, 1e5]</right>   <eos_right>ideal_gas gamma=1.4</eos_right>
//     <position>0.7</position>
//   </exact_solution>
// Densities are those of the mixture in a cell: that of the one material which is there.
#pragma once
#include <array>
#include <memory>

#include "exact/base/exact_solution.hpp"
#include "exact/base/solution_parameters.hpp"
#include "exact/riemann/material_shocks.hpp"

namespace sluice::exact {

// Where a one-dimensional flow lies in space, and which materials of the deck its two sides are.
struct Placement {
  double position = 0;  // along the direction, m
  Vec3 direction{1, 0, 0};
  std::array<int, 2> materials{0, 1};
};

class TwoMaterials final : public ExactSolution {
 public:
  TwoMaterials(MaterialRiemann solution, Placement place)
      : solution_(std::move(solution)), place_(place) {}
  int materials() const override { return 2; }
  State at(Vec3 x, double t) const override;
  bool varies_along(int d) const override { return place_.direction[d] != 0; }
  const MaterialRiemann& riemann() const { return solution_; }

 private:
  MaterialRiemann solution_;
  Placement place_;
};

// Positions of the flow itself; placed at 0 along the direction.
class ShockAtInterface final : public ExactSolution {
 public:
  ShockAtInterface(ShockMeetsInterface solution, Placement place)
      : solution_(std::move(solution)), place_(place) {}
  int materials() const override { return 2; }
  State at(Vec3 x, double t) const override;
  bool varies_along(int d) const override { return place_.direction[d] != 0; }
  const ShockMeetsInterface& flow() const { return solution_; }

 private:
  ShockMeetsInterface solution_;
  Placement place_;
};

// From the parameters of a deck; InputError as make_exact_solution() (exact/exact_solutions.hpp).
std::unique_ptr<ExactSolution> make_two_materials(const SolutionParameters& from, Vec3 direction);
std::unique_ptr<ExactSolution> make_shock_at_interface(const SolutionParameters& from,
                                                       Vec3 direction);

}  // namespace sluice::exact
