// Boxes of space and the cover of convex pieces.
#include "framework/geometry/piece.hpp"
#include "framework/base/infinity.hpp"

#include <algorithm>
#include <cmath>

namespace sluice {

namespace {

Vec3 lesser(Vec3 a, Vec3 b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vec3 greater(Vec3 a, Vec3 b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

constexpr double round_off = 1e-12;

double magnitude(const Bounds& b, int d) {
  return std::abs(b.lower[d]) + std::abs(b.upper[d]);
}

Bounds widened(Bounds box, Vec3 margin) {
  return {box.lower - margin, box.upper + margin};
}

}  // namespace

bool Bounds::meets(const Bounds& b) const {
  for (int d = 0; d < 3; ++d)
    if (b.lower[d] > upper[d] || b.upper[d] < lower[d]) return false;
  return true;
}

Vec3 Bounds::corner(int n) const {
  return {(n & 1) != 0 ? upper.x : lower.x, (n & 2) != 0 ? upper.y : lower.y,
          (n & 4) != 0 ? upper.z : lower.z};
}

Bounds Bounds::nothing() {
  return {Vec3::all(infinity), Vec3::all(-infinity)};
}
Bounds Bounds::everything() {
  return {Vec3::all(-infinity), Vec3::all(infinity)};
}

Bounds intersection(const Bounds& a, const Bounds& b) {
  return {greater(a.lower, b.lower), lesser(a.upper, b.upper)};
}

Bounds bounding(const Bounds& a, const Bounds& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {lesser(a.lower, b.lower), greater(a.upper, b.upper)};
}

Cover GeometryPiece::cover(const Bounds& box) const {
  return bounds().meets(box) ? Cover::some : Cover::none;
}

Bounds with_margin(const Bounds& b) {
  return widened(b, round_off * Vec3{magnitude(b, 0), magnitude(b, 1), magnitude(b, 2)});
}

Cover convex_cover(const GeometryPiece& piece, const Bounds& box, bool exact) {
  const Bounds own = piece.bounds();
  if (!own.meets(box)) return Cover::none;
  Vec3 margin{};
  if (!exact)
    for (int d = 0; d < 3; ++d) margin[d] = round_off * (magnitude(box, d) + magnitude(own, d));
  const Bounds wide = widened(box, margin);
  for (int n = 0; n < 8; ++n)
    if (!piece.inside(wide.corner(n))) return Cover::some;
  return Cover::all;
}

}  // namespace sluice
