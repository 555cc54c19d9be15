#include "mpm/implicit/all_particles.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace sluice::mpm {
namespace {

// Those of all ranks, in the order in which ranks and boxes hold them.
ParticleSet collect(const ParticleStore& store, Communicator& ranks) {
  ParticleSet all = store.empty_set();
  std::vector<double> packed;
  for (int b = 0; b < store.box_count(0); ++b) {
    const ParticleSet& set = store.set(0, b);
    for (std::size_t n = 0; n < set.size(); ++n)
      if (ranks.size() == 1) {
        all.add_from(set, n);
      } else {
        packed.resize(packed.size() + set.packed_size());
        set.pack(n, packed.data() + packed.size() - set.packed_size());
      }
  }
  if (ranks.size() == 1) return all;
  std::string bytes(packed.size() * sizeof(double), '\0');
  std::memcpy(bytes.data(), packed.data(), bytes.size());
  for (const std::string& of_rank : ranks.gather_to_all(bytes)) {
    packed.resize(of_rank.size() / sizeof(double));
    std::memcpy(packed.data(), of_rank.data(), of_rank.size());
    for (std::size_t at = 0; at < packed.size(); at += all.packed_size())
      all.add_packed(packed.data() + at);
  }
  return all;
}

}  // namespace

void AllParticles::gather(const ParticleCloud& cloud, const std::vector<ParticleKind>& kinds,
                          Communicator& ranks) {
  kinds_.clear();
  kinds_.resize(kinds.size());
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const ParticleStore& store = cloud.store(static_cast<int>(k));
    Kind& kind = kinds_[k];
    kind.now = collect(store, ranks);
    std::vector<std::uint32_t> order(kind.now.size());
    std::iota(order.begin(), order.end(), 0U);
    const std::vector<std::int64_t>& ids = kind.now.ids();
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return ids[a] < ids[b]; });
    kind.now.select(order);
    kind.next = ParticleSet(kind.now.attribute_count());
    kind.next.make_room(kind.now, kinds[k].advanced_columns());
    for (int b = 0; b < store.box_count(0); ++b) {
      const std::vector<std::int64_t>& own = store.set(0, b).ids();
      for (std::size_t n = 0; n < own.size(); ++n) {
        const auto at = std::lower_bound(kind.now.ids().begin(), kind.now.ids().end(), own[n]);
        kind.homes.push_back({static_cast<std::size_t>(at - kind.now.ids().begin()), b, n});
      }
    }
  }
}

void AllParticles::give_back(ParticleCloud& cloud, const std::vector<ParticleKind>& kinds) const {
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    ParticleStore& store = cloud.store(static_cast<int>(k));
    const std::vector<std::size_t> advanced = kinds[k].advanced_columns();
    for (int b = 0; b < store.box_count(0); ++b)
      store.next(0, b).make_room(store.set(0, b), advanced);
    for (const Kind::Home& home : kinds_[k].homes) {
      ParticleSet& to = store.next(0, home.box);
      for (int d = 0; d < 3; ++d)
        to.coordinate(d)[home.number] = kinds_[k].next.coordinate(d)[home.row];
      for (const std::size_t a : advanced)
        to.column(a)[home.number] = kinds_[k].next.column(a)[home.row];
    }
  }
}

}  // namespace sluice::mpm
