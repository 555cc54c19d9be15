#include "mpm/step/particle_temperature.hpp"

#include <algorithm>

namespace sluice::mpm {

void HeatOfLaw::to_particles(const Chunk& chunk) {
  const int column = chunk.columns().temperature;
  const double *before = chunk.old(column), *heating = chunk.buffers->heating;
  const double dt = chunk.dt();
  double* T = chunk.made(column);
  for (int q = 0; q < chunk.n; ++q) T[q] = before[q] + dt * heating[q];
}

bool SavedHeating::possible(const std::vector<Carried>& carried) {
  return std::any_of(carried.begin(), carried.end(),
                     [](const Carried& of) { return of.columns.heating >= 0; });
}

void SavedHeating::to_particles(const Chunk& chunk) {
  const Columns& c = chunk.columns();
  if (c.heating < 0) return;
  const double *before = chunk.old(c.temperature), *T = chunk.made(c.temperature);
  const double dt = chunk.dt();
  double* rate = chunk.made(c.heating);
  for (int q = 0; q < chunk.n; ++q) rate[q] = (T[q] - before[q]) / dt;
}

}  // namespace sluice::mpm
