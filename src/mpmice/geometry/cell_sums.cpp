#include "mpmice/geometry/cell_sums.hpp"

#include <bit>
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

namespace {

constexpr std::size_t block_cells = 64;

// Of a lane of a block the bits of the cells that are not 0, then their numbers.
void pack(const std::uint64_t* numbers, std::vector<double>& to) {
  std::uint64_t cells = 0;
  for (std::size_t i = 0; i < block_cells; ++i)
    cells |= std::uint64_t{numbers[i] != 0 ? 1u : 0u} << i;
  to.push_back(std::bit_cast<double>(cells));
  for (; cells != 0; cells &= cells - 1)
    to.push_back(std::bit_cast<double>(numbers[std::countr_zero(cells)]));
}

const double* add_packed(const double* from, std::uint64_t* numbers) {
  auto cells = std::bit_cast<std::uint64_t>(*from++);
  for (; cells != 0; cells &= cells - 1)
    numbers[std::countr_zero(cells)] += std::bit_cast<std::uint64_t>(*from++);
  return from;
}

}  // namespace

template <int D>
void CellSums<D>::sum_over_ranks(Communicator& ranks) {
  share_sums<D>({this}, ranks);
}

template <int D>
void share_sums(std::initializer_list<CellSums<D>*> all, Communicator& ranks) {
  if (ranks.size() == 1) return;
  static_assert(block_cells == CellBlocks<D>::block_cells);
  const CellBlocks<D>& cells = (*all.begin())->cells();
  if (cells.sharers() == nullptr)
    throw std::logic_error("sums over cells that no rank shares are asked for on several");
  const auto& shared = cells.shared();
  typename BlockSharers<D>::Buffers out(shared.size()), in;
  for (std::size_t n = 0; n < shared.size(); ++n)
    for (const std::uint32_t block : shared[n])
      for (CellSums<D>* sums : all)
        for (int l = 0; l < sums->lanes(); ++l) pack(sums->lane(l) + block * block_cells, out[n]);
  cells.sharers()->swap(out, in);
  for (std::size_t n = 0; n < shared.size(); ++n) {
    const double* from = in[n].data();
    for (const std::uint32_t block : shared[n])
      for (CellSums<D>* sums : all)
        for (int l = 0; l < sums->lanes(); ++l)
          from = add_packed(from, sums->lane(l) + block * block_cells);
  }
}

template <int D>
void CellSums<D>::fold(const PeriodicSides<D>& sides, int lane_of) {
  if (!sides.any()) return;
  std::uint64_t* sums = lane(lane_of);
  for (std::size_t b = 1; b <= cells_->block_count(); ++b) {
    const CellBox<D> block = cells_->cells(b);
    if (!sides.any_beyond(block)) continue;
    for_each_cell_of<D>(block, [&](const Cell<D>& c) {
      std::uint64_t& beyond = sums[cells_->index(c)];
      const Cell<D> image = sides.image(c);
      if (beyond == 0 || image == c) return;
      sums[cells_->index_to_add(image)] += beyond;
      beyond = 0;
    });
  }
}

template <int D>
void CellSums<D>::values(int lane_of, KeptArray<double>& to) const {
  to.resize(count_);
  const std::uint64_t* sums = lane(lane_of);
  for (std::size_t i = 0; i < count_; ++i) to[i] = from_sum(sums[i]);
}

template void share_sums<1>(std::initializer_list<CellSums<1>*>, Communicator&);
template void share_sums<2>(std::initializer_list<CellSums<2>*>, Communicator&);
template void share_sums<3>(std::initializer_list<CellSums<3>*>, Communicator&);
template class CellSums<1>;
template class CellSums<2>;
template class CellSums<3>;

}  // namespace sluice::mpmice
