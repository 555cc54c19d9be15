// spatialAvg: averages of cell variables over a box of cells around each cell, as fields.
//
//   spatialAvg_<label>            mean of the cells of the box
//   spatialAvg_variance_<label>   mean square of what they differ from it
// of the state that is written, vectors component by component, from timeStart to timeStop, else 0.
// Of a box that leaves the domain or the level those cells count that the level has; across
// periodic ends it goes on. Sums run in the order of the cells of a box: no choice of boxes shows.
#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/analysis/modules.hpp"
#include "framework/run/levels/hierarchy.hpp"

namespace sluice {

// Does a module average cells.
bool averages_cells(const AnalysisModule& module);
// The fields that it gives to save, two for each of its variables.
std::vector<std::string> names_of_cell_averages(const std::string& label);

class CellAverages {
 public:
  // DeckError for variables that have no cells or live inside a step only, and for boxes that wrap
  // around a periodic domain.
  CellAverages(const AnalysisModule& module, const FindQuantity& find, Hierarchy& hierarchy,
               int rank);

  const std::vector<Label>& labels() const { return labels_; }
  // What must be in the outputs to give these labels.
  std::vector<Label> sources(const std::vector<Label>& wanted) const;
  // Into the outputs of all levels. Collective.
  void store(const std::vector<Label>& wanted, double time) const;

 private:
  struct Averaged {
    AnalysedQuantity quantity;
    Label mean, variance;
  };
  bool wants(const Averaged& a, const std::vector<Label>& wanted) const;
  void store_level(LevelSolver& solver, const Averaged& a, bool in_time) const;

  const AnalysisModule* module_;
  Hierarchy* hierarchy_;
  int rank_;
  std::vector<Averaged> averaged_;
  std::vector<Label> labels_;
};

}  // namespace sluice
