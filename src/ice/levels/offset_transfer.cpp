// The offset where levels meet.
//
//   prolong   Y_f = Y + sum over axes of L3(Y) x_f,  x_f: of the fine cell, in coarse cells
//   restrict  Y = mean(Y_f)
#include "ice/levels/offset_transfer.hpp"

#include "framework/refine/face_table.hpp"
#include "ice/fluid/limiters.hpp"
#include "ice/levels/children.hpp"

namespace sluice::ice {
namespace {

int floor_of(int a, int b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

}  // namespace

void OffsetTransfer::prolong(const StateViews& coarse, const StateViews& fine,
                             const IndexBox& cells, const TransferGeometry& geometry,
                             int order) const {
  flow_->prolong(flow_views(coarse), flow_views(fine), cells, geometry, order);
  const RealView &Y = coarse.back(), &Y_f = fine.back();
  const IntVec3 ratio = geometry.ratio;
  for_each_cell(cells, [&](IntVec3 cell) {
    const IntVec3 parent{floor_of(cell.x, ratio.x), floor_of(cell.y, ratio.y),
                         floor_of(cell.z, ratio.z)};
    double value = Y(parent);
    for (int d = 0; d < 3; ++d) {
      if (order == 0 || !geometry.active[d]) continue;
      IntVec3 low = parent, high = parent;
      --low[d];
      ++high[d];
      const double x = (cell[d] - parent[d] * ratio[d] + 0.5) / ratio[d] - 0.5;
      value += x * central_slope(Y(parent) - Y(low), Y(high) - Y(parent));
    }
    Y_f(cell) = value;
  });
}

void OffsetTransfer::restrict_to(const StateViews& fine, const StateViews& coarse,
                                 const IndexBox& coarse_cells,
                                 const TransferGeometry& geometry) const {
  flow_->restrict_to(flow_views(fine), flow_views(coarse), coarse_cells, geometry);
  const Children children(geometry);
  for_each_cell(coarse_cells, [&](IntVec3 parent) {
    double values[Children::most][1];
    for (int child = 0; child < children.count(); ++child) {
      IntVec3 cell = parent;
      for (int a = 0; a < children.axes().count; ++a) {
        const int d = children.axes().direction[a];
        cell[d] = parent[d] * geometry.ratio[d] + children.place(child, a);
      }
      values[child][0] = fine.back()(cell);
    }
    children.mean(values, 1);
    coarse.back()(parent) = values[0][0];
  });
}

void OffsetTransfer::correct(const StateViews& state, const ConservedChange& change,
                             std::span<double> share) const {
  flow_->correct(flow_views(state), change, share);
}

}  // namespace sluice::ice
