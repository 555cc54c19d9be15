// How often a point lies inside of a particle with corners: its winding number.
//
// The signed crossings of the ray from the point along +x with the facets of the particle
// (corner_table.hpp). Two particles that share a face find the same crossings with opposite signs,
// to the bit: each facet is taken with its nodes in one order, and what the ray meets exactly is
// decided as if the point were moved by infinitesimal lengths along y and z. So the numbers of all
// particles of a body add up to 1 inside of it, 0 outside, whatever lies between them.
#pragma once
#include "mpmice/geometry/corner_table.hpp"
#include "mpmice/geometry/facet.hpp"

namespace sluice::mpmice {

// Places of the corners of one particle, [corner][direction].
template <int D>
using ParticleCorners = std::array<std::array<double, D>, corners_of_particle<D>>;

// Of a point in a particle: 1 or 0, -1 where the particle is turned inside out, and what they add
// up to where it overlaps itself.
template <int D>
int winding_number(const ParticleCorners<D>& corners, const std::array<double, D>& point);

// Where the point of a cell lies that is asked, cells from its low corner. Irrational, so that
// lattices of corners do not meet it.
inline constexpr std::array<double, 3> inside_point{0.38196601125010515, 0.41421356237309503,
                                                    0.57721566490153287};

}  // namespace sluice::mpmice
