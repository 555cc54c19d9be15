// Rigid bodies that transmit forces: no particle of them has an equation of its own; what contact
// gives them, loads and gravity move all of them alike, dv = (J + dk sum f)/M + dk g.
#include <algorithm>

#include "framework/base/reduction.hpp"
#include "mpm/step/solid_step.hpp"

namespace sluice::mpm {

bool SolidStep::transmits(int m) const {
  return bodies_[static_cast<std::size_t>(m)].material->force_transmitting &&
         (contact_ == nullptr || contact_->motion_of(m) == nullptr);
}

// Mass and forces from outside on this rank's particles of a body.
void SolidStep::sum_body(int kind, double kick, std::array<ExactSum, 4>& sums) const {
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

// Collective. `given`: impulses that contact gave to other bodies, by body, of this rank.
void SolidStep::move_transmitting(const StageScope& scope, const NodeStep& step,
                                  std::span<const Impulse> given, NodeBooks& books) {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    Body& body = bodies_[k];
    body.pushed = {};
    if (!transmits(static_cast<int>(k))) continue;
    std::array<ExactSum, 4> sums;
    sum_body(static_cast<int>(k), step.kick, sums);
    std::array<ExactSum, 4> loads = sums;
    for (std::size_t d = 0; d < 3; ++d) sums[1 + d].subtract(given[k][d]);
    Reduction all;
    std::array<Reduction::Sum, 4> slots;
    for (std::size_t s = 0; s < 4; ++s) slots[s] = all.add_sum(sums[s]);
    scope.ranks->reduce(all);
    const double mass = all.sum(slots[0]).value();
    for (int d = 0; d < 3; ++d) {
      const auto a = static_cast<std::size_t>(d);
      body.pushed[d] = level_.active[a] && mass > 0
                           ? all.sum(slots[1 + a]).value() / mass + step.kick * step.gravity[d]
                           : 0.0;
      // What is no reaction came from outside; the reaction others have given.
      books.sums[static_cast<std::size_t>(StepSums::force_x + d)].add(
          loads[1 + a].value() + step.kick * step.gravity[d] * loads[0].value());
    }
  }
}

}  // namespace sluice::mpm
