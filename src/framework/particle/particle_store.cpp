// Particles into the boxes where they live.
#include "framework/particle/particle_store.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

#include "framework/particle/particle_exchange.hpp"

namespace sluice {

// Cells of the coarsest level that a particle passes before it is brought to its box; those that go
// farther arrive as well.
static constexpr int usual_way = 2;

void ParticleStore::lay_out(const ParticleMap& map) {
  ParticleSet homeless(attributes_);
  for (const auto& boxes : sets_)
    for (const Box& box : boxes)
      for (std::size_t n = 0; n < box.set.size(); ++n) homeless.add_from(box.set, n);
  homeless_ = std::move(homeless);
  map_ = &map;
  neighbours_ = map.ranks_near(rank_, usual_way);
  sets_.clear();
  locals_.clear();
  for (const Level& level : map.levels()) {
    auto& sets = sets_.emplace_back();
    auto& locals = locals_.emplace_back();
    for (const GridBox& b : level.boxes) {
      locals.push_back(b.owner == rank_ ? static_cast<int>(sets.size()) : -1);
      if (b.owner == rank_)
        sets.push_back({b.id, ParticleSet(attributes_), ParticleSet(attributes_), {}});
    }
  }
}

void ParticleStore::clear() {
  sets_.clear();
  locals_.clear();
  homeless_.clear();
}

const GridBox& ParticleStore::box(int level, int local) const {
  const int id = at(level)[local].id;
  return map_->levels()[level].boxes[id];
}

ParticleMap::Home ParticleStore::find(Vec3 point, std::int64_t id) const {
  const ParticleMap::Home home = map_->find(point);
  if (home.level < 0)
    throw std::logic_error("particle " + std::to_string(id) + " at [" + std::to_string(point.x) +
                           ", " + std::to_string(point.y) + ", " + std::to_string(point.z) +
                           "] is in no box");
  return home;
}

ParticleSet& ParticleStore::home_of(const ParticleMap::Home& home) {
  const int local = locals_[home.level][home.box];
  return set(home.level, local);
}

void ParticleStore::adopt(const ParticleSet& from, std::size_t n) {
  const ParticleMap::Home home = find(from.position(n), from.id(n));
  if (home.owner == rank_) home_of(home).add_from(from, n);
}

void ParticleStore::settle(Communicator& communicator) {
  std::vector<ParticleSet> leaving(communicator.size(), ParticleSet(attributes_));
  const auto send = [&](const ParticleSet& from, std::size_t n) {
    const ParticleMap::Home home = find(from.position(n), from.id(n));
    leaving[home.owner].add_from(from, n);
  };
  for (std::size_t n = 0; n < homeless_.size(); ++n) send(homeless_, n);
  homeless_.clear();
  std::vector<std::uint32_t> staying;
  for (int l = 0; l < level_count(); ++l)
    for (Box& box : at(l)) {
      staying.clear();
      for (std::size_t n = 0; n < box.set.size(); ++n)
        if (map_->is_home(l, box.id, box.set.position(n)))
          staying.push_back(static_cast<std::uint32_t>(n));
        else
          send(box.set, n);
      if (staying.size() < box.set.size()) box.set.select(staying);
    }
  const ParticleSet arrived = exchange_particles(leaving, neighbours_, communicator);
  for (std::size_t n = 0; n < arrived.size(); ++n) adopt(arrived, n);
  for (int l = 0; l < level_count(); ++l)
    for (Box& box : at(l)) sort(l, box);
}

namespace {

// The order by cell, then by id; `cells` counts the cells of the box, `at` says which each is in.
std::vector<std::uint32_t> order_of(const ParticleSet& set, const std::vector<std::uint32_t>& at,
                                    std::size_t cells) {
  const auto by_id = [&](std::uint32_t a, std::uint32_t b) { return set.id(a) < set.id(b); };
  std::vector<std::uint32_t> order(set.size());
  if (set.size() < cells / 8) {  // few particles: counting would cost more than they do
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return at[a] != at[b] ? at[a] < at[b] : by_id(a, b);
    });
    return order;
  }
  std::vector<std::uint32_t> first(cells + 1, 0);
  for (const std::uint32_t cell : at) ++first[cell + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> next = first;
  for (std::uint32_t n = 0; n < set.size(); ++n) order[next[at[n]]++] = n;
  for (std::size_t c = 0; c < cells; ++c)
    if (first[c + 1] > first[c] + 1)
      std::sort(order.begin() + first[c], order.begin() + first[c + 1], by_id);
  return order;
}

}  // namespace

void ParticleStore::sort(int l, Box& box) const {
  const Level& level = map_->levels()[l];
  if (by_blocks_) {
    box.runs = sort_by_blocks(box.set, level);
    return;
  }
  const std::vector<std::uint32_t> order = by_cell(l, box);
  if (!order.empty()) box.set.select(order);
}

std::vector<std::uint32_t> ParticleStore::order_by_cell(int level, int local) const {
  const Box& box = at(level)[local];
  std::vector<std::uint32_t> order = by_cell(level, box);
  if (order.empty()) {
    order.resize(box.set.size());
    std::iota(order.begin(), order.end(), 0U);
  }
  return order;
}

// Empty where the set is in that order.
std::vector<std::uint32_t> ParticleStore::by_cell(int l, const Box& box) const {
  if (box.set.empty()) return {};
  const Level& level = map_->levels()[l];
  const IndexBox& cells = level.boxes[box.id].cells;
  const IntVec3 size = cells.size();
  std::vector<std::uint32_t> at;
  at.reserve(box.set.size());
  bool sorted = true;
  for (std::size_t n = 0; n < box.set.size(); ++n) {
    const IntVec3 c = cell_at(level, box.set.position(n)) - cells.lower;
    at.push_back(
        static_cast<std::uint32_t>(c.x + size.x * (c.y + static_cast<std::int64_t>(size.y) * c.z)));
    if (n > 0 && sorted)
      sorted = at[n - 1] != at[n] ? at[n - 1] < at[n] : box.set.id(n - 1) < box.set.id(n);
  }
  if (sorted) return {};
  return order_of(box.set, at, cells.volume());
}

std::int64_t ParticleStore::count() const {
  std::int64_t n = static_cast<std::int64_t>(homeless_.size());
  for (const auto& boxes : sets_)
    for (const Box& box : boxes) n += static_cast<std::int64_t>(box.set.size());
  return n;
}

}  // namespace sluice
