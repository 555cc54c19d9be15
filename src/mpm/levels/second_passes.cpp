// Stages in which particles and nodes exchange once more within a step, on all levels.
#include <algorithm>
#include <cmath>

#include "framework/base/lowest_text.hpp"
#include "framework/base/reduction.hpp"
#include "mpm/levels/solid_levels.hpp"

namespace sluice::mpm {
namespace {

double binomial(int n, int k) {
  double b = 1;
  for (int i = 1; i <= k; ++i) b = b * (n - k + i) / i;
  return b;
}

}  // namespace

// XPIC(m): what PIC would take from velocities is given back but for what the grid cannot hold
// (C. C. Hammerquist, J. A. Nairn, Comput. Methods Appl. Mech. Engrg. 318 (2017) 724).
//
//   v_p = sum_i S_ip (m v_i - sum_{r=2..m} (-1)^r (m over r) B^{r-1} v_i) + dv_p
//   (B v)_i = sum_p m_p S_ip (sum_j S_jp v_j)/M_i
//
// The sum in brackets is added to the lanes of dv, relative to v_ref: the factors add up to 1.
Verdict SolidLevels::filter_velocities(const StageScope& scope) {
  std::vector<double> most(solids_->materials.size());
  for (const auto& step : steps_) {
    const std::vector<double> own = step->filter().take_velocities();
    for (std::size_t k = 0; k < most.size(); ++k) most[k] = std::max(most[k], own[k]);
  }
  Reduction reduction;
  std::vector<Reduction::Maximum> slots;
  for (const double m : most) slots.push_back(reduction.add_maximum(m));
  scope.ranks->reduce(reduction);
  for (std::size_t k = 0; k < most.size(); ++k) most[k] = reduction.maximum(slots[k]);
  for (const auto& step : steps_) step->filter().begin(most);
  for (int r = 2; r <= solids_->xpic_order; ++r) {
    for (int l = 0; l < count(); ++l) level(l).filter().sum(level(l).work(), r == 2);
    join_sums(scope, passed_of);
    for (const auto& step : steps_) step->filter().finish();
    spread_velocities(filtered_of);
    const double factor = (r % 2 == 0 ? -1 : 1) * binomial(solids_->xpic_order, r);
    for (const auto& step : steps_) step->filter().add(factor);
  }
  return Verdict::good;
}

// Bounds of all ranks; or some rank has a fault, and the first of all texts is the reason.
Verdict SolidLevels::agree_on(const StageScope& scope, std::vector<KindRates>& bounds,
                              const std::string& fault) {
  Reduction reduction;
  std::vector<Reduction::Maximum> slots;
  for (const KindRates& r : bounds) {
    for (int d = 0; d < 3; ++d) {
      slots.push_back(reduction.add_maximum(r.up[d]));
      slots.push_back(reduction.add_maximum(r.down[d]));
    }
    slots.push_back(reduction.add_maximum(r.affine));
  }
  const auto any_fault = reduction.add_any(!fault.empty());
  scope.ranks->reduce(reduction);
  if (reduction.any(any_fault)) {
    *scope.reason = lowest_text(*scope.ranks, fault);
    return Verdict::reject;
  }
  auto slot = slots.begin();
  for (KindRates& r : bounds) {
    for (int d = 0; d < 3; ++d) {
      r.up[d] = reduction.maximum(*slot++);
      r.down[d] = reduction.maximum(*slot++);
    }
    r.affine = reduction.maximum(*slot++);
  }
  return Verdict::good;
}

// New velocities of particles to nodes, once more.
void SolidLevels::map_all_back(const StageScope& scope, std::span<const KindRates> bounds) {
  for (int l = 0; l < count(); ++l)
    level(l).mapped().sum(level(l).work(), level(l).spacings(), bounds);
  join_sums(scope, mapped_of);
  for (int l = 0; l < count(); ++l) level(l).mapped().finish();
  spread_velocities(mapped_of);
}

// MUSL: new velocities of particles go to the nodes once more, and velocity gradients are taken
// from those (D. Sulsky, S.-J. Zhou, H. L. Schreyer, Comput. Phys. Commun. 87 (1995) 236).
// Gradients of hats do not vanish with their weight: from v* of nodes that have hardly any mass
// they would have no bound (docs/theory/mpm_transfers.md). The midpoint transfer does so at the
// middle of the step, and with spins (step/midpoint_motion.cpp).
Verdict SolidLevels::map_back(const StageScope& scope) {
  std::vector<KindRates> bounds(solids_->materials.size());
  std::string fault;
  for (int l = 0; l < count(); ++l) {
    const std::vector<KindRates> own =
        level(l).particles().first_pass(scope_of(scope, l), level(l).work(), fault);
    for (std::size_t k = 0; k < bounds.size(); ++k) bounds[k].add(own[k]);
  }
  if (agree_on(scope, bounds, fault) == Verdict::reject) return Verdict::reject;
  map_all_back(scope, bounds);
  return Verdict::good;
}

// Where the deck gives particles velocities one by one: a spin is that of the velocities around,
// and of the spins that these then have, which a few passes find.
Verdict SolidLevels::start_spins(const StageScope& scope) {
  if (scope.dt_before != 0) return Verdict::good;
  constexpr int passes = 8;
  for (int pass = 0; pass < passes; ++pass) {
    std::vector<KindRates> bounds(solids_->materials.size());
    for (int l = 0; l < count(); ++l) {
      const std::vector<KindRates> own =
          level(l).particles().hold_start(scope_of(scope, l), level(l).work(), pass > 0);
      for (std::size_t k = 0; k < bounds.size(); ++k) bounds[k].add(own[k]);
    }
    if (agree_on(scope, bounds, {}) == Verdict::reject) return Verdict::reject;
    map_all_back(scope, bounds);
    for (int l = 0; l < count(); ++l)
      level(l).particles().take_spins(scope_of(scope, l), level(l).work());
  }
  return Verdict::good;
}

}  // namespace sluice::mpm
