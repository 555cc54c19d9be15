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

// Only large unions gain: the members that do not reach into the box are left out.
PiecePtr UnionPiece::restricted(const Bounds& box) const {
  constexpr std::size_t large = 4;
  if (members_.size() <= large) return nullptr;
  std::vector<PiecePtr> near;
  for (const PiecePtr& m : members_)
    if (m->cover(box) != Cover::none) near.push_back(m);
  if (near.empty() || 2 * near.size() > members_.size()) return nullptr;
  return std::make_shared<UnionPiece>(std::move(near));
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

PiecePtr IntersectionPiece::restricted(const Bounds& box) const {
  std::vector<PiecePtr> members = members_;
  bool simpler = false;
  for (PiecePtr& m : members)
    if (PiecePtr part = m->restricted(box)) {
      m = std::move(part);
      simpler = true;
    }
  return simpler ? std::make_shared<IntersectionPiece>(std::move(members)) : nullptr;
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

PiecePtr DifferencePiece::restricted(const Bounds& box) const {
  const PiecePtr first = first_->restricted(box), second = second_->restricted(box);
  if (!first && !second) return nullptr;
  return std::make_shared<DifferencePiece>(first ? first : first_, second ? second : second_);
}

}  // namespace sluice
