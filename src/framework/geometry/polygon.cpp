// The line_segment piece: a closed polygon in the x-y plane, extruded along all of z.
#include "framework/geometry/polygon.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/base/data_lines.hpp"
#include "framework/base/error.hpp"

namespace sluice {

std::vector<PolygonPoint> read_polygon(const std::string& file) {
  std::vector<PolygonPoint> corners;
  read_table(file, {"x", "y"}, [&](const TableRow& row) { corners.push_back({row[0], row[1]}); });
  return corners;
}

PolygonPiece::PolygonPiece(std::vector<PolygonPoint> corners)
    : corners_(std::move(corners)), bounds_(Bounds::nothing()) {
  if (corners_.size() < 3)
    throw InputError(
        fmt::format("line_segment: {} points; a closed line needs at least 3", corners_.size()));
  const Bounds all = Bounds::everything();
  for (const PolygonPoint& c : corners_)
    bounds_ = bounding(bounds_, {{c.x, c.y, all.lower.z}, {c.x, c.y, all.upper.z}});
}

bool PolygonPiece::inside(Vec3 p) const {
  if (!bounds_.contains(p)) return false;
  bool odd = false;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const PolygonPoint u = corners_[i], v = corners_[(i + 1) % corners_.size()];
    if (u.y == v.y && u.y == p.y && std::min(u.x, v.x) <= p.x && p.x <= std::max(u.x, v.x))
      return true;
    if ((u.x == p.x && u.y == p.y) || (v.x == p.x && v.y == p.y)) return true;
    if ((u.y > p.y) == (v.y > p.y)) continue;
    const double at = u.x + (v.x - u.x) * ((p.y - u.y) / (v.y - u.y));
    if (at == p.x) return true;
    odd = odd != (at > p.x);
  }
  return odd;
}

Cover PolygonPiece::cover(const Bounds& box) const {
  if (!bounds_.meets(box)) return Cover::none;
  const Bounds near = with_margin({{box.lower.x, box.lower.y, 0}, {box.upper.x, box.upper.y, 0}});
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const PolygonPoint u = corners_[i], v = corners_[(i + 1) % corners_.size()];
    const auto [low_x, high_x] = std::minmax(u.x, v.x);
    const auto [low_y, high_y] = std::minmax(u.y, v.y);
    if (near.meets({{low_x, low_y, 0}, {high_x, high_y, 0}})) return Cover::some;
  }
  return inside(box.lower) ? Cover::all : Cover::none;
}

}  // namespace sluice
