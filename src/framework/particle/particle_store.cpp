// Particles into the boxes where they live.
#include "framework/particle/particle_store.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

#include "framework/particle/particle_exchange.hpp"

namespace sluice {

void ParticleStore::lay_out(const ParticleMap& map) {
  ParticleSet homeless(attributes_);
  for (const auto& boxes : sets_)
    for (const Box& box : boxes)
      for (std::size_t n = 0; n < box.set.size(); ++n) homeless.add_from(box.set, n);
  homeless_ = std::move(homeless);
  map_ = &map;
  sets_.clear();
  locals_.clear();
  for (const Level& level : map.levels()) {
    auto& sets = sets_.emplace_back();
    auto& locals = locals_.emplace_back();
    for (const GridBox& b : level.boxes) {
      locals.push_back(b.owner == rank_ ? static_cast<int>(sets.size()) : -1);
      if (b.owner == rank_) sets.push_back({b.id, ParticleSet(attributes_)});
    }
  }
}

void ParticleStore::clear() {
  sets_.clear();
  locals_.clear();
  homeless_.clear();
}

const GridBox& ParticleStore::box(int level, int local) const {
  const int id = at(level)[static_cast<std::size_t>(local)].id;
  return map_->levels()[static_cast<std::size_t>(level)].boxes[static_cast<std::size_t>(id)];
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
  const int local =
      locals_[static_cast<std::size_t>(home.level)][static_cast<std::size_t>(home.box)];
  return set(home.level, local);
}

void ParticleStore::adopt(const ParticleSet& from, std::size_t n) {
  const ParticleMap::Home home = find(from.position(n), from.id(n));
  if (home.owner == rank_) home_of(home).add_from(from, n);
}

void ParticleStore::settle(Communicator& communicator) {
  std::vector<ParticleSet> leaving(static_cast<std::size_t>(communicator.size()),
                                   ParticleSet(attributes_));
  const auto send = [&](const ParticleSet& from, std::size_t n) {
    const ParticleMap::Home home = find(from.position(n), from.id(n));
    leaving[static_cast<std::size_t>(home.owner)].add_from(from, n);
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
  const ParticleSet arrived = exchange_particles(leaving, communicator);
  for (std::size_t n = 0; n < arrived.size(); ++n) adopt(arrived, n);
  for (int l = 0; l < level_count(); ++l)
    for (Box& box : at(l)) sort(l, box);
}

void ParticleStore::sort(int l, Box& box) const {
  const Level& level = map_->levels()[static_cast<std::size_t>(l)];
  const IndexBox& cells = level.boxes[static_cast<std::size_t>(box.id)].cells;
  const IntVec3 size = cells.size();
  using Key = std::pair<std::int64_t, std::int64_t>;
  std::vector<Key> keys;
  keys.reserve(box.set.size());
  for (std::size_t n = 0; n < box.set.size(); ++n) {
    const IntVec3 c = cell_at(level, box.set.position(n)) - cells.lower;
    keys.emplace_back(c.x + size.x * (c.y + static_cast<std::int64_t>(size.y) * c.z),
                      box.set.id(n));
  }
  if (std::is_sorted(keys.begin(), keys.end())) return;
  std::vector<std::uint32_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
  box.set.select(order);
}

std::int64_t ParticleStore::count() const {
  std::int64_t n = static_cast<std::int64_t>(homeless_.size());
  for (const auto& boxes : sets_)
    for (const Box& box : boxes) n += static_cast<std::int64_t>(box.set.size());
  return n;
}

}  // namespace sluice
