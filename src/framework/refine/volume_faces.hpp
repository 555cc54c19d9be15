// Control volumes on a level: the faces through which they exchange, and their cells.
//
// A volume is a box of cells of the coarsest level. Of a face that lies on several levels the
// finest one counts, of a face between two boxes the box above it: every part of the surface is
// counted once over all levels, boxes and ranks, with the flux that both sides have agreed on.
#pragma once
#include <array>
#include <vector>

#include "framework/refine/face_table.hpp"
#include "framework/scene/analysis_settings.hpp"

namespace sluice {

// A control volume in cells of the coarsest level.
struct VolumeCells {
  IndexBox cells;  // empty: the box lies outside the domain
  // By side (x-, x+, ...): the cells inside of it whose faces count; empty: none.
  std::array<IndexBox, 6> sides;
  bool clipped = false;
};
// Corners go to the nearest faces of the coarsest level, at least a cell apart. A rectangle becomes
// the low side of the cells above it, at the high end of the domain the high side of the last ones.
VolumeCells cells_of(const ControlVolume& volume, const Level& coarsest);
// Of all modules, in the deck's order.
std::vector<ControlVolume> control_volumes(const AnalysisSettings& settings);

// Where the sums of a step hold what volumes exchange: amounts that pass along the axis.
class VolumeSums {
 public:
  VolumeSums(int first, int materials) : first_(first), materials_(materials) {}

  int count(int volumes) const { return volumes * per_volume(); }
  int mass(int volume, int side, int material) const { return at(volume, side) + material; }
  int momentum(int volume, int side) const { return at(volume, side) + materials_; }  // three
  int viscous(int volume, int side) const { return momentum(volume, side) + 3; }      // three
  int pressure(int volume, int side) const { return momentum(volume, side) + 6; }
  int energy(int volume, int side) const { return momentum(volume, side) + 7; }
  int heat(int volume, int side) const { return momentum(volume, side) + 8; }  // part of energy
  // What forces add inside: momentum (three) and work.
  int force(int volume) const { return at(volume, 6); }
  int work(int volume) const { return force(volume) + 3; }

 private:
  int per_side() const { return materials_ + 9; }
  int per_volume() const { return 6 * per_side() + 4; }
  int at(int volume, int side) const { return first_ + volume * per_volume() + side * per_side(); }

  int first_, materials_;
};

class VolumeFaces {
 public:
  VolumeFaces() = default;  // no volumes
  // `levels`: geometry and boxes of all levels that exist up to the next finer one, coarse to fine;
  // the last but `finer` is the one that this is for.
  VolumeFaces(const std::vector<VolumeCells>& volumes, const Level& coarsest, const Level& level,
              const Level* finer, int rank);

  int count() const { return static_cast<int>(inside_.size()); }
  // Segments of a row, as FaceTable::segments; which volume and side a segment belongs to.
  std::span<const FaceTable::Segment> segments(int box, int axis, IntVec3 cell) const {
    return table_.segments(box, axis, cell);
  }
  IndexBox cells_with_faces(int box, int axis, const IndexBox& block) const {
    return table_.cells_with_faces(box, axis, block);
  }
  int side_of(const FaceTable::Segment& s) const {  // 6 * volume + side
    return side_of_[s.slot];
  }
  // The cells of a volume on this level, also where there are none.
  const IndexBox& inside(int volume) const { return inside_[volume]; }
  std::ptrdiff_t faces() const { return table_.faces(); }

 private:
  struct Builder;

  FaceTable table_;
  std::vector<int> side_of_;  // by slot
  std::vector<IndexBox> inside_;
};

}  // namespace sluice
