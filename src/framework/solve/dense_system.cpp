// From boxes into one window and back, and the checks of what arrives there.
#include "framework/solve/dense_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "framework/base/communicator.hpp"
#include "framework/base/error.hpp"
#include "framework/base/exact_sum.hpp"
#include "framework/base/text.hpp"
#include "framework/solve/all_boxes.hpp"

namespace sluice::solve {
namespace {

// Rows that sum to less than this share of the diagonals sum to nothing but round-off.
constexpr double singular_share = 1e-13;
// From this ratio of mean couplings on the order of directions pays for copies across rows.
constexpr double reorder_ratio = 4;

IndexBox window_of(const Level& level) {
  IndexBox window = level.boxes.empty() ? IndexBox{} : level.boxes.front().cells;
  for (const GridBox& b : level.boxes) window = bounding(window, b.cells);
  return window;
}

ConstBoxViews constant(const BoxViews& views) {
  return {views.begin(), views.end()};
}

std::array<double, 3> total_couplings(const std::array<ConstBoxViews, 3>& low) {
  std::array<double, 3> total{};
  for (int d = 0; d < 3; ++d) {
    ExactSum sum;
    for (const ConstRealView& v : low[d])
      for_each_cell(v.box, [&](IntVec3 c) { sum.add(std::fabs(v(c))); });
    total[d] = sum.value();
  }
  return total;
}

}  // namespace

DenseSystem::DenseSystem(const CellMatrix& matrix)
    : DenseSystem(matrix.level(), AllBoxes(matrix.level(), constant(matrix.diagonal())).views(),
                  {AllBoxes(matrix.level(), constant(matrix.low(0))).views(),
                   AllBoxes(matrix.level(), constant(matrix.low(1))).views(),
                   AllBoxes(matrix.level(), constant(matrix.low(2))).views()}) {}

DenseSystem::DenseSystem(const Level& level, const ConstBoxViews& diagonal,
                         const std::array<ConstBoxViews, 3>& low, const DenseSystem* like)
    : level_(&level), window_(window_of(level)) {
  if (window_.empty()) throw PhysicsError("linear system: the level has no cells");
  if (like == nullptr)
    choose_directions(total_couplings(low));
  else
    axis_ = like->axis_;
  take_shape();
  present_.assign(shape_.size(), 0);
  diagonal_.assign(shape_.size(), 1.0);
  for (auto& v : low_) v.assign(shape_.size(), 0.0);
  const auto copy = [this](const ConstRealView& from, DenseVector& to) {
    for_each_cell(from.box,
                  [&](IntVec3 c) { to[static_cast<std::size_t>(place_of(c))] = from(c); });
  };
  for (std::size_t n = 0; n < level_->boxes.size(); ++n) {
    copy(diagonal[n], diagonal_);
    for (int d = 0; d < 3; ++d) copy(low[static_cast<std::size_t>(axis_[d])][n], low_[d]);
    for_each_cell(level_->boxes[n].cells,
                  [&](IntVec3 c) { present_[static_cast<std::size_t>(place_of(c))] = 1; });
  }
  wrap(shape_, present_.data());
  need_rows();
  fold_own_neighbours();
  need_neighbours();
  for (auto& v : low_) wrap(shape_, v.data());
  unknowns_ = level_->cell_count();
  DenseVector sums = equations().sum;
  const double of_rows = sum(sums);
  for (std::size_t c = 0; c < sums.size(); ++c) sums[c] = present_[c] != 0 ? diagonal_[c] : 0.0;
  singular_ = std::fabs(of_rows) <= singular_share * sum(sums);
}

// The strongest direction becomes 1; of the others, the one of unit stride stays so.
void DenseSystem::choose_directions(const std::array<double, 3>& couplings) {
  const IntVec3 size = window_.size();
  std::stable_sort(axis_.begin(), axis_.end(),
                   [&](int a, int b) { return (size[a] > 1) > (size[b] > 1); });
  const int active = (size.x > 1) + (size.y > 1) + (size.z > 1);
  const auto strongest = std::max_element(axis_.begin(), axis_.end(), [&](int a, int b) {
    return couplings[static_cast<std::size_t>(a)] < couplings[static_cast<std::size_t>(b)];
  });
  const double most = couplings[static_cast<std::size_t>(*strongest)];
  double next = 0;
  for (const int a : axis_)
    if (a != *strongest) next = std::max(next, couplings[static_cast<std::size_t>(a)]);
  if (active == 1) {
    std::swap(axis_[0], axis_[1]);
  } else if (most > reorder_ratio * next && strongest != axis_.begin() + 1) {
    std::swap(*strongest, axis_[1]);
  }
}

void DenseSystem::take_shape() {
  const IntVec3 size = window_.size();
  for (int d = 0; d < 3; ++d) {
    const int a = axis_[d];
    shape_.count[d] = size[a];
    shape_.periodic[d] = level_->periodic[static_cast<std::size_t>(a)] && size[a] > 1 &&
                         size[a] == level_->domain.size()[a];
  }
}

std::ptrdiff_t DenseSystem::place_of(IntVec3 cell) const {
  const IntVec3 c = cell - window_.lower;
  return shape_.at(c[axis_[0]], c[axis_[1]], c[axis_[2]]);
}

IntVec3 DenseSystem::cell_of(std::ptrdiff_t c) const {
  const int k = shape_.deep() ? static_cast<int>(c / shape_.slice()) - 1 : 0;
  const std::ptrdiff_t in_slice = shape_.deep() ? c % shape_.slice() : c;
  IntVec3 cell = window_.lower;
  cell[axis_[0]] += static_cast<int>(in_slice % shape_.row()) - 1;
  cell[axis_[1]] += static_cast<int>(in_slice / shape_.row()) - 1;
  cell[axis_[2]] += k;
  return cell;
}

std::string DenseSystem::cell_name(std::ptrdiff_t c) const {
  const IntVec3 cell = cell_of(c);
  return fmt::format("cell ({}, {}, {})", cell.x, cell.y, cell.z);
}

void DenseSystem::need_rows() const {
  for_rows([&](std::ptrdiff_t row) {
    for (std::ptrdiff_t c = row; c < row + shape_.count[0]; ++c) {
      const auto n = static_cast<std::size_t>(c);
      if (present_[n] == 0) continue;
      for (int d = 0; d < 3; ++d) {
        if (!std::isfinite(low_[d][n])) {
          throw PhysicsError(fmt::format(
              "linear system: the coupling of {} with the cell below it in {} is {}; a finite "
              "number is needed",
              cell_name(c), "xyz"[axis_[d]], low_[d][n]));
        }
      }
      if (!(diagonal_[n] > 0) || !std::isfinite(diagonal_[n])) {
        throw PhysicsError(
            fmt::format("linear system: the {} of {} is {}; a finite number above 0 is needed",
                        diagonal_[n] == 0 ? "diagonal (an empty row)" : "diagonal", cell_name(c),
                        shortest_text(diagonal_[n])));
      }
    }
  });
}

// A periodic direction of one cell: both neighbours are the cell itself.
void DenseSystem::fold_own_neighbours() {
  for (int d = 0; d < 3; ++d) {
    if (shape_.count[d] > 1 || !level_->periodic[static_cast<std::size_t>(axis_[d])]) continue;
    if (level_->domain.size()[axis_[d]] != 1) continue;
    for (std::size_t c = 0; c < diagonal_.size(); ++c)
      diagonal_[c] += 2 * std::exchange(low_[d][c], 0.0);
  }
}

void DenseSystem::need_neighbours() const {
  for_rows([&](std::ptrdiff_t row) {
    for (std::ptrdiff_t c = row; c < row + shape_.count[0]; ++c) {
      for (int d = 0; d < 3; ++d) {
        const std::ptrdiff_t below = c - shape_.stride(d);
        const bool there = below != c && present_[static_cast<std::size_t>(below)] != 0;
        if (there || low_[d][static_cast<std::size_t>(c)] == 0) continue;
        throw PhysicsError(fmt::format(
            "linear system: {} is coupled with a cell below it in {} that is not one of the "
            "level's; 0 is needed there",
            cell_name(c), "xyz"[axis_[d]]));
      }
    }
  });
}

DenseEquations DenseSystem::equations() const {
  DenseEquations e;
  e.shape = shape_;
  e.sum.assign(shape_.size(), 0.0);
  for (int d = 0; d < 3; ++d) {
    e.low[static_cast<std::size_t>(d)].resize(shape_.size());
    for (std::size_t c = 0; c < shape_.size(); ++c)
      e.low[static_cast<std::size_t>(d)][c] = 0.0 - low_[d][c];
  }
  if (singular_) return e;
  const std::ptrdiff_t n = shape_.count[0];
  for_rows([&](std::ptrdiff_t row) {
    for (std::ptrdiff_t c = row; c < row + n; ++c) {
      const auto at = static_cast<std::size_t>(c);
      if (present_[at] == 0) continue;
      double sum = diagonal_[at];
      for (int d = 0; d < 3; ++d) {
        if (shape_.count[d] == 1) continue;
        sum += low_[d][at] + low_[d][static_cast<std::size_t>(c + shape_.stride(d))];
      }
      e.sum[at] = sum;
    }
  });
  return e;
}

void DenseSystem::load(const ConstBoxViews& boxes, DenseVector& v) const {
  const AllBoxes all(*level_, boxes);
  for (const ConstRealView& from : all.views())
    for_each_cell(from.box, [&](IntVec3 c) { v[static_cast<std::size_t>(place_of(c))] = from(c); });
}

void DenseSystem::store(const DenseVector& v, const BoxViews& boxes) const {
  const std::vector<IndexBox> own = boxes_of(*level_, world().rank());
  for (std::size_t n = 0; n < own.size(); ++n)
    for_each_cell(own[n],
                  [&](IntVec3 c) { boxes[n](c) = v[static_cast<std::size_t>(place_of(c))]; });
}

}  // namespace sluice::solve
