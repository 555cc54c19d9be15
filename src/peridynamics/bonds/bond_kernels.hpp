// Sums over bonds, eight points at a time: dilatation, forces, stability.
//
// A bond from i to j has xi = X_j - X_i, r = |xi|, eta = u_j - u_i, y = |xi + eta|, the direction
// M = (xi + eta)/y and the extension e = (2 xi.eta + eta.eta)/(y + r), which loses no digits where
// eta is small.
//
//   theta_i = (d/m_i) sum w r e V_j
//   t_ij + t_ji = w [ r (A_i + A_j) + e (B_i + B_j) + (e/r) (C_i + C_j) ]
//   A = theta (d k - (d+2) mu)/m,  B = d (d+2) mu/m  (LPS);   C = k d^2/sum w r V  (PMB)
//   f_i = sum (t_ij + t_ji) M V_j
//   W_i = (k/2 - (d+2) mu/(2 d)) theta^2 + (B_i/2) sum w e^2 V_j + sum (C_i + C_j) w e^2/(4 r) V_j
// Everything of a pair is the same in both its ends, to the bit. d = 2: places lie in x and y.
// A bond breaks where e > 0 and e > s r or omega (t_ij + t_ji)/w e/2 > w_c, the smaller limit of
// both ends. SI units: m, Pa, N/m^3, J/m^3.
#pragma once
#include <array>
#include <vector>

#include "peridynamics/bonds/families.hpp"

namespace sluice::peridynamics {

// Columns of all points, with margins.
struct BondInput {
  std::array<const double*, 3> X{}, u{};
  const double* V = nullptr;
  const double *A = nullptr, *B = nullptr;  // null: no LPS
  const double* C = nullptr;                // null: no PMB
  // Limits of damage; null: no such criterion. `never` is 0, or so large that no bond breaks.
  const double *stretch = nullptr, *energy = nullptr, *never = nullptr;
  const double* horizon = nullptr;
  Influence influence = Influence::one;
  int dimensions = 3;
};

// What forces give to own points.
struct BondOutput {
  std::array<double*, 3> force{};  // N/m^3
  double* bond_energy = nullptr;   // J/m^3: the sums of W
};

// sum w r e V of the points of a chunk.
void sum_extensions(const BondTile& tile, const BondChunk& chunk, const BondInput& in,
                    double* sums);
// Forces on them; true where a bond is beyond its limit.
bool sum_forces(const BondTile& tile, const BondChunk& chunk, const BondInput& in,
                const BondOutput& out);
// Breaks the bonds that are beyond their limit; how many of each point.
int break_bonds(BondTile& tile, const BondChunk& chunk, const BondInput& in, int (&broken)[8]);

// lambda_max of sum_j V_j C_ij n n^T, C_ij = w [(D_i + D_j) + (C_i + C_j)/r], n = xi/r, of each
// point: no frequency of the linear body is above sqrt(2 lambda_max/rho). N/m^4.
void bound_stiffness(const BondTile& tile, const BondChunk& chunk, const BondInput& in,
                     const double* D, double* bound);

}  // namespace sluice::peridynamics
