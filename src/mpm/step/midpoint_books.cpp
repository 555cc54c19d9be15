#include "mpm/step/midpoint_books.hpp"

#include <algorithm>

#include "framework/base/eight.hpp"
#include "mpm/step/midpoint_motion.hpp"

namespace sluice::mpm {

static constexpr double spin_relaxation = 0.001;  // kappa: spins follow the grid in h/(kappa c)

void book_kick(const Chunk& chunk) {
  const Columns& c = chunk.columns();
  const int n = chunk.n;
  alignas(64) double gain[chunk_size] = {}, before[chunk_size] = {}, middle[chunk_size] = {},
                     after[chunk_size] = {}, spins[chunk_size];
  for (int d = 0; d < 3; ++d) {
    const double *v = chunk.old(c.velocity + d), *to_v = chunk.made(c.velocity + d);
    const double *spin = chunk.old(c.spin + d), *to_spin = chunk.made(c.spin + d);
    const double* inertia = chunk.buffers->impulses.inertia[d];
    for_eights(0, static_cast<std::size_t>(n), [&](auto q) {
      const auto sum = q(spin) + q(to_spin);
      q.put(q(gain) + (q(to_v) * q(to_v) - q(v) * q(v)), gain);
      q.put(q(before) + q(inertia) * (q(spin) * q(spin)), before);
      q.put(q(middle) + q(inertia) * (sum * sum), middle);
      q.put(q(after) + q(inertia) * (q(to_spin) * q(to_spin)), after);
    });
  }
  const double* mass = chunk.old(c.mass);
  for (int q = 0; q < n; ++q) {
    gain[q] = 0.5 * mass[q] * (gain[q] + (after[q] - before[q]));
    spins[q] = 0.5 * mass[q] * (after[q] - before[q]);
    before[q] *= 0.5 * mass[q];
    middle[q] *= 0.125 * mass[q];
    after[q] *= 0.5 * mass[q];
  }
  using Of = BodyEnergySums;
  BodyEnergySums& to = chunk.sums();
  const double unit = chunk.body->energy_units.energy;
  add_rounded(gain, n, unit, to[Of::kick_gain]);
  add_rounded(spins, n, unit, to[Of::inner_gain]);
  add_rounded(before, n, unit, to[Of::kinetic_before]);
  add_rounded(middle, n, unit, to[Of::kinetic_middle]);
  add_rounded(after, n, unit, to[Of::kinetic_after]);
}

void relax_spins(const Level& level, const Chunk& chunk) {
  const Body& body = *chunk.body;
  const Columns& c = chunk.columns();
  const double beta = std::min(1.0, spin_relaxation * chunk.dt() * body.rates.wave);
  alignas(64) double gain[chunk_size] = {};
  for (int k = 0; k < 3; ++k) {
    if (!turns(level, k)) continue;
    double inertia = 0;
    for (int d = 0; d < 3; ++d)
      if (d != k) inertia += body.energy_units.moment[d];
    double* spin = chunk.made(c.spin + k);
    for (int q = 0; q < chunk.n; ++q) {
      const double before = spin[q];
      spin[q] += beta * (spin_of(chunk.read(), k, q) - spin[q]);
      gain[q] += inertia * (spin[q] * spin[q] - before * before);
    }
  }
  const double* mass = chunk.old(c.mass);
  for (int q = 0; q < chunk.n; ++q) gain[q] *= 0.5 * mass[q];
  using Of = BodyEnergySums;
  add_rounded(gain, chunk.n, body.energy_units.energy, chunk.sums()[Of::kinetic_after]);
  add_rounded(gain, chunk.n, body.energy_units.energy, chunk.sums()[Of::inner_gain]);
  if (c.lost_heat < 0) return;
  double* losses = chunk.made(c.lost_heat);
  for (int q = 0; q < chunk.n; ++q) losses[q] -= gain[q];
}

}  // namespace sluice::mpm
