// The tri piece: what a closed triangulated surface encloses.
#include "framework/geometry/triangulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "framework/base/data_lines.hpp"
#include "framework/base/error.hpp"

namespace sluice {

Triangulation read_triangulation(const std::string& stem) {
  Triangulation t;
  read_table(stem + ".pts", {"x", "y", "z"}, [&](const TableRow& row) {
    t.points.push_back({row[0], row[1], row[2]});
  });
  const int count = static_cast<int>(t.points.size());
  const std::vector<std::string> corners = {"first point", "second point", "third point"};
  read_table(stem + ".tri", corners, [&](const TableRow& row) {
    std::array<int, 3> triangle{};
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(row[i] >= 0 && row[i] < count && row[i] == std::floor(row[i])))
        row.refuse(i, fmt::format("point {} does not exist; {}.pts has points 0 to {}", row[i],
                                  stem, count - 1));
      triangle[i] = static_cast<int>(row[i]);
    }
    t.triangles.push_back(triangle);
  });
  return t;
}

TriangulationPiece::TriangulationPiece(Triangulation surface)
    : surface_(std::move(surface)), bounds_(Bounds::nothing()) {
  if (surface_.triangles.size() < 4)
    throw InputError(fmt::format("tri: {} triangles cannot enclose a volume; at least 4 are needed",
                                 surface_.triangles.size()));
  std::map<std::pair<int, int>, int> edges;
  for (const std::array<int, 3>& t : surface_.triangles) {
    bounds_ = bounding(bounds_, bounds_of(t));
    for (std::size_t i = 0; i < 3; ++i) ++edges[std::minmax(t[i], t[(i + 1) % 3])];
  }
  for (const auto& [edge, uses] : edges) closed_ = closed_ && uses % 2 == 0;
  for (int d = 0; d < 3; ++d) {
    Projection& projection = projections_[d];
    projection.a = d;
    projection.b = (d + 1) % 3;
    projection.c = (d + 2) % 3;
    sort(projection);
  }
}

Bounds TriangulationPiece::bounds_of(const std::array<int, 3>& triangle) const {
  Bounds b = Bounds::nothing();
  for (int i : triangle) {
    const Vec3 p = surface_.points[i];
    b = bounding(b, {p, p});
  }
  return b;
}

int TriangulationPiece::Projection::bin(double x, double low, double per) const {
  return static_cast<int>(std::clamp((x - low) * per, 0.0, bins - 1.0));
}

void TriangulationPiece::sort(Projection& m) {
  // Fine bins: large surfaces of few triangles have long ones, of which a line meets few.
  const double across = std::sqrt(static_cast<double>(surface_.triangles.size()));
  m.bins = std::clamp(static_cast<int>(4 * across), 1, 512);
  auto per = [&](int d) {
    const double width = bounds_.upper[d] - bounds_.lower[d];
    return width > 0 ? m.bins / width : 0;
  };
  m.lower_b = bounds_.lower[m.b];
  m.lower_c = bounds_.lower[m.c];
  m.per_b = per(m.b);
  m.per_c = per(m.c);
  std::vector<std::vector<int>> lists(static_cast<std::size_t>(m.bins) * m.bins);
  for (std::size_t n = 0; n < surface_.triangles.size(); ++n) {
    const Bounds box = bounds_of(surface_.triangles[n]);
    for (int c = m.bin(box.lower[m.c], m.lower_c, m.per_c);
         c <= m.bin(box.upper[m.c], m.lower_c, m.per_c); ++c)
      for (int b = m.bin(box.lower[m.b], m.lower_b, m.per_b);
           b <= m.bin(box.upper[m.b], m.lower_b, m.per_b); ++b)
        lists[b + m.bins * c].push_back(static_cast<int>(n));
  }
  m.start.assign(1, 0);
  for (const std::vector<int>& list : lists) {
    m.members.insert(m.members.end(), list.begin(), list.end());
    m.start.push_back(static_cast<int>(m.members.size()));
  }
}

// Even-odd rule in the plane: edge by edge, each computed from its lower-numbered end.
bool TriangulationPiece::crosses(const Projection& m, const std::array<int, 3>& triangle,
                                 Vec3 p) const {
  bool odd = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [low, high] = std::minmax(triangle[i], triangle[(i + 1) % 3]);
    const Vec3 u = surface_.points[static_cast<std::size_t>(low)];
    const Vec3 v = surface_.points[high];
    if ((u[m.c] > p[m.c]) == (v[m.c] > p[m.c])) continue;
    const double at = u[m.b] + (v[m.b] - u[m.b]) * ((p[m.c] - u[m.c]) / (v[m.c] - u[m.c]));
    odd = odd != (at > p[m.b]);
  }
  return odd;
}

// Where the line through p along the axis meets the triangle's plane, within the triangle's reach.
double TriangulationPiece::height(const Projection& m, const std::array<int, 3>& triangle,
                                  Vec3 p) const {
  const Vec3 o = surface_.points[triangle[0]];
  const Vec3 n = cross(surface_.points[triangle[1]] - o, surface_.points[triangle[2]] - o);
  const Bounds box = bounds_of(triangle);
  if (n[m.a] == 0) return box.lower[m.a];
  const double h = o[m.a] - (n[m.b] * (p[m.b] - o[m.b]) + n[m.c] * (p[m.c] - o[m.c])) / n[m.a];
  return std::clamp(h, box.lower[m.a], box.upper[m.a]);
}

TriangulationPiece::Vote TriangulationPiece::vote(const Projection& m, Vec3 p) const {
  const int n = m.bin(p[m.b], m.lower_b, m.per_b) + m.bins * m.bin(p[m.c], m.lower_c, m.per_c);
  bool odd = false;
  for (int i = m.start[n]; i < m.start[n + 1]; ++i) {
    const std::array<int, 3>& t = surface_.triangles[m.members[i]];
    if (!crosses(m, t, p)) continue;
    const double h = height(m, t, p);
    if (h == p[m.a]) return Vote::surface;
    odd = odd != (h > p[m.a]);
  }
  return odd ? Vote::inside : Vote::outside;
}

bool TriangulationPiece::inside(Vec3 p) const {
  if (!bounds_.contains(p)) return false;
  int yes = 0, no = 0;
  for (const Projection& m : projections_) {
    const Vote v = vote(m, p);
    if (v == Vote::surface) return true;
    if (v == Vote::inside)
      ++yes;
    else
      ++no;
  }
  return yes > no;
}

Cover TriangulationPiece::cover(const Bounds& box) const {
  if (!bounds_.meets(box)) return Cover::none;
  if (!closed_) return Cover::some;
  // No triangle near the box: all of it lies on the same side of the surface.
  const Projection& m = projections_[0];
  const Bounds near = with_margin(box);
  for (int c = m.bin(near.lower[m.c], m.lower_c, m.per_c);
       c <= m.bin(near.upper[m.c], m.lower_c, m.per_c); ++c)
    for (int b = m.bin(near.lower[m.b], m.lower_b, m.per_b);
         b <= m.bin(near.upper[m.b], m.lower_b, m.per_b); ++b) {
      const std::size_t n = b + m.bins * c;
      for (int i = m.start[n]; i < m.start[n + 1]; ++i)
        if (bounds_of(surface_.triangles[m.members[i]]).meets(near)) return Cover::some;
    }
  return inside(box.lower) ? Cover::all : Cover::none;
}

}  // namespace sluice
