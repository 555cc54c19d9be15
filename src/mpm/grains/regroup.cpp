#include "mpm/grains/regroup.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "framework/base/reduction.hpp"
#include "mpm/grains/choose_slots.hpp"
#include "mpm/grains/clusters.hpp"
#include "mpm/grains/gather_all.hpp"
#include "mpm/step/step_sums.hpp"
#include "mpm/transfer/dispatch.hpp"
#include "mpm/transfer/to_grid.hpp"

namespace sluice::mpm {
namespace {

// The boxes of a family's particles on this rank: material after material, box after box.
struct FamilyBoxes {
  std::vector<GrainBox> boxes;
  std::vector<int> materials;  // by box
  std::vector<int> homes;      // by box: local number of the box of cells that has the particle
  double corners = 0;
};

FamilyBoxes boxes_of(const GrainFamily& family, const MpmScene& solids,
                     const std::vector<Carried>& carried, const ParticleCloud& cloud) {
  FamilyBoxes all;
  for (const int m : family.members) {
    const ParticleStore& store = cloud.store(m);
    for (int b = 0; b < store.box_count(0); ++b) {
      add_grain_boxes(store.set(0, b), carried[m].columns, solids.materials[m].loosest,
                      cloud.level(0), all.boxes, all.corners);
      all.materials.resize(all.boxes.size(), m);
      all.homes.resize(all.boxes.size(), b);
    }
  }
  return all;
}

// May a box overlap one beyond the box of cells that holds its particle: those are two cells wide.
bool near_others(const GrainBox& box, const Level& level, const IndexBox& cells) {
  constexpr double farthest = 2.5;  // cells; particles stray from their box by less than half a one
  for (int d = 0; d < 3; ++d) {
    if (!level.active[d]) continue;
    const bool goes_on = level.periodic[d];
    const double at = (box.place[d] - level.anchor[d]) / level.spacing[d];
    const bool inner_low = goes_on || cells.lower[d] > level.domain.lower[d];
    const bool inner_high = goes_on || cells.upper[d] < level.domain.upper[d];
    if ((inner_low && at < cells.lower[d] + farthest) ||
        (inner_high && at > cells.upper[d] - farthest))
      return true;
  }
  return false;
}

void label_over_ranks(FamilyBoxes& own, const GrainFamily& family, const ParticleCloud& cloud,
                      Communicator& ranks) {
  const ParticleStore& store = cloud.store(family.members.front());
  const auto rim = [&](const GrainBox& box) {
    const std::size_t n = &box - own.boxes.data();
    return near_others(box, cloud.level(0), store.box(0, own.homes[n]).cells);
  };
  label_clusters(own.boxes, cloud.level(0), rim, ranks);
}

struct CountRow {
  std::int64_t label = 0, count = 0;
  int material = 0;
};

// The clusters of all ranks, by label.
std::vector<Cluster> clusters_of(const FamilyBoxes& own, Communicator& ranks) {
  std::map<std::pair<std::int64_t, int>, std::int64_t> counts;
  for (std::size_t n = 0; n < own.boxes.size(); ++n)
    ++counts[{own.boxes[n].label, own.materials[n]}];
  std::vector<CountRow> rows;
  for (const auto& [key, count] : counts) rows.push_back({key.first, count, key.second});
  counts.clear();
  for (const CountRow& row : gather_all(rows, ranks))
    counts[{row.label, row.material}] += row.count;
  std::vector<Cluster> clusters;
  std::int64_t most = 0;
  for (const auto& [key, count] : counts) {
    if (clusters.empty() || clusters.back().label != key.first) {
      clusters.emplace_back().label = key.first;
      most = 0;
    }
    Cluster& c = clusters.back();
    c.size += count;
    if (count > most) {  // of equal ones the lowest material
      most = count;
      c.home = key.second;
    }
  }
  return clusters;
}

// Two clusters have no node in common when they are that many cells apart.
int cells_apart(const MpmScene& solids, double corners, Communicator& ranks) {
  int reach = std::max(reach_of(solids.basis), reach_of(Basis::gimp));  // contact has GIMP's
  if (by_corners(solids.basis)) {
    Reduction all;
    const auto far = all.add_maximum(corners);
    ranks.reduce(all);
    reach = std::max(reach, static_cast<int>(std::floor(all.maximum(far))) + 2);
  }
  return 2 * reach + 2;
}

// A tuple is no plain record.
struct PartRow {
  std::int64_t label = 0;
  int x = 0, y = 0, z = 0;
};

void find_parts(const FamilyBoxes& own, const GridParts& grid, Communicator& ranks,
                std::vector<Cluster>& clusters) {
  std::set<std::pair<std::int64_t, GridPart>> parts;
  for (const GrainBox& box : own.boxes) parts.emplace(box.label, grid.of(box.place));
  std::vector<PartRow> rows;
  for (const auto& [label, part] : parts)
    rows.push_back({label, std::get<0>(part), std::get<1>(part), std::get<2>(part)});
  for (const PartRow& row : gather_all(rows, ranks)) {
    const auto at =
        std::lower_bound(clusters.begin(), clusters.end(), row.label,
                         [](const Cluster& c, std::int64_t label) { return c.label < label; });
    at->parts.insert({row.x, row.y, row.z});
  }
}

// The journeys of a family's particles, into the books too: mass leaves a material and comes to
// another. Whether there are any on this rank.
bool move_particles(const FamilyBoxes& own, const std::vector<Cluster>& clusters,
                    const SlotChoice& choice, const std::vector<Carried>& carried,
                    ParticleCloud& cloud, std::vector<ExactSum>& left) {
  std::unordered_map<std::int64_t, int> slot;
  for (std::size_t n = 0; n < clusters.size(); ++n) slot[clusters[n].label] = choice.slots[n];
  const std::size_t kinds = cloud.kind_count();
  std::vector<std::vector<std::vector<int>>> to;  // by box of cells and kind
  bool any = false;
  for (std::size_t n = 0; n < own.boxes.size(); ++n) {
    const std::size_t b = own.homes[n];
    const std::size_t m = own.materials[n];
    if (to.size() <= b) to.resize(b + 1, std::vector<std::vector<int>>(kinds));
    const int target = slot.at(own.boxes[n].label);
    to[b][m].push_back(target);
    if (target == own.materials[n]) continue;
    any = true;
    const double mass = cloud.store(own.materials[n])
                            .set(0, own.homes[n])
                            .column(carried[m].columns.mass)[to[b][m].size() - 1];
    left[m].add(mass);
    left[target].add(-mass);
  }
  for (std::size_t b = 0; b < to.size() && any; ++b)
    cloud.change_kinds(0, static_cast<int>(b), to[b]);
  return any;
}

void tell(const GrainFamily& family, std::size_t clusters, std::int64_t near_ones,
          Communicator& ranks, EventLedger* events) {
  if (events == nullptr || !ranks.is_root()) return;
  EventPlace place;
  place.material = family.members.front();
  place.task = "grains";
  place.value = static_cast<double>(clusters);
  if (clusters > family.members.size())
    events->record("more clusters of grains than materials", place);
  place.value = static_cast<double>(near_ones);
  if (near_ones > 0) events->record("clusters of grains near each other in one material", place);
}

GrainFamily present_members(const MpmScene& solids, const GrainFamily& family, double time) {
  GrainFamily present;
  for (std::size_t n = 0; n < family.members.size(); ++n) {
    const int m = family.members[n];
    if (!solids.materials[m].takes_part(time)) continue;
    present.members.push_back(m);
    present.in_contact += n < family.in_contact;
  }
  return present;
}

}  // namespace

bool regroup_grains(const MpmScene& solids, const std::vector<Carried>& carried,
                    ParticleCloud& cloud, Communicator& ranks, const StepEnd& end) {
  std::vector<ExactSum> left(solids.materials.size());
  bool any = false;
  for (const GrainFamily& family : solids.grains) {
    const GrainFamily present = present_members(solids, family, end.time);
    if (present.members.size() < 2) continue;
    FamilyBoxes own = boxes_of(present, solids, carried, cloud);
    label_over_ranks(own, present, cloud, ranks);
    std::vector<Cluster> clusters = clusters_of(own, ranks);
    const GridParts grid(cloud.level(0), cells_apart(solids, own.corners, ranks));
    if (!all_fit(clusters.size(), present)) find_parts(own, grid, ranks, clusters);
    const SlotChoice choice = choose_slots(clusters, present, grid);
    tell(present, clusters.size(), choice.near_ones, ranks, end.events);
    any |= move_particles(own, clusters, choice, carried, cloud, left);
  }
  Reduction all;
  const auto one = all.add_any(any);
  std::vector<Reduction::Sum> slots;
  for (const ExactSum& s : left) slots.push_back(all.add_sum(s));
  ranks.reduce(all);
  for (std::size_t m = 0; m < slots.size(); ++m)
    (*end.sums)[StepSums::count + m] += all.sum(slots[m]).value();
  return all.any(one);
}

bool free_loose_grains(const MpmScene& solids, const std::vector<Carried>& carried,
                       ParticleCloud& cloud, Communicator& ranks) {
  bool any = false;
  for (std::size_t m = 0; m < solids.materials.size(); ++m) {
    if (!solids.materials[m].loose_have_no_stress) continue;
    const Columns& c = carried[m].columns;
    ParticleStore& store = cloud.store(static_cast<int>(m));
    for (int b = 0; b < store.box_count(0); ++b) {
      ParticleSet& set = store.set(0, b);
      const double* volume = set.column(c.volume);
      const double* volume_0 = set.column(c.volume_0);
      const auto stress = write_columns<6>(set, c.stress);
      for (std::size_t p = 0; p < set.size(); ++p)
        if (volume[p] > solids.materials[m].loosest * volume_0[p])
          for (double* s : stress) {
            any |= s[p] != 0;
            s[p] = 0;
          }
    }
  }
  Reduction all;
  const auto one = all.add_any(any);
  ranks.reduce(all);
  return all.any(one);
}

}  // namespace sluice::mpm
