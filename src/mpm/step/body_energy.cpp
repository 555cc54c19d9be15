#include "mpm/step/body_energy.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/shape/weights.hpp"

namespace sluice::mpm {
namespace {

constexpr double largest_whole = 0x1p45;

}  // namespace

double energy_unit(double bound) {
  if (!(bound > 0)) return 0x1p1000;
  int exponent = 0;
  std::frexp(bound, &exponent);  // bound < 2^exponent
  return std::ldexp(1.0, std::min(41 - exponent, 1000));
}

void add_rounded(const double* x, int n, double unit, ExactSum& to) {
  std::int64_t sum = 0;
  int fits = 1;
  for (int q = 0; q < n; ++q) {
    const double scaled = x[q] * unit;
    const bool one = std::fabs(scaled) <= largest_whole;
    fits &= static_cast<int>(one);
    const double whole = one ? scaled : 0.0;
    sum += std::bit_cast<std::int64_t>(whole + rounding_number) - rounding_bits;
  }
  if (sum != 0) to.add(static_cast<double>(sum) / unit);
  if (fits != 0) return;
  for (int q = 0; q < n; ++q)
    if (!(std::fabs(x[q] * unit) <= largest_whole)) to.add(x[q]);
}

void add_energies(const ParticleSet& set, const ParticleSet& next, const Columns& c, std::size_t at,
                  int n, EnergyUnits unit, BodyEnergySums& to) {
  const double* m = set.column(static_cast<std::size_t>(c.mass)) + at;
  alignas(64) double before[chunk_size] = {}, middle[chunk_size] = {}, after[chunk_size] = {};
  for (int d = 0; d < 3; ++d) {
    const double* v = set.column(static_cast<std::size_t>(c.velocity + d)) + at;
    const double* w = next.column(static_cast<std::size_t>(c.velocity + d)) + at;
    for (int q = 0; q < n; ++q) {
      before[q] += v[q] * v[q];
      middle[q] += (v[q] + w[q]) * (v[q] + w[q]);
      after[q] += w[q] * w[q];
    }
  }
  alignas(64) double inner[chunk_size] = {};
  for (int e = 0; e < 9 && c.affine >= 0; ++e) {
    const double moment = unit.moment[e % 3];
    const double* v = set.column(static_cast<std::size_t>(c.affine + e)) + at;
    const double* w = next.column(static_cast<std::size_t>(c.affine + e)) + at;
    for (int q = 0; q < n; ++q) {
      before[q] += moment * (v[q] * v[q]);
      middle[q] += moment * ((v[q] + w[q]) * (v[q] + w[q]));
      after[q] += moment * (w[q] * w[q]);
      inner[q] += moment * (w[q] * w[q] - v[q] * v[q]);
    }
  }
  for (int q = 0; q < n; ++q) {
    before[q] *= 0.5 * m[q];
    middle[q] *= 0.125 * m[q];
    after[q] *= 0.5 * m[q];
  }
  using Of = BodyEnergySums;
  if (c.affine >= 0) {
    for (int q = 0; q < n; ++q) inner[q] *= 0.5 * m[q];
    add_rounded(inner, n, unit.energy, to[Of::inner_gain]);
  }
  if (unit.capacity > 0) {
    const auto temperature = static_cast<std::size_t>(c.temperature);
    const double *T = set.column(temperature) + at, *warmed = next.column(temperature) + at;
    alignas(64) double heat[chunk_size];
    for (int q = 0; q < n; ++q) heat[q] = m[q] * unit.capacity * (warmed[q] - T[q]);
    add_rounded(heat, n, unit.heat, to[Of::heat]);
  }
  const auto energy = static_cast<std::size_t>(c.energy);
  add_rounded(m, n, unit.mass, to[Of::mass]);
  add_rounded(before, n, unit.energy, to[Of::kinetic_before]);
  add_rounded(middle, n, unit.energy, to[Of::kinetic_middle]);
  add_rounded(after, n, unit.energy, to[Of::kinetic_after]);
  add_rounded(set.column(energy) + at, n, unit.energy, to[Of::stored_before]);
  add_rounded(next.column(energy) + at, n, unit.energy, to[Of::stored_after]);
}

}  // namespace sluice::mpm
