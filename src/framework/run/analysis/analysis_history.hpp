// What statistics keep in the cells of one level, on boxes of its own time.
#pragma once
#include <map>
#include <vector>

#include "framework/archive/field_piece.hpp"
#include "framework/field/warehouse.hpp"
#include "framework/run/analysis/analysis_statistics.hpp"

namespace sluice {

struct Statistics::LevelStore {
 public:
  LevelStore(const Level& level, int rank, const std::vector<Label>& labels,
             const std::vector<int>& materials);
  LevelStore(const LevelStore&) = delete;
  LevelStore& operator=(const LevelStore&) = delete;

  // Are these the boxes.
  bool holds(const Level& level) const;
  RealView view(Label label, int box) const { return kept_.view(slot_of_.at(label), 0, box); }
  // Cells of an earlier layout keep what they had; others take it from the coarser level, whose
  // ghost cells are filled for that. Either may be null. Collective.
  void commit(const LevelStore* earlier, LevelStore* coarser);
  void add_pieces(std::vector<FieldPiece>& pieces) const;
  // False when the checkpoint does not hold all of it: then all is zero.
  bool read(const ArchiveStep& checkpoint);

 private:
  Level level_;
  int rank_;
  Warehouse kept_;
  std::map<Label, int> slot_of_;
  std::vector<int> slots_;
};

}  // namespace sluice
