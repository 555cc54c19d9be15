// The line_segment piece: a closed polygon in the x-y plane, extruded along all of z. Points in m.
//
// A point is inside when the ray towards larger x crosses the polygon an odd number of times
// (half-open rule on y), and when it lies on an edge.
#pragma once
#include <string>

#include "framework/geometry/piece.hpp"

namespace sluice {

struct PolygonPoint {
  double x = 0, y = 0;
};

// One corner "x y" a line, the last joined to the first. InputError names file and line.
std::vector<PolygonPoint> read_polygon(const std::string& file);

class PolygonPiece final : public GeometryPiece {
 public:
  // InputError for fewer than three corners.
  explicit PolygonPiece(std::vector<PolygonPoint> corners);
  bool inside(Vec3 p) const override;
  Bounds bounds() const override { return bounds_; }
  Cover cover(const Bounds& box) const override;

 private:
  std::vector<PolygonPoint> corners_;
  Bounds bounds_;
};

}  // namespace sluice
