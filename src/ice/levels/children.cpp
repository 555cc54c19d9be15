// The order of sums.
#include "ice/levels/children.hpp"

#include <stdexcept>

namespace sluice::ice {

Children::Children(const TransferGeometry& geometry) {
  axes_.count = 0;
  for (int d = 0; d < 3; ++d) {
    if (!geometry.active[d]) continue;
    const int r = geometry.ratio[d];
    if (r != 1 && r != 2 && r != 4) throw std::logic_error("a refinement ratio is 1, 2 or 4");
    ratio_[axes_.count] = r;
    axes_.direction[axes_.count++] = d;
  }
  add_block({0, 0, 0}, {ratio_[0], ratio_[1], ratio_[2]});
}

void Children::add(int to, int from) {
  sum_[sums_++] = {static_cast<std::uint8_t>(to), static_cast<std::uint8_t>(from)};
}

// The sum of a block ends in its lowest child.
void Children::add_block(std::array<int, 3> low, std::array<int, 3> size) {
  std::array<std::size_t, 3> halved{};
  std::size_t axes = 0;
  for (std::size_t a = 0; a < 3; ++a)
    if (size[a] > 1) halved[axes++] = a;
  if (axes == 0) return;
  std::array<int, 3> half = size;
  for (std::size_t h = 0; h < axes; ++h) half[halved[h]] /= 2;
  int part[8] = {};  // bit h: the upper half along halved[h]
  for (unsigned p = 0; p < (1U << axes); ++p) {
    std::array<int, 3> corner = low;
    for (std::size_t h = 0; h < axes; ++h)
      if ((p >> h & 1U) != 0) corner[halved[h]] += half[halved[h]];
    add_block(corner, half);
    part[p] = number(corner[0], corner[1], corner[2]);
  }
  // Opposite parts first.
  const unsigned last = (1U << axes) - 1U;
  if (axes == 3) {
    for (const unsigned p : {0U, 1U, 2U, 4U}) add(part[p], part[last - p]);
    add(part[0], part[1]);
    add(part[2], part[4]);
    add(part[0], part[2]);
    return;
  }
  for (unsigned p = 0; p <= last / 2; ++p) add(part[p], part[last - p]);
  if (axes == 2) add(part[0], part[1]);
}

int longest_direction(const IndexBox& cells, const Axes& axes) {
  int longest = axes.direction[0];
  for (int a = 1; a < axes.count; ++a)
    if (cells.size()[axes.direction[a]] > cells.size()[longest]) longest = axes.direction[a];
  return longest;
}

}  // namespace sluice::ice
