#include "mpm/step/solid_step.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/reduction.hpp"
#include "mpm/nodes/node_sums.hpp"
#include "mpm/shape/second_moment.hpp"
#include "mpm/shape/weights.hpp"
#include "mpm/step/midpoint_stage.hpp"

namespace sluice::mpm {

// Corners beyond this distance may lie on ranks that are no neighbours, cells.
static constexpr double farthest_corner_of_neighbours = 4;

TransferGrid transfer_grid(const MpmScene& solids, const Level& level,
                           const std::array<double, 3>& half) {
  TransferGrid g;
  g.count = 0;
  for (int d = 0; d < 3; ++d) {
    const auto n = static_cast<std::size_t>(d);
    g.axes[n] = axis_of(level, d);
    if (level.active[n]) g.active[static_cast<std::size_t>(g.count++)] = d;
  }
  g.half = half;
  g.corner_limit = solids.cpdi_limit;
  return g;
}

SolidStep::SolidStep(const Scene& scene, const MpmScene& solids,
                     const std::vector<Carried>& carried, const std::vector<ParticleKind>& kinds)
    : scene_(&scene), solids_(&solids), carried_(&carried), kinds_(&kinds) {}

void SolidStep::list_work(ParticleCloud& cloud, double time) {
  work_.clear();
  for (int k = 0; k < static_cast<int>(bodies_.size()); ++k) {
    ParticleStore& store = cloud.store(k);
    if (rests(k, time)) {
      keep(k, store);
      continue;
    }
    for (int b = 0; b < store.box_count(level_.index); ++b)
      for (const BlockRun& run : store.runs(level_.index, b))
        work_.push_back({k, &store.set(level_.index, b), &store.next(level_.index, b), run, b});
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
      bodies_.back().grid = transfer_grid(*solids_, level_, (*carried_)[m].half);
      bodies_.back().parted =
          PartedNeighbours(*solids_, solids_->materials[m], (*carried_)[m], level_);
    }
    outside_ = std::make_unique<OutsideForces>(*solids_, level_, *carried_);
    if (!solids_->contacts.empty()) contact_ = std::make_unique<Contact>(*solids_, level_);
    surface_units_ = surface_units(level_, solids_->axisymmetric);
    if (!solids_->prescribed_file.empty())
      prescribed_ =
          std::make_unique<PrescribedMotion>(PrescribedMotion::read(solids_->prescribed_file));
    if (!solids_->insert_file.empty())
      insertions_ =
          read_insertions(solids_->insert_file, static_cast<int>(solids_->materials.size()));
    if (Heat::possible(*solids_)) heat_ = std::make_unique<Heat>(*scene_, *solids_, level_);
    if (Heat::possible(*solids_, concentration_spreads))
      concentration_ = std::make_unique<Heat>(*scene_, *solids_, level_, concentration_spreads);
    if (!solids_->cohesive_zones.empty())
      cohesive_ = std::make_unique<CohesiveZones>(*solids_, level_, shape_);
    if (solids_->any_water()) water_ = std::make_unique<PoreWater>(*solids_, level_);
  }
  if (contact_ != nullptr) contact_->begin_step(scope.step.time, scope.step.dt);
  const std::vector<double>& maxima = scope.maxima->front();
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    Body& body = bodies_[k];
    body.rates = KindRates::from(
        std::span(maxima).subspan(1 + k * static_cast<std::size_t>(KindRates::count)));
    ParticleStore& store = cloud.store(static_cast<int>(k));
    const std::vector<std::size_t> advanced = (*kinds_)[k].advanced_columns();
    for (int b = 0; b < store.box_count(level_.index); ++b)
      store.next(level_.index, b).make_room(store.set(level_.index, b), advanced);
  }
  list_work(cloud, scope.step.time);
  if (cohesive_ != nullptr) cohesive_->begin(cloud, *kinds_);
  bool far = solids_->total_lagrangian;
  const double on_the_way = solids_->midpoint() ? farthest_middle : 0.0;
  for (const Body& body : bodies_)
    far |= body.rates.extent + on_the_way > farthest_corner_of_neighbours;
  if (exchange_ == nullptr || !exchange_->fits(level_, far))
    exchange_ = std::make_unique<NodeExchange>(level_, *scope.ranks, far);
  jumps_ = insertions_in(insertions_, scope.step.time, scope.step.dt);
  find_outside_forces(scope);
  for (Body& body : bodies_) body.corner_loads = body.corners.size();
  if (water_ != nullptr) water_->begin(lend_to_water(scope));
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    Body& body = bodies_[k];
    body.units = units_of(body, static_cast<int>(k), body.rates);
    const double energy = std::max(body.rates.most_kinetic(), body.rates.energy);
    const double capacity = heat_ != nullptr ? body.material->constants.specific_heat : 0;
    constexpr double usual_change = 1;  // of a temperature in a step, K
    body.energy_units = {energy_unit(body.rates.mass), energy_unit(energy),
                         energy_unit(body.rates.mass * capacity * usual_change), capacity};
    for (int d = 0; d < 3; ++d)
      if (level_.active[static_cast<std::size_t>(d)])
        body.energy_units.moment[d] =
            level_.spacing[d] * level_.spacing[d] *
            second_moment(solids_->basis, body.grid.half[static_cast<std::size_t>(d)]);
  }
  return Verdict::good;
}

// Block and reach; corners farther than a stencil, reference places wherever they are.
void SolidStep::find_nodes_of(BlockWork& w) const {
  const Body& body = bodies_[static_cast<std::size_t>(w.kind)];
  const Columns& c = body.carried->columns;
  const int reach = std::max(reach_of(solids_->basis),
                             static_cast<int>(std::floor(max_stray + body.rates.extent)) + 1);
  w.lowest = w.highest = shape_.lower(w.run.block);
  const std::array<const double*, 3> x = places_of(*w.set, c);
  for (int d = 0; d < 3; ++d) {
    if (shape_.edge[d] == 1) continue;
    if (c.reference < 0) {
      w.lowest[d] -= reach;
      w.highest[d] += shape_.edge[d] + reach;
      continue;
    }
    const double* places = x[static_cast<std::size_t>(d)];
    const auto [low, high] = std::minmax_element(places + w.run.begin, places + w.run.end);
    const Axis& axis = body.grid.axes[static_cast<std::size_t>(d)];
    w.lowest[d] = static_cast<int>(std::floor(axis.place(*low) + axis.first)) - 1;
    w.highest[d] = static_cast<int>(std::floor(axis.place(*high) + axis.first)) + 2;
  }
}

// Forces from outside at the time of the positions, and the largest on any particle of all ranks.
void SolidStep::find_outside_forces(const StageScope& scope) {
  for (Body& body : bodies_) {
    body.corners.clear();
    body.most_force = 0;
  }
  if (!outside_->any() && cohesive_ == nullptr) return;
  const ParticleCloud& cloud = *scope.particles;
  const std::vector<double>& maxima = scope.maxima->front();
  outside_->count(cloud, *scope.ranks, std::span(maxima).subspan(rate_count(bodies_.size())));
  outside_->make_room(cloud, level_.index);
  const ThreadTeam& team = *scope.levels.front()->team();
  std::vector<std::vector<double>> most(static_cast<std::size_t>(team.size()),
                                        std::vector<double>(bodies_.size()));
  team.for_each(work_.size(), [&](std::size_t n, int thread) {
    const BlockWork& w = work_[n];
    if (!outside_->acts(w.kind)) return;
    double& m = most[static_cast<std::size_t>(thread)][static_cast<std::size_t>(w.kind)];
    m = std::max(m, outside_->fill(w.kind, w.box, *w.set, w.run.begin, w.run.end, scope.step.time));
  });
  Reduction all;
  std::vector<Reduction::Maximum> slots;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    double m = 0;
    for (const std::vector<double>& of : most) m = std::max(m, of[k]);
    if (solids_->loads_on_corners) m = std::max(m, find_corners(static_cast<int>(k)));
    if (cohesive_ != nullptr) m = std::max(m, cohesive_->most_force(static_cast<int>(k)));
    slots.push_back(all.add_maximum(m));
  }
  scope.ranks->reduce(all);
  for (std::size_t k = 0; k < bodies_.size(); ++k) bodies_[k].most_force = all.maximum(slots[k]);
}

void SolidStep::set_most_force(int m, double force) {
  body(m).most_force = force;
  body(m).units = units_of(body(m), m, body(m).rates);
}

// Bounds of what one particle gives to a node (mpm_scheme, section 4).
SumUnits SolidStep::units_of(const Body& body, int kind, const KindRates& r) const {
  SumUnits u;
  if (!r.any()) return u;
  double slopes = 0, reach = 0;  // sum of 1/h; farthest node of a stencil
  for (int a = 0; a < body.grid.count; ++a) {
    const int d = body.grid.active[static_cast<std::size_t>(a)];
    slopes += 1 / finest_[d];
    reach += 2 * coarsest_[d];
  }
  if (by_corners(solids_->basis)) reach *= 1 + r.extent;
  if (by_corners(solids_->basis) || solids_->total_lagrangian) slopes = r.slope;
  u.reference = r.middle();
  // The images of a mirror have the opposite velocity; rigid bodies keep their own to the bit.
  for (int d = 0; d < 3; ++d)
    if (boundary_->mirrored(d, kind) || body.material->rigid) u.reference[d] = 0;
  double spread = r.spread();
  for (int d = 0; d < 3; ++d)
    if (u.reference[d] == 0) spread = std::max({spread, std::fabs(r.up[d]), std::fabs(r.down[d])});
  u.mass = scale_for(r.mass);
  u.momentum = scale_for(r.mass * (spread + r.affine * reach));
  u.force = scale_for((r.tension + body.pore_pull) * slopes + body.most_force);
  return u;
}

Verdict SolidStep::to_grid(const StageScope& scope) {
  for (Body& body : bodies_) {
    body.table.clear();
    body.nodes.clear();
    body.surfaces.clear();
  }
  for (BlockWork& w : work_) {
    find_nodes_of(w);
    add_blocks(bodies_[static_cast<std::size_t>(w.kind)].table, w.lowest, w.highest);
  }
  if (cohesive_ != nullptr) cohesive_->add_nodes(*boundary_, bodies_);
  if (water_ != nullptr) water_->filter(lend_to_water(scope));
  for (Body& body : bodies_) body.nodes.fit(body.table);
  const ThreadTeam& team = *scope.levels.front()->team();
  std::vector<Window> windows(static_cast<std::size_t>(team.size()), Window(shape_, 1));
  team.for_each(work_.size(), [&](std::size_t n, int thread) {
    const BlockWork& w = work_[n];
    Body& body = bodies_[static_cast<std::size_t>(w.kind)];
    const Columns& c = body.carried->columns;
    ParticlesToGrid p;
    p.x = places_of(*w.set, c);
    p.shape = shape_of(*w.set, c);
    p.reference_gradients = solids_->total_lagrangian;
    p.v = read_columns<3>(*w.set, c.velocity);
    p.mass = w.set->column(static_cast<std::size_t>(c.mass));
    p.volume = w.set->column(static_cast<std::size_t>(c.volume));
    p.stress = read_columns<6>(*w.set, c.stress);
    p.affine = read_columns<9>(*w.set, c.affine);
    p.spin = read_columns<3>(*w.set, c.spin);
    p.load = outside_->middle_forces(w.kind, w.box);
    if (c.viscous >= 0) p.extra_pressure = w.set->column(static_cast<std::size_t>(c.viscous));
    if (c.pore_pressure >= 0) p.pore_pressure = water_->acting(w, c);
    Window& window = windows[static_cast<std::size_t>(thread)];
    window.begin(w.lowest, w.highest);
    add_to_window(solids_->basis, body.grid, p, static_cast<int>(w.run.begin),
                  static_cast<int>(w.run.end), body.units, window);
    window.add_to(body.table, body.nodes, team.size() > 1);
  });
  corners_to_grid();
  return Verdict::good;
}

void SolidStep::fold(NodeLanes Body::*group) {
  for (std::size_t m = 0; m < bodies_.size(); ++m)
    boundary_->fold(static_cast<int>(m), bodies_[m].table, bodies_[m].*group);
}

void SolidStep::unfold(NodeLanes Body::*group) {
  for (std::size_t m = 0; m < bodies_.size(); ++m)
    boundary_->unfold(static_cast<int>(m), bodies_[m].table, bodies_[m].*group);
}

// All ranks agree on the sums.
Verdict SolidStep::share_sums(const StageScope& scope, NodeLanes Body::*group) {
  const bool first = group == &Body::nodes;
  if (first && contact_ != nullptr && scope.ranks->size() > 1) unite_blocks();
  std::vector<SharedBlocks> shared;
  for (Body& body : bodies_) {
    NodeLanes* const groups[] = {&(body.*group)};
    shared.push_back(exchange_->share(body.table, groups));
  }
  if (first && contact_ != nullptr) {
    find_meetings();
    if (any_meets_ && contact_->needs_surfaces()) gather_surfaces(scope, shared);
  }
  if (first && cohesive_ != nullptr) share_cohesive();
  return Verdict::good;
}

// Cohesive forces follow the masses of nodes, so that these are shared before.
void SolidStep::share_cohesive() {
  cohesive_->to_grid(*boundary_, bodies_);
  for (Body& body : bodies_) {
    NodeLanes* const group = &body.cohesive;
    exchange_->share(body.table, std::span(&group, 1));
  }
  cohesive_->take(bodies_);
}

}  // namespace sluice::mpm
