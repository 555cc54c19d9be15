#include "peridynamics/step/peri_step.hpp"

#include <fmt/format.h>

#include <cmath>

#include "framework/base/reduction.hpp"
#include "framework/run/levels/level_solver.hpp"
#include "framework/run/levels/particle_cloud.hpp"

namespace sluice::peridynamics {
namespace {

const ThreadTeam* team_of(const StageScope& scope) {
  return scope.levels.front()->team();
}

}  // namespace

// act(entry) for each own point.
template <class Act>
void PeriStep::for_own(Act act) const {
  for (const BondTile& tile : points_->families().tiles)
    for (const BondChunk& chunk : tile.chunks)
      for (int i = chunk.first; i < chunk.first + chunk.lanes; ++i)
        act(static_cast<std::size_t>(i));
}

// v' = (1 - c) v + dt a/2, u += dt v'. Images follow by the exchange.
Verdict PeriStep::move(const StageScope& scope) {
  sums_ = {};
  const double dt = scope.step.dt, half = 0.5 * dt;
  const Motion& now = points_->present();
  Motion& next = points_->next();
  const std::size_t size = now.u[0].size();
  for (std::size_t d = 0; d < 3; ++d) {
    const double *u = now.u[d].data(), *v = now.v[d].data(), *a = now.a[d].data();
    double *u_next = next.u[d].data(), *v_next = next.v[d].data();
    if (scene_->damping > 0) {
      for_own([&](std::size_t i) {
        const double c = 0.5 * scene_->damping * dt / points_->density(static_cast<int>(i));
        v_next[i] = (1 - c) * v[i] + half * a[i];
        u_next[i] = u[i] + dt * v_next[i];
      });
      continue;
    }
#pragma GCC ivdep
    for (std::size_t i = 0; i < size; ++i) {
      v_next[i] = v[i] + half * a[i];
      u_next[i] = u[i] + dt * v_next[i];
    }
  }
  return Verdict::good;
}

Verdict PeriStep::exchange_displacements(const StageScope& /*scope*/) {
  points_->fill_displacements(points_->next().u);
  return Verdict::good;
}

Verdict PeriStep::sum_dilatations(const StageScope& scope) {
  points_->sum_dilatations(points_->next().u, team_of(scope));
  return Verdict::good;
}

Verdict PeriStep::exchange_dilatations(const StageScope& /*scope*/) {
  points_->fill_dilatations();
  return Verdict::good;
}

Verdict PeriStep::sum_forces(const StageScope& scope) {
  beyond_ = points_->sum_forces(points_->next().u, team_of(scope));
  return Verdict::good;
}

// a = f/rho + g, v = (v' + dt a/2)/(1 + c).
Verdict PeriStep::finish_velocities(const StageScope& scope) {
  const double dt = scope.step.dt, half = 0.5 * dt;
  Motion& next = points_->next();
  bool finite = true;
  std::size_t first = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const double g = scene_->gravity[static_cast<int>(d)];
    const double* f = points_->force()[d].data();
    double *a = next.a[d].data(), *v = next.v[d].data();
    for_own([&](std::size_t i) {
      const double rho = points_->density(static_cast<int>(i));
      a[i] = f[i] / rho + g;
      v[i] += half * a[i];
      if (scene_->damping > 0) v[i] /= 1 + 0.5 * scene_->damping * dt / rho;
      if (!std::isfinite(v[i]) && finite) {
        finite = false;
        first = i;
      }
    });
  }
  Reduction all;
  const auto bad = all.add_any(!finite);
  const auto where =
      all.add_minimum(finite ? 1e300 : static_cast<double>(points_->points().id[first]));
  scope.ranks->reduce(all);
  if (all.any(bad)) {
    *scope.reason = fmt::format(
        "stage 'second half of velocities': the velocity of point {:.0f} is not a finite number",
        all.minimum(where));
    return Verdict::reject;
  }
  sum_books(scope);
  return Verdict::good;
}

// Impulse and work of forces from outside, what drag takes, impulse of sides.
void PeriStep::sum_books(const StageScope& scope) {
  const double dt = scope.step.dt;
  const Motion &now = points_->present(), &next = points_->next();
  const bool sides = !scene_->mirrors.empty();
  for (std::size_t d = 0; d < 3; ++d) {
    const double g = scene_->gravity[static_cast<int>(d)];
    if (g != 0)
      for_own([&](std::size_t i) {
        const double force = points_->mass(static_cast<int>(i)) * g;
        sums_[StepSums::force_x + d].add(force * dt);
        sums_[StepSums::work].add(force * (next.u[d][i] - now.u[d][i]));
      });
    // What bonds to images give to all points: half of it before the move, half behind.
    if (sides)
      for_own([&](std::size_t i) {
        sums_[StepSums::side_x + d].add(0.5 * dt * points_->mass(static_cast<int>(i)) *
                                        ((now.a[d][i] - g) + (next.a[d][i] - g)));
      });
    // Drag works by -gamma (v_n + v_(n+1))/2 on the way of the step.
    if (scene_->damping > 0)
      for_own([&](std::size_t i) {
        const double v = 0.5 * (now.v[d][i] + next.v[d][i]);
        const double force = scene_->damping * points_->points().V[i] * v;
        sums_[StepSums::side_x + d].add(-dt * force);
        sums_[StepSums::drag].add(force * (next.u[d][i] - now.u[d][i]));
      });
  }
}

bool PeriStep::some_beyond(const StageScope& scope, bool here) const {
  Reduction all;
  const auto any = all.add_any(here);
  scope.ranks->reduce(all);
  return all.any(any);
}

// The bonds that the last forces found beyond their limit; then forces with those that are left.
Verdict PeriStep::break_bonds(const StageScope& scope) {
  if (!some_beyond(scope, beyond_)) return Verdict::good;
  Motion& next = points_->next();
  const auto add_energy = [&](double sign) {
    for_own([&](std::size_t i) {
      sums_[StepSums::broken].add(sign * points_->energy()[i] * points_->points().V[i]);
    });
  };
  add_energy(1);
  // Each bond is in the rows of both its points; of one with an image one is another rank's.
  sums_[StepSums::bonds].add(0.5 * static_cast<double>(points_->break_bonds(next.u)));
  points_->sum_dilatations(next.u, team_of(scope));
  points_->fill_dilatations();
  points_->sum_forces(next.u, team_of(scope));
  add_energy(-1);
  for (std::size_t d = 0; d < 3; ++d) {
    const double g = scene_->gravity[static_cast<int>(d)];
    const double* f = points_->force()[d].data();
    double* a = next.a[d].data();
    for_own([&](std::size_t i) { a[i] = f[i] / points_->density(static_cast<int>(i)) + g; });
  }
  return Verdict::good;
}

// Limits are looked at with the dilatation of the new places, before forces.
Verdict PeriStep::break_before_forces(const StageScope& scope) {
  beyond_ = points_->sum_forces(points_->next().u, team_of(scope));
  return break_bonds(scope);
}

Verdict PeriStep::commit(const StageScope& scope) {
  Reduction all;
  std::array<Reduction::Sum, StepSums::count> slots;
  for (std::size_t n = 0; n < sums_.size(); ++n) slots[n] = all.add_sum(sums_[n]);
  scope.ranks->reduce(all);
  for (std::size_t n = 0; n < sums_.size(); ++n) (*scope.sums)[n] = all.sum(slots[n]).value();
  (*scope.maxima)[0].resize(std::max<std::size_t>(1, (*scope.maxima)[0].size()));
  scope.journal->at_acceptance(
      [this, cloud = scope.particles, end = scope.step.time + scope.step.dt] {
        points_->commit(*cloud);
        cloud->commit(end);
      });
  return Verdict::good;
}

}  // namespace sluice::peridynamics
