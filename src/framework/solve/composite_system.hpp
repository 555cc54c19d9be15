// A symmetric system on all levels at once: unknowns are the cells that no finer level covers.
//
// Rows are summed over the volume of their cell. Inside a level neighbours are coupled as in
// cell_matrix.hpp. A face where a level meets a coarser one couples its fine cell with the coarse
// cell behind it, by the fine level's own coefficient over the longer distance of the two centres:
//   w 2/(r + 1),  w that of two fine cells, r the ratio along the face's normal
// so that the matrix stays symmetric; what a two-point difference lacks there is up to who
// corrects the defect. Units as in cell_matrix.hpp; norms have that of a right-hand side.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "framework/solve/dense_system.hpp"

namespace sluice::solve {

// Of the boxes of a level on this rank, for each cell: what its own unknown takes, and the
// couplings (at least 0) across its low and high faces, on sides of the domain too, where the
// unknown behind the face is 0.
struct LevelCoefficients {
  LevelCoefficients(const Level& level, int rank);
  const Level* level;  // must outlive it
  BoxArrays own;
  std::array<BoxArrays, 3> low, high;
};

// A number for each cell, by level.
using CompositeVector = std::vector<DenseVector>;

class CompositeSystem {
 public:
  // Coarse to fine. Collective. Throws PhysicsError that names the first cell whose row no solver
  // may see.
  explicit CompositeSystem(std::span<const LevelCoefficients> levels);

  std::size_t levels() const { return levels_.size(); }
  std::int64_t unknowns() const;
  CompositeVector vector() const;
  // Collective: boxes of all ranks into the windows. Covered cells get 0.
  void load(std::size_t level, const ConstBoxViews& boxes, CompositeVector& v) const;
  // Covered cells as means of the finer ones; back into the boxes of this rank.
  void cover(CompositeVector& v) const;
  void store(const CompositeVector& v, std::size_t level, const BoxViews& boxes) const;

  void apply(CompositeVector& x, CompositeVector& y) const;
  double dot(const CompositeVector& a, const CompositeVector& b) const;  // by exact sums
  double norm(const CompositeVector& v, Norm kind) const;

  // What couples unknowns of one level; covered cells have the diagonal 1.
  const DenseSystem& rows(std::size_t level) const { return levels_[level].rows; }
  DenseVector unknowns_of(std::size_t level) const;  // 1 where a cell of a level is one, else 0
  // face(fine level, place there, place on the next coarser level, w): takes w x_coarse from the
  // fine row, and adds w (x_coarse - x_fine) to the coarse one.
  template <class F>
  void for_interfaces(F&& face) const {
    for (std::size_t l = 1; l < levels_.size(); ++l)
      for (const Interface& f : levels_[l].interfaces) face(l, f.fine, f.coarse, f.weight);
  }

  // A level for itself, with its covered cells: for preconditioners.
  const DenseSystem& whole(std::size_t level) const { return levels_[level].whole; }
  // Sums over the cells below each covered one, into it, from the finest level down to `level`.
  void gather(const CompositeVector& v, std::size_t level, CompositeVector& sums) const;
  // The number of a covered cell into all cells above it: from `level` up; others as they are.
  void spread(CompositeVector& v, std::size_t level) const;
  void clear_covered(CompositeVector& v) const;
  // The share of a correction of a level that a cycle may take.
  double step_share(std::size_t level) const;

 private:
  // Places in the windows of both levels.
  struct Interface {
    std::ptrdiff_t fine, coarse;
    double weight;
  };
  struct LevelPart {
    const Level* level;
    DenseSystem rows;                     // uncovered cells; covered ones have the diagonal 1
    DenseSystem whole;                    // all cells, also the covered ones
    std::vector<std::ptrdiff_t> covered;  // places
    std::vector<std::ptrdiff_t> cells, parents;  // of all cells, and of those below; not of level 0
    std::vector<Interface> interfaces;           // with the next coarser level
    double children = 1;                         // of a cell of the next coarser level
  };
  void find_parents(std::size_t level);

  std::vector<LevelPart> levels_;
};

}  // namespace sluice::solve
