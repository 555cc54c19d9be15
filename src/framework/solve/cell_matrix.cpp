// Memory of the coefficients.
#include "framework/solve/cell_matrix.hpp"

#include "framework/base/communicator.hpp"

namespace sluice::solve {
namespace {

template <class T>
ArrayView<T> packed(T* numbers, const IndexBox& box) {
  const IntVec3 n = box.size();
  return {numbers, box, {1, n.x, static_cast<std::ptrdiff_t>(n.x) * n.y}};
}

}  // namespace

std::vector<IndexBox> boxes_of(const Level& level, int rank) {
  std::vector<IndexBox> found;
  for (const GridBox& b : level.boxes)
    if (b.owner == rank) found.push_back(b.cells);
  return found;
}

ConstRealView view_of(const double* numbers, const IndexBox& box) {
  return packed(numbers, box);
}

RealView view_of(double* numbers, const IndexBox& box) {
  return packed(numbers, box);
}

BoxArrays::BoxArrays(const std::vector<IndexBox>& boxes) {
  for (const IndexBox& box : boxes) {
    memory_.emplace_back(box.volume(), 0.0);
    views_.push_back(packed(memory_.back().data(), box));
  }
}

CellMatrix::CellMatrix(const Level& level)
    : level_(&level),
      diagonal_(boxes_of(level, world().rank())),
      low_{BoxArrays(boxes_of(level, world().rank())), BoxArrays(boxes_of(level, world().rank())),
           BoxArrays(boxes_of(level, world().rank()))} {}

}  // namespace sluice::solve
