// Parabolas down, means up.
#include "examples/cell_transfer.hpp"

#include "framework/grid/box_list.hpp"

namespace sluice::examples {
namespace {

// What the parabola along d adds in fine cell `i` of `ratio` in a coarse cell, 0 at the lowest; its
// mean over the fine cell, so that the fine cells of a coarse one sum to nothing.
double along(const RealView& coarse, IntVec3 c, int d, int i, int ratio) {
  IntVec3 below = c, above = c;
  --below[d];
  ++above[d];
  const double slope = 0.5 * (coarse(above) - coarse(below));
  const double curve = coarse(above) - 2 * coarse(c) + coarse(below);
  const double x = (i + 0.5) / ratio - 0.5;
  const double width = 1.0 / ratio;
  return slope * x + 0.5 * curve * (x * x + (width * width - 1) / 12);
}

}  // namespace

void CellTransfer::prolong(const StateViews& coarse, const StateViews& fine, const IndexBox& cells,
                           const TransferGeometry& geometry, int order) const {
  for (std::size_t v = 0; v < coarse.size(); ++v)
    for_each_cell(cells, [&](IntVec3 f) {
      const IntVec3 c = coarsen(f, geometry.ratio);
      double value = coarse[v](c);
      for (int d = 0; d < 3 && order > 0; ++d)
        if (geometry.ratio[d] > 1)
          value += along(coarse[v], c, d, f[d] - c[d] * geometry.ratio[d], geometry.ratio[d]);
      fine[v](f) = value;
    });
}

void CellTransfer::restrict_to(const StateViews& fine, const StateViews& coarse,
                               const IndexBox& coarse_cells,
                               const TransferGeometry& geometry) const {
  const double share = 1.0 / (geometry.ratio.x * geometry.ratio.y * geometry.ratio.z);
  for (std::size_t v = 0; v < coarse.size(); ++v)
    for_each_cell(coarse_cells, [&](IntVec3 c) {
      double sum = 0;
      for_each_cell(refine(IndexBox{c, c + IntVec3::all(1)}, geometry.ratio),
                    [&](IntVec3 f) { sum += fine[v](f); });
      coarse[v](c) = share * sum;
    });
}

}  // namespace sluice::examples
