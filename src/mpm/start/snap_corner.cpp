#include "mpm/start/snap_corner.hpp"

#include <cmath>
#include <cstdlib>
#include <optional>

namespace sluice::mpm {
namespace {

constexpr double min_displacement = 1e-9;  // of a part: the corner lies on the surface
constexpr double beside = 1e-6;            // of a part: points just inside and just outside
constexpr int bisections = 60;

// In units of parts, from the corner; directions in their order among the active ones.
using Way = std::array<double, 3>;

class Surface {
 public:
  Surface(const GeometryPiece& piece, const LatticeCorner& corner)
      : piece_(piece), corner_(corner) {}

  Vec3 place(const Way& w) const {
    Vec3 p = corner_.place;
    for (int a = 0; a < corner_.count; ++a) {
      const int d = corner_.active[a];
      const double way = w[a];
      if (std::fabs(way) > min_displacement) p[d] += way * corner_.step[d];
    }
    return p;
  }
  bool inside(const Way& w) const {
    Vec3 p = corner_.place;
    for (int a = 0; a < corner_.count; ++a) {
      const int d = corner_.active[a];
      p[d] += w[a] * corner_.step[d];
    }
    return piece_.inside(p);
  }

  // The first crossing on the way from `from` along a direction, at most `far` of it.
  std::optional<Way> crossing(const Way& from, const Way& along, double far) const {
    constexpr int segments = 16;
    const bool start = inside(from);
    double low = 0;
    for (int n = 1; n <= segments; ++n) {
      double high = far * n / segments;
      if (inside(at(from, along, high)) == start) {
        low = high;
        continue;
      }
      for (int b = 0; b < bisections; ++b) {
        const double middle = 0.5 * (low + high);
        (inside(at(from, along, middle)) == start ? low : high) = middle;
      }
      return at(from, along, 0.5 * (low + high));
    }
    return std::nullopt;
  }

  static Way at(const Way& from, const Way& along, double t) {
    Way w = from;
    for (std::size_t a = 0; a < 3; ++a) w[a] += t * along[a];
    return w;
  }

 private:
  const GeometryPiece& piece_;
  const LatticeCorner& corner_;
};

// By active direction: +1 where parts of these bits lie on the low side alone (outward is up), -1
// on the high side alone, 0 on both.
std::array<int, 3> outward_of(const LatticeCorner& corner, unsigned bits) {
  std::array<int, 3> outward{};
  for (int a = 0; a < corner.count; ++a) {
    bool low = false, high = false;
    for (int k = 0; k < 1 << corner.count; ++k)
      if (bits >> k & 1) (k >> a & 1 ? high : low) = true;
    if (low != high) outward[a] = low ? 1 : -1;
  }
  return outward;
}

// Along each outward direction of a body from its filled parts (`body`: inside() is that of the
// body, else of the space around it); nothing where the surface is not square there.
std::optional<Way> square_corner(const Surface& surface, const LatticeCorner& corner,
                                 const std::array<int, 3>& outward, bool body) {
  const auto stays = [&](std::size_t a) {
    return outward[a] == 0 || corner.fixed[corner.active[a]];
  };
  Way base{}, w{};
  for (std::size_t a = 0; a < 3; ++a) base[a] = -0.5 * outward[a];
  if (surface.inside(base) != body) return std::nullopt;
  bool moves = false;
  for (std::size_t a = 0; a < 3; ++a) {
    if (stays(a)) continue;
    Way along{};
    along[a] = outward[a];
    const auto found = surface.crossing(base, along, 1 + min_displacement);
    if (!found) return std::nullopt;
    w[a] = (*found)[a];
    moves = true;
  }
  if (!moves) return std::nullopt;
  Way within = w;
  for (std::size_t a = 0; a < 3; ++a) within[a] -= beside * outward[a];
  if (surface.inside(within) != body) return std::nullopt;
  for (std::size_t a = 0; a < 3; ++a) {
    if (stays(a)) continue;
    Way beyond = within;
    beyond[a] += 2 * beside * outward[a];
    if (surface.inside(beyond) == body) return std::nullopt;
  }
  return w;
}

// Outward normal: minus the sum of the ways to points of a small lattice that are inside. Whole
// numbers, so that nothing of it depends on an order.
Way normal_of(const Surface& surface, const LatticeCorner& corner) {
  const int reach = corner.count == 3 ? 4 : 8;
  const auto span = [&](int a) { return corner.count > a ? reach : 0; };
  std::array<int, 3> sum{};
  for (int k = -span(2); k <= span(2); ++k)
    for (int j = -span(1); j <= span(1); ++j)
      for (int i = -reach; i <= reach; ++i) {
        const Way w{1.0 * i / reach, 1.0 * j / reach, 1.0 * k / reach};
        const int sign = surface.inside(w) ? -1 : 1;
        sum[0] += sign * i;
        sum[1] += sign * j;
        sum[2] += sign * k;
      }
  Way n{};
  double kept = 0;  // the largest component along a direction in which the corner stays
  for (int a = 0; a < corner.count; ++a) {
    if (corner.fixed[corner.active[a]])
      kept = std::fmax(kept, std::abs(sum[a]));
    else
      n[a] = sum[a];
  }
  double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  // A surface that lies along a side of the domain cannot be reached along the side.
  if (length < kept) length = 0;
  for (double& component : n) component = length > 0 ? component / length : 0;
  return n;
}

}  // namespace

Vec3 on_surface(const GeometryPiece& piece, const LatticeCorner& corner) {
  const Surface surface(piece, corner);
  const unsigned all = (1u << (1 << corner.count)) - 1;
  for (const bool body : {true, false}) {
    const unsigned bits = body ? corner.filled : all & ~corner.filled;
    if (const auto w = square_corner(surface, corner, outward_of(corner, bits), body))
      return surface.place(*w);
  }
  Way along = normal_of(surface, corner);
  if (along == Way{}) return corner.place;
  if (!surface.inside({}))
    for (double& component : along) component = -component;
  const double half_diagonal = 0.5 * std::sqrt(static_cast<double>(corner.count));
  if (const auto w = surface.crossing({}, along, half_diagonal * (1 + min_displacement)))
    return surface.place(*w);
  return corner.place;
}

}  // namespace sluice::mpm
