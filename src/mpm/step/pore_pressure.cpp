// What particles take from the nodes of water: their pressure, their water's velocity, its energy;
// and the fastest waves of both.
#include <algorithm>
#include <cmath>

#include "mpm/step/pore_water.hpp"

namespace sluice::mpm {

// Strains e_s, e_w of a wave without drag: p = -Q ((1 - n) e_s + n e_w) with Q = K_w/n, and as
// nodes move with F_w/M_f and (f - s F_w)/M_s, s = M_w/M_f,
//   c^2 e_s = [M e_s - (1 - s) p]/rho_s',  c^2 e_w = -p/rho_w
// where rho_s' is the mass of grains per volume and M = rho_s' c_law^2: c^2 is the larger root.
void add_water_to_waves(const SolidMaterial& material, const Columns& c, const ParticleSet& set,
                        const ParticleSet& now, std::size_t at, int n, double* wave_speed) {
  if (!material.water) return;
  const PoreWaterConstants& water = *material.water;
  const double *mass = set.column(static_cast<std::size_t>(c.mass)) + at,
               *of_water = set.column(static_cast<std::size_t>(c.water_mass)) + at,
               *V_0 = set.column(static_cast<std::size_t>(c.volume_0)) + at,
               *V = now.column(static_cast<std::size_t>(c.volume)) + at;
  for (int q = 0; q < n; ++q) {
    const double pores = porosity(water, V_0[q], V[q]), grains = 1 - pores;
    const double solid = mass[q] / V[q];
    const double fluid = of_water[q] / V[q], share = fluid / water.density;
    const double Q = water.bulk_modulus / pores;
    const double a = wave_speed[q] * wave_speed[q] + Q * grains * (1 - share) / solid;
    const double d = Q * pores / water.density;
    const double across = Q * pores * (1 - share) / solid * Q * grains / water.density;
    const double half = 0.5 * (a - d);
    wave_speed[q] = std::sqrt(0.5 * (a + d) + std::sqrt(half * half + across));
  }
}

void PoreWater::load(const BlockWork& w, int thread) {
  const auto k = static_cast<std::size_t>(w.kind);
  if (in(w.kind))
    reads_[static_cast<std::size_t>(thread)].window.load(w.lowest, w.highest, (*bodies_)[k].table,
                                                         water_[k]);
}

void PoreWater::to_particles(const Chunk& chunk) {
  if (!in(chunk.kind())) return;
  const BlockWork& w = *chunk.work;
  const Body& body = *chunk.body;
  const Columns& c = body.carried->columns;
  const PoreWaterConstants& water = *body.material->water;
  const GridAtParticles& solid = chunk.read();
  const std::size_t at = chunk.at;
  const int n = chunk.n;
  const double dt = chunk.dt();
  Reads& reads = reads_[static_cast<std::size_t>(chunk.thread)];
  GridAtParticles& read = reads.at;
  read_window(solids_->basis, body.grid, places_of(*w.set, c), shape_of(*w.set, c),
              static_cast<int>(at), n, false, reads.window, read);
  for (int d = 0; d < 3; ++d) {
    const double* v = chunk.old(c.water_velocity + d);
    double* next = chunk.made(c.water_velocity + d);
    for (int q = 0; q < n; ++q) next[q] = v[q] + read.dv[d][q];
  }
  const double *V_0 = chunk.old(c.volume_0), *V = chunk.old(c.volume),
               *p = chunk.old(c.pore_pressure);
  double *next = chunk.made(c.pore_pressure), *energy = chunk.made(c.energy);
  for (int q = 0; q < n; ++q) {
    const double pores = porosity(water, V_0[q], V[q]);
    const double rate = (1 - pores) * (solid.L[0][q] + solid.L[4][q] + solid.L[8][q]) +
                        pores * (read.L[0][q] + read.L[4][q] + read.L[8][q]);
    next[q] = p[q] - dt * water.bulk_modulus / pores * rate;
    energy[q] -= 0.5 * (p[q] + next[q]) * V[q] * dt * rate;  // that pressing the water takes
  }
  if (c.filtered_pressure >= 0) {
    const double* acted = acting(w, c) + at;
    std::copy_n(acted, n, chunk.made(c.filtered_pressure));
  }
  add_water_to_waves(*body.material, c, *w.set, *w.next, at, n, chunk.buffers->wave_speed);
}

}  // namespace sluice::mpm
