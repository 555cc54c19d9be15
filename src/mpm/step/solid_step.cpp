#include "mpm/step/solid_step.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/shape/weights.hpp"

namespace sluice::mpm {

TransferGrid transfer_grid(const Level& level, const std::array<double, 3>& half) {
  TransferGrid g;
  g.count = 0;
  for (int d = 0; d < 3; ++d) {
    const auto n = static_cast<std::size_t>(d);
    g.axes[n] = axis_of(level, d);
    if (level.active[n]) g.active[static_cast<std::size_t>(g.count++)] = d;
  }
  g.half = half;
  return g;
}

SolidStep::SolidStep(const Scene& scene, const MpmScene& solids,
                     const std::vector<Carried>& carried, const std::vector<ParticleKind>& kinds)
    : scene_(&scene), solids_(&solids), carried_(&carried), kinds_(&kinds) {}

void SolidStep::list_work(ParticleCloud& cloud) {
  work_.clear();
  for (int k = 0; k < cloud.kind_count(); ++k) {
    ParticleStore& store = cloud.store(k);
    for (int b = 0; b < store.box_count(level_.index); ++b)
      for (const BlockRun& run : store.runs(level_.index, b))
        work_.push_back({k, &store.set(level_.index, b), &store.next(level_.index, b), run});
  }
}

Verdict SolidStep::begin(const StageScope& scope) {
  LevelSolver& level = *scope.levels.front();
  ParticleCloud& cloud = *scope.particles;
  const bool anew = bodies_.empty();
  level_ = level.level();
  if (anew) {
    shape_ = block_shape(level_.active);
    boundary_ = std::make_unique<NodeBoundary>(*scene_, *solids_, level_);
    for (std::size_t m = 0; m < solids_->materials.size(); ++m) {
      bodies_.emplace_back(solids_->materials[m], (*carried_)[m], shape_);
      bodies_.back().grid = transfer_grid(level_, (*carried_)[m].half);
    }
  }
  const std::vector<double>& maxima = scope.maxima->front();
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    Body& body = bodies_[k];
    body.rates = KindRates::from(
        std::span(maxima).subspan(1 + k * static_cast<std::size_t>(KindRates::count)));
    body.units = units_of(body, static_cast<int>(k));
    ParticleStore& store = cloud.store(static_cast<int>(k));
    const std::vector<std::size_t> advanced = (*kinds_)[k].advanced_columns();
    for (int b = 0; b < store.box_count(level_.index); ++b)
      store.next(level_.index, b).make_room(store.set(level_.index, b), advanced);
  }
  list_work(cloud);
  return Verdict::good;
}

// Bounds of what one particle gives to a node (mpm_scheme, section 4).
SumUnits SolidStep::units_of(const Body& body, int kind) const {
  SumUnits u;
  const KindRates& r = body.rates;
  if (!r.any()) return u;
  double slopes = 0, reach = 0;  // sum of 1/h; farthest node of a stencil
  for (int a = 0; a < body.grid.count; ++a) {
    const double h = level_.spacing[body.grid.active[static_cast<std::size_t>(a)]];
    slopes += 1 / h;
    reach += 2 * h;
  }
  u.reference = r.middle();
  // The images of a mirror have the opposite velocity.
  for (int d = 0; d < 3; ++d)
    if (boundary_->mirrored(d, kind)) u.reference[d] = 0;
  double spread = r.spread();
  for (int d = 0; d < 3; ++d)
    if (u.reference[d] == 0) spread = std::max({spread, std::fabs(r.up[d]), std::fabs(r.down[d])});
  u.mass = scale_for(r.mass);
  u.momentum = scale_for(r.mass * (spread + r.affine * reach));
  u.force = scale_for(r.tension * slopes);
  return u;
}

Verdict SolidStep::to_grid(const StageScope& scope) {
  for (Body& body : bodies_) {
    body.table.clear();
    body.nodes.clear();
  }
  const int reach = reach_of(solids_->basis);
  for (const BlockWork& w : work_) {
    const IntVec3 low = shape_.lower(w.run.block);
    IntVec3 from = low, to = low;
    for (int d = 0; d < 3; ++d)
      if (shape_.edge[d] > 1) {
        from[d] -= reach;
        to[d] += shape_.edge[d] + reach;
      }
    add_blocks(bodies_[static_cast<std::size_t>(w.kind)].table, from, to);
  }
  for (Body& body : bodies_) body.nodes.fit(body.table);
  const ThreadTeam& team = *scope.levels.front()->team();
  std::vector<Window> windows(static_cast<std::size_t>(team.size()), Window(shape_, reach));
  team.for_each(work_.size(), [&](std::size_t n, int thread) {
    const BlockWork& w = work_[n];
    Body& body = bodies_[static_cast<std::size_t>(w.kind)];
    const Columns& c = body.carried->columns;
    ParticlesToGrid p;
    for (int d = 0; d < 3; ++d) p.x[static_cast<std::size_t>(d)] = w.set->coordinate(d);
    p.v = read_columns<3>(*w.set, c.velocity);
    p.mass = w.set->column(static_cast<std::size_t>(c.mass));
    p.volume = w.set->column(static_cast<std::size_t>(c.volume));
    p.stress = read_columns<6>(*w.set, c.stress);
    p.affine = read_columns<9>(*w.set, c.affine);
    Window& window = windows[static_cast<std::size_t>(thread)];
    window.begin(w.run.block);
    add_to_window(solids_->basis, body.grid, p, static_cast<int>(w.run.begin),
                  static_cast<int>(w.run.end), body.units, window);
    window.add_to(body.table, body.nodes, team.size() > 1);
  });
  for (std::size_t m = 0; m < bodies_.size(); ++m)
    boundary_->fold(static_cast<int>(m), bodies_[m].table, bodies_[m].nodes);
  return Verdict::good;
}

Verdict SolidStep::take_over(const StageScope& scope) {
  scope.journal->at_acceptance([this, cloud = scope.particles, maxima = scope.maxima,
                                end = scope.step.time + scope.step.dt] {
    cloud->take_over(end);
    maxima->front() = new_rates_;
    strayed_ += travel_;
    if (strayed_ >= most_stray || left_) {
      cloud->relocate();
      strayed_ = 0;
    }
  });
  return Verdict::good;
}

}  // namespace sluice::mpm
