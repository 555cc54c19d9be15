#include "ice/levels/interface_seeds.hpp"

#include <algorithm>
#include <cmath>

#include "ice/closure/interface_band.hpp"
#include "ice/fluid/labels.hpp"

namespace sluice::ice {
namespace {

// A row of volume fractions with those aside of it; across a direction that is no dimension of the
// run the stride is 0, and a cell its own neighbour.
struct FractionRow {
  const double* centre;
  const std::ptrdiff_t* aside;

  bool at_interface(int i) const {
    const double v = centre[i];
    double jump = 0;
    for (int d = 0; d < 3; ++d)
      jump = std::max(
          {jump, std::fabs(v - centre[i - aside[d]]), std::fabs(v - centre[i + aside[d]])});
    constexpr double least = mixture::interface_band, most = 1 - least;
    return (v > least && v < most) || jump > most - least;
  }
};

void add_cells(const RealView& fraction, const IndexBox& cells, std::vector<IntVec3>& found) {
  const int along = fraction.stride[0] == 1 ? 0 : fraction.stride[1] == 1 ? 1 : 2;
  IndexBox starts = cells;
  starts.upper[along] = starts.lower[along] + 1;
  for_each_cell(starts, [&](IntVec3 cell) {
    const FractionRow row{fraction.data + fraction.offset(cell), fraction.stride};
    const int count = cells.size()[along], first = cell[along];
    for (int i = 0; i < count; ++i) {
      if (!row.at_interface(i)) continue;
      cell[along] = first + i;
      found.push_back(cell);
    }
  });
}

}  // namespace

std::vector<FlagSeeds> interface_seeds(const Warehouse& state, const std::vector<int>& materials,
                                       const std::vector<InterfaceCriterion>& criteria) {
  std::vector<FlagSeeds> all;
  const int count = static_cast<int>(materials.size());
  if (count < 2) return all;
  for (const InterfaceCriterion& c : criteria) {
    if (state.level().index >= c.finest_level) continue;
    FlagSeeds& seeds = all.emplace_back();
    seeds.distance = c.distance;
    for (int m = 0; m < count; ++m) {
      if (c.material >= 0 && c.material != m) continue;
      const int slot = state.find(labels().volume, materials[m]);
      for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
        add_cells(state.view(slot, 0, b), state.local_boxes()[b].cells, seeds.cells);
    }
  }
  return all;
}

}  // namespace sluice::ice
