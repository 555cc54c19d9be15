// The part of a box inside a piece, by lines.
#include "mpm/start/cut_cell.hpp"

#include <algorithm>

namespace sluice::mpm {
namespace {

constexpr int segments = 4;     // of a line, within which one crossing is looked for
constexpr int bisections = 21;  // of a segment: 1e-7 of the line

// A line of the box along direction d.
class Line {
 public:
  Line(const GeometryPiece& piece, const Bounds& box, int d, Vec3 at)
      : piece_(piece), lower_(box.lower[d]), length_(box.upper[d] - box.lower[d]), d_(d), at_(at) {}

  bool inside(double s) const {  // s from 0 to 1
    Vec3 p = at_;
    p[d_] = lower_ + s * length_;
    return piece_.inside(p);
  }

  // Length inside and its first moment, of a line of length 1.
  struct Moments {
    double length = 0, moment = 0;
  };
  Moments measure() const {
    Moments m;
    bool before = inside(0);
    for (int n = 0; n < segments; ++n) {
      const double a = static_cast<double>(n) / segments, b = static_cast<double>(n + 1) / segments;
      const bool after = inside(b);
      const double crossing = before == after ? b : crossing_between(a, b, before);
      if (before) add(m, a, crossing);
      if (after) add(m, before == after ? b : crossing, b);
      before = after;
    }
    return m;
  }

 private:
  static void add(Moments& m, double a, double b) {
    m.length += b - a;
    m.moment += 0.5 * (b - a) * (b + a);
  }
  double crossing_between(double a, double b, bool inside_a) const {
    for (int n = 0; n < bisections; ++n) {
      const double middle = 0.5 * (a + b);
      (inside(middle) == inside_a ? a : b) = middle;
    }
    return 0.5 * (a + b);
  }

  const GeometryPiece& piece_;
  double lower_, length_;
  int d_;
  Vec3 at_;
};

// Calls f(place) for n lines a direction, in the middles of equal parts of the box's cross-section.
template <class F>
void for_lines(const Bounds& box, int d, int n, std::array<bool, 3> active, F&& f) {
  const int e = (d + 1) % 3, g = (d + 2) % 3;
  const int n_e = active[e] ? n : 1;
  const int n_g = active[g] ? n : 1;
  for (int j = 0; j < n_g; ++j)
    for (int i = 0; i < n_e; ++i) {
      Vec3 at{};
      at[e] = box.lower[e] + (i + 0.5) / n_e * (box.upper[e] - box.lower[e]);
      at[g] = box.lower[g] + (j + 0.5) / n_g * (box.upper[g] - box.lower[g]);
      f(at);
    }
}

// The direction whose lines the surface crosses most often; -1: it crosses none.
int crossed_direction(const GeometryPiece& piece, const Bounds& box, std::array<bool, 3> active) {
  int best = -1, most = 0;
  for (int d = 0; d < 3; ++d) {
    if (!active[d]) continue;
    int crossed = 0;
    for_lines(box, d, 4, active, [&](Vec3 at) {
      const Line line(piece, box, d, at);
      bool before = line.inside(0);
      for (int n = 1; n <= segments; ++n) {
        const bool after = line.inside(static_cast<double>(n) / segments);
        crossed += before != after;
        before = after;
      }
    });
    if (crossed > most) {
      most = crossed;
      best = d;
    }
  }
  return best;
}

}  // namespace

CutPart part_inside(const GeometryPiece& piece, const Bounds& box, std::array<bool, 3> active) {
  CutPart part;
  part.centroid = 0.5 * (box.lower + box.upper);
  const int d = crossed_direction(piece, box, active);
  if (d < 0) {
    part.share = piece.inside(part.centroid) ? 1 : 0;
    return part;
  }
  const bool flat = std::count(active.begin(), active.end(), true) < 3;
  double length = 0;
  int lines = 0;
  Vec3 moment{};
  for_lines(box, d, flat ? 32 : 12, active, [&](Vec3 at) {
    const auto m = Line(piece, box, d, at).measure();
    at[d] = 0;
    length += m.length;
    moment += m.length * at;
    moment[d] += box.lower[d] * m.length + (box.upper[d] - box.lower[d]) * m.moment;
    ++lines;
  });
  if (length == 0) return part;
  part.share = length / lines;
  part.centroid = (1 / length) * moment;
  return part;
}

}  // namespace sluice::mpm
