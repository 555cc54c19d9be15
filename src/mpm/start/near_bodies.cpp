// Looking for gaps between the parts that particles fill.
#include "mpm/start/near_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "framework/deck/faults.hpp"
#include "framework/geometry/boolean.hpp"
#include "framework/geometry/sampling.hpp"
#include "framework/grid/index_box.hpp"
#include "mpm/start/seed.hpp"

namespace sluice::mpm {
namespace {

constexpr std::int64_t max_cells = 200'000;  // around two bodies; more are not looked at
constexpr double round_off = 1e-6;           // of a cell
constexpr std::size_t max_pairs_shown = 3;

struct Body {
  const SeedObject* object;
  PiecePtr piece;
  std::size_t together;  // a body that it hangs together with, or itself
};

void add_bodies(const SeedObject& object, const PiecePtr& piece, std::vector<Body>& bodies) {
  if (const auto* whole = dynamic_cast<const UnionPiece*>(piece.get())) {
    for (const PiecePtr& member : whole->members()) add_bodies(object, member, bodies);
    return;
  }
  if (piece->points() == nullptr) bodies.push_back({&object, piece, bodies.size()});
}

std::size_t first_of(const std::vector<Body>& bodies, std::size_t n) {
  while (bodies[n].together != n) n = bodies[n].together;
  return n;
}

// The parts that hold particles, cell by cell, of one body in a window.
class BodyPositions {
 public:
  BodyPositions(const Body& body, const Level& level, const IndexBox& window)
      : body_(body),
        level_(level),
        window_(window),
        lattice_{level.anchor, level.spacing},
        counts_(count_inside(*body.piece, lattice_, window.lower, window.upper,
                             body.object->per_cell)) {}

  bool any(IntVec3 cell) const {
    if (!window_.contains(cell)) return false;
    const IntVec3 n = window_.size(), r = cell - window_.lower;
    return counts_[r.x + n.x * (r.y + static_cast<std::size_t>(n.y) * r.z)] > 0;
  }
  std::vector<Vec3> in(IntVec3 cell) const {
    std::vector<Vec3> places;
    const IntVec3 res = body_.object->per_cell;
    for_each_cell({{0, 0, 0}, res}, [&](IntVec3 s) {
      Vec3 p;
      for (int d = 0; d < 3; ++d) p[d] = lattice_.sub_point(d, cell[d], s[d], res[d]);
      if (body_.piece->inside(p)) places.push_back(p);
    });
    return places;
  }
  // Of a part, in cells.
  double width(int d) const { return 1.0 / body_.object->per_cell[d]; }
  const Level& level() const { return level_; }
  const Body& body() const { return body_; }

 private:
  const Body& body_;
  const Level& level_;
  IndexBox window_;
  CellLattice lattice_;
  std::vector<std::int32_t> counts_;
};

// The gap between the parts of two places, in cells, along the direction in which it is widest.
double gap_of(const BodyPositions& a, Vec3 p, const BodyPositions& b, Vec3 q) {
  double gap = 0;
  for (int d = 0; d < 3; ++d) {
    if (a.level().domain.size()[d] == 1) continue;
    const double apart = std::abs(p[d] - q[d]) / a.level().spacing[d];
    gap = std::max(gap, apart - 0.5 * (a.width(d) + b.width(d)));
  }
  return gap;
}

// Where the piece ends on the way from a place inside to one outside.
Vec3 end_of(const GeometryPiece& piece, Vec3 inside, Vec3 outside) {
  for (int halving = 0; halving < 30; ++halving) {
    const Vec3 middle = 0.5 * (inside + outside);
    (piece.inside(middle) ? inside : outside) = middle;
  }
  return inside;
}

// Between the surfaces on the way between two places, in cells, likewise.
double gap_of_surfaces(const Body& a, Vec3 p, const Body& b, Vec3 q, const Level& level) {
  const Vec3 from = end_of(*a.piece, p, q), to = end_of(*b.piece, q, p);
  if (b.piece->inside(from) || a.piece->inside(to)) return 0;
  double gap = 0;
  for (int d = 0; d < 3; ++d) gap = std::max(gap, std::abs(to[d] - from[d]) / level.spacing[d]);
  return gap;
}

// The least gaps between two bodies in neighbouring cells.
struct Nearest {
  double of_parts = std::numeric_limits<double>::infinity();
  double of_surfaces = std::numeric_limits<double>::infinity();
};

void look_in(const BodyPositions& a, IntVec3 cell, const BodyPositions& b, IntVec3 other,
             Nearest& nearest) {
  const std::vector<Vec3> theirs = b.in(other);
  for (const Vec3 p : a.in(cell))
    for (const Vec3 q : theirs) {
      const double gap = gap_of(a, p, b, q);
      if (gap > std::min(nearest.of_parts, 1.0) + round_off) continue;
      nearest.of_parts = std::min(gap, nearest.of_parts);
      nearest.of_surfaces =
          std::min(nearest.of_surfaces, gap_of_surfaces(a.body(), p, b.body(), q, a.level()));
    }
}

// Cells of the level that are within a cell of both.
IndexBox between(const Body& a, const Body& b, const Level& level) {
  IndexBox window = level.domain;
  for (const Body* body : {&a, &b}) {
    SeedObject alone = *body->object;
    alone.piece = body->piece;
    const IndexBox own = window_of(alone, level);
    if (own.empty()) return {};
    window = intersection(window, own.grown({1, 1, 1}));
  }
  return window;
}

// In cells; 0 where they touch, nothing where they are further apart than a cell.
std::optional<double> gap_between(const Body& a, const Body& b, const Level& level) {
  const IndexBox window = between(a, b, level);
  if (window.empty() || window.volume() > max_cells) return {};
  const BodyPositions first(a, level, window), second(b, level, window);
  Nearest nearest;
  for_each_cell(window, [&](IntVec3 cell) {
    if (nearest.of_parts < round_off || !first.any(cell)) return;
    for_each_cell({cell - IntVec3{1, 1, 1}, cell + IntVec3{2, 2, 2}}, [&](IntVec3 other) {
      if (nearest.of_parts > round_off && second.any(other))
        look_in(first, cell, second, other, nearest);
    });
  });
  // Cells that are not neighbours have no node in common.
  if (nearest.of_parts > 1 + round_off) return {};
  const double gap = nearest.of_parts < round_off ? 0 : nearest.of_surfaces;
  if (gap >= 1) return {};
  return gap < round_off ? 0.0 : gap;
}

struct NearPair {
  std::size_t a, b;
  double gap;
};

void tell(const std::vector<Body>& bodies, const NearPair& pair, std::size_t more,
          std::vector<Fault>& faults) {
  const SeedObject& other = *bodies[pair.a].object;
  std::string text = fmt::format(
      "this body is {:.2g} of a cell away from the one at {}, of the same material: at less than a "
      "cell they move as one and stick together",
      pair.gap, to_string(other.where));
  if (more > 0) text += fmt::format(" ({} more pairs of this material are as close)", more);
  add_warning(faults, bodies[pair.b].object->where, text,
              "give them different materials and a <contact>, or make the cells finer");
}

}  // namespace

void check_near_bodies(const SolidMaterial& material, const Level& level,
                       std::vector<Fault>& faults) {
  if (material.rigid) return;
  std::vector<Body> bodies;
  for (const SeedObject& object : material.objects)
    if (!object.mapped && object.piece != nullptr) add_bodies(object, object.piece, bodies);
  std::vector<NearPair> near;
  for (std::size_t b = 1; b < bodies.size(); ++b)
    for (std::size_t a = 0; a < b; ++a) {
      if (first_of(bodies, a) == first_of(bodies, b)) continue;
      const std::optional<double> gap = gap_between(bodies[a], bodies[b], level);
      if (gap && *gap == 0)
        bodies[first_of(bodies, b)].together = first_of(bodies, a);
      else if (gap)
        near.push_back({a, b, *gap});
    }
  std::erase_if(near, [&](const NearPair& pair) {
    return first_of(bodies, pair.a) == first_of(bodies, pair.b);
  });
  const std::size_t shown = near.size() > max_pairs_shown ? 1 : near.size();
  for (std::size_t n = 0; n < shown; ++n) tell(bodies, near[n], near.size() - shown, faults);
}

}  // namespace sluice::mpm
