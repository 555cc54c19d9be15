#include "mpmice/geometry/cell_sums.hpp"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

#include "framework/base/communicator.hpp"
#include "framework/base/reduction.hpp"

namespace sluice::mpmice {

template <int D>
CellBox<D> box_of_all(const CellBox<D>& mine, Communicator& ranks) {
  Reduction ends;
  std::array<Reduction::Minimum, D> low;
  std::array<Reduction::Maximum, D> high;
  const bool none = mine.empty();
  for (std::size_t d = 0; d < D; ++d) {
    low[d] = ends.add_minimum(none ? std::numeric_limits<int>::max() : mine.lower[d]);
    high[d] = ends.add_maximum(none ? std::numeric_limits<int>::min() : mine.upper[d]);
  }
  ranks.reduce(ends);
  CellBox<D> box;
  if (ends.minimum(low[0]) > ends.maximum(high[0])) return box;  // all are empty
  for (std::size_t d = 0; d < D; ++d) {
    box.lower[d] = static_cast<int>(ends.minimum(low[d]));
    box.upper[d] = static_cast<int>(ends.maximum(high[d]));
  }
  return box;
}

template <int D>
void CellSums<D>::begin(const CellBox<D>& box, int lanes) {
  box_ = box;
  reached_ = {};
  cells_ = box.cells();
  sums_.assign(cells_ * static_cast<std::size_t>(lanes), 0);
}

template <int D>
void CellSums<D>::reach(const CellBox<D>& cells) {
  if (!box_.contains(cells))
    throw std::out_of_range(
        fmt::format("faces of solids reach cells [{}) to [{}), beyond the box [{}) to [{})",
                    fmt::join(cells.lower, " "), fmt::join(cells.upper, " "),
                    fmt::join(box_.lower, " "), fmt::join(box_.upper, " ")));
  reached_.include(cells);
}

template <int D>
void CellSums<D>::merge(const CellSums& other) {
  if (!(other.box_ == box_) || other.sums_.size() != sums_.size())
    throw std::logic_error("sums over different boxes are merged");
  reached_.include(other.reached_);
  for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += other.sums_[i];
}

template <int D>
void CellSums<D>::sum_over_ranks(Communicator& ranks) {
  if (ranks.size() == 1) return;
  ranks.sum(sums_.data(), sums_.size());
  reached_ = box_of_all<D>(reached_, ranks);
}

template <int D>
void CellSums<D>::fold(const PeriodicSides<D>& sides, int lane_of) {
  reach(box_);
  std::uint64_t* sums = lane(lane_of);
  for (std::size_t d = 0; d < D; ++d) {
    if (!sides.periodic[d]) continue;
    const int low = sides.domain.lower[d], high = sides.domain.upper[d], n = high - low;
    for (int layer = box_.lower[d]; layer < box_.upper[d]; ++layer) {
      if (layer >= low && layer < high) continue;
      CellBox<D> beyond = box_;
      beyond.lower[d] = layer;
      beyond.upper[d] = layer + 1;
      const int image = low + ((layer - low) % n + n) % n;
      const std::ptrdiff_t shift = (image - layer) * box_.stride(static_cast<int>(d));
      for_each_row_down<D>(box_, beyond, 0, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
          sums[static_cast<std::ptrdiff_t>(i) + shift] += sums[i];
          sums[i] = 0;
        }
      });
    }
  }
}

template <int D>
void CellSums<D>::add_from_above(int lane_of, int d) {
  std::uint64_t* sums = lane(lane_of);
  CellBox<D> part = reached_;
  --part.upper[static_cast<std::size_t>(d)];  // the highest has nothing above it
  const std::ptrdiff_t above = box_.stride(d);
  for_each_row_down<D>(box_, part, d, [&](std::size_t first, std::size_t n) {
    std::uint64_t* row = sums + first;
    if (d == 0)
      for (std::size_t i = n; i-- > 0;) row[i] += row[i + 1];
    else
      for (std::size_t i = 0; i < n; ++i) row[i] += row[static_cast<std::ptrdiff_t>(i) + above];
  });
}

template <int D>
void CellSums<D>::values(int lane_of, std::vector<double>& to) const {
  to.assign(cells_, 0.0);
  const std::uint64_t* sums = lane(lane_of);
  for_each_row_down<D>(box_, reached_, 0, [&](std::size_t first, std::size_t n) {
    for (std::size_t i = first; i < first + n; ++i) to[i] = from_sum(sums[i]);
  });
}

template CellBox<1> box_of_all<1>(const CellBox<1>&, Communicator&);
template CellBox<2> box_of_all<2>(const CellBox<2>&, Communicator&);
template CellBox<3> box_of_all<3>(const CellBox<3>&, Communicator&);
template class CellSums<1>;
template class CellSums<2>;
template class CellSums<3>;

}  // namespace sluice::mpmice
