// How a step of either scheme ends: is the new state admissible, and what may the next step be.
//
// Rates: the deck's rule max_d (|u_d| + knob c)/dx_d (aggressive) or the outflow rule with face
// velocities (conservative); with viscosity or conduction 2 D sum_d 1/dx_d^2, D the larger of
// mu/rho and k/(rho cv); the scheme's own sum_d |u_d|/dx_d and max_d (|u_d| + c)/dx_d.
// Coefficients that vary are those of the old state.
#pragma once
#include <array>
#include <cmath>

#include "framework/base/infinity.hpp"
#include "framework/task/reductions.hpp"
#include "ice/fluid/closure_rows.hpp"
#include "ice/fluid/limiters.hpp"
#include "ice/step/step_bounds.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

// A row that must be above zero and finite everywhere, and what a fault of it is called.
struct PositiveRow {
  const double* values = nullptr;  // in any unit
  int kind = fault_density;
  double (*told)(double) = nullptr;  // what the message shows; null: the value itself
  const double* shown = nullptr;     // the row that the message shows instead; null: this one
};

// Counts cells that are not admissible; NaN fails every comparison. The first row of `rows` that
// fails names the fault.
template <std::size_t N>
void admissible_row(const Row& row, const Axes& axes, const std::array<PositiveRow, N>& rows,
                    int material = 0) {
  const int n = row.count();
  std::array<const double*, N> q;
  for (std::size_t k = 0; k < N; ++k) q[k] = rows[k].values;
  int bad = 0;
  for (int i = 0; i < n; ++i) {
    int good = 1;  // an integer, so that no comparison becomes a branch
    for (std::size_t k = 0; k < N; ++k) good &= int{q[k][i] > 0.0} & int{q[k][i] < infinity};
    bad += 1 - good;
  }
  if (bad == 0) return;
  for (int i = 0; i < n; ++i)
    for (const PositiveRow& r : rows) {
      if (r.values[i] > 0.0 && r.values[i] < infinity) continue;
      CellFault f;
      f.cell = row.cell();
      f.cell[axes.direction[0]] += i;
      f.level = row.step().level;
      f.material = material;
      f.kind = r.kind;
      const double value = r.shown != nullptr ? r.shown[i] : r.values[i];
      f.value = r.told != nullptr ? r.told(value) : value;
      row.reductions().fault(f);
      break;
    }
}

// What the rates of the new state are made of.
struct RateHandles {
  Out rho, momentum, energy;        // new state
  In sound;                         // conservative rule only
  std::array<In, 3> face_velocity;  // conservative rule only
  Out closure;                      // pressure and modulus; not for ideal gases
  In viscosity, conductivity;       // where they vary
  Out heat_capacity;                // conduction only, where it is no constant
};

struct RateConstants {
  double inverse_dx[3] = {0, 0, 0};  // by axis, 1/m
  double sound_speed_factor = 1;
  double gravity_speed = 0;  // sqrt(sum dx |g|), m/s; conservative rule only
  bool conservative = false;
  double sum_share = 0;  // share of the sum over directions that counts as the rate of sound
};

inline RateConstants rate_constants(const SchemeOptions& o, const StepConstants& step) {
  RateConstants x;
  x.sound_speed_factor = o.scheme.sound_speed_factor;
  x.conservative = o.scheme.conservative_time_step;
  x.sum_share = sound_sum_share(o);
  double dx_g = 0;
  for (int a = 0; a < o.grid.axes.count; ++a) {
    const double dx = step.spacing[o.grid.axes.direction[a]];
    x.inverse_dx[a] = 1.0 / dx;
    dx_g += dx * std::fabs(o.forces.gravity[o.grid.axes.direction[a]]);
  }
  x.gravity_speed = std::sqrt(dx_g);
  return x;
}

// `modulus`(i): rho c^2 of cell i, Pa. Rates are in 1/s.
template <int D, class Modulus>
void rate_row(const Row& row, const RateHandles& h, const RateConstants& x, Modulus modulus) {
  const int n = row.count();
  const double* __restrict r = row(h.rho);
  const double* m[3];
  for (int d = 0; d < D; ++d) m[d] = row(h.momentum, d);
  std::int64_t deck = 0, flow = 0, sound = 0;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double w = 1.0 / r[i];
    const double c = std::sqrt(modulus(i) * w);
    double deck_rate = 0, flow_rate = 0, sound_rate = 0, sum = 0;
    for (int d = 0; d < D; ++d) {
      const double speed = std::fabs(m[d][i]) * w;
      deck_rate = larger(deck_rate, (speed + x.sound_speed_factor * c) * x.inverse_dx[d]);
      sound_rate = larger(sound_rate, (speed + c) * x.inverse_dx[d]);
      sum += (speed + c) * x.inverse_dx[d];
      flow_rate += speed * x.inverse_dx[d];
    }
    if constexpr (D > 1) sound_rate = larger(sound_rate, x.sum_share * sum);
    const std::int64_t a = ordered_bits(deck_rate), b = ordered_bits(flow_rate),
                       s = ordered_bits(sound_rate);
    deck = a > deck ? a : deck;
    flow = b > flow ? b : flow;
    sound = s > sound ? s : sound;
  }
  if (!x.conservative) row.reductions().maximum(StepSlots::deck_rate, deck);
  row.reductions().maximum(StepSlots::flow_rate, flow);
  row.reductions().maximum(StepSlots::sound_rate, sound);
}

// Sum over directions of the outflow of a cell, each side widened by sound, shear and gravity:
// what the deck's conservative rule bounds by V cfl / dt.
template <int D>
void outflow_rate_row(const Row& row, const RateHandles& h, const RateConstants& x) {
  const int n = row.count();
  const double* um[3];
  const double* up[3];
  const double* cm[3];
  const double* cp[3];
  const double* c = row(h.sound);
  for (int d = 0; d < D; ++d) {
    const In faces = h.face_velocity[d];
    um[d] = row(faces);
    up[d] = row(faces, 0, d, 1);
    cm[d] = row(h.sound, 0, d, -1);
    cp[d] = row(h.sound, 0, d, 1);
  }
  std::int64_t most = 0;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    double rate = 0;
    for (int d = 0; d < D; ++d) {
      const double margin = std::fabs(up[d][i] - um[d][i]) + x.gravity_speed;
      const double right = up[d][i] + x.sound_speed_factor * larger(c[i], cp[d][i]) + margin;
      const double left = um[d][i] - x.sound_speed_factor * larger(c[i], cm[d][i]) - margin;
      rate += (larger(0.0, right) + larger(0.0, -left)) * x.inverse_dx[d];
    }
    const std::int64_t a = ordered_bits(rate);
    most = a > most ? a : most;
  }
  row.reductions().maximum(StepSlots::deck_rate, most);
}

// 2 D sum 1/dx^2 with D = coefficient(i)/rho.
template <class Coefficient>
void diffusion_rate_row(const Row& row, const RateHandles& h, Coefficient coefficient) {
  const int n = row.count();
  const double* __restrict r = row(h.rho);
  std::int64_t most = 0;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const std::int64_t a = ordered_bits(coefficient(i) / r[i]);
    most = a > most ? a : most;
  }
  row.reductions().maximum(StepSlots::diffusion_rate, most);
}

// Whether cv is the same everywhere.
inline bool constant_heat_capacity(const Fluid& fluid) {
  return fluid.gamma_law() != nullptr && !fluid.heat;
}

inline void viscous_rate_row(const Row& row, const RateHandles& h, const SchemeOptions& o,
                             double twice) {
  if (o.transport.viscosity_varies)
    diffusion_rate_row(row, h, [=, mu = row(h.viscosity)](int i) { return twice * mu[i]; });
  else
    diffusion_rate_row(row, h, [rate = twice * o.transport.viscosity](int) { return rate; });
}

inline void conduction_rate_row(const Row& row, const RateHandles& h, const SchemeOptions& o,
                                double twice) {
  const double* k = o.transport.conductivity_varies ? row(h.conductivity) : nullptr;
  const auto conductivity = [k, all = o.transport.conductivity](int i) {
    return k != nullptr ? k[i] : all;
  };
  if (constant_heat_capacity(o.materials.fluid)) {
    return diffusion_rate_row(row, h, [=, cv = o.materials.fluid.specific_heat](int i) {
      return twice * conductivity(i) / cv;
    });
  }
  double* cv = row(h.heat_capacity);
  heat_capacity_row(o.materials.fluid, row.count(), row(h.rho), row(h.energy), cv);
  diffusion_rate_row(row, h, [=](int i) { return twice * conductivity(i) / cv[i]; });
}

// Those of the conservative rule and of diffusion.
template <int D>
void other_rates_of_row(const Row& row, const RateHandles& h, const SchemeOptions& o,
                        const RateConstants& x) {
  if (x.conservative) outflow_rate_row<D>(row, h, x);
  double inverse_dx2 = 0;
  for (int d = 0; d < D; ++d) inverse_dx2 += x.inverse_dx[d] * x.inverse_dx[d];
  if (o.materials.mixture) return;  // mixture/diffusion_rates.hpp
  if (o.transport.viscous) viscous_rate_row(row, h, o, 2.0 * inverse_dx2);
  if (o.transport.conducting) conduction_rate_row(row, h, o, 2.0 * inverse_dx2);
}

// What the checks and rates of a new state read.
struct EndOfStepInput {
  VariableId energy_star, inverse_J, sound;
  std::array<VariableId, 3> face_velocity;
  VariableId viscosity, conductivity;

  static EndOfStepInput of(const SchemeVariables& v) {
    return {.energy_star = v.energy_star,
            .inverse_J = v.inverse_J,
            .sound = v.sound,
            .face_velocity = v.face_velocity,
            .viscosity = v.viscosity,
            .conductivity = v.conductivity};
  }
};

// What varying coefficients need in the task that ends the step.
inline void read_transport(TaskBuilder& task, const EndOfStepInput& v, const SchemeOptions& o,
                           RateHandles& h) {
  if (o.transport.viscosity_varies) h.viscosity = task.read(v.viscosity);
  if (o.transport.conductivity_varies) h.conductivity = task.read(v.conductivity);
}

template <int D>
void rates_of_row(const Row& row, const RateHandles& h, const SchemeOptions& o) {
  if (!row.step().rates) return;
  const RateConstants x = rate_constants(o, row.step());
  if (const eos::IdealGas* gas = o.materials.fluid.gamma_law()) {
    rate_row<D>(row, h, x, [gas = *gas, r = row(h.rho), E = row(h.energy)](int i) {
      return gas.gamma * gas.pressure(r[i], E[i]);
    });
  } else {
    pressure_and_modulus_row(o.materials.fluid, row.count(), row(h.rho), row(h.energy),
                             row(h.closure, 0), row(h.closure, 1));
    rate_row<D>(row, h, x, [K = row(h.closure, 1)](int i) { return K[i]; });
  }
  other_rates_of_row<D>(row, h, o, x);
}

// The same where the modulus (Pa) is known; h.rho is the density of the mixture.
template <int D>
void rates_of_mixture(const Row& row, const RateHandles& h, const SchemeOptions& o,
                      const double* modulus) {
  if (!row.step().rates) return;
  const RateConstants x = rate_constants(o, row.step());
  rate_row<D>(row, h, x, [modulus](int i) { return modulus[i]; });
  other_rates_of_row<D>(row, h, o, x);
}

}  // namespace sluice::ice
