// The books of forces from outside, and their saved column.
#include "mpm/step/solid_step.hpp"

namespace sluice::mpm {

// Impulse dk f and work dk f . (v + v*)/2 at the places of the particles: with the weights of the
// particle sum to the same over nodes.
void SolidStep::take_outside_forces(const BlockWork& w, std::size_t at, int n,
                                    const GridAtParticles& read, NodeBooks& books) const {
  const Columns& c = (*carried_)[static_cast<std::size_t>(w.kind)].columns;
  const OutsideForces::Columns3 f = outside_->forces(w.kind, w.box);
  if (c.outside_force >= 0)
    for (int d = 0; d < 3; ++d) {
      double* to = w.next->column(static_cast<std::size_t>(c.outside_force + d)) + at;
      for (int q = 0; q < n; ++q) {
        const std::size_t p = at + static_cast<std::size_t>(q);
        to[q] = f[0] == nullptr ? 0.0 : f[static_cast<std::size_t>(d)][p];
        if (d == 0) to[q] -= outside_->hoop(w.kind, *w.set, p);
      }
    }
  if (f[0] == nullptr) return;
  const Vec3 reference = bodies_[static_cast<std::size_t>(w.kind)].units.reference;
  for (int q = 0; q < n; ++q) {
    const std::size_t p = at + static_cast<std::size_t>(q);
    Vec3 force{f[0][p], f[1][p], f[2][p]};
    if (force == Vec3{}) continue;
    for (int d = 0; d < 3; ++d)
      books.sums[static_cast<std::size_t>(StepSums::force_x + d)].add(kick_ * force[d]);
    force.x -= outside_->hoop(w.kind, *w.set, p);
    double power = 0;
    for (int d = 0; d < 3; ++d)
      power += force[d] * (reference[d] + read.u[d][q] - 0.5 * read.dv[d][q]);
    books.sums[StepSums::force_work].add(kick_ * power);
  }
}

}  // namespace sluice::mpm
