// Particles to grid: mass, momentum and force of every node, as exact integer sums.
//
//   M = sum m S,  P = sum m S (v - v_ref + C (x_i - x_p)),  f = sum (f_p S - tau grad S)
//
// tau = V sigma; C only with affine transfers (docs/theory/mpm_transfers.md); of the midpoint
// transfer it is that of a spin w, C r = w x r.
#pragma once
#include <array>

#include "mpm/deck/mpm_scene.hpp"
#include "mpm/material/base/material.hpp"
#include "mpm/transfer/particle_shape.hpp"
#include "mpm/transfer/window.hpp"

namespace sluice::mpm {

// The columns that go to the grid: m, m/s, kg, m^3, Pa.
struct ParticlesToGrid {
  std::array<const double*, 3> x{}, v{};  // total Lagrangian: x in the reference state
  ParticleShape shape;
  const double* mass = nullptr;
  const double* volume = nullptr;  // null: mass and momentum alone are given
  Six<const double> stress{};
  const double* extra_pressure = nullptr;  // of the artificial viscosity; may be null
  const double* pore_pressure = nullptr;   // may be null
  Nine<const double> affine{};             // C, 1/s; null unless the transfer is affine
  std::array<const double*, 3> spin{};     // w, 1/s; null unless the transfer has one
  std::array<const double*, 3> load{};     // f_p, N; null: none
  bool varies() const { return affine[0] != nullptr || spin[0] != nullptr; }  // within a particle
  bool reference_gradients = false;  // total Lagrangian: V sigma F^-T in place of V sigma
};

// Units of the integers (2^k by field, of sums in kg, kg m/s and N), and the velocity (m/s) from
// which momentum is counted.
struct SumUnits {
  double mass = 1, momentum = 1, force = 1;
  Vec3 reference{};  // v_ref
};

int reach_of(Basis basis);  // of a Window, in nodes; of corners at least

// Particles begin to end (of one block) into the window.
void add_to_window(Basis basis, const TransferGrid& grid, const ParticlesToGrid& p, int begin,
                   int end, const SumUnits& units, Window& window);

}  // namespace sluice::mpm
