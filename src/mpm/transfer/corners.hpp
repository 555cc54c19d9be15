// Particles as parallelepipeds (CPDI) or tetrahedra (CPTI) that deform: corners and their weights.
//
//   E = F diag(h) R0 (columns: full edges), corners x_c = x + E s_c/2, s_c all vectors of signs;
//   S_i = 2^-D sum_c N_i(x_c),  grad S_i = sum_c al_c N_i(x_c),  al_c = 2^(1-D) E^-T s_c
//
// with the hats N_i (A. Sadeghirad, R. M. Brannon, J. Burghardt, IJNME 86 (2011) 1435). CPTI: the
// edges go out from one corner of a tetrahedron, x is its centroid:
//
//   x_0 = x - (e_1 + e_2 + e_3)/4, x_k = x_0 + e_k;  S_i = 1/4 sum_c N_i(x_c),
//   al_k = row k of E^-1, al_0 = -(al_1 + al_2 + al_3)
//
// (R. B. Leavy et al., Comput. Mech. 64 (2019) 563). Along directions that are not active particles
// have no extent. Half diagonals longer than TransferGrid::corner_limit are cut to it, each for
// itself, and the edges follow from the diagonals (M. A. Homel, R. M. Brannon, J. Guilkey, IJNME
// 107 (2016) 31). Mirror images have mirrored bits: sums over corners go by pairs (corner_sum).
//
// Particles that carry their corners (corner_volume.hpp): S_i as above with x_c, al_c = b_c/V.
#pragma once
#include "mpm/shape/weights.hpp"
#include "mpm/transfer/particle_shape.hpp"
#include "solids/corner_volume.hpp"

namespace sluice::mpm {

using solids::corner_sum;
using solids::CornerVolume;
using solids::farthest_corner;
using solids::read_carried;

// Of the particles of a chunk. Corner c has the sign + along edge a where bit a of c is set.
template <int D, bool Tetrahedron>
struct Corners {
  static constexpr int count = Tetrahedron ? D + 1 : 1 << D;
  static constexpr double share = 1.0 / count;     // of a particle, for each corner
  alignas(64) double s[count][D][chunk_size];      // place within its cell, from the middle, cells
  alignas(64) double way[count][D][chunk_size];    // from the particle, cells
  alignas(64) double slope[count][D][chunk_size];  // al_c, 1/length
  alignas(64) int first[count][D][chunk_size];     // lower node of its cell
};

// Particles at, ..., at + n - 1 of columns; without slopes where values alone pass. Instantiated
// for D = 1 to 3, tetrahedra for D = 3.
enum class Slopes { wanted, unused };
template <int D, bool Tetrahedron>
void find_corners(const TransferGrid& grid, const std::array<const double*, 3>& x,
                  const ParticleShape& shape, int at, int n, Slopes slopes,
                  Corners<D, Tetrahedron>& to);

// How far particles begin to end - 1 reach, and how steep their shape functions are.
struct CornerReach {
  double extent = 0;  // largest distance of a corner from its particle along a direction, cells
  double slope = 0;   // largest sum_d |al_c,d|, 1/length
};
CornerReach corner_reach(Basis basis, const TransferGrid& grid, const ParticleShape& shape,
                         int begin, int end);

}  // namespace sluice::mpm
