// Who is told of the systems that this process solves, while there is one: for `sluice tune`, which
// tries other solvers on them.
#pragma once
#include <span>

#include "framework/solve/composite_system.hpp"
#include "framework/solve/solver_settings.hpp"

namespace sluice::solve {

class LinearSystemObserver {
 public:
  // Is told from now on. One at a time; throws std::logic_error for a second one.
  LinearSystemObserver();
  virtual ~LinearSystemObserver();
  LinearSystemObserver(const LinearSystemObserver&) = delete;
  LinearSystemObserver& operator=(const LinearSystemObserver&) = delete;
  static LinearSystemObserver* current();  // null: nobody watches

  // A valid matrix, of one level or of several, and by which solver it will be solved.
  virtual void matrix(const CellMatrix& matrix, const SolverSettings& settings) = 0;
  virtual void matrix(std::span<const LevelCoefficients> levels,
                      const SolverSettings& settings) = 0;
  // What is solved for with the last matrix; both finite. On levels solves begin at 0.
  virtual void right_side(const ConstBoxViews& right_side, const ConstBoxViews& start) = 0;
  virtual void right_side(const CompositeVector& right_side) = 0;
};

}  // namespace sluice::solve
