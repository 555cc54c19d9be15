#include "mpm/levels/solid_levels.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/reduction.hpp"
#include "framework/grid/grid_boxes.hpp"
#include "mpm/step/book_leaving.hpp"
#include "mpm/step/carry_corners.hpp"
#include "mpm/step/split_particles.hpp"

namespace sluice::mpm {
SolidLevels::SolidLevels(const Scene& scene, const MpmScene& solids,
                         const std::vector<Carried>& carried,
                         const std::vector<ParticleKind>& kinds)
    : scene_(&scene), solids_(&solids), carried_(&carried), kinds_(&kinds) {}

void SolidLevels::look_at_levels(const StageScope& scope) {
  const std::size_t count = scope.levels.size();
  present_.resize(count);
  interfaces_.resize(count - 1);
  for (std::size_t l = 0; l < count; ++l) {
    const Level& now = scope.levels[l]->level();
    const bool same = l < steps_.size() && same_boxes(present_[l].boxes, now.boxes);
    if (l >= steps_.size())
      steps_.push_back(std::make_unique<SolidStep>(*scene_, *solids_, *carried_, *kinds_));
    if (!same && l > 0) interfaces_[l - 1] = std::make_unique<CompositeNodes>(now);
    present_[l] = now;
  }
  steps_.resize(count);
}

StageScope SolidLevels::scope_of(const StageScope& scope, int l) {
  StageScope own = scope;
  own.levels = {scope.levels[l]};
  own.maxima = &maxima_[l];
  return own;
}

Verdict SolidLevels::on_levels(const StageScope& scope, Stage stage) {
  for (int l = 0; l < count(); ++l)
    if ((level(l).*stage)(scope_of(scope, l)) == Verdict::reject) return Verdict::reject;
  return Verdict::good;
}

// Sums of all levels count in the same units: bounds are those of all particles.
Verdict SolidLevels::begin(const StageScope& scope) {
  look_at_levels(scope);
  std::vector<double> all((*scope.maxima)[0].size());
  for (std::size_t l = 0; l < steps_.size(); ++l) {
    const std::vector<double>& own = (*scope.maxima)[l];
    for (std::size_t n = 0; n < all.size(); ++n)
      all[n] = l == 0 ? own[n] : std::max(all[n], own[n]);
  }
  maxima_.assign(steps_.size(), {all});
  for (const auto& step : steps_)
    step->spacings() = {present_.back().spacing, present_.front().spacing};
  const Verdict verdict = on_levels(scope, &SolidStep::begin);
  if (count() > 1)
    for (int m = 0; m < static_cast<int>(solids_->materials.size()); ++m) {
      double most = 0;
      for (int l = 0; l < count(); ++l) most = std::max(most, level(l).body(m).most_force);
      for (int l = 0; l < count(); ++l) level(l).set_most_force(m, most);
    }
  return verdict;
}

// A force gives no node more than its own largest component.
void SolidLevels::add_corner_forces(const StageScope& scope,
                                    const std::vector<std::vector<solids::CornerForces>>& forces) {
  const std::size_t kinds = kinds_->size();
  std::vector<double> most(kinds);
  for (std::size_t l = 0; l < forces.size(); ++l)
    for (std::size_t m = 0; m < kinds; ++m) {
      level(static_cast<int>(l)).effects().corners().add(static_cast<int>(m), forces[l][m]);
      for (const CornerForce& f : forces[l][m])
        for (int d = 0; d < 3; ++d) {
          const double size = std::fabs(f.force[d]);
          if (!(size <= most[m])) most[m] = size;  // NaN too
        }
    }
  Reduction all;
  std::vector<Reduction::Maximum> slots;
  for (const double force : most) slots.push_back(all.add_maximum(force));
  scope.ranks->reduce(all);
  for (int m = 0; m < static_cast<int>(kinds); ++m)
    for (int l = 0; l < count(); ++l) {
      const double own = level(l).body(m).most_force;
      level(l).set_most_force(m, std::max(own, all.maximum(slots[m])));
    }
}

SolidLevels::BeforeAndAfter SolidLevels::moved(ParticleCloud& cloud, int kind, int l, int box) {
  ParticleStore& store = cloud.store(kind);
  return {store.set(l, box), store.next(l, box)};
}

Verdict SolidLevels::to_grid(const StageScope& scope) {
  return on_levels(scope, &SolidStep::to_grid);
}

// Images join their nodes; coarse nodes under a finer level join the fine ones there; from the
// finest level on ranks agree, and hanging nodes join the coarse ones around them.
Verdict SolidLevels::share_sums(const StageScope& scope) {
  join_sums(scope, nodes_of);
  return Verdict::good;
}

void SolidLevels::join_sums(const StageScope& scope, NodeGroup group) {
  for (const auto& step : steps_) step->fold(group);
  for (int m = 0; m < static_cast<int>(solids_->materials.size()); ++m)
    for (int l = 0; l + 1 < count(); ++l) {
      interfaces_[l]->to_fine(level(l).body(m).table, group(level(l), m),
                              level(l + 1).body(m).table, group(level(l + 1), m));
    }
  for (int l = count() - 1; l >= 0; --l) {
    level(l).share_sums(scope_of(scope, l), group);
    if (l == 0) break;
    const CompositeNodes& joint = *interfaces_[l - 1];
    for (int m = 0; m < static_cast<int>(solids_->materials.size()); ++m) {
      BlockTable &coarse = level(l - 1).body(m).table, &fine = level(l).body(m).table;
      NodeLanes &to = group(level(l - 1), m), &from = group(level(l), m);
      joint.add_parents(fine, from, coarse, to);
      joint.to_coarse(fine, from, coarse, to,
                      [&](int block) { return level(l).nodes().booked(fine, block); });
    }
  }
}

Verdict SolidLevels::move_nodes(const StageScope& scope) {
  if (on_levels(scope, &SolidStep::move_nodes) == Verdict::reject) return Verdict::reject;
  push_transmitting(scope);
  if (count() == 1) return Verdict::good;
  spread_velocities(nodes_of);
  if (solids_->contact_heats() && solids_->prescribed_file.empty()) {
    spread(friction_of);
    for (const auto& step : steps_) step->effects().friction()->unfold();
  }
  return Verdict::good;
}

void SolidLevels::push_transmitting(const StageScope& scope) {
  for (int m = 0; m < static_cast<int>(solids_->materials.size()); ++m) {
    if (!level(0).effects().transmitted().transmits(m)) continue;
    MassAndImpulse sums;
    for (const auto& step : steps_)
      for (std::size_t s = 0; s < sums.size(); ++s)
        sums[s].merge(step->effects().transmitted().sums(m)[s]);
    Reduction all;
    std::array<Reduction::Sum, 4> slots;
    for (std::size_t s = 0; s < sums.size(); ++s) slots[s] = all.add_sum(sums[s]);
    scope.ranks->reduce(all);
    std::array<double, 4> total;
    for (std::size_t s = 0; s < sums.size(); ++s) total[s] = all.sum(slots[s]).value();
    for (std::size_t l = 0; l < steps_.size(); ++l)
      steps_[l]->effects().transmitted().push(m, total[0], {total[1], total[2], total[3]},
                                              present_[l].active);
  }
}

void SolidLevels::spread_velocities(NodeGroup group) {
  spread(group);
  for (const auto& step : steps_) step->unfold(group);
}

void SolidLevels::spread(NodeGroup group) {
  for (int m = 0; m < static_cast<int>(solids_->materials.size()); ++m) {
    for (int l = 0; l + 1 < count(); ++l) {
      interfaces_[l]->from_coarse(level(l + 1).body(m).table, group(level(l + 1), m),
                                  level(l).body(m).table, group(level(l), m));
    }
    for (int l = count() - 2; l >= 0; --l) {
      interfaces_[l]->from_fine(level(l).body(m).table, group(level(l), m),
                                level(l + 1).body(m).table, group(level(l + 1), m));
    }
  }
}

Verdict SolidLevels::from_grid(const StageScope& scope) {
  if (on_levels(scope, &SolidStep::from_grid) == Verdict::reject) return Verdict::reject;
  heat_by_losses(scope);
  return Verdict::good;
}

// The heat of a body is what all its particles have lost, on all levels and ranks, and no more:
// phi sum of g > 0 + sum of g < 0 = sum of losses (step/lost_energy.cpp).
void SolidLevels::heat_by_losses(const StageScope& scope) {
  std::vector<double>& sums = *scope.sums;
  for (std::size_t m = 0; m < solids_->materials.size(); ++m) {
    if (!solids_->materials[m].lost_energy_heats) continue;
    using Of = BodyEnergySums;
    const std::size_t first = StepSums::of_body(solids_->materials.size(), m);
    const double wanted = sums[first + Of::heat_wanted], taken = sums[first + Of::heat_taken];
    const double share =
        wanted > 0 ? std::clamp((sums[first + Of::lost] - taken) / wanted, 0.0, 1.0) : 0.0;
    for (const auto& step : steps_)
      step->effects().losses()->give_heat(step->work(), static_cast<int>(m), share, scope.step.dt);
    const double given = taken + share * wanted - sums[first + Of::heat_before];
    sums[first + Of::lost_heat] += given;
    sums[StepSums::lost_heat] += given;
  }
}

Verdict SolidLevels::commit(const StageScope& scope) {
  scope.journal->at_acceptance([this, cloud = scope.particles, maxima = scope.maxima,
                                ranks = scope.ranks, sums = scope.sums, events = scope.events,
                                end = scope.step.time + scope.step.dt] {
    cloud->commit(end);
    double travel = 0;
    bool left = false;
    for (int l = 0; l < count(); ++l) {
      // Those of other parts of a component come after.
      std::vector<double>& all = (*maxima)[l];
      const std::vector<double>& own = level(l).outcome().rates;
      all.resize(std::max(all.size(), own.size()));
      std::copy(own.begin(), own.end(), all.begin());
      travel = std::max(travel, level(l).outcome().travel);
      left |= level(l).outcome().left;
    }
    strayed_ += travel;
    const bool split =
        solids_->refine_particles && split_particles(*solids_, *carried_, *cloud, *ranks);
    if (left) book_leaving(*solids_, *carried_, present_, *cloud, *ranks, *sums, *events);
    if (strayed_ >= max_stray || left || split) relocate(*cloud);
    const bool regrouped = solids_->granular && regroup(*cloud, *ranks, {end, sums, events});
    for (int l = 0; l < count() && (split || regrouped); ++l) {  // the bounds of what there is now
      const std::vector<double> rates = cloud->rates(l);
      std::copy(rates.begin(), rates.end(), (*maxima)[l].begin());
    }
  });
  return Verdict::good;
}

bool SolidLevels::regroup(ParticleCloud& cloud, Communicator& ranks, const StepEnd& end) {
  const bool freed = free_loose_grains(*solids_, *carried_, cloud, ranks);
  const bool moved = regroup_grains(*solids_, *carried_, cloud, ranks, end);
  if (moved) relocate(cloud);
  return freed || moved;
}

void SolidLevels::relocate(ParticleCloud& cloud) {
  cloud.relocate();
  strayed_ = 0;
}

}  // namespace sluice::mpm
