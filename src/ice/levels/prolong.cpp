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

template <int Order, int S>
void prolong_regions(std::span<const Prolongation> regions, const TransferGeometry& geometry,
                     int components, const Fluid& fluid, const std::size_t* by_volume) {
  const Children children(geometry);
  dispatch(children.axes().count, components, [&]<int D, int C>() {
    Prolonger<D, C, Order, S>(regions, geometry, children, fluid, by_volume).run();
  });
}

}  // namespace

void IceTransfer::prolong_all(std::span<const Prolongation> regions,
                              const TransferGeometry& geometry, int order) const {
  const auto with = [&]<int S>() {
    if (order == 2)
      prolong_regions<2, S>(regions, geometry, components_, fluid_, by_volume_.data());
    else
      prolong_regions<1, S>(regions, geometry, components_, fluid_, by_volume_.data());
  };
  if (order > 0 && by_volume_.size() == 2) return with.template operator()<2>();
  if (order > 0 && by_volume_.size() == 1) return with.template operator()<1>();
  if (order > 0) return with.template operator()<0>();
  for (const Prolongation& r : regions)
    for (std::size_t q = 0; q < r.coarse->size() && !r.cells.empty(); ++q)
      copy_to_children(r, q, geometry);
}

}  // namespace sluice::ice
