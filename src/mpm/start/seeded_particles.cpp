// Rows into columns.
#include "mpm/start/seeded_particles.hpp"

#include <cmath>

namespace sluice::mpm {
namespace {

void add(std::array<SeededParticles::Column, 3>& columns, Vec3 v) {
  columns[0].push_back(v.x);
  columns[1].push_back(v.y);
  columns[2].push_back(v.z);
}

}  // namespace

void append(SeededParticles& particles, const SeededParticle& row, const OptionalColumns& columns) {
  particles.x.push_back(row.x.x);
  particles.y.push_back(row.x.y);
  particles.z.push_back(row.x.z);
  add(particles.velocity, row.velocity);
  particles.mass.push_back(row.mass);
  particles.volume.push_back(row.volume);
  for (std::size_t n = 0; n < 9; ++n) particles.edges[n].push_back(row.edges[n]);
  particles.temperature.push_back(row.temperature);
  particles.concentration.push_back(row.concentration);
  particles.colour.push_back(row.colour);
  particles.id.push_back(row.id);
  particles.surface.push_back(row.surface ? 1 : 0);
  if (columns.corners) particles.corners.push_back(row.corners);
  if (columns.external_force) add(particles.external_force, row.external_force);
  if (columns.fibre) add(particles.fibre, row.fibre);
  if (columns.normal) add(particles.normal, row.normal);
  if (columns.load_curve)
    for (int d = 0; d < 3; ++d)
      particles.load_curve[d].push_back(static_cast<int>(std::lround(row.load_curve[d])));
}

}  // namespace sluice::mpm
