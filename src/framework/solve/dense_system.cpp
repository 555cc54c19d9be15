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
#include "framework/solve/slab_boxes.hpp"

namespace sluice::solve {
namespace {

// Rows that sum to less than this share of the diagonals sum to nothing but round-off.
constexpr double singular_share = 1e-13;
// From this ratio of mean couplings on the order of directions pays for copies across rows.
constexpr double reorder_ratio = 4;

IndexBox window_of(const Level& level) {
  IndexBox window = level.boxes.empty() ? IndexBox{} : level.boxes.front().cells;
  for (const GridBox& b : level.boxes) window = bounding(window, b.cells);
  if (window.empty()) throw PhysicsError("linear system: the level has no cells");
  return window;
}

ConstBoxViews constant(const BoxViews& views) {
  return {views.begin(), views.end()};
}

// Of boxes of this rank, over all ranks; or of all boxes, which every rank has.
std::array<double, 3> total_couplings(const std::array<ConstBoxViews, 3>& low, bool own) {
  std::array<double, 3> total{};
  std::vector<double> sizes;
  for (int d = 0; d < 3; ++d) {
    ExactSum sum;
    for (const ConstRealView& v : low[d]) {
      sizes.clear();
      for_each_cell(v.box, [&](IntVec3 c) { sizes.push_back(std::fabs(v(c))); });
      sum.add(sizes.data(), sizes.size());
    }
    total[d] = own ? total_of_ranks(sum) : sum.value();
  }
  return total;
}

std::array<ConstBoxViews, 3> couplings_of(const CellMatrix& matrix) {
  return {constant(matrix.low(0)), constant(matrix.low(1)), constant(matrix.low(2))};
}

}  // namespace

DenseSystem::DenseSystem(const CellMatrix& matrix)
    : level_(&matrix.level()), window_(window_of(*level_)) {
  const std::array<ConstBoxViews, 3> low = couplings_of(matrix);
  choose_directions(total_couplings(low, true));
  take_shape();
  slabs_ = Slabs::slabs_of_ranks(shape_);
  clear_rows();
  load(constant(matrix.diagonal()), diagonal_);
  for (int d = 0; d < 3; ++d) load(low[axis_[d]], low_[d]);
  finish();
}

DenseSystem::DenseSystem(const Level& level, const ConstBoxViews& diagonal,
                         const std::array<ConstBoxViews, 3>& low, const DenseSystem* like)
    : level_(&level), window_(window_of(level)) {
  if (like == nullptr)
    choose_directions(total_couplings(low, false));
  else
    axis_ = like->axis_;
  take_shape();
  slabs_ = Slabs(shape_);
  clear_rows();
  for (const ConstRealView& part : diagonal) put(part, diagonal_);
  for (int d = 0; d < 3; ++d)
    for (const ConstRealView& part : low[axis_[d]]) put(part, low_[d]);
  finish();
}

template <class F>
void DenseSystem::for_part(const IndexBox& part, F&& row) const {
  int across = 0;  // the window's direction that is x of the level
  while (axis_[across] != 0) ++across;
  for (int z = part.lower.z; z < part.upper.z; ++z)
    for (int y = part.lower.y; y < part.upper.y; ++y)
      row(IntVec3{part.lower.x, y, z}, place_of({part.lower.x, y, z}), shape_.stride(across));
}

void DenseSystem::finish() {
  present_.assign(shape_.size(), 0);
  for (const GridBox& box : level_->boxes)
    for_part(box.cells, [&](IntVec3, std::ptrdiff_t place, std::ptrdiff_t stride) {
      for (int i = 0; i < box.cells.size().x; ++i) present_[place + stride * i] = 1;
    });
  wrap(shape_, present_.data());
  for_cells([&](std::size_t c) {
    if (present_[c] == 0) diagonal_[c] = 1.0;
  });
  need_none(fault_of_rows());
  fold_own_neighbours();
  need_none(fault_of_neighbours());
  for (DenseVector& v : low_) exchange(v);
  unknowns_ = level_->cell_count();
  DenseVector sums = equations().sum;
  const double of_rows = sum(sums);
  for_cells([&](std::size_t c) { sums[c] = present_[c] != 0 ? diagonal_[c] : 0.0; });
  singular_ = std::fabs(of_rows) <= singular_share * sum(sums);
}

// The strongest direction becomes 1; of the others, the one of unit stride stays so.
void DenseSystem::choose_directions(const std::array<double, 3>& couplings) {
  const IntVec3 size = window_.size();
  std::stable_sort(axis_.begin(), axis_.end(),
                   [&](int a, int b) { return (size[a] > 1) > (size[b] > 1); });
  const int active = (size.x > 1) + (size.y > 1) + (size.z > 1);
  const auto strongest = std::max_element(
      axis_.begin(), axis_.end(), [&](int a, int b) { return couplings[a] < couplings[b]; });
  const double most = couplings[*strongest];
  double next = 0;
  for (const int a : axis_)
    if (a != *strongest) next = std::max(next, couplings[a]);
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
    shape_.periodic[d] = level_->periodic[a] && size[a] > 1 && size[a] == level_->domain.size()[a];
  }
}

void DenseSystem::clear_rows() {
  diagonal_ = vector();
  for (DenseVector& v : low_) v = vector();
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

std::string DenseSystem::fault_of_row(std::ptrdiff_t c) const {
  const std::size_t n = c;
  for (int d = 0; d < 3; ++d) {
    if (std::isfinite(low_[d][n])) continue;
    return fmt::format(
        "linear system: the coupling of {} with the cell below it in {} is {}; a finite number is "
        "needed",
        cell_name(c), "xyz"[axis_[d]], low_[d][n]);
  }
  if (diagonal_[n] > 0 && std::isfinite(diagonal_[n])) return {};
  return fmt::format("linear system: the {} of {} is {}; a finite number above 0 is needed",
                     diagonal_[n] == 0 ? "diagonal (an empty row)" : "diagonal", cell_name(c),
                     shortest_text(diagonal_[n]));
}

std::string DenseSystem::fault_of_rows() const {
  std::string fault;
  for_cells([&](std::size_t c) {
    if (fault.empty() && present_[c] != 0) fault = fault_of_row(static_cast<std::ptrdiff_t>(c));
  });
  return fault;
}

void DenseSystem::need_none(const std::string& own) const {
  if (const std::string fault = slabs_.first(own); !fault.empty()) throw PhysicsError(fault);
}

// A periodic direction of one cell: both neighbours are the cell itself.
void DenseSystem::fold_own_neighbours() {
  for (int d = 0; d < 3; ++d) {
    if (shape_.count[d] > 1 || !level_->periodic[axis_[d]]) continue;
    if (level_->domain.size()[axis_[d]] != 1) continue;
    for (std::size_t c = 0; c < diagonal_.size(); ++c)
      diagonal_[c] += 2 * std::exchange(low_[d][c], 0.0);
  }
}

std::string DenseSystem::fault_of_neighbours() const {
  std::string fault;
  for_cells([&](std::size_t c) {
    for (int d = 0; d < 3 && fault.empty(); ++d) {
      const std::size_t below = c - shape_.stride(d);
      const bool there = below != c && present_[below] != 0;
      if (there || low_[d][c] == 0) continue;
      fault = fmt::format(
          "linear system: {} is coupled with a cell below it in {} that is not one of the level's; "
          "0 is needed there",
          cell_name(static_cast<std::ptrdiff_t>(c)), "xyz"[axis_[d]]);
    }
  });
  return fault;
}

DenseEquations DenseSystem::equations() const {
  DenseEquations e(shape_, slabs_);
  for (int d = 0; d < 3; ++d)
    for_places(shape_, slabs_, [&](std::size_t c) { e.low[d][c] = 0.0 - low_[d][c]; });
  if (singular_) return e;
  for_cells([&](std::size_t c) {
    if (present_[c] == 0) return;
    double sum = diagonal_[c];
    for (int d = 0; d < 3; ++d) {
      if (shape_.count[d] == 1) continue;
      sum += low_[d][c] + low_[d][c + shape_.stride(d)];
    }
    e.sum[c] = sum;
  });
  return e;
}

void DenseSystem::put(const ConstRealView& part, DenseVector& v) const {
  for_part(part.box, [&](IntVec3 first, std::ptrdiff_t place, std::ptrdiff_t stride) {
    const double* from = &part(first);
    double* to = v.data() + place;
    for (int i = 0; i < part.box.size().x; ++i) to[stride * i] = from[part.stride[0] * i];
  });
}

IndexBox DenseSystem::slab_of(int rank) const {
  IndexBox slab = window_;
  slab.lower[axis_[2]] = window_.lower[axis_[2]] + slabs_.begin_of(rank);
  slab.upper[axis_[2]] = window_.lower[axis_[2]] + slabs_.begin_of(rank + 1);
  return slab;
}

void DenseSystem::exchange(DenseVector& v) const {
  for (int k = slabs_.begin(); k < slabs_.end(); ++k) wrap_slice(shape_, v.data(), k);
  slabs_.exchange(shape_, v.data());
}

bool DenseSystem::is_like(const DenseSystem& other) const {
  if (level_ != other.level_ || !(window_ == other.window_) || axis_ != other.axis_ ||
      singular_ != other.singular_ || unknowns_ != other.unknowns_)
    return false;
  double differs = 0;
  for (int d = 0; d < 3; ++d)
    for_cells([&](std::size_t c) {
      if ((low_[d][c] == 0) != (other.low_[d][c] == 0)) differs = 1;
    });
  return slabs_.largest(differs) == 0;
}

DenseVector DenseSystem::ones() const {
  DenseVector v = vector();
  for_places(shape_, slabs_, [&](std::size_t c) { v[c] = present_[c]; });
  return v;
}

void DenseSystem::copy(const DenseVector& from, DenseVector& to) const {
  for_places(shape_, slabs_, [&](std::size_t c) { to[c] = from[c]; });
}

void DenseSystem::clear(DenseVector& v) const {
  for_places(shape_, slabs_, [&](std::size_t c) { v[c] = 0; });
}

void DenseSystem::load(const ConstBoxViews& boxes, DenseVector& v) const {
  const auto take = [&](const ConstRealView& part) { put(part, v); };
  if (slabs_.shared())
    return SlabBoxes(*level_, [this](int rank) { return slab_of(rank); }).load(boxes, take);
  const AllBoxes all(*level_, boxes);
  for (const ConstRealView& part : all.views()) put(part, v);
}

void DenseSystem::store(const DenseVector& v, const BoxViews& boxes) const {
  const auto give = [&](const RealView& part) {
    for_part(part.box, [&](IntVec3 first, std::ptrdiff_t place, std::ptrdiff_t stride) {
      const double* from = v.data() + place;
      double* to = &part(first);
      for (int i = 0; i < part.box.size().x; ++i) to[part.stride[0] * i] = from[stride * i];
    });
  };
  if (slabs_.shared())
    return SlabBoxes(*level_, [this](int rank) { return slab_of(rank); }).store(give, boxes);
  const std::vector<IndexBox> own = boxes_of(*level_, world().rank());
  for (std::size_t n = 0; n < own.size(); ++n) {
    RealView cells = boxes[n];
    cells.data = &boxes[n](own[n].lower);
    cells.box = own[n];
    give(cells);
  }
}

}  // namespace sluice::solve
