// A system as solvers see it: one window of cells, checked.
//
// The window is the bounding box of the level's boxes; cells of it that are in no box have the
// diagonal 1 and no coupling. So nothing that a solver computes depends on boxes or ranks. The
// window's directions are put into the order that suits the solver (DenseShape). Where it pays each
// rank has a slab of it (Slabs), else the whole. Units as in cell_matrix.hpp; norms and sums have
// that of a vector.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "framework/solve/cell_matrix.hpp"
#include "framework/solve/multigrid_level.hpp"
#include "framework/solve/raw_memory.hpp"
#include "framework/solve/slabs.hpp"
#include "framework/solve/solver_settings.hpp"

namespace sluice::solve {

using DenseVector = RawVector<double>;

class DenseSystem {
 public:
  // Collective. Throws PhysicsError that names the first cell whose row no solver may see: a
  // coefficient that is not finite, an empty row, a diagonal that is not positive, a coupling with
  // no cell.
  explicit DenseSystem(const CellMatrix& matrix);
  // The whole, from the numbers of all boxes of the level (all_boxes.hpp). `like`: another system
  // on the same level, whose places are to be those of this one.
  DenseSystem(const Level& level, const ConstBoxViews& diagonal,
              const std::array<ConstBoxViews, 3>& low, const DenseSystem* like = nullptr);

  const DenseShape& shape() const { return shape_; }
  const Slabs& slabs() const { return slabs_; }
  const DenseVector& diagonal() const { return diagonal_; }
  const DenseVector& low(int d) const { return low_[d]; }
  bool singular() const { return singular_; }  // every row sums to 0
  // Collective: does each cell have its place in the other's vectors, and the same neighbours.
  bool is_like(const DenseSystem& other) const;
  std::int64_t unknowns() const { return unknowns_; }
  // Couplings as positive numbers and the sums of rows.
  DenseEquations equations() const;
  IntVec3 cell_of(std::ptrdiff_t c) const;
  std::ptrdiff_t place_of(IntVec3 cell) const;  // in vectors; of a cell in the window
  std::string cell_name(std::ptrdiff_t c) const;

  DenseVector vector() const { return zeros<double>(shape_, slabs_); }
  // Zeros in cells of no box: those of a vector of the same level stay.
  void give_size(DenseVector& v) const {
    if (v.size() != shape_.size()) v = vector();
  }
  DenseVector ones() const;
  // Of the own slices, with the ghosts around them.
  void copy(const DenseVector& from, DenseVector& to) const;
  void clear(DenseVector& v) const;
  // Collective, as all below: boxes of all ranks into the window, and back into those of this one.
  void load(const ConstBoxViews& boxes, DenseVector& v) const;
  void store(const DenseVector& v, const BoxViews& boxes) const;
  // Throws PhysicsError that names the first cell whose number is not finite.
  void need_finite(const DenseVector& v, const char* what) const;

  // out = A x; fills the ghosts of x.
  void apply(DenseVector& x, DenseVector& out) const;
  void residual(const DenseVector& b, DenseVector& x, DenseVector& r) const;
  double dot(const DenseVector& a, const DenseVector& b) const;  // by exact sums, as all below
  double sum(const DenseVector& v) const;
  double norm(const DenseVector& v, Norm kind) const;
  void remove_mean(DenseVector& v) const;

  // row(c): for every row of the own slices, its first cell.
  template <class F>
  void for_rows(F&& row) const {
    for (int k = slabs_.begin(); k < slabs_.end(); ++k)
      for (int j = 0; j < shape_.count[1]; ++j) row(shape_.at(0, j, k));
  }
  // cell(c): for every cell of them, its place.
  template <class F>
  void for_cells(F&& cell) const {
    for_rows([&](std::ptrdiff_t row) {
      for (std::ptrdiff_t c = row; c < row + shape_.count[0]; ++c) cell(c);
    });
  }

 private:
  void choose_directions(const std::array<double, 3>& couplings);
  void take_shape();
  void clear_rows();
  void finish();  // what follows from the coefficients, and their checks
  // row(first cell, its place, stride along x), for the rows along x of a part of the window.
  template <class F>
  void for_part(const IndexBox& part, F&& row) const;
  void put(const ConstRealView& part, DenseVector& v) const;
  IndexBox slab_of(int rank) const;
  // What is wrong with the first row that no solver may see, among the own ones.
  std::string fault_of_rows() const;
  std::string fault_of_row(std::ptrdiff_t c) const;
  std::string fault_of_neighbours() const;
  void need_none(const std::string& fault) const;  // of any rank
  void fold_own_neighbours();
  void exchange(DenseVector& v) const;  // the ghosts of all own slices

  const Level* level_;
  IndexBox window_;
  std::array<int, 3> axis_{0, 1, 2};  // direction of the level, by direction of the window
  DenseShape shape_;
  Slabs slabs_;
  std::vector<char> present_;  // of the whole window
  DenseVector diagonal_, low_[3];
  std::int64_t unknowns_ = 0;
  bool singular_ = false;
};

}  // namespace sluice::solve
