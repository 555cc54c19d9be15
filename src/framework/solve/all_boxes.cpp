#include "framework/solve/all_boxes.hpp"

#include <cstring>

#include "framework/base/communicator.hpp"

namespace sluice::solve {
namespace {

void append(std::string& bytes, const ConstRealView& v) {
  for_each_cell(v.box, [&](IntVec3 c) {
    char raw[sizeof(double)];
    std::memcpy(raw, &v(c), sizeof raw);
    bytes.append(raw, sizeof raw);
  });
}

// A view of a box's own cells, without ghosts.
ConstRealView cells_of(const ConstRealView& v, const IndexBox& cells) {
  ConstRealView inner = v;
  inner.data = v.data + v.offset(cells.lower);
  inner.box = cells;
  return inner;
}

}  // namespace

AllBoxes::AllBoxes(const Level& level, const ConstBoxViews& own) {
  if (world().size() == 1) {
    std::size_t next = 0;
    for (const GridBox& b : level.boxes) views_.push_back(cells_of(own.at(next++), b.cells));
    return;
  }
  std::string bytes;
  const std::vector<IndexBox> mine = boxes_of(level, world().rank());
  for (std::size_t n = 0; n < own.size(); ++n) append(bytes, cells_of(own[n], mine.at(n)));
  received_ = world().gather_to_all(bytes);
  std::vector<std::size_t> read(received_.size(), 0);
  for (const GridBox& b : level.boxes) {
    const std::size_t owner = b.owner;
    std::vector<double>& numbers = numbers_.emplace_back(b.cells.volume());
    const std::size_t size = numbers.size() * sizeof(double);
    std::memcpy(numbers.data(), received_.at(owner).data() + read[owner], size);
    read[owner] += size;
  }
  for (std::size_t n = 0; n < numbers_.size(); ++n)
    views_.push_back(view_of(numbers_[n].data(), level.boxes[n].cells));
}

}  // namespace sluice::solve
