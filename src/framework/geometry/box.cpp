// Pieces with flat faces: box, parallelepiped, convex polyhedron.
#include "framework/geometry/box.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "framework/base/error.hpp"

namespace sluice {

BoxPiece::BoxPiece(Vec3 min, Vec3 max) : box_{min, max} {
  for (int d = 0; d < 3; ++d)
    if (!(min[d] < max[d]))
      throw InputError(
          fmt::format("box: min {} is not below max {} in direction {}; swap them or give the box "
                      "a thickness",
                      min[d], max[d], "xyz"[d]));
}

Cover BoxPiece::cover(const Bounds& box) const {
  if (!box_.meets(box)) return Cover::none;
  return box_.contains(box) ? Cover::all : Cover::some;
}

ParallelepipedPiece::ParallelepipedPiece(Vec3 p1, Vec3 p2, Vec3 p3, Vec3 p4) : origin_(p1) {
  const std::array<Vec3, 3> edge = {p2 - p1, p3 - p1, p4 - p1};
  for (std::size_t i = 0; i < 3; ++i) normals_[i] = cross(edge[(i + 1) % 3], edge[(i + 2) % 3]);
  volume_ = dot(edge[0], normals_[0]);
  const double scale =
      std::sqrt(dot(edge[0], edge[0]) * dot(edge[1], edge[1]) * dot(edge[2], edge[2]));
  if (!(std::abs(volume_) > 1e-12 * scale))
    throw InputError("parallelepiped: p1, p2, p3 and p4 lie in one plane; move one of them off it");
  bounds_ = Bounds::nothing();
  for (int n = 0; n < 8; ++n) {
    Vec3 corner = p1;
    for (int i = 0; i < 3; ++i)
      if ((n >> i & 1) != 0) corner += edge[i];
    bounds_ = bounding(bounds_, {corner, corner});
  }
  bounds_ = with_margin(bounds_);
}

bool ParallelepipedPiece::inside(Vec3 p) const {
  const Vec3 d = p - origin_;
  for (const Vec3& n : normals_) {
    const double a = dot(d, n) / volume_;
    if (!(a > 0 && a <= 1)) return false;
  }
  return true;
}

namespace {

// The point on three planes, unless two of them are parallel.
std::optional<Vec3> meeting_point(const HalfSpace& a, const HalfSpace& b, const HalfSpace& c) {
  const Vec3 bc = cross(b.normal, c.normal);
  const double determinant = dot(a.normal, bc);
  const double scale =
      std::sqrt(dot(a.normal, a.normal) * dot(b.normal, b.normal) * dot(c.normal, c.normal));
  if (!(std::abs(determinant) > 1e-12 * scale)) return std::nullopt;
  return (dot(a.point, a.normal) * bc + dot(b.point, b.normal) * cross(c.normal, a.normal) +
          dot(c.point, c.normal) * cross(a.normal, b.normal)) *
         (1 / determinant);
}

// A direction in which the faces leave the piece open: the half spaces bound it exactly when no
// direction t has normal . t >= 0 for all of them, and such a t, if any, lies along a line in which
// two planes meet.
bool unbounded(const std::vector<HalfSpace>& faces) {
  auto escapes = [&](Vec3 t) {
    for (const HalfSpace& f : faces)
      if (dot(f.normal, t) < -1e-12 * std::sqrt(dot(f.normal, f.normal) * dot(t, t))) return false;
    return true;
  };
  bool two_cross = false;
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 t = cross(faces[i].normal, faces[j].normal);
      if (dot(t, t) <=
          1e-24 * dot(faces[i].normal, faces[i].normal) * dot(faces[j].normal, faces[j].normal))
        continue;
      two_cross = true;
      if (escapes(t) || escapes(-1.0 * t)) return true;
    }
  return !two_cross;
}

}  // namespace

PolyhedronPiece::PolyhedronPiece(Vec3 center, std::vector<HalfSpace> faces)
    : faces_(std::move(faces)), bounds_(Bounds::nothing()) {
  if (faces_.size() < 4)
    throw InputError(
        fmt::format("polyhedron: {} half spaces cannot enclose a volume; at least 4 are needed",
                    faces_.size()));
  for (const HalfSpace& f : faces_)
    if (!(dot(f.normal, f.normal) > 0))
      throw InputError(
          "polyhedron: the normal of a half space is a zero vector; give a normal (or offset) that "
          "is not zero");
  if (!inside(center))
    throw InputError(
        "polyhedron: its center lies outside one of its half spaces; normals point "
        "inwards");
  if (unbounded(faces_))
    throw InputError("polyhedron: its half spaces leave it open to infinity; add the missing face");
  for (std::size_t i = 0; i < faces_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        const std::optional<Vec3> p = meeting_point(faces_[i], faces_[j], faces_[k]);
        if (!p) continue;
        bool corner = true;
        for (const HalfSpace& f : faces_) {
          const Vec3 d = *p - f.point;
          const double size = std::sqrt(dot(f.normal, f.normal)) *
                              (std::sqrt(dot(*p, *p)) + std::sqrt(dot(f.point, f.point)));
          if (dot(d, f.normal) < -1e-12 * size) corner = false;
        }
        if (corner) bounds_ = bounding(bounds_, {*p, *p});
      }
  bounds_ = with_margin(bounds_);
}

bool PolyhedronPiece::inside(Vec3 p) const {
  for (const HalfSpace& f : faces_)
    if (!(dot(p - f.point, f.normal) >= 0)) return false;
  return true;
}

}  // namespace sluice
