// What boxes will cost, from what others cost that lay in the same places.
#include "framework/refine/box_cost.hpp"

#include "framework/grid/box_list.hpp"

namespace sluice {

std::vector<double> carried_costs(const std::vector<GridBox>& measured,
                                  const std::vector<double>& costs,
                                  const std::vector<GridBox>& boxes) {
  std::vector<IndexBox> cells;
  std::vector<double> a_cell;
  double total = 0, volume = 0;
  for (std::size_t b = 0; b < measured.size() && b < costs.size(); ++b) {
    const auto n = static_cast<double>(measured[b].cells.volume());
    cells.push_back(measured[b].cells);
    a_cell.push_back(costs[b] / n);
    total += costs[b];
    volume += n;
  }
  if (!(total > 0)) return {};
  const double average = total / volume;
  const BoxFinder finder(cells);
  std::vector<double> carried;
  for (const GridBox& box : boxes) {
    double cost = 0;
    std::int64_t found = 0;
    for (const int m : finder.overlapping(box.cells)) {
      const std::int64_t n = intersection(cells[m], box.cells).volume();
      cost += a_cell[m] * static_cast<double>(n);
      found += n;
    }
    carried.push_back(cost + average * static_cast<double>(box.cells.volume() - found));
  }
  return carried;
}

std::vector<GridBox> better_owners(const std::vector<GridBox>& now,
                                   const std::vector<double>& costs, int ranks, double least_gain) {
  std::vector<GridBox> better = now;
  assign_owners(better, costs, ranks);
  const double before = imbalance(now, costs, ranks), after = imbalance(better, costs, ranks);
  if (!(after < (1 - least_gain) * before)) better.clear();
  return better;
}

}  // namespace sluice
