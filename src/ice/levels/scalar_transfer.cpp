// Scalars where levels meet.
//
// Scalars that are carried by volume are prolonged with the flow (levels/prolonger.hpp), others so:
//   prolong    q_f = q + a (s.x_f - w),  s = L3 of the coarse values, w = <rho_f s.x_f>/<rho_f>,
//              a the largest share that keeps all fine cells between the coarse ones around
//   restrict   q = r + <M_f (q_f - r)>/M,  r = <q_f>: uniform scalars keep their bits
//   correct    q' = q + share (dA - q dM)/M',  A = M q
#include "ice/levels/scalar_transfer.hpp"

#include <algorithm>
#include <cmath>

#include "framework/grid/box_list.hpp"
#include "ice/fluid/shared_mass.hpp"
#include "ice/levels/children.hpp"

namespace sluice::ice::scalars {
namespace {

// The children of one coarse cell, each a row of one cell: Children::mean sums them.
using ChildRows = double[Children::most][1];

IntVec3 child_cell(const Children& children, const TransferGeometry& geometry, IntVec3 parent,
                   int child) {
  IntVec3 cell = parent;
  for (int a = 0; a < children.axes().count; ++a) {
    const int d = children.axes().direction[a];
    cell[d] = parent[d] * geometry.ratio[d] + children.place(child, a);
  }
  return cell;
}

double mean(const Children& children, ChildRows& rows) {
  children.mean(rows, 1);
  return rows[0][0];
}

// The linear function of a coarse cell, and between which values it must stay.
struct Linear {
  double slope[3] = {0, 0, 0};
  double low = 0, high = 0;
};

Linear linear_of(const RealView& q, const RealView& M, IntVec3 cell, const Axes& axes) {
  Linear f;
  const double here = q(cell);
  f.low = f.high = here;
  for (int a = 0; a < axes.count; ++a) {
    IntVec3 below = cell, above = cell;
    --below[axes.direction[a]];
    ++above[axes.direction[a]];
    const double down = difference(q(below), here, M(below), M(cell));
    const double up = difference(here, q(above), M(cell), M(above));
    f.slope[a] = central_slope(down, up);
    f.low = smaller(f.low, smaller(here - down, here + up));
    f.high = larger(f.high, larger(here - down, here + up));
  }
  return f;
}

// The deviations from the coarse value, into `deviation`.
void spread_out(const Children& children, const Linear& f, double q, ChildRows& mass,
                double* deviation) {
  ChildRows moments;
  for (int child = 0; child < children.count(); ++child) {
    double sum = f.slope[0] * children.offset(child, 0);
    for (int a = 1; a < children.axes().count; ++a) sum += f.slope[a] * children.offset(child, a);
    deviation[child] = sum;
    moments[child][0] = mass[child][0] * sum;
  }
  const double weight = mean(children, mass);
  const double shift = mean(children, moments) / larger(weight, min_divisor);
  double share = 1.0;
  for (int child = 0; child < children.count(); ++child) {
    double& x = deviation[child];
    x -= shift;
    const double room = x > 0 ? f.high - q : q - f.low;
    if (std::fabs(x) > room) share = smaller(share, room / std::fabs(x));
  }
  for (int child = 0; child < children.count(); ++child) deviation[child] *= share;
}

// Room for whole coarse cells where only some of their fine ones are wanted.
class Scratch {
 public:
  Scratch(std::size_t count, const IndexBox& box, const std::array<bool, 3>& active) {
    const std::size_t cells = box.volume();
    room_.resize(count * cells);
    for (std::size_t n = 0; n < count; ++n) {
      RealView v;
      v.data = room_.data() + n * cells;
      v.box = box;
      std::ptrdiff_t stride = 1;
      for (int d = 0; d < 3; ++d) {
        v.stride[d] = active[d] ? stride : 0;
        if (active[d]) stride *= box.size()[d];
      }
      views.push_back(v);
    }
  }
  StateViews views;

 private:
  std::vector<double> room_;
};

}  // namespace

void ScalarTransfer::prolong(const StateViews& coarse, const StateViews& fine,
                             const IndexBox& cells, const TransferGeometry& geometry,
                             int order) const {
  if (cells.empty()) return;
  const IndexBox parents = coarsen(cells, geometry.ratio);
  const IndexBox whole = refine(parents, geometry.ratio);
  if (whole == cells) return prolong_whole_cells(coarse, fine, parents, geometry, order);
  const Scratch scratch(fine.size(), whole, geometry.active);
  prolong_whole_cells(coarse, scratch.views, parents, geometry, order);
  for (std::size_t q = 0; q < fine.size(); ++q)
    for_each_cell(cells, [&](IntVec3 cell) { fine[q](cell) = scratch.views[q](cell); });
}

void ScalarTransfer::prolong_whole_cells(const StateViews& coarse, const StateViews& fine,
                                         const IndexBox& parents, const TransferGeometry& geometry,
                                         int order) const {
  const IndexBox cells = refine(parents, geometry.ratio);
  if (by_volume_.empty())
    flow_->prolong(flow_views(coarse), flow_views(fine), cells, geometry, order);
  else
    flow_->prolong(coarse, fine, cells, geometry, order);
  const Children children(geometry);
  for (std::size_t s = 0; s < mass_.size(); ++s) {
    const auto own = std::find(by_volume_.begin(), by_volume_.end(), views_ + s);
    if (own != by_volume_.end()) continue;
    const RealView &q = coarse[views_ + s], &M = coarse[mass_[s]];
    const RealView &fine_q = fine[views_ + s], &fine_M = fine[mass_[s]];
    for_each_cell(parents, [&](IntVec3 parent) {
      double deviation[Children::most] = {};
      if (order > 0 && M(parent) > 0.0) {
        ChildRows mass;
        for (int child = 0; child < children.count(); ++child)
          mass[child][0] = fine_M(child_cell(children, geometry, parent, child));
        spread_out(children, linear_of(q, M, parent, children.axes()), q(parent), mass, deviation);
      }
      for (int child = 0; child < children.count(); ++child)
        fine_q(child_cell(children, geometry, parent, child)) = q(parent) + deviation[child];
    });
  }
}

void ScalarTransfer::restrict_to(const StateViews& fine, const StateViews& coarse,
                                 const IndexBox& coarse_cells,
                                 const TransferGeometry& geometry) const {
  if (coarse_cells.empty()) return;
  flow_->restrict_to(flow_views(fine), flow_views(coarse), coarse_cells, geometry);
  const Children children(geometry);
  for (std::size_t s = 0; s < mass_.size(); ++s) {
    const RealView &fine_q = fine[views_ + s], &fine_M = fine[mass_[s]];
    const RealView &q = coarse[views_ + s], &M = coarse[mass_[s]];
    for_each_cell(coarse_cells, [&](IntVec3 parent) {
      if (!(M(parent) > 0.0)) {
        q(parent) = 0.0;
        return;
      }
      ChildRows values, moments;
      for (int child = 0; child < children.count(); ++child)
        values[child][0] = fine_q(child_cell(children, geometry, parent, child));
      const double reference = mean(children, values);
      for (int child = 0; child < children.count(); ++child) {
        const IntVec3 cell = child_cell(children, geometry, parent, child);
        moments[child][0] = fine_M(cell) * (fine_q(cell) - reference);
      }
      q(parent) = reference + mean(children, moments) / M(parent);
    });
  }
}

void ScalarTransfer::correct(const StateViews& state, const ConservedChange& change,
                             std::span<double> share) const {
  flow_->correct(by_volume_.empty() ? flow_views(state) : state, change, share);
  const std::size_t first = flow_->flux_quantities();
  for (std::size_t s = 0; s < mass_.size(); ++s) {
    const RealView &q = state[views_ + s], &M = state[mass_[s]];
    for (std::size_t n = 0; n < change.cells.size(); ++n) {
      const IntVec3 cell = change.cells[n];
      const double gained = change.amount[first + s][n] - q(cell) * change.amount[mass_[s]][n];
      if (gained != 0.0 || !(M(cell) > 0.0))
        q(cell) = M(cell) > 0.0 ? q(cell) + share[n] * gained / M(cell) : 0.0;
    }
  }
}

}  // namespace sluice::ice::scalars
