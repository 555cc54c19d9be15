// A plate with one corrugated edge.
//
// The plate fills [xymin, xymax] in x and y and `thickness` along z from xymin.z. Points at the
// distance u from the corrugated edge (of the width W across) are shifted along that edge's normal
// by  A (1 - u/W) sin(2 pi s / lambda),  s the coordinate along the edge (cos for curve "cos"): the
// full amplitude A at the edge, nothing at the opposite one. Points and lengths in m.
#pragma once
#include "framework/geometry/piece.hpp"

namespace sluice {

struct CorrugatedPlate {
  Vec3 xymin{}, xymax{};
  double thickness = 0;
  int edge_direction = 0;  // 0: x, 1: y
  bool edge_plus = false;
  bool cosine = false;
  double wavelength = 0, amplitude = 0;
};

class CorrugatedPiece final : public GeometryPiece {
 public:
  // InputError for a plate without volume, or an amplitude as large as the plate.
  explicit CorrugatedPiece(const CorrugatedPlate& plate);
  bool inside(Vec3 p) const override;
  Bounds bounds() const override { return bounds_; }

 private:
  CorrugatedPlate plate_;
  Bounds bounds_;
};

}  // namespace sluice
