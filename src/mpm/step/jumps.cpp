#include "mpm/step/jumps.hpp"

namespace sluice::mpm {

void Jumps::jump(const Chunk& chunk, int q, const Insertion& by) const {
  const Columns& c = chunk.columns();
  for (int d = 0; d < 3; ++d) {
    (chunk.work->next->coordinate(d) + chunk.at)[q] += by.way[d];
    chunk.made(c.velocity + d)[q] = by.velocity[d];
    if (c.spin >= 0) chunk.made(c.spin + d)[q] = 0;
    const double way = chunk.body->grid.axes[static_cast<std::size_t>(d)].rounded(by.way[d]);
    for (int k = 0; k < c.corner_count; ++k) chunk.made(c.corners + 3 * k + d)[q] += way;
  }
}

void Jumps::to_particles(const Chunk& chunk) {
  if (now_.empty() || chunk.columns().colour < 0) return;
  const double* colour = chunk.old(chunk.columns().colour);
  for (const Insertion& by : now_) {
    if (by.material >= 0 && by.material != chunk.kind()) continue;
    for (int q = 0; q < chunk.n; ++q) {
      if (colour[q] != by.colour) continue;
      jump(chunk, q, by);
      chunk.report->left = true;  // of its block at least
    }
  }
}

}  // namespace sluice::mpm
