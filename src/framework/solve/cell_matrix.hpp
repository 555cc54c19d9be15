// A symmetric system of 7-point equations on the cells of one level, box by box.
//
//   diagonal(c) x(c) + sum over d of  low_d(c) x(c - e_d) + low_d(c + e_d) x(c + e_d)  =  b(c)
//
// A coupling is held once, by the cell above its face. It is 0 where there is no neighbour: at the
// sides of the domain (what they do is in diagonal and right-hand side), beside cells of other
// levels, and in directions that are not active. In a periodic direction low_d of the first cell
// is its coupling with the last one. Units are those of the equation that is solved: x may have
// any, b that of a coefficient times x.
#pragma once
#include <array>
#include <vector>

#include "framework/field/array_view.hpp"
#include "framework/grid/level.hpp"

namespace sluice::solve {

// One view for each box of this rank, in the order of the level's boxes.
using BoxViews = std::vector<RealView>;
using ConstBoxViews = std::vector<ConstRealView>;

// The boxes of a level that a rank owns.
std::vector<IndexBox> boxes_of(const Level& level, int rank);

// Memory for one number a cell of some boxes, at first 0.
class BoxArrays {
 public:
  explicit BoxArrays(const std::vector<IndexBox>& boxes);
  BoxArrays(BoxArrays&&) = default;  // no copies: the views point into the memory
  BoxArrays& operator=(BoxArrays&&) = default;
  const BoxViews& views() const { return views_; }
  ConstBoxViews values() const { return {views_.begin(), views_.end()}; }

 private:
  std::vector<std::vector<double>> memory_;
  BoxViews views_;
};

// Numbers that lie without gaps, x fastest.
ConstRealView view_of(const double* numbers, const IndexBox& box);
RealView view_of(double* numbers, const IndexBox& box);

class CellMatrix {
 public:
  // The level must outlive the matrix. All coefficients are 0.
  explicit CellMatrix(const Level& level);

  const Level& level() const { return *level_; }
  const BoxViews& diagonal() const { return diagonal_.views(); }
  const BoxViews& low(int direction) const { return low_[direction].views(); }

 private:
  const Level* level_;
  BoxArrays diagonal_;
  std::array<BoxArrays, 3> low_;
};

}  // namespace sluice::solve
