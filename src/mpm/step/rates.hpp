// What a step must know of all particles before it begins: its length and the bounds of its sums.
//
// Maxima, so that no number of ranks or boxes changes a bit; the run keeps them in checkpoints.
#pragma once
#include <span>
#include <vector>

#include "framework/run/levels/particle_cloud.hpp"
#include "mpm/step/columns.hpp"

namespace sluice::mpm {

// The maxima of one kind of particles, in the order in which they are kept.
struct KindRates {
  static constexpr int count = 13;
  double mass = 0;                  // kg
  Vec3 up = none(), down = none();  // of v and of -v
  double tension = 0;               // of |V sigma|, any component, and V q, J
  double affine = 0;                // of |C|, any component, 1/s
  double extent = 0;                // of a corner from its particle along a direction, cells
  // Of sum_d |al_c,d| of corners; total Lagrangian: of sum_d,k |(F^-1)_dk|/h_d. 1/m
  double slope = 0;
  double wave = 0;    // of c_p/h_d, 1/s: of affine transfers
  double energy = 0;  // of the size of what a particle stores, J

  static constexpr Vec3 none() { return {-1e300, -1e300, -1e300}; }
  bool any() const { return mass > 0; }
  // v_ref: the middle of all velocities; and how far any lies from it.
  Vec3 middle() const { return 0.5 * (up - down); }
  double spread() const;
  double most_kinetic() const;  // a bound of m v^2/2, J
  void add(const KindRates& other);
  void to(std::span<double> kept) const;
  static KindRates from(std::span<const double> kept);
};

// All of a level: first the rate of the time step, max over p and d of (c_p + |v_p,d|)/h_d, 1/s.
inline std::size_t rate_count(std::size_t kinds) {
  return 1 + kinds * static_cast<std::size_t>(KindRates::count);
}

// Of particles begin to end: what a step writes anew stands in `now`, the rest in `set`. Without
// the wave.
KindRates rates_of(Basis basis, const TransferGrid& grid, const ParticleSet& set,
                   const ParticleSet& now, const Columns& columns, std::size_t begin,
                   std::size_t end);

// Of the next step's length: max over n particles and directions of (c_p + |v_d|)/h_d. Total
// Lagrangian: waves cross reference cells of fixed length, c_p |row d of F^-1|/h_d; where the law
// says how it stiffens, the fastest wave there,
//   c_ref^2 = (c_p^2 - mu b_max)/b_min + mu.
double step_rate(const Level& level, const ParticleSet& set, const Columns& columns,
                 const Material& law, std::size_t at, int n, const double* wave_speed);
// max of c_p/h_d.
double wave_rate(const Level& level, int n, const double* wave_speed);

}  // namespace sluice::mpm
