// Fine cells from coarse ones, material by material where one is alone.
#include <algorithm>

#include "framework/grid/box_list.hpp"
#include "ice/fluid/mixed_gas.hpp"
#include "ice/levels/children.hpp"
#include "ice/levels/mixture_transfer.hpp"

namespace sluice::ice {

MixtureTransfer::MixtureTransfer(std::vector<Fluid> fluids, int components, bool matches_fluxes,
                                 bool multi_velocity, MixedGasView gas)
    : layout_{fluids.size(), static_cast<std::size_t>(components), multi_velocity},
      fluids_(std::move(fluids)),
      mixed_(gas),
      matches_fluxes_(matches_fluxes) {
  const std::size_t behind_energy = layout_.components + 2;
  for (std::size_t m = 0; m < fluids_.size(); ++m)
    alone_.emplace_back(
        components, false, matches_fluxes, fluids_[m],
        is_mixed(mixed_.gas, m) ? std::vector{behind_energy} : std::vector<std::size_t>{});
}

namespace {

constexpr int mixed = -1;

// Which material each cell of a box holds alone; `mixed` where there are several.
class SoleMaterials {
 public:
  SoleMaterials(const IndexBox& box, const Axes& axes, std::vector<int>& room)
      : box_(box), axes_(axes), of_(room) {
    stride_[0] = 1;
    stride_[1] = box.size().x;
    stride_[2] = static_cast<std::ptrdiff_t>(box.size().x) * box.size().y;
    of_.assign(box.volume(), mixed);
  }

  void find(const StateViews& state, std::size_t materials) {
    for (std::size_t m = 0; m < materials; ++m) {
      const RealView& mass = state[m];
      const int along = longest_direction(box_, axes_);
      for_each_line(box_, along, box_.size()[along], [&](IntVec3 first, int n) {
        const double* M = mass.data + mass.offset(first);
        int* sole = &of_[place(first)];
        for (int i = 0; i < n; ++i, M += mass.stride[along], sole += stride_[along]) {
          if (*M == 0.0) continue;
          *sole = *sole == mixed ? static_cast<int>(m) : several;
        }
      });
    }
    for (int& sole : of_)
      if (sole == several) sole = mixed;
  }
  bool all_alike() const {
    return std::all_of(of_.begin(), of_.end(), [&](int sole) { return sole == of_.front(); });
  }
  // A cell keeps its material only if all its neighbours have it too. The outermost layer of the
  // box is of no use afterwards.
  void spread_mixed() {
    for (int a = 0; a < axes_.count; ++a) {
      const int d = axes_.direction[a];
      const std::ptrdiff_t step = stride_[d];
      IndexBox starts = box_;
      starts.upper[d] = starts.lower[d] + 1;
      for_each_cell(starts, [&](IntVec3 start) {
        int* sole = &of_[place(start)];
        int before = mixed;
        const int n = box_.size()[d];
        for (int i = 0; i < n; ++i, sole += step) {
          const int here = *sole, after = i + 1 < n ? sole[step] : mixed;
          if (here != before || here != after) *sole = mixed;
          before = here;
        }
      });
    }
  }
  int operator()(IntVec3 cell) const { return of_[place(cell)]; }

 private:
  static constexpr int several = -2;
  std::size_t place(IntVec3 c) const {
    return (c.x - box_.lower.x) * stride_[0] + (c.y - box_.lower.y) * stride_[1] +
           (c.z - box_.lower.z) * stride_[2];
  }

  IndexBox box_;
  const Axes& axes_;
  std::ptrdiff_t stride_[3];
  std::vector<int>& of_;
};

void write(const RealView& view, const IndexBox& cells, int along, double value) {
  for_each_line(cells, along, cells.size()[along], [&](IntVec3 first, int n) {
    double* to = view.data + view.offset(first);
    for (int i = 0; i < n; ++i) to[i * view.stride[along]] = value;
  });
}

// The views of one material and of the momentum; behind them its fraction, if it is a mixture.
StateViews views_of(const StateViews& state, const MixtureLayout& layout, std::size_t material,
                    const MixedGasView& gas) {
  StateViews views = {state[layout.mass(material)]};
  for (std::size_t c = 0; c < layout.components; ++c) views.push_back(state[layout.momentum(c)]);
  views.push_back(state[layout.energy(material)]);
  if (is_mixed(gas.gas, material)) views.push_back(state[gas.fraction]);
  return views;
}

}  // namespace

void MixtureTransfer::prolong(const StateViews& coarse, const StateViews& fine,
                              const IndexBox& cells, const TransferGeometry& geometry,
                              int order) const {
  if (cells.empty()) return;
  if (order == 0) return alone_.front().prolong(coarse, fine, cells, geometry, 0);
  const Children children(geometry);
  const Axes& axes = children.axes();
  const IndexBox parents = coarsen(cells, geometry.ratio);
  IntVec3 layer{};
  for (int a = 0; a < axes.count; ++a) layer[axes.direction[a]] = 1;
  thread_local std::vector<int> room;
  SoleMaterials sole(parents.grown(layer), axes, room);
  sole.find(coarse, layout_.materials);

  const int along = longest_direction(parents, axes);
  const auto prolong_part = [&](const IndexBox& part, int material) {
    if (material == mixed) return alone_.front().prolong(coarse, fine, part, geometry, 0);
    const std::size_t present = material;
    alone_[present].prolong(views_of(coarse, layout_, present, mixed_),
                            views_of(fine, layout_, present, mixed_), part, geometry, order);
    if (mixed_.gas != nullptr && !is_mixed(mixed_.gas, present))
      write(fine[mixed_.fraction], part, along, 0.0);
    for (std::size_t m = 0; m < layout_.materials; ++m) {
      write(fine[layout_.volume(m)], part, along, m == present ? 1.0 : 0.0);
      for (std::size_t c = 0; c < layout_.components && layout_.multi_velocity; ++c)
        write(fine[layout_.slip(m, c)], part, along, 0.0);
      if (m == present) continue;
      write(fine[layout_.mass(m)], part, along, 0.0);
      write(fine[layout_.energy(m)], part, along, 0.0);
    }
  };
  if (sole.all_alike()) return prolong_part(cells, sole(parents.lower));
  sole.spread_mixed();
  for_each_line(parents, along, parents.size()[along], [&](IntVec3 first, int n) {
    IndexBox run{first, first + IntVec3::all(1)};
    for (int end = 1; end <= n; ++end) {
      IntVec3 next = first;
      next[along] += end;
      if (end < n && sole(next) == sole(run.lower)) continue;
      run.upper[along] = next[along];
      prolong_part(intersection(refine(run, geometry.ratio), cells), sole(run.lower));
      run.lower[along] = next[along];
    }
  });
}

}  // namespace sluice::ice
