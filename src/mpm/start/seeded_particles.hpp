// Particles at the start of a run, as plain columns.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sluice::mpm {

// One material's particles. All columns have as many rows as there are particles, but for the
// optional ones, which are empty where no point file of the material has them.
struct SeededParticles {
  using Column = std::vector<double>;

  Column x, y, z;        // m
  std::array<Column, 3> velocity;  // m/s
  Column mass, volume;   // kg, m^3; axisymmetric: of one radian
  // Edge vectors in cells, row after row: edge c has the components edges[c], edges[3 + c],
  // edges[6 + c] times the spacing of their direction.
  std::array<Column, 9> edges;
  Column temperature, colour;      // K, -
  std::vector<std::int64_t> id;
  std::vector<unsigned char> surface;  // 1: a neighbouring place lies outside of the piece

  std::array<Column, 3> external_force, fibre, normal;  // optional
  std::array<std::vector<int>, 3> load_curve;           // optional; 0: none

  std::size_t count() const { return x.size(); }
};

}  // namespace sluice::mpm
