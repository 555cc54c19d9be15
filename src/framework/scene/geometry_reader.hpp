// Geometry pieces from the deck: nested operators, labels, files, and the <geom_object> around
// them.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/geometry/piece.hpp"
#include "framework/grid/level.hpp"

namespace sluice {

// A piece with what a material has in it at the start.
struct GeomObject {
  PiecePtr piece;  // nullptr only when a fault was reported
  IntVec3 res{1, 1, 1};
  Vec3 velocity{};  // m/s
  // density, temperature, volumeFraction, ... by tag, in SI units.
  std::map<std::string, double> values;
  std::map<std::string, Location> value_where;
  Location where;

  bool has(const std::string& tag) const { return values.count(tag) > 0; }
  double value(const std::string& tag) const { return values.at(tag); }
};

// Reads pieces. Labels hold in the whole deck: a tag that has a label and no children stands for
// the piece that carries the same label elsewhere.
class GeometryReader {
 public:
  // Collects the labels below `root`, which must outlive the reader. Reusing a label that has two
  // different definitions is a fault.
  GeometryReader(const DeckNode& root, std::vector<Fault>& faults);

  static bool is_piece(std::string_view tag);
  PiecePtr piece(const DeckNode& node, std::vector<Fault>& faults) const;
  // Several pieces side by side are their union.
  GeomObject object(const DeckNode& geom_object, std::vector<Fault>& faults) const;

 private:
  PiecePtr build(const DeckNode& node, std::vector<Fault>& faults, int depth) const;
  const DeckNode* labelled(const DeckNode& node, const std::string& label,
                           std::vector<Fault>& faults) const;

  std::map<std::string, const DeckNode*> labels_;
};

// Sub-points inside the object for every cell of the box, x fastest; of object.res per cell.
std::vector<std::int32_t> count_inside(const GeomObject& object, const Level& level,
                                       const IndexBox& cells);

}  // namespace sluice
