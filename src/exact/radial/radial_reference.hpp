// A run of the Lagrangian radial solver as an exact solution in space and time.
#pragma once
#include <memory>

#include "exact/base/exact_solution.hpp"
#include "exact/base/symmetry.hpp"
#include "exact/radial/radial_lagrangian.hpp"

namespace sluice::exact {

// Runs are kept in memory for the whole process, so that many who ask for the same problem at the
// same time cost one run.
class RadialReference final : public ExactSolution {
 public:
  RadialReference(RadialProblem problem, Vec3 origin, Vec3 axis);
  State at(Vec3 x, double t) const override;
  bool varies_along(int d) const override { return varies_radially(problem_.dimension, axis_, d); }

 private:
  RadialProblem problem_;
  Vec3 origin_, axis_;
  mutable std::shared_ptr<const RadialLagrangian> run_;  // the last that was asked for
};

}  // namespace sluice::exact
