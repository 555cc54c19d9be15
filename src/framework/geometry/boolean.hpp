// Unions, intersections and differences of pieces. Points in m. A union or an intersection of none
// is an InputError.
#pragma once
#include "framework/geometry/piece.hpp"

namespace sluice {

class UnionPiece final : public GeometryPiece {
 public:
  explicit UnionPiece(std::vector<PiecePtr> members);
  const std::vector<PiecePtr>& members() const { return members_; }
  bool inside(Vec3 p) const override;
  Bounds bounds() const override { return bounds_; }
  Cover cover(const Bounds& box) const override;
  PiecePtr restricted(const Bounds& box) const override;

 private:
  std::vector<PiecePtr> members_;
  Bounds bounds_;
};

class IntersectionPiece final : public GeometryPiece {
 public:
  explicit IntersectionPiece(std::vector<PiecePtr> members);
  bool inside(Vec3 p) const override;
  Bounds bounds() const override { return bounds_; }
  Cover cover(const Bounds& box) const override;
  PiecePtr restricted(const Bounds& box) const override;

 private:
  std::vector<PiecePtr> members_;
  Bounds bounds_;
};

// Inside the first and not inside the second.
class DifferencePiece final : public GeometryPiece {
 public:
  DifferencePiece(PiecePtr first, PiecePtr second);
  bool inside(Vec3 p) const override { return first_->inside(p) && !second_->inside(p); }
  Bounds bounds() const override { return first_->bounds(); }
  Cover cover(const Bounds& box) const override;
  PiecePtr restricted(const Bounds& box) const override;

 private:
  PiecePtr first_, second_;
};

}  // namespace sluice
