// The stages of a step: velocity Verlet, with drag of second order.
//
//   v' = (1 - c) v + dt a/2,  u += dt v',  a = (f + b)/rho of the new places,
//   v = (v' + dt a/2)/(1 + c),   c = gamma dt/(2 rho)
// Bonds that are beyond their limit at the new places break, and forces are summed once more with
// those that are left: each step is one of a single potential. With <damage_order> before_force
// (as Peridigm) they break before the forces of the new places are summed.
#pragma once
#include <array>

#include "framework/base/exact_sum.hpp"
#include "framework/run/component/step_shape.hpp"
#include "peridynamics/step/bonded_points.hpp"
#include "peridynamics/step/step_sums.hpp"

namespace sluice::peridynamics {

class PeriStep {
 public:
  explicit PeriStep(BondedPoints& points) : points_(&points), scene_(&points.scene()) {}

  // In order.
  Verdict move(const StageScope& scope);
  Verdict exchange_displacements(const StageScope& scope);
  Verdict sum_dilatations(const StageScope& scope);
  Verdict exchange_dilatations(const StageScope& scope);
  Verdict break_before_forces(const StageScope& scope);
  Verdict sum_forces(const StageScope& scope);
  Verdict finish_velocities(const StageScope& scope);
  Verdict break_bonds(const StageScope& scope);
  Verdict commit(const StageScope& scope);

 private:
  void sum_books(const StageScope& scope);
  bool some_beyond(const StageScope& scope, bool here) const;
  template <class Act>
  void for_own(Act act) const;

  BondedPoints* points_;
  const PeriScene* scene_;
  bool beyond_ = false;  // some bond of this rank is
  std::array<ExactSum, StepSums::count> sums_;
};

}  // namespace sluice::peridynamics
