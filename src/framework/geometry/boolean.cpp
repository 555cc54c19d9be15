// Unions, intersections and differences of pieces.
#include "framework/geometry/boolean.hpp"

#include <utility>

#include "framework/base/error.hpp"

namespace sluice {

UnionPiece::UnionPiece(std::vector<PiecePtr> members)
    : members_(std::move(members)), bounds_(Bounds::nothing()) {
  if (members_.empty()) throw InputError("a union needs at least one piece");
  for (const PiecePtr& m : members_) bounds_ = bounding(bounds_, m->bounds());
}

bool UnionPiece::inside(Vec3 p) const {
  for (const PiecePtr& m : members_)
    if (m->inside(p)) return true;
  return false;
}

Cover UnionPiece::cover(const Bounds& box) const {
  Cover result = Cover::none;
  for (const PiecePtr& m : members_) {
    const Cover c = m->cover(box);
    if (c == Cover::all) return Cover::all;
    if (c == Cover::some) result = Cover::some;
  }
  return result;
}

IntersectionPiece::IntersectionPiece(std::vector<PiecePtr> members)
    : members_(std::move(members)), bounds_(Bounds::everything()) {
  if (members_.empty()) throw InputError("an intersection needs at least one piece");
  for (const PiecePtr& m : members_) bounds_ = sluice::intersection(bounds_, m->bounds());
}

bool IntersectionPiece::inside(Vec3 p) const {
  for (const PiecePtr& m : members_)
    if (!m->inside(p)) return false;
  return true;
}

Cover IntersectionPiece::cover(const Bounds& box) const {
  Cover result = Cover::all;
  for (const PiecePtr& m : members_) {
    const Cover c = m->cover(box);
    if (c == Cover::none) return Cover::none;
    if (c == Cover::some) result = Cover::some;
  }
  return result;
}

DifferencePiece::DifferencePiece(PiecePtr first, PiecePtr second)
    : first_(std::move(first)), second_(std::move(second)) {}

Cover DifferencePiece::cover(const Bounds& box) const {
  const Cover first = first_->cover(box);
  if (first == Cover::none) return Cover::none;
  const Cover second = second_->cover(box);
  if (second == Cover::all) return Cover::none;
  if (second == Cover::none) return first;
  return Cover::some;
}

}  // namespace sluice
