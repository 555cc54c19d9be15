// Bonds that a pre-crack cuts.
//
// The bond from A to B crosses a plane n.(X - a) = 0 where f(A) = n.(A - a) and f(B) have different
// signs; 0 counts as above. It does so at P = A + (B - A) f(A)/(f(A) - f(B)), which must lie in the
// segment, parallelogram or disk, widened by a margin.
#include <cmath>

#include "peridynamics/bonds/families.hpp"

namespace sluice::peridynamics {

bool crosses(const PreCrack& crack, Vec3 a, Vec3 b, double margin) {
  Vec3 n;
  switch (crack.shape) {
    case PreCrack::Shape::segment: {
      const Vec3 along = crack.b - crack.a;
      n = {-along.y, along.x, 0};
      break;
    }
    case PreCrack::Shape::rectangle:
      n = cross(crack.b, crack.c);
      break;
    case PreCrack::Shape::disk:
      n = crack.b;
      break;
  }
  const double fa = dot(n, a - crack.a), fb = dot(n, b - crack.a);
  if ((fa >= 0) == (fb >= 0)) return false;
  const Vec3 p = a + (fa / (fa - fb)) * (b - a) - crack.a;
  // Of a place along an edge e, its length less the margin: -margin <= p.e/|e| <= |e| + margin.
  const auto within = [&](double along, double square) {
    const double length = std::sqrt(square);
    return along >= -margin * length && along <= square + margin * length;
  };
  switch (crack.shape) {
    case PreCrack::Shape::segment: {
      const Vec3 e = crack.b - crack.a;
      return within(p.x * e.x + p.y * e.y, e.x * e.x + e.y * e.y);
    }
    case PreCrack::Shape::rectangle:
      return within(dot(p, crack.b), dot(crack.b, crack.b)) &&
             within(dot(p, crack.c), dot(crack.c, crack.c));
    case PreCrack::Shape::disk:
      return std::sqrt(dot(p, p)) <= crack.radius + margin;
  }
  return false;
}

}  // namespace sluice::peridynamics
