// A region of space: what a deck's <geom_object> is made of. Points and lengths in m.
//
// Rule for points on the surface: every piece is closed (the surface belongs to it), with two
// exceptions that the format prescribes: the torus is open, and the parallelepiped is open on the
// three faces through p1. So a point on the common face of two boxes belongs to both; a deck that
// wants a partition writes <difference>, which gives such a point to one of them only.
#pragma once
#include <limits>
#include <memory>
#include <vector>

#include "framework/base/vec3.hpp"

namespace sluice {

// A closed axis-parallel box of space; empty when lower > upper in any direction.
struct Bounds {
  Vec3 lower{}, upper{};

  bool empty() const { return lower.x > upper.x || lower.y > upper.y || lower.z > upper.z; }
  bool contains(Vec3 p) const {
    return p.x >= lower.x && p.x <= upper.x && p.y >= lower.y && p.y <= upper.y && p.z >= lower.z &&
           p.z <= upper.z;
  }
  bool contains(const Bounds& b) const {
    return b.empty() || (contains(b.lower) && contains(b.upper));
  }
  bool meets(const Bounds& b) const;
  Vec3 corner(int n) const;  // n = 0..7, bit d set: upper end of direction d

  static Bounds nothing();
  static Bounds everything();
};
Bounds intersection(const Bounds&, const Bounds&);
Bounds bounding(const Bounds&, const Bounds&);
// The box with a margin for the round-off of inside tests: 1e-12 of its coordinates and size.
Bounds with_margin(const Bounds&);

// How a box of space lies to a piece. `all` and `none` are promises; `some` may also mean unknown.
enum class Cover { none, some, all };

class GeometryPiece {
 public:
  virtual ~GeometryPiece() = default;

  virtual bool inside(Vec3 p) const = 0;
  virtual Bounds bounds() const = 0;
  // Must agree with inside() to the bit: with `all` every point of the box is inside.
  virtual Cover cover(const Bounds& box) const;
  // A piece that has the same points in the box and is cheaper to ask, or nullptr.
  virtual std::shared_ptr<const GeometryPiece> restricted(const Bounds&) const { return nullptr; }
  // Pieces that are lists of points (particle files) say so here; others return nullptr.
  virtual const std::vector<Vec3>* points() const { return nullptr; }
};

using PiecePtr = std::shared_ptr<const GeometryPiece>;

// Cover of a convex piece: a box is inside when its eight corners are. `exact` says that the inside
// test rounds monotonically in each coordinate; otherwise the box is widened by the round-off.
Cover convex_cover(const GeometryPiece& piece, const Bounds& box, bool exact);

// All of space (<null>).
class EverywherePiece final : public GeometryPiece {
 public:
  bool inside(Vec3) const override { return true; }
  Bounds bounds() const override { return Bounds::everything(); }
  Cover cover(const Bounds&) const override { return Cover::all; }
};

}  // namespace sluice
