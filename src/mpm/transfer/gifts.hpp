// What particles give to nodes, as lanes that are scaled to integers.
#pragma once
#include "mpm/nodes/node_sums.hpp"
#include "mpm/transfer/to_grid.hpp"

namespace sluice::mpm {

// Of one particle: lanes M, P | f, count.
//   momentum half: (mass_momentum + sum_d affine_d (x_i - x_p)_d) S
//   force half:    load S + sum_d traction_d dS/dx_d
// Before they are scaled: M in kg, P and its share sum affine x S in kg m/s, f and load in N,
// traction (the part of V sigma along an axis) in N m, affine in kg/s.
struct alignas(64) NodalContribution {
  Four mass_momentum, load;
  Four traction[3];  // of the active directions, in their order
  Four affine[3];
};

// Particles at, ..., at + n - 1 of columns, n <= chunk_size.
void nodal_contributions(const TransferGrid& grid, const ParticlesToGrid& p, int at, int n,
                         const SumUnits& units, NodalContribution* gifts);

}  // namespace sluice::mpm
