#include "mpm/grains/choose_slots.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sluice::mpm {

GridParts::GridParts(const Level& level, int width) : level_(&level) {
  for (int d = 0; d < 3; ++d)
    if (level.active[d]) count_[d] = std::max(1, level.domain.size()[d] / width);
}

GridPart GridParts::of(Vec3 place) const {
  IntVec3 part{};
  const IntVec3 size = level_->domain.size();
  for (int d = 0; d < 3; ++d) {
    if (count_[d] == 1) continue;
    const double cell = std::floor((place[d] - level_->anchor[d]) / level_->spacing[d]);
    const int inside = std::clamp(static_cast<int>(cell) - level_->domain.lower[d], 0, size[d] - 1);
    part[d] = static_cast<int>(static_cast<std::int64_t>(inside) * count_[d] / size[d]);
  }
  return {part.x, part.y, part.z};
}

std::vector<GridPart> GridParts::around(const GridPart& part) const {
  const auto [x, y, z] = part;
  const IntVec3 at{x, y, z};
  std::vector<GridPart> found;
  for (int n = 0; n < 27; ++n) {
    IntVec3 next = at + IntVec3{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
    bool inside = true;
    for (int d = 0; d < 3; ++d) {
      if (level_->periodic[d]) next[d] = (next[d] + count_[d]) % count_[d];
      inside = inside && next[d] >= 0 && next[d] < count_[d];
    }
    if (inside) found.emplace_back(next.x, next.y, next.z);
  }
  return found;
}

bool all_fit(std::size_t clusters, const GrainFamily& family) {
  return clusters <= (family.in_contact > 0 ? family.in_contact : family.members.size());
}

namespace {

class Choice {
 public:
  Choice(const std::vector<Cluster>& clusters, const GrainFamily& family, const GridParts& parts)
      : clusters_(clusters), family_(family), grid_(parts), taken_(family.members.size()) {
    result_.slots.assign(clusters.size(), -1);
  }

  SlotChoice run() {
    std::vector<std::size_t> order(clusters_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      if (clusters_[a].size != clusters_[b].size) return clusters_[a].size > clusters_[b].size;
      return clusters_[a].label < clusters_[b].label;
    });
    for (const std::size_t n : order)  // rule 1
      if (const std::size_t home = member_of(clusters_[n].home);
          home < first_tier() && !taken_[home].any)
        put(n, home);
    for (const std::size_t n : order)
      if (result_.slots[n] < 0) find(n);
    return std::move(result_);
  }

 private:
  struct Taken {
    bool any = false;
    std::set<GridPart> near;  // parts of its clusters, and those around
  };

  std::size_t first_tier() const {
    return family_.in_contact > 0 ? family_.in_contact : family_.members.size();
  }
  std::size_t member_of(int material) const {
    return std::find(family_.members.begin(), family_.members.end(), material) -
           family_.members.begin();
  }
  void put(std::size_t n, std::size_t member) {
    result_.slots[n] = family_.members[member];
    taken_[member].any = true;
    for (const GridPart& part : clusters_[n].parts)
      for (const GridPart& next : grid_.around(part)) taken_[member].near.insert(next);
  }
  bool put_where_free(std::size_t n, std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; ++m)
      if (!taken_[m].any) {
        put(n, m);
        return true;
      }
    return false;
  }
  bool far_from(std::size_t n, std::size_t member) const {
    const auto& near = taken_[member].near;
    return std::none_of(clusters_[n].parts.begin(), clusters_[n].parts.end(),
                        [&](const GridPart& part) { return near.contains(part); });
  }
  bool put_where_far(std::size_t n) {
    const std::size_t home = member_of(clusters_[n].home);
    if (home < first_tier() && far_from(n, home)) {
      put(n, home);
      return true;
    }
    for (std::size_t m = 0; m < first_tier(); ++m)
      if (far_from(n, m)) {
        put(n, m);
        return true;
      }
    return false;
  }
  void find(std::size_t n) {
    const std::size_t home = member_of(clusters_[n].home);
    if (put_where_free(n, 0, first_tier()) || put_where_far(n) ||
        (home >= first_tier() && put_where_free(n, home, home + 1)) ||
        put_where_free(n, first_tier(), family_.members.size()))
      return;
    put(n, home);
    ++result_.near_ones;
  }

  const std::vector<Cluster>& clusters_;
  const GrainFamily& family_;
  const GridParts& grid_;
  std::vector<Taken> taken_;  // by member
  SlotChoice result_;
};

}  // namespace

SlotChoice choose_slots(const std::vector<Cluster>& clusters, const GrainFamily& family,
                        const GridParts& parts) {
  return Choice(clusters, family, parts).run();
}

}  // namespace sluice::mpm
