// Rigid bodies that transmit forces: no particle of them has an equation of its own; what contact
// gives them, loads and gravity move all of them alike, dv = (J + dk sum f)/M + dk g.
#include "mpm/step/solid_step.hpp"

namespace sluice::mpm {

bool SolidStep::transmits(int m) const {
  return bodies_[static_cast<std::size_t>(m)].material->force_transmitting &&
         (contact_ == nullptr || contact_->motion_of(m) == nullptr);
}

const MassAndImpulse& SolidStep::transmitted(int m) const {
  return transmitted_[static_cast<std::size_t>(m)];
}

// Mass and forces from outside on this rank's particles of a body.
void SolidStep::sum_body(int kind, double kick, MassAndImpulse& sums) const {
  const Columns& c = (*carried_)[static_cast<std::size_t>(kind)].columns;
  for (const BlockWork& w : work_) {
    if (w.kind != kind) continue;
    const double* mass = w.set->column(static_cast<std::size_t>(c.mass));
    const OutsideForces::Columns3 f = outside_->forces(kind, w.box);
    for (std::size_t p = w.run.begin; p < w.run.end; ++p) {
      sums[0].add(mass[p]);
      for (std::size_t d = 0; d < 3 && f[0] != nullptr; ++d) sums[1 + d].add(kick * f[d][p]);
    }
  }
}

// Less what contact gave to other bodies. What is no reaction came from outside; the reaction
// others have given.
void SolidStep::sum_transmitted(const NodeStep& step, NodeBooks& books) {
  transmitted_.assign(bodies_.size(), {});
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    bodies_[k].pushed = {};
    if (!transmits(static_cast<int>(k))) continue;
    MassAndImpulse& sums = transmitted_[k];
    sum_body(static_cast<int>(k), step.kick, sums);
    for (std::size_t d = 0; d < 3; ++d) {
      books.sums[StepSums::force_x + d].add(
          sums[1 + d].value() + step.kick * step.gravity[static_cast<int>(d)] * sums[0].value());
      sums[1 + d].subtract(books.given[k][d]);
    }
  }
}

// `mass`, `impulse`: of the whole body. dv = J/M + dk g.
void SolidStep::push(int m, double mass, Vec3 impulse) {
  for (int d = 0; d < 3; ++d)
    body(m).pushed[d] =
        level_.active[static_cast<std::size_t>(d)] && mass > 0 ? impulse[d] / mass + fall_[d] : 0.0;
}

}  // namespace sluice::mpm
