// What the particles of a material carry, and in which columns of a ParticleSet it stands.
#pragma once
#include <string_view>
#include <vector>

#include "framework/run/component/particle_method.hpp"
#include "mpm/deck/mpm_scene.hpp"
#include "mpm/transfer/particle_shape.hpp"

namespace sluice::mpm {

// First column of each; -1: the scene does not need it.
struct Columns {
  int velocity = -1;      // 3, half a step behind the position
  int acceleration = -1;  // 3, of implicit steps
  int mass = -1;
  int volume_0 = -1;  // in the reference state
  int volume = -1;    // J V_0
  int F = -1;         // 9, deformation gradient
  int stress = -1;    // 6, Cauchy
  int energy = -1;    // work of the stress until now, J
  int temperature = -1;
  int concentration = -1;  // per mass, where one diffuses
  int affine = -1;         // 9, C of affine transfers
  int spin = -1;           // 3, angular velocity of the midpoint transfer, 1/s
  int half = -1;           // 3, half widths in cells, where they differ among the particles
  int size = -1;           // 9, edges in the reference state, in cells
  int displacement = -1;   // 3
  int reference = -1;      // 3, place at the start: total Lagrangian
  int corners = -1;        // 3 for each of corner_count: places of corners that particles carry
  int corner_count = 0;
  int split = -1;  // 1: part of a particle that was split
  int outer = -1;  // faces that no particle shared at the start: see outer_face_bit
  int colour = -1;
  int marks = -1;          // 3, loads on the particle: number in the deck plus one; 0: none
  int given_force = -1;    // 3, that a point file gives, N
  int normal = -1;         // 3, of the surface, from a point file
  int outside_force = -1;  // 3, of the last step, where it is saved, N
  int viscous = -1;        // artificial pressure, Pa
  // Of materials that lost energy heats (step/lost_energy.cpp): what is lost, heat that it became,
  // what of it is not lost yet, heat of the artificial viscosity where there is one, J; what of
  // their temperature these two heats are, K.
  int lost_energy = -1, lost_heat = -1, open_energy = -1, viscous_heat = -1;
  int loss_temperature = -1;
  std::array<int, 4> of_losses() const {
    return {lost_energy, lost_heat, open_energy, viscous_heat};
  }
  int heat_source = -1;  // of the last step, where it is saved, W
  int heating = -1;      // of the last step, where it is saved, K/s
  // Of water in pores; mass of it, velocity (3), pressure, and the filtered one, where it is saved.
  int water_mass = -1, water_velocity = -1, pore_pressure = -1, filtered_pressure = -1;
  int history = -1;  // of the constitutive model
};

struct Carried {
  Columns columns;
  std::vector<ParticleAttribute> attributes;
  int history_columns = 0;
  int filled = -1;   // column: part of the volume between the corners that has not burned
  int surface = -1;  // 2, what its burning surface remembers: temperature, gradient
  int flame = -1;    // 4, of the flame that comes to it: kind, share come, time, way
  std::array<double, 3> half{0.5, 0.5, 0.5};          // where the particles do not differ
  std::array<double, 3> half_at_rest{0.5, 0.5, 0.5};  // of the first object's, in cells
};

// Do files of points give particles velocities of their own.
bool files_give_velocities(const MpmScene& solids);

Carried carried_by(const Scene& scene, const MpmScene& solids, const SolidMaterial& material);

// First column of an attribute with this label; -1: there is none.
int column_of(const Carried& carried, std::string_view label);

// Columns as a kernel takes them.
template <std::size_t N>
std::array<const double*, N> read_columns(const ParticleSet& set, int first) {
  std::array<const double*, N> to{};
  for (std::size_t n = 0; n < N && first >= 0; ++n)
    to[n] = set.column(static_cast<std::size_t>(first) + n);
  return to;
}
template <std::size_t N>
std::array<double*, N> write_columns(ParticleSet& set, int first) {
  std::array<double*, N> to{};
  for (std::size_t n = 0; n < N && first >= 0; ++n)
    to[n] = set.column(static_cast<std::size_t>(first) + n);
  return to;
}

// Which bit of the number in Columns::outer is that of a face: on the low (0) or high (1) side of
// the a-th active direction, as the particle was at the start.
constexpr int outer_face_bit(int a, int side) {
  return 1 << (2 * a + side);
}
// Component d of corner c in column 3 c + d; null beyond those that there are.
using CornerColumns = std::array<const double*, 3 * max_corners>;
CornerColumns corners_of(const ParticleSet& set, const Columns& columns);

// Places at which shape functions are taken, and what these ask beside.
std::array<const double*, 3> places_of(const ParticleSet& set, const Columns& columns);
ParticleShape shape_of(const ParticleSet& set, const Columns& columns);

// p.scalefactor: the edges F diag(h) R0 of a particle; `spacing` h of the level of the set.
DerivedAttribute scale_factor(const Columns& columns, Vec3 spacing);
// p.dTdt+, as the format also calls p.dTdt.
DerivedAttribute rate_of_format(const Columns& columns);

}  // namespace sluice::mpm
