// Volumes of particles and their gradients with respect to corners, in chunks.
//
//   b_k = dV_p/dx_k, V_p = (1/D) sum_k b_k.(x_k - x_0)
//   1-D: -1, 1;  2-D: R(x_next - x_prev)/2, R(a, b) = (b, -a);
//   3-D: over the faces a b c d of corner k, with centre m,
//        (c - a) x (d - b)/24 + (x_prev - x_next) x (x_k - m)/6
//
// (the volume inside the facets of corner_table.hpp). Then sum_k b_k = 0,
// sum_k b_k (x) x_k = V_p 1, dV_p/dt = sum_k b_k.v_k, and V_p grad S_ip = sum_k b_k N_i(x_k) is the
// mean gradient of the hat N_i over the particle as its corners see it.
#pragma once
#include "mpm/shape/weights.hpp"
#include "mpmice/geometry/outer_faces.hpp"

namespace sluice::mpmice {

using mpm::chunk_size;

// Of the particles of a chunk.
template <int D>
struct VolumeGradients {
  alignas(64) double b[corners_of_particle<D>][D][chunk_size];  // [corner][direction]
  alignas(64) double volume[chunk_size];
};

// Particles at, ..., at + n - 1 of columns, n <= chunk_size; volumes in units of x^D.
template <int D>
void volume_gradients(const CornerColumns<D>& x, std::size_t at, int n, VolumeGradients<D>& to);

}  // namespace sluice::mpmice
