// The numbers of all boxes of a level, on all ranks; of any unit.
#pragma once
#include <string>
#include <vector>

#include "framework/solve/cell_matrix.hpp"

namespace sluice::solve {

class AllBoxes {
 public:
  // Collective. `own`: of the boxes of this rank; they must outlive it.
  AllBoxes(const Level& level, const ConstBoxViews& own);
  // In the order of Level::boxes.
  const ConstBoxViews& views() const { return views_; }

 private:
  std::vector<std::string> received_;
  std::vector<std::vector<double>> numbers_;
  ConstBoxViews views_;
};

}  // namespace sluice::solve
