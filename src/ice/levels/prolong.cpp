// Fine cells of a gas from coarse ones, by the order that is asked for.
#include "ice/levels/prolonger.hpp"

namespace sluice::ice {
namespace {

// Order 0: every fine cell is its coarse cell.
void copy_to_children(const Prolongation& region, std::size_t q, const TransferGeometry& geometry) {
  const IndexBox& cells = region.cells;
  const RealView &coarse = (*region.coarse)[q], &fine = (*region.fine)[q];
  const int along = longest_direction(cells, Children(geometry).axes());
  const int ratio = geometry.ratio[along];
  for_each_line(cells, along, cells.size()[along], [&](IntVec3 first, int n) {
    const IntVec3 parent = coarsen(first, geometry.ratio);
    const std::ptrdiff_t at = coarse.offset(parent), step = coarse.stride[along];
    const double* from = coarse.data + at;
    const double* later = region.later == nullptr ? nullptr : (*region.later)[q].data + at;
    double* to = fine.data + fine.offset(first);
    int place = first[along] - parent[along] * ratio;
    for (int i = 0; i < n; ++i, to += fine.stride[along]) {
      const std::ptrdiff_t cell = place++ / ratio * step;
      *to = later == nullptr ? from[cell] : blended(from[cell], later[cell], region.share);
    }
  });
}

template <int Order>
void prolong_regions(std::span<const Prolongation> regions, const TransferGeometry& geometry,
                     int components, const Fluid& fluid, std::span<const std::size_t> by_volume) {
  const Children children(geometry);
  const auto on_axes = [&]<int D>() {
    Prolonger<D, Order>(regions, geometry, children, components, fluid, by_volume).run();
  };
  switch (children.axes().count) {
    case 1:
      return on_axes.template operator()<1>();
    case 2:
      return on_axes.template operator()<2>();
    default:
      return on_axes.template operator()<3>();
  }
}

}  // namespace

void IceTransfer::prolong_all(std::span<const Prolongation> regions,
                              const TransferGeometry& geometry, int order) const {
  const bool by_polynomial = order > 0 && by_volume_.size() <= max_prolonged_scalars;
  if (by_polynomial && order == 2)
    return prolong_regions<2>(regions, geometry, components_, fluid_, by_volume_);
  if (by_polynomial) return prolong_regions<1>(regions, geometry, components_, fluid_, by_volume_);
  for (const Prolongation& r : regions)
    for (std::size_t q = 0; q < r.coarse->size() && !r.cells.empty(); ++q)
      copy_to_children(r, q, geometry);
}

}  // namespace sluice::ice
