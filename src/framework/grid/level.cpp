// Splitting a level into boxes and dealing them out to ranks.
#include "framework/grid/level.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sluice {

std::vector<IndexBox> split(const IndexBox& domain, IntVec3 pieces) {
  const IntVec3 n = domain.size();
  auto cut = [&](int d, int part) {
    return domain.lower[d] + static_cast<int>(static_cast<std::int64_t>(n[d]) * part / pieces[d]);
  };
  std::vector<IndexBox> boxes;
  for (int i = 0; i < pieces.x; ++i)
    for (int j = 0; j < pieces.y; ++j)
      for (int k = 0; k < pieces.z; ++k) {
        const IndexBox b{{cut(0, i), cut(1, j), cut(2, k)},
                         {cut(0, i + 1), cut(1, j + 1), cut(2, k + 1)}};
        if (!b.empty()) boxes.push_back(b);
      }
  return boxes;
}

namespace {

// Interleaves the lowest 21 bits of three coordinates: the Morton key of a box corner.
std::uint64_t morton_key(IntVec3 c) {
  std::uint64_t key = 0;
  for (int bit = 0; bit < 21; ++bit)
    for (int d = 0; d < 3; ++d)
      key |= ((static_cast<std::uint64_t>(c[d]) >> bit) & 1u) << (3 * bit + d);
  return key;
}

// Weights are integers, so that every rank and every machine cuts at the same boxes.
void deal_out(std::vector<GridBox>& boxes, const std::vector<std::int64_t>& weights, int ranks) {
  if (ranks == 1)
    for (GridBox& b : boxes) b.owner = 0;
  if (ranks == 1 || boxes.empty()) return;
  IntVec3 low = boxes.front().cells.lower;
  std::int64_t total = 0;
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    low = min(low, boxes[b].cells.lower);
    total += weights[b];
  }
  std::vector<std::uint64_t> keys;
  for (const GridBox& b : boxes) keys.push_back(morton_key(b.cells.lower - low));
  std::vector<std::size_t> order(boxes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
  std::int64_t before = 0;
  int last = -1;
  for (std::size_t n = 0; n < order.size(); ++n) {
    const std::int64_t weight = weights[order[n]];
    const std::int64_t middle = before + weight / 2;
    int owner = static_cast<int>(std::min<std::int64_t>(ranks - 1, middle * ranks / total));
    if (static_cast<int>(order.size()) >= ranks) {
      // Big boxes must not leave a rank without any: skip none, and keep enough for the rest.
      const int left = static_cast<int>(order.size() - n);
      owner = std::max(std::min(owner, last + 1), ranks - left);
    }
    boxes[order[n]].owner = last = owner;
    before += weight;
  }
}

}  // namespace

void assign_owners(std::vector<GridBox>& boxes, int ranks) {
  std::vector<std::int64_t> cells;
  for (const GridBox& b : boxes) cells.push_back(b.cells.volume());
  deal_out(boxes, cells, ranks);
}

void assign_owners(std::vector<GridBox>& boxes, const std::vector<double>& costs, int ranks) {
  constexpr double parts = 1 << 30;  // of the whole cost; weights are even, so that half is whole
  const auto good = [](double cost) { return std::isfinite(cost) && cost > 0; };
  double total = 0;
  for (const double cost : costs) total += good(cost) ? cost : 0;
  if (costs.size() != boxes.size() || !(total > 0)) {
    assign_owners(boxes, ranks);
    return;
  }
  std::vector<std::int64_t> weights;
  for (const double cost : costs)
    weights.push_back(2 + 2 * static_cast<std::int64_t>(good(cost) ? cost / total * parts : 0));
  deal_out(boxes, weights, ranks);
}

double imbalance(const std::vector<GridBox>& boxes, const std::vector<double>& costs, int ranks) {
  std::vector<double> load(ranks);
  double total = 0;
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    load[boxes[b].owner] += costs[b];
    total += costs[b];
  }
  return total > 0 ? *std::max_element(load.begin(), load.end()) * ranks / total : 1;
}

}  // namespace sluice
