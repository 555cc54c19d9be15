// Corners that particles carry, in a step: they move with the grid, x_k' = x_k + dt v*(x_k), and
// the particle is what they span.
#pragma once
#include <optional>

#include "mpm/material/base/material.hpp"
#include "mpm/step/body.hpp"
#include "mpm/transfer/from_grid.hpp"

namespace sluice::mpm {

Vec3 corner_at(const ParticleSet& set, const Columns& columns, int corner, std::size_t p);

// Corners of particles at, ..., at + n - 1 after dt of the velocities reference + v that were read;
// new places: the middles of the corners. dt v* is a multiple of Axis::unit, so that adding it is
// exact: what moves as a whole keeps its shape to the bit, however far it goes.
void move_corners(const Body& body, const BlockWork& work, std::size_t at, int n, Vec3 reference,
                  double dt, const VelocitiesAtCorners& v);

// J = V/V_0 of the new corners. New F, which has gone on by dt L F, L = sum_k v_k (x) b_k/V, is
// scaled by s along the active directions to det F = J, and L becomes that of this step:
// I + dt L' = s (I + dt L). What is wrong: the first particle that encloses nothing any more, or
// has a corner far away.
std::optional<BatchFault> deform_to_corners(const Body& body, const BlockWork& work, std::size_t at,
                                            const Batch& batch, GridAtParticles& read);

// After the framework took particles across periodic ends: their corners follow.
void wrap_corners(const Level& level, const Columns& columns, ParticleSet& set);

// Volume per length, area or volume that the corners span: the particle's widths along the
// directions that are not active.
double depth_of(const TransferGrid& grid, const Nine<const double>& edges, std::size_t p);

}  // namespace sluice::mpm
