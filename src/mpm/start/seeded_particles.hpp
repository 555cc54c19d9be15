// Particles at the start of a run, as plain columns.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "framework/base/vec3.hpp"
#include "mpm/start/affine.hpp"

namespace sluice::mpm {

// Corners that a particle carries: all places, of the first 2^D the corners; faces that no other
// particle of the object shares, as bits.
struct ParticleCorners {
  std::array<Vec3, 8> place{};  // m
  int outer = 0;
};

// One material's particles. All columns have as many rows as there are particles, but for the
// optional ones, which are empty where no point file of the material has them.
struct SeededParticles {
  using Column = std::vector<double>;

  Column x, y, z;                  // m
  std::array<Column, 3> velocity;  // m/s
  Column mass, volume;             // kg, m^3; axisymmetric: of one radian
  // Edge vectors in cells, row after row: edge c has the components edges[c], edges[3 + c],
  // edges[6 + c] times the spacing of their direction.
  std::array<Column, 9> edges;
  Column temperature, concentration, colour;  // K, -, -
  std::vector<std::int64_t> id;
  std::vector<unsigned char> surface;  // 1: a neighbouring place lies outside of the piece

  // Optional: of particles that carry their corners; see Columns::corners and Columns::outer.
  std::vector<ParticleCorners> corners;

  std::array<Column, 3> external_force, fibre, normal;  // N, directions without unit; optional
  std::array<std::vector<int>, 3> load_curve;           // optional; 0: none

  std::size_t count() const { return x.size(); }
};

// One row, in the units of the columns.
struct SeededParticle {
  Vec3 x{}, velocity{};
  double mass = 0, volume = 0;
  Map edges{};
  double temperature = 0, concentration = 0, colour = 0;
  std::int64_t id = 0;
  bool surface = false;
  Vec3 external_force{}, fibre{}, normal{}, load_curve{};
  ParticleCorners corners;
};

// Which optional columns a material has.
struct OptionalColumns {
  bool external_force = false, fibre = false, normal = false, load_curve = false;
  bool corners = false;
};

void append(SeededParticles& particles, const SeededParticle& row, const OptionalColumns& columns);

}  // namespace sluice::mpm
