// The tri piece: what a closed triangulated surface encloses. Points in m.
//
// A point is inside when rays along at least two of the three axes cross the surface an odd number
// of times beyond it; a point on the surface is inside. Which triangles a ray meets is decided edge
// by edge with a half-open rule on numbers that both neighbours of an edge compute alike, so a ray
// through an edge or a corner is counted right.
// Reference: Haines, "Point in polygon strategies", Graphics Gems IV (1994), p. 24.
#pragma once
#include <array>
#include <string>

#include "framework/geometry/piece.hpp"

namespace sluice {

struct Triangulation {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;  // indices into points, from 0
};

// Reads STEM.pts (x y z a line) and STEM.tri (three indices a line). InputError names file and
// line.
Triangulation read_triangulation(const std::string& stem);

class TriangulationPiece final : public GeometryPiece {
 public:
  // InputError for fewer than four triangles.
  explicit TriangulationPiece(Triangulation surface);
  bool inside(Vec3 p) const override;
  Bounds bounds() const override { return bounds_; }
  Cover cover(const Bounds& box) const override;
  // Every edge belongs to an even number of triangles.
  bool closed() const { return closed_; }

 private:
  // Triangles sorted into squares of the plane normal to one axis.
  struct Projection {
    int a, b, c;  // axis of the rays; the two directions of the plane
    int bins = 1;
    double lower_b = 0, lower_c = 0, per_b = 0, per_c = 0;
    std::vector<int> start, members;  // triangles of bin n: members[start[n] .. start[n+1])
    int bin(double x, double low, double per) const;
  };
  enum class Vote { outside, inside, surface };

  void sort(Projection& projection);
  Vote vote(const Projection& projection, Vec3 p) const;
  bool crosses(const Projection& projection, const std::array<int, 3>& triangle, Vec3 p) const;
  double height(const Projection& projection, const std::array<int, 3>& triangle, Vec3 p) const;
  Bounds bounds_of(const std::array<int, 3>& triangle) const;

  Triangulation surface_;
  std::array<Projection, 3> projections_;
  Bounds bounds_;
  bool closed_ = true;
};

}  // namespace sluice
