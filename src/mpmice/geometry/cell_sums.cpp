#include "mpmice/geometry/cell_sums.hpp"

#include <stdexcept>

#include "framework/base/communicator.hpp"

namespace sluice::mpmice {

template <int D>
void CellSums<D>::begin(const CellBlocks<D>& cells, int lanes) {
  cells_ = &cells;
  count_ = cells.size();
  lanes_ = lanes;
  sums_.assign(count_ * static_cast<std::size_t>(lanes), 0);
}

template <int D>
void CellSums<D>::merge(const CellSums& other) {
  if (other.cells_ != cells_ || other.sums_.size() != sums_.size())
    throw std::logic_error("sums over different cells are merged");
  for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += other.sums_[i];
}

template <int D>
void CellSums<D>::sum_over_ranks(Communicator& ranks) {
  if (ranks.size() > 1) ranks.sum(sums_.data(), sums_.size());
}

template <int D>
void CellSums<D>::fold(const PeriodicSides<D>& sides, int lane_of) {
  std::uint64_t* sums = lane(lane_of);
  for (std::size_t d = 0; d < D; ++d) {
    if (!sides.periodic[d]) continue;
    const int low = sides.domain.lower[d], high = sides.domain.upper[d], n = high - low;
    for (std::size_t b = 1; b <= cells_->block_count(); ++b) {
      const CellBox<D> block = cells_->cells(b);
      if (block.lower[d] >= low && block.upper[d] <= high) continue;
      for_each_cell_of<D>(block, [&](Cell<D> c) {
        if (c[d] >= low && c[d] < high) return;
        std::uint64_t& beyond = sums[cells_->index(c)];
        if (beyond == 0) return;
        c[d] = low + ((c[d] - low) % n + n) % n;
        sums[cells_->index_to_add(c)] += beyond;
        beyond = 0;
      });
    }
  }
}

template <int D>
void CellSums<D>::values(int lane_of, KeptArray<double>& to) const {
  to.resize(count_);
  const std::uint64_t* sums = lane(lane_of);
  for (std::size_t i = 0; i < count_; ++i) to[i] = from_sum(sums[i]);
}

template class CellSums<1>;
template class CellSums<2>;
template class CellSums<3>;

}  // namespace sluice::mpmice
