// What the labels of a step read of each material of a mixture.
#pragma once
#include "ice/multi_velocity/tasks.hpp"
#include "ice/outputs/step_labels.hpp"

namespace sluice::ice::mixture {

struct MaterialsInput {
  MaterialStates state, next;
  VariableId density_new, energy_L, energy_star, pure;
  std::array<VariableId, 3> flux, face_velocity;
  // With velocities of their own.
  RelativeStateInput relative;
  std::vector<VariableId> slip_new;
  VariableId velocity_L;
  std::array<VariableId, 3> own_face_velocity, stress;

  static MaterialsInput of(const Variables&);
};
MaterialsOfStep materials_of_step(TaskList&, const MaterialsInput&, const SchemeOptions&);

}  // namespace sluice::ice::mixture
