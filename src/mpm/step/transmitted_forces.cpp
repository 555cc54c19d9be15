#include "mpm/step/transmitted_forces.hpp"

namespace sluice::mpm {

TransmittedForces::TransmittedForces(const MpmScene& solids, const std::vector<Carried>& carried,
                                     const std::vector<BlockWork>& work,
                                     const OutsideForces& outside, const Contact* rules)
    : solids_(&solids),
      carried_(&carried),
      work_(&work),
      outside_(&outside),
      rules_(rules),
      sums_(solids.materials.size()),
      pushed_(solids.materials.size()) {}

bool TransmittedForces::transmits(int m) const {
  return transmits_forces(solids_->materials[static_cast<std::size_t>(m)],
                          rules_ != nullptr ? rules_->motion_of(m) : nullptr);
}

// Mass and forces from outside on this rank's particles of a body.
void TransmittedForces::sum_particles(int m, double kick, MassAndImpulse& sums) const {
  const Columns& c = (*carried_)[static_cast<std::size_t>(m)].columns;
  for (const BlockWork& w : *work_) {
    if (w.kind != m) continue;
    const double* mass = w.set->column(static_cast<std::size_t>(c.mass));
    const OutsideForces::Columns3 f = outside_->forces(m, w.box);
    for (std::size_t p = w.run.begin; p < w.run.end; ++p) {
      sums[0].add(mass[p]);
      for (std::size_t d = 0; d < 3 && f[0] != nullptr; ++d) sums[1 + d].add(kick * f[d][p]);
    }
  }
}

void TransmittedForces::after_nodes(const NodeStep& step, NodeBooks& books) {
  fall_ = step.kick * step.gravity;
  sums_.assign(sums_.size(), {});
  for (std::size_t k = 0; k < sums_.size(); ++k) {
    pushed_[k] = {};
    const int m = static_cast<int>(k);
    if (!transmits(m)) continue;
    MassAndImpulse& sums = sums_[k];
    sum_particles(m, step.kick, sums);
    for (std::size_t d = 0; d < 3; ++d) {
      const int axis = static_cast<int>(d);
      books.add(StepSums::force_x + axis,
                sums[1 + d].value() + step.kick * step.gravity[axis] * sums[0].value());
      sums[1 + d].subtract(books.given[k][d]);
    }
  }
}

void TransmittedForces::push(int m, double mass, Vec3 impulse, const std::array<bool, 3>& active) {
  Vec3& to = pushed_[static_cast<std::size_t>(m)];
  for (int d = 0; d < 3; ++d)
    to[d] = active[static_cast<std::size_t>(d)] && mass > 0 ? impulse[d] / mass + fall_[d] : 0.0;
}

}  // namespace sluice::mpm
