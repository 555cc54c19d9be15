// Boundary regions: which face centres they hold, and what holds there.
#include "framework/scene/boundary.hpp"

#include <cmath>
#include <numbers>

namespace sluice {

namespace {

bool in_rectangle(int a, int b, Vec3 p, Vec3 lower, Vec3 upper) {
  return p[a] >= lower[a] && p[a] <= upper[a] && p[b] >= lower[b] && p[b] <= upper[b];
}

}  // namespace

bool RegionShape::contains(int normal, Vec3 p) const {
  const int a = normal == 0 ? 1 : 0, b = normal == 2 ? 1 : 2;  // rising order
  const double da = p[a] - origin[a], db = p[b] - origin[b];
  switch (kind) {
    case Kind::side:
      return true;
    case Kind::circle:
      return da * da + db * db <= radius * radius;
    case Kind::annulus: {
      const double r2 = da * da + db * db;
      return r2 > inner_radius * inner_radius && r2 <= radius * radius;
    }
    case Kind::ellipse: {
      // The angle turns the major axis from the lower towards the higher transverse direction.
      const double turn = angle * std::numbers::pi / 180;
      const double along = da * std::cos(turn) + db * std::sin(turn);
      const double across = db * std::cos(turn) - da * std::sin(turn);
      const double u = along / major_radius, v = across / minor_radius;
      return u * u + v * v <= 1;
    }
    case Kind::rectangle:
      return in_rectangle(a, b, p, lower, upper);
    case Kind::rectangulus:
      return in_rectangle(a, b, p, lower, upper) &&
             !in_rectangle(a, b, p, inner_lower, inner_upper);
  }
  return false;
}

const Condition* BoundaryRegion::find(std::string_view variable, int material) const {
  const Condition* general = nullptr;
  const Condition* symmetric = nullptr;
  const Condition* symmetric_general = nullptr;
  for (const Condition& c : conditions) {
    const bool mine = c.material == material, all = c.material < 0;
    if (c.variable == variable) {
      if (mine) return &c;
      if (all && general == nullptr) general = &c;
    } else if (c.variable == "Symmetric") {
      if (mine && symmetric == nullptr) symmetric = &c;
      if (all && symmetric_general == nullptr) symmetric_general = &c;
    }
  }
  if (symmetric != nullptr) return symmetric;
  if (general != nullptr) return general;
  return symmetric_general;
}

RegionMap::RegionMap(const BoundarySide& conditions, Side side, const Level& level) {
  const int d = direction_of(side);
  const int a = d == 0 ? 1 : 0, b = d == 2 ? 1 : 2;
  const IntVec3 size = level.domain.size();
  counts_.assign(std::max<std::size_t>(conditions.regions.size(), 1), 0);
  const std::int64_t faces = static_cast<std::int64_t>(size[a]) * size[b];
  counts_[0] = faces;
  if (conditions.regions.size() < 2) return;

  uniform_ = false;
  lower_a_ = level.domain.lower[a];
  lower_b_ = level.domain.lower[b];
  size_a_ = size[a];
  regions_.assign(faces, 0);
  for (int y = 0; y < size[b]; ++y)
    for (int x = 0; x < size[a]; ++x) {
      IntVec3 cell{};
      cell[a] = lower_a_ + x;
      cell[b] = lower_b_ + y;
      const Vec3 p = level.centre(cell);
      for (std::size_t r = 1; r < conditions.regions.size(); ++r)
        if (conditions.regions[r].shape.contains(d, p)) {
          regions_[x + size_a_ * y] = static_cast<std::uint8_t>(r);
          ++counts_[r];
          --counts_[0];
          break;
        }
    }
}

}  // namespace sluice
