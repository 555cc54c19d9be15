// Labels that only exist within a step, of each material, the same in every graph of a step.
#pragma once
#include <optional>
#include <vector>

#include "ice/step/variables.hpp"

namespace sluice::ice {

// A velocity of its own: momentum relative to the mixture before and after the step; velocity
// relative to the mixture's before advection (components from `first` on); momentum that friction
// pushes it apart from the others.
struct OwnMotion {
  VariableId slip, slip_new, velocity_L;
  int first = 0;
  std::optional<VariableId> friction;
};

// A material in a graph; all per volume of the cell.
struct MaterialOfStep {
  int index = 0;
  Fluid fluid;
  VariableId mass, volume, energy, mass_new, volume_new, energy_new;
  VariableId energy_L;  // after the Lagrangian phase
  std::optional<OwnMotion> motion;
  // By axis: its share of the volume that passes; absent where it is all of it.
  std::array<std::optional<VariableId>, 3> passing;
};

struct MaterialsOfStep {
  std::vector<MaterialOfStep> each;
  VariableId density_new;              // of all; its first component
  std::optional<VariableId> f, f_new;  // of a gas whose properties are mixed
};

// The one material of a graph of one.
struct MaterialAloneInput {
  VariableId rho, energy, energy_star;
  AfterVariables after;

  static MaterialAloneInput of(const SchemeVariables& v) {
    return {.rho = v.rho, .energy = v.energy, .energy_star = v.energy_star, .after = v.after};
  }
};
MaterialsOfStep material_alone(TaskList&, const MaterialAloneInput&, const SchemeOptions&);

// What outputs read of the mixture, or of the one material.
struct OutputInput {
  VariableId rho, momentum, velocity, pressure, impulse;
  VariableId pressure_change;  // of the classic form
  VariableId new_pressure;     // of a mixture
  VariableId source_change;    // of any sources
  std::array<VariableId, 3> face_velocity, face_pressure, stress, heat_flux;
  AfterVariables after;

  static OutputInput of(const SchemeVariables& v) {
    return {.rho = v.rho,
            .momentum = v.momentum,
            .velocity = v.velocity,
            .pressure = v.pressure,
            .impulse = v.impulse,
            .pressure_change = v.pressure_change,
            .new_pressure = v.new_pressure,
            .source_change = v.source_change,
            .face_velocity = v.face_velocity,
            .face_pressure = v.face_pressure,
            .stress = v.stress,
            .heat_flux = v.heat_flux,
            .after = v.after};
  }
};

// All of them, as tasks: what a deck saves of these is computed.
void declare_step_outputs(TaskList&, const OutputInput&, const SchemeOptions&,
                          const MaterialsOfStep&);
// Mass, volume and energy in the Lagrangian phase; how the temperature changes in it and in the
// step.
void declare_phase_labels(TaskList&, const OutputInput&, const SchemeOptions&,
                          const MaterialsOfStep&, int effect);
// Momentum and velocity.
void declare_motion_labels(TaskList&, const OutputInput&, const SchemeOptions&,
                           const MaterialsOfStep&, int effect);
// Temperature and share of each material on faces; gradient of the pressure there.
void declare_face_labels(TaskList&, const OutputInput&, const SchemeOptions&,
                         const MaterialsOfStep&, int effect);
// delP_MassX, zero without sources.
void declare_source_pressure(TaskList&, const OutputInput&, const SchemeOptions&,
                             const MaterialsOfStep&, int effect);

// Temperature (K) of a material from mass (kg/m^3), volume (fraction) and energy (J/m^3) per volume
// of the cell; `f`: mixture fraction of a gas whose properties are mixed.
struct TemperatureFunction {
  Fluid fluid;
  const models::MixedGas* gas;
  double at(double M, double V, double E, double f) const;
};

TemperatureFunction temperature_function(const MaterialOfStep& m, const SchemeOptions& o);

// The axis along a level direction, or -1.
int axis_along(const SchemeOptions& o, int direction);

// A task that saves a number of a material in each cell:
// f(row, values, i) of variables at the cell.
template <std::size_t N, class F>
void save_values(TaskList& list, Label label, int material, int effect,
                 const std::array<VariableId, N>& variables, F f) {
  TaskBuilder task = list.task("save " + label.name(), effect);
  std::array<In, N> in;
  for (std::size_t n = 0; n < N; ++n) in[n] = task.read(variables[n]);
  const Out out = task.write(list.output(label, material));
  task.kernel([=](const Row& row) {
    std::array<const double*, N> values;
    for (std::size_t n = 0; n < N; ++n) values[n] = row(in[n]);
    double* to = row(out);
    for (int i = 0; i < row.count(); ++i) to[i] = f(row, values, i);
  });
}

inline void save_copy(TaskList& list, Label label, int material, int effect, VariableId from) {
  save_values(list, label, material, effect, std::array{from},
              [](const Row&, const auto& q, int i) { return q[0][i]; });
}

}  // namespace sluice::ice
