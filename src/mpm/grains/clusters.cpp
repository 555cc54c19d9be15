#include "mpm/grains/clusters.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "framework/particle/particle_map.hpp"
#include "mpm/grains/disjoint_sets.hpp"
#include "mpm/grains/gather_all.hpp"

namespace sluice::mpm {
namespace {

// Boxes by the cell of their middle, cells through periodic sides being one.
class BoxFinder {
 public:
  BoxFinder(const std::vector<GrainBox>& boxes, const Level& level)
      : level_(level), size_(level.domain.size()) {
    Vec3 half{};
    for (std::size_t n = 0; n < boxes.size(); ++n) {
      for (int d = 0; d < 3; ++d) half[d] = std::max(half[d], boxes[n].half[d]);
      by_cell_[number(cell_of(boxes[n]))].push_back(n);
    }
    for (int d = 0; d < 3; ++d)
      if (level.active[d])
        reach_[d] = static_cast<int>(std::floor(2 * half[d] / level.spacing[d])) + 1;
  }

  // Calls f for each box that may overlap this one.
  template <class F>
  void near(const GrainBox& box, F&& f) const {
    const IntVec3 at = cell_of(box);
    for (int k = -reach_.z; k <= reach_.z; ++k)
      for (int j = -reach_.y; j <= reach_.y; ++j)
        for (int i = -reach_.x; i <= reach_.x; ++i)
          if (const auto found = by_cell_.find(number(at + IntVec3{i, j, k}));
              found != by_cell_.end())
            for (const std::size_t n : found->second) f(n);
  }

 private:
  IntVec3 cell_of(const GrainBox& box) const {
    IntVec3 cell{};
    for (int d = 0; d < 3; ++d)
      if (level_.active[d])
        cell[d] =
            static_cast<int>(std::floor((box.place[d] - level_.anchor[d]) / level_.spacing[d]));
    return cell;
  }
  // Outside of the domain too, by two cells and more: what is there leaves in the same step.
  std::int64_t number(IntVec3 cell) const {
    constexpr int margin = 8;
    std::int64_t n = 0;
    for (int d = 2; d >= 0; --d) {
      int c = cell[d] - level_.domain.lower[d];
      if (!level_.active[d]) continue;
      if (level_.periodic[d]) c = ((c % size_[d]) + size_[d]) % size_[d];
      n = n * (size_[d] + 2 * margin) + c + margin;
    }
    return n;
  }

  const Level& level_;
  IntVec3 size_{};
  IntVec3 reach_{};
  std::unordered_map<std::int64_t, std::vector<std::size_t>> by_cell_;
};

}  // namespace

bool overlap(const GrainBox& a, const GrainBox& b, const Level& level) {
  for (int d = 0; d < 3; ++d) {
    double apart = a.place[d] - b.place[d];
    if (level.periodic[d]) apart = std::remainder(apart, level.domain.size()[d] * level.spacing[d]);
    if (!(std::fabs(apart) <= a.half[d] + b.half[d])) return false;
  }
  return true;
}

void label_clusters(std::vector<GrainBox>& boxes, const Level& level) {
  DisjointSets sets(boxes.size());
  std::unordered_map<std::int64_t, std::size_t> first;
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    const auto [known, fresh] = first.emplace(boxes[n].label, n);
    if (!fresh) sets.unite(known->second, n);
  }
  const BoxFinder finder(boxes, level);
  for (std::size_t n = 0; n < boxes.size(); ++n)
    finder.near(boxes[n], [&](std::size_t other) {
      if (other > n && sets.find(other) != sets.find(n) && overlap(boxes[n], boxes[other], level))
        sets.unite(n, other);
    });
  std::vector<std::int64_t> least(boxes.size(), most_particle_id);
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    std::int64_t& label = least[sets.find(n)];
    label = std::min(label, boxes[n].label);
  }
  for (std::size_t n = 0; n < boxes.size(); ++n) boxes[n].label = least[sets.find(n)];
}

// What has one label is one cluster here too, so that clusters may pass through several ranks.
std::unordered_map<std::int64_t, std::int64_t> join_rims(const std::vector<GrainBox>& rims,
                                                         const Level& level) {
  std::vector<GrainBox> joined = rims;
  label_clusters(joined, level);
  std::unordered_map<std::int64_t, std::int64_t> renamed;
  for (std::size_t n = 0; n < rims.size(); ++n) renamed[rims[n].label] = joined[n].label;
  return renamed;
}

// Each rank joins its own; then all do the same with what lies near others.
void label_clusters(std::vector<GrainBox>& boxes, const Level& level,
                    const std::function<bool(const GrainBox&)>& near_others, Communicator& ranks) {
  label_clusters(boxes, level);
  if (ranks.size() == 1) return;
  std::vector<GrainBox> rim;
  std::copy_if(boxes.begin(), boxes.end(), std::back_inserter(rim), near_others);
  const auto renamed = join_rims(gather_all(rim, ranks), level);
  for (GrainBox& box : boxes)
    if (const auto to = renamed.find(box.label); to != renamed.end()) box.label = to->second;
}

}  // namespace sluice::mpm
