#include "mpmice/geometry/block_directory.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

namespace sluice::mpmice {

template <int D>
void BlockDirectory<D>::begin(const CellBox<D>& cells) {
  for (std::size_t d = 0; d < D; ++d) {
    pages_.lower[d] = cells.lower[d] >> (2 * shift);
    pages_.upper[d] = cells.empty() ? pages_.lower[d] : ((cells.upper[d] - 1) >> (2 * shift)) + 1;
  }
  first_.assign(pages_.cells(), -1);
  entries_.clear();
}

template <int D>
std::int32_t& BlockDirectory<D>::entry(const Cell<D>& block) {
  Cell<D> page;
  bool there = true;
  for (std::size_t d = 0; d < D; ++d) {
    page[d] = block[d] >> shift;
    there &= page[d] >= pages_.lower[d] && page[d] < pages_.upper[d];
  }
  if (!there)
    throw std::out_of_range(
        fmt::format("there is no room for block [{}] of cells", fmt::join(block, " ")));
  std::int32_t& first = first_[pages_.index(page)];
  if (first < 0) {
    first = static_cast<std::int32_t>(entries_.size());
    entries_.resize(entries_.size() + 64, 0);
  }
  return entries_[static_cast<std::size_t>(first) + place_of(block)];
}

template class BlockDirectory<1>;
template class BlockDirectory<2>;
template class BlockDirectory<3>;

}  // namespace sluice::mpmice
