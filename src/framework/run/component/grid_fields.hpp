// Fields that particles have on the grid, made when they are saved: zero where no particle reaches.
#pragma once
#include <deque>
#include <map>
#include <tuple>
#include <vector>

#include "framework/archive/field_piece.hpp"
#include "framework/field/label.hpp"
#include "framework/grid/level.hpp"

namespace sluice {

// The cells of a box that a label's piece covers: labels of faces and nodes have one more layer
// where the domain ends.
IndexBox piece_cells(const IndexBox& cells, Label label, const Level& level);

// Arrays on the boxes of one rank of a level, for some labels and materials. Labels of faces and
// nodes have their closing layer at the high sides of the domain.
class GridFields {
 public:
  GridFields(const Level& level, int rank) : level_(&level), rank_(rank) {}

  void add(Label label, int material);
  bool has(Label label, int material) const { return first_.contains({label, material}); }
  // Sets a value, in the unit of the label, where the index lies in a box of this rank.
  void set(Label label, int material, int component, IntVec3 at, double value);
  std::vector<FieldPiece> pieces() const;

 private:
  struct Array {
    Label label;
    int material = 0, component = 0, box_id = 0;
    IndexBox cells;
    std::vector<double> values;
  };
  std::size_t boxes() const;

  const Level* level_;
  int rank_;
  std::deque<Array> arrays_;  // of a label and material: component by component, box by box
  std::map<std::pair<Label, int>, std::size_t> first_;
};

}  // namespace sluice
