// Taking particles through coarse steps and over changes of the boxes.
#include "framework/run/levels/particle_cloud.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>

#include "framework/archive/archive.hpp"
#include "framework/base/json.hpp"
#include "framework/particle/domain_ends.hpp"
#include "framework/run/component/succession.hpp"

namespace sluice {
namespace {

// The cells of a local box where its particles live.
std::vector<IndexBox> own_cells(const LevelSolver& level, int box, int levels) {
  if (levels > 1) return level.graphs().coverage().uncovered(box);
  return {level.state().local_boxes()[box].cells};
}

}  // namespace

ParticleCloud::ParticleCloud(const ParticleMethod& method, Communicator& communicator)
    : method_(&method), communicator_(&communicator) {
  for (const ParticleKind& kind : method.kinds())
    kinds_.push_back({ParticleStore(kind.columns(), communicator.rank(), kind.by_blocks)});
}

void ParticleCloud::lay_out(const Levels& levels) {
  std::vector<Level> now;
  for (const LevelSolver* level : levels) now.push_back(level->level());
  auto map = std::make_unique<ParticleMap>(std::move(now));
  box_seconds_.clear();
  for (const LevelSolver* level : levels)
    box_seconds_.emplace_back(level->state().local_boxes().size(), 0.0);
  for (Kind& kind : kinds_) kind.store.lay_out(*map);
  map_ = std::move(map);
}

void ParticleCloud::settle() {
  for (Kind& kind : kinds_) kind.store.settle(*communicator_);
}

void ParticleCloud::succeed(const ParticleCloud& earlier, const Levels& levels) {
  time_ = earlier.time_;
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    Kind& kind = kinds_[k];
    const Kind& before = earlier.kinds_[k];
    const auto columns = common_columns(earlier.method_->kinds()[k], method_->kinds()[k]);
    kind.made = before.made;
    kind.left = before.left;
    kind.store.clear();
    kind.store.lay_out(*earlier.map_);  // boxes may have moved to other ranks since the start
    for (int l = 0; l < kind.store.level_count(); ++l)
      for (int b = 0; b < kind.store.box_count(l); ++b) {
        const ParticleSet& from = before.store.set(l, b);
        ParticleSet& to = kind.store.set(l, b);
        to.reserve(from.size());
        for (std::size_t n = 0; n < from.size(); ++n) to.add(from.position(n), from.id(n));
        for (const auto& [its, own] : columns)
          std::copy_n(from.column(its), from.size(), to.column(own));
      }
  }
  lay_out(levels);
  settle();
  method_->laid_out(*this, levels.front()->team());
}

void ParticleCloud::follow(const Levels& levels) {
  lay_out(levels);
  settle();
  method_->laid_out(*this, levels.front()->team());
}

void ParticleCloud::start(const Levels& levels, double time) {
  time_ = time;
  for (Kind& kind : kinds_) kind.store.clear();
  lay_out(levels);
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    ParticleStore& store = kinds_[k].store;
    for (int l = 0; l < store.level_count(); ++l) {
      const LevelSolver& level = *levels[l];
      for (int b = 0; b < store.box_count(l); ++b)
        for (const IndexBox& cells : own_cells(level, b, store.level_count()))
          method_->start(static_cast<int>(k), level.level(), cells, store.set(l, b));
    }
    kinds_[k].made = store.count();
  }
  settle();
  for (Kind& kind : kinds_)
    for (int l = 0; l < kind.store.level_count(); ++l)
      for (int b = 0; b < kind.store.box_count(l); ++b) kind.store.set(l, b).shrink();
  method_->laid_out(*this, levels.front()->team());
}

Reflects ParticleCloud::reflects(int kind, const Level& level) const {
  return [this, kind, l = level.index](Side side, IntVec3 cell) {
    return method_->reflects(kind, l, side, cell);
  };
}

std::vector<std::uint32_t> ParticleCloud::leaving(int kind, int l, int box) const {
  const Reflects walls = reflects(kind, level(l));
  const ParticleSet& set = store(kind).set(l, box);
  std::vector<std::uint32_t> dropped;
  for (std::size_t n = 0; n < set.size(); ++n) {
    Vec3 place = set.position(n);
    if (!bring_inside(level(l), walls, place)) dropped.push_back(static_cast<std::uint32_t>(n));
  }
  return dropped;
}

void ParticleCloud::keep_inside(int kind, const Level& level, ParticleSet& set) {
  const Reflects walls = reflects(kind, level);
  std::vector<std::uint32_t> kept;
  for (std::size_t n = 0; n < set.size(); ++n) {
    Vec3 place = set.position(n);
    if (!bring_inside(level, walls, place)) continue;
    set.move_to(n, place);
    kept.push_back(static_cast<std::uint32_t>(n));
  }
  if (kept.size() < set.size()) set.select(kept);
}

void ParticleCloud::advance_box(int kind, LevelSolver& level, int box, ParticleStep step) {
  const std::vector<IndexBox> cells =
      own_cells(level, box, static_cast<int>(map_->levels().size()));
  step.old_state = &level.states().start();
  step.new_state = &level.state();
  step.box = box;
  step.cells = cells;
  ParticleSet& set = kinds_[kind].store.set(level.level().index, box);
  method_->advance(kind, step, set);
}

void ParticleCloud::advance(const Levels& levels, double end, int parts) {
  ParticleStep step;
  step.old_time = time_;
  step.new_time = end;
  for (int part = 0; part < parts; ++part) {
    step.begin = part == 0 ? step.old_time : step.end;
    step.end = part + 1 == parts ? end : step.old_time + (end - step.old_time) * (part + 1) / parts;
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
      if (method_->in_stages(static_cast<int>(k))) continue;
      Kind& kind = kinds_[k];
      std::atomic<std::int64_t> made = 0, left = 0;
      for (std::size_t l = 0; l < levels.size(); ++l) {
        const int level = static_cast<int>(l);
        const std::size_t boxes = kind.store.box_count(level);
        levels[l]->team()->for_each(boxes, [&](std::size_t b, int) {
          const auto start = std::chrono::steady_clock::now();
          const int box = static_cast<int>(b);
          ParticleSet& set = kind.store.set(level, box);
          const std::size_t before = set.size();
          advance_box(static_cast<int>(k), *levels[l], box, step);
          const std::size_t moved = set.size();
          keep_inside(static_cast<int>(k), levels[l]->level(), set);
          made += static_cast<std::int64_t>(moved - before);
          left += static_cast<std::int64_t>(moved - set.size());
          box_seconds_[l][b] +=
              std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        });
      }
      kind.made += made;
      kind.left += left;
    }
    // What stages have made lies beside what they began with, in its order, until it is taken over.
    for (std::size_t k = 0; k < kinds_.size(); ++k)
      if (!method_->in_stages(static_cast<int>(k))) kinds_[k].store.settle(*communicator_);
  }
  time_ = end;
}

void ParticleCloud::commit(double end) {
  // Of a particle that steps in stages, with what couples it to a fluid. Stages wait for other
  // ranks, so that their seconds do not tell whose boxes cost them: particles are counted.
  constexpr double seconds_of_particle = 1e-6;
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    if (!method_->in_stages(static_cast<int>(k))) continue;
    const std::vector<std::size_t> advanced = method_->kinds()[k].advanced_columns();
    ParticleStore& store = kinds_[k].store;
    for (int l = 0; l < store.level_count(); ++l)
      for (int b = 0; b < store.box_count(l); ++b) {
        store.set(l, b).exchange(store.next(l, b), advanced);
        box_seconds_[static_cast<std::size_t>(l)][static_cast<std::size_t>(b)] +=
            seconds_of_particle * static_cast<double>(store.set(l, b).size());
      }
  }
  time_ = end;
}

void ParticleCloud::keep_only(int kind, int level, int box,
                              const std::vector<std::uint32_t>& kept) {
  Kind& of = kinds_[kind];
  ParticleSet& set = of.store.set(level, box);
  of.left += static_cast<std::int64_t>(set.size() - kept.size());
  set.select(kept);
}

void ParticleCloud::add_copy(int kind, int level, int box, std::size_t n, Vec3 place,
                             std::int64_t id) {
  Kind& of = kinds_[kind];
  ParticleSet& set = of.store.set(level, box);
  set.add(place, id);
  for (std::size_t a = 0; a < set.attribute_count(); ++a)
    set.attribute(a, set.size() - 1) = set.attribute(a, n);
  ++of.made;
}

// All arrive before any leaves: numbers of particles stay what they were.
void ParticleCloud::change_kinds(int level, int box, const std::vector<std::vector<int>>& to) {
  for (std::size_t k = 0; k < to.size(); ++k)
    for (std::size_t n = 0; n < to[k].size(); ++n) {
      if (to[k][n] == static_cast<int>(k)) continue;
      Kind& other = kinds_[to[k][n]];
      other.store.set(level, box).add_from(kinds_[k].store.set(level, box), n);
      ++other.made;
      --kinds_[k].made;
    }
  std::vector<std::uint32_t> kept;
  for (std::size_t k = 0; k < to.size(); ++k) {
    ParticleSet& set = kinds_[k].store.set(level, box);
    kept.clear();
    for (std::size_t n = 0; n < set.size(); ++n)
      if (n >= to[k].size() || to[k][n] == static_cast<int>(k))
        kept.push_back(static_cast<std::uint32_t>(n));
    if (kept.size() < set.size()) set.select(kept);
  }
}

void ParticleCloud::relocate() {
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    ParticleStore& store = kinds_[k].store;
    for (int l = 0; l < store.level_count(); ++l)
      for (int b = 0; b < store.box_count(l); ++b) {
        ParticleSet& set = store.set(l, b);
        const std::size_t before = set.size();
        const Level& level = map_->levels()[l];
        keep_inside(static_cast<int>(k), level, set);
        method_->follow_wrapped(static_cast<int>(k), level, set);
        kinds_[k].left += static_cast<std::int64_t>(before - set.size());
      }
  }
  settle();
}

std::vector<double> ParticleCloud::rates(int level) const {
  std::vector<double> all = method_->rates(*this, level);
  Reduction reduction;
  std::vector<Reduction::Maximum> slots;
  for (const double r : all) slots.push_back(reduction.add_maximum(r));
  communicator_->reduce(reduction);
  for (std::size_t n = 0; n < all.size(); ++n) all[n] = reduction.maximum(slots[n]);
  return all;
}

std::vector<FlagSeeds> ParticleCloud::flag_seeds(int l) const {
  std::vector<FlagSeeds> all;
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    const double distance = method_->kinds()[k].refine_distance;
    if (distance < 0) continue;
    FlagSeeds& of_kind = all.emplace_back();
    of_kind.distance = distance;
    const ParticleStore& store = kinds_[k].store;
    // A cell under a finer level holds what lives there.
    for (int f = l; f < store.level_count(); ++f)
      for (int b = 0; b < store.box_count(f); ++b) {
        const ParticleSet& set = store.set(f, b);
        for (std::size_t n = 0; n < set.size(); ++n)
          if (method_->asks_refinement(static_cast<int>(k), set, n, f, l))
            of_kind.cells.push_back(cell_at(map_->levels()[l], set.position(n)));
      }
  }
  return all;
}

std::int64_t ParticleCloud::local_count() const {
  std::int64_t count = 0;
  for (const Kind& kind : kinds_) count += kind.store.count();
  return count;
}

std::vector<ParticleCount> ParticleCloud::counts() const {
  Reduction reduction;
  std::vector<Reduction::Count> slots;
  for (const Kind& kind : kinds_)
    for (const std::int64_t n : {kind.made, kind.left, kind.store.count()})
      slots.push_back(reduction.add_count(n));
  communicator_->reduce(reduction);
  std::vector<ParticleCount> counts;
  for (std::size_t k = 0; k < kinds_.size(); ++k)
    counts.push_back({method_->kinds()[k].name, reduction.count(slots[3 * k]),
                      reduction.count(slots[3 * k + 1]), reduction.count(slots[3 * k + 2])});
  return counts;
}

std::string ParticleCloud::state() const {
  Json json;
  json["time"] = time_;
  for (const ParticleCount& c : counts())
    json["kinds"].push_back({{"made", c.made}, {"left", c.left}});
  return json.dump();
}

}  // namespace sluice
