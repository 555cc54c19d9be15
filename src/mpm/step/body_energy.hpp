// What a step sums of the energy of one body: for the books of a run and the guard of its energy
// (framework/run/simulation/energy_guard.hpp).
#pragma once
#include <array>

#include "framework/base/exact_sum.hpp"
#include "mpm/step/columns.hpp"

namespace sluice::mpm {

struct BodyEnergySums {
  enum Index {
    mass,
    // sum m v^2/2 with v before, (v before + v after)/2, v after; energy before and after.
    kinetic_before,
    kinetic_middle,
    kinetic_after,
    stored_before,
    stored_after,
    // Of nodes: K* - K; work of the forces that particles and corners gave them; of that, what
    // loads on particles and what a fluid on corners gave.
    node_gain,
    node_work,
    load_work,
    corner_work,
    // Work of contact by velocities behind it, beyond that by the middle of before and behind.
    contact_slack,
    kick_gain,   // what kicks of the midpoint transfer gave to velocities and spins of particles
    kick,        // sum J . dv of impulses J of everything but these forces
    inner_gain,  // what spins and affine velocities within particles got
    // Of energy lost (step/lost_energy.cpp): what became heat of particles in this step, and what
    // joined that of motion within cells and of the open half of a step; since the start what those
    // want that have lost and what those give back that have won, all of it; heat until this step.
    lost_heat,
    open_gain,
    heat_wanted,
    heat_taken,
    lost,
    heat_before,
    contact_heat,  // what contact took and joined the energy lost
    heat,          // sum m c_v dT, where heat can move
    // Numbers of particles: those that parted from neighbours (step/parted_neighbours.hpp), all.
    parted,
    particles,
    count
  };
  std::array<ExactSum, count> sums;

  ExactSum& operator[](Index n) { return sums[static_cast<std::size_t>(n)]; }
  const ExactSum& operator[](Index n) const { return sums[static_cast<std::size_t>(n)]; }
  void merge(const BodyEnergySums& other) {
    for (std::size_t n = 0; n < sums.size(); ++n) sums[n].merge(other.sums[n]);
  }
};

// 2^k that makes whole numbers of energies of particles: of those of at most 16 times this bound
// 64 have an exact sum. Larger ones are summed one by one.
double energy_unit(double bound);

struct EnergyUnits {
  double mass = 1, energy = 1, heat = 1;
  double capacity = 0;  // c_v where heat can move, J/(kg K)
  // Of affine transfers and spins: second moments of the shape functions by direction, m^2. Within
  // a particle they carry m tr(C M C^T)/2 beside m v^2/2, or m w . I w/2 (mpm_transfers.md).
  Vec3 moment{};
};

// x of n particles to a sum, each rounded to 46 bits of the bound of which the unit was made, so
// that no bit depends on their order.
void add_rounded(const double* x, int n, double unit, ExactSum& to);

// Adds masses and energies of n particles from `at` on: as they were in `set`, as they are in
// `next`.
void add_energies(const ParticleSet& set, const ParticleSet& next, const Columns& columns,
                  std::size_t at, int n, EnergyUnits unit, BodyEnergySums& to);

}  // namespace sluice::mpm
