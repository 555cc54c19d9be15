#include "mpm/step/solid_step.hpp"

#include <algorithm>

#include "framework/base/reduction.hpp"
#include "framework/run/levels/level_solver.hpp"
#include "mpm/step/heat.hpp"
#include "mpm/step/particles_to_nodes.hpp"
#include "mpm/step/resting.hpp"

namespace sluice::mpm {

// Corners beyond this distance may lie on ranks that are no neighbours, cells.
static constexpr double farthest_corner_of_neighbours = 4;

NodeLanes& nodes_of(SolidStep& step, int m) {
  return step.body(m).nodes;
}
NodeLanes& mapped_of(SolidStep& step, int m) {
  return step.mapped().of(m);
}
NodeLanes& passed_of(SolidStep& step, int m) {
  return step.filter().sums(m);
}
NodeLanes& filtered_of(SolidStep& step, int m) {
  return step.filter().velocities(m);
}
NodeLanes& friction_of(SolidStep& step, int m) {
  return step.effects().friction()->rise(m);
}

SolidStep::SolidStep(const Scene& scene, const MpmScene& solids,
                     const std::vector<Carried>& carried, const std::vector<ParticleKind>& kinds)
    : parts_{&scene, &solids, &carried, &kinds} {}

const MasterMotion* SolidStep::motion_of(int body) const {
  return contact_ != nullptr ? contact_->rules().motion_of(body) : nullptr;
}

// All parts of the step, of what the scene asks.
void SolidStep::make() {
  const MpmScene& solids = *parts_.solids;
  nodes_.shape = block_shape(nodes_.level.active);
  nodes_.boundary = std::make_unique<NodeBoundary>(*parts_.scene, solids, nodes_.level);
  for (std::size_t m = 0; m < solids.materials.size(); ++m) {
    const Carried& carried = (*parts_.carried)[m];
    bodies_.emplace_back(solids.materials[m], carried, nodes_.shape);
    bodies_.back().grid = transfer_grid(solids, nodes_.level, carried.half);
  }
  if (!solids.contacts.empty()) contact_ = std::make_unique<ContactStage>(solids, nodes_, bodies_);
  if (solids.maps_back())
    mapped_ = std::make_unique<MappedBack>(solids, nodes_, bodies_, contact_.get());
  if (solids.transfer == Transfer::xpic)
    filter_ = std::make_unique<XpicFilter>(solids, nodes_, bodies_);
  effects_ =
      std::make_unique<SolidEffects>(parts_, nodes_, bodies_, work_, contact_.get(), mapped_.get());
  node_stage_ = std::make_unique<NodeStage>(solids, nodes_, bodies_, contact_.get(),
                                            effects_->friction(), effects_->all());
  particles_ = std::make_unique<NodesToParticles>(solids, nodes_, bodies_, *effects_,
                                                  contact_.get(), mapped_.get());
}

void SolidStep::list_work(ParticleCloud& cloud, double time) {
  work_.clear();
  const int level = nodes_.level.index;
  for (int k = 0; k < static_cast<int>(bodies_.size()); ++k) {
    ParticleStore& store = cloud.store(k);
    const ParticleKind& kind = (*parts_.kinds)[static_cast<std::size_t>(k)];
    const std::vector<std::size_t> advanced = kind.advanced_columns();
    for (int b = 0; b < store.box_count(level); ++b)
      store.next(level, b).make_room(store.set(level, b), advanced);
    if (!body(k).material->takes_part(time)) {
      keep_particles(store, kind, level);
      continue;
    }
    for (int b = 0; b < store.box_count(level); ++b)
      for (const BlockRun& run : store.runs(level, b)) {
        BlockWork& w = work_.emplace_back();
        w.kind = k;
        w.set = &store.set(level, b);
        w.next = &store.next(level, b);
        w.run = run;
        w.box = b;
      }
  }
}

Verdict SolidStep::begin(const StageScope& scope) {
  nodes_.level = scope.levels.front()->level();
  nodes_.team = scope.levels.front()->team();
  if (bodies_.empty()) make();
  if (contact_ != nullptr) contact_->begin_step(scope.step);
  const std::vector<double>& maxima = scope.maxima->front();
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    bodies_[k].rates = KindRates::from(
        std::span(maxima).subspan(1 + k * static_cast<std::size_t>(KindRates::count)));
  list_work(*scope.particles, scope.step.time);
  bool far = parts_.solids->total_lagrangian;
  const double on_the_way = parts_.solids->midpoint() ? farthest_middle : 0.0;
  for (const Body& body : bodies_)
    far |= body.rates.extent + on_the_way > farthest_corner_of_neighbours;
  if (nodes_.exchange == nullptr || !nodes_.exchange->fits(nodes_.level, far))
    nodes_.exchange = std::make_unique<NodeExchange>(nodes_.level, *scope.ranks, far);
  for (SolidEffect* effect : effects_->all()) effect->begin(scope);
  find_bounds(scope);
  return Verdict::good;
}

// The largest force on any particle of all ranks, and the units of sums.
void SolidStep::find_bounds(const StageScope& scope) {
  const int count = static_cast<int>(bodies_.size());
  Reduction all;
  std::vector<Reduction::Maximum> slots;
  for (int m = 0; m < count && effects_->pushes(); ++m)
    slots.push_back(all.add_maximum(effects_->most_force(m)));
  if (effects_->pushes()) scope.ranks->reduce(all);
  const bool heats = Heat::possible(*parts_.solids);
  for (int m = 0; m < count; ++m) {
    set_most_force(m, slots.empty() ? 0.0 : all.maximum(slots[static_cast<std::size_t>(m)]));
    body(m).energy_units = energy_units(*parts_.solids, nodes_.level, body(m), heats);
  }
}

void SolidStep::set_most_force(int m, double force) {
  body(m).most_force = force;
  body(m).units = sum_units(*parts_.solids, *nodes_.boundary, spacings_, body(m), m, body(m).rates,
                            effects_->tension(m));
}

Verdict SolidStep::to_grid(const StageScope& /*scope*/) {
  if (contact_ != nullptr) contact_->begin_sums();
  ParticlesToNodes(*parts_.solids, nodes_, bodies_).give(work_, effects_->all());
  return Verdict::good;
}

void SolidStep::fold(NodeGroup group) {
  for (int m = 0; m < static_cast<int>(bodies_.size()); ++m)
    nodes_.boundary->fold(m, body(m).table, group(*this, m));
}

void SolidStep::unfold(NodeGroup group) {
  for (int m = 0; m < static_cast<int>(bodies_.size()); ++m)
    nodes_.boundary->unfold(m, body(m).table, group(*this, m));
}

// All ranks agree on the sums.
Verdict SolidStep::share_sums(const StageScope& scope, NodeGroup group) {
  const bool first = group == nodes_of;
  if (first && contact_ != nullptr && scope.ranks->size() > 1) contact_->unite_blocks();
  std::vector<SharedBlocks> shared;
  for (int m = 0; m < static_cast<int>(bodies_.size()); ++m) {
    NodeLanes* const groups[] = {&group(*this, m)};
    shared.push_back(nodes_.exchange->share(body(m).table, groups));
  }
  if (!first) return Verdict::good;
  if (contact_ != nullptr) contact_->find_meetings(work_, shared);
  for (SolidEffect* effect : effects_->all()) effect->on_sums();
  return Verdict::good;
}

Verdict SolidStep::move_nodes(const StageScope& scope) {
  const NodeStep step = node_step(*parts_.scene, *parts_.solids, nodes_.level, scope);
  node_stage_->move(scope.step, step, spacings_.several());
  return Verdict::good;
}

Verdict SolidStep::from_grid(const StageScope& scope) {
  NodeBooks& books = node_stage_->books();
  for (SolidEffect* effect : effects_->all()) effect->before_particles(scope, books);
  StepReport all = particles_->last_pass(scope, work_);
  books.merge(all.books);
  book_bodies(!parts_.solids->prescribed_file.empty(), parts_.solids->midpoint(), books);
  return conclude_step(scope, effects_->outside().counts(), all, books, outcome_);
}

}  // namespace sluice::mpm
