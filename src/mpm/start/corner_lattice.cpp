#include "mpm/start/corner_lattice.hpp"

#include "mpm/start/snap_corner.hpp"
#include "solids/corner_volume.hpp"

namespace sluice::mpm {
namespace {

template <int D>
CornerSpan span_in(const std::array<int, 3>& active, const ParticleCorners& corners, Vec3 place) {
  solids::CornerVolume<D> v;
  for (int c = 0; c < v.count; ++c)
    for (int a = 0; a < D; ++a) v.x[c][a] = corners.place[c][active[a]];
  v.find();
  for (int a = 0; a < D; ++a) place[active[a]] = v.middle[a];
  return {v.volume, place};
}

int floor_of(int a, int b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

}  // namespace

CornerSpan span_of(const Level& level, const ParticleCorners& corners, Vec3 place) {
  std::array<int, 3> active{};
  int count = 0;
  for (int d = 0; d < 3; ++d)
    if (level.active[d]) active[count++] = d;
  if (count == 3) return span_in<3>(active, corners, place);
  if (count == 2) return span_in<2>(active, corners, place);
  return span_in<1>(active, corners, place);
}

void span_corners(const Level& level, SeededParticle& row) {
  const CornerSpan span = span_of(level, row.corners, row.x);
  row.x = span.middle;
  row.volume = span.measure;
  for (int d = 0; d < 3; ++d)
    if (!level.active[d]) row.volume *= row.edges[4 * d] * level.spacing[d];
}

CornerLattice::CornerLattice(const SeedObject& object, const Level& level)
    : object_(object), level_(level), lattice_{level.anchor, level.spacing} {
  for (int d = 0; d < 3; ++d) {
    axes_[d] = axis_of(level, d);
    if (level.active[d]) active_[count_++] = d;
    step_[d] = level.spacing[d] / object.per_cell[d];
  }
}

Vec3 CornerLattice::rounded(Vec3 x) const {
  for (int d = 0; d < 3; ++d) x[d] = axes_[d].rounded(x[d]);
  return x;
}

Vec3 CornerLattice::middle_of(IntVec3 number) const {
  Vec3 x;
  for (int d = 0; d < 3; ++d) {
    const int res = object_.per_cell[d], cell = floor_of(number[d], res);
    x[d] = lattice_.sub_point(d, cell, number[d] - cell * res, res);
  }
  return x;
}

// Does a part hold a particle, if it is in the domain. Beyond a periodic end that at the other.
bool CornerLattice::filled(const GeometryPiece* piece, IntVec3 number) const {
  bool wrapped = false;
  for (int d = 0; d < 3 && !object_.mapped; ++d) {
    if (!level_.periodic[d]) continue;
    const int res = object_.per_cell[d], parts = level_.domain.size()[d] * res;
    const int first = level_.domain.lower[d] * res;
    const int turns = floor_of(number[d] - first, parts);
    number[d] -= turns * parts;
    wrapped |= turns != 0;
  }
  if (wrapped) return object_.piece->inside(middle_of(number));
  return piece == nullptr || piece->inside(middle_of(number));
}

bool CornerLattice::seeded(const GeometryPiece* piece, IntVec3 number) const {
  Vec3 x = middle_of(number);
  if (object_.mapped) x = applied(object_.map, x) + object_.shift;
  const IntVec3 cell = lattice_.cell_of(x);
  for (int d = 0; d < 3; ++d)
    if ((object_.mapped || !level_.periodic[d]) &&
        (cell[d] < level_.domain.lower[d] || cell[d] >= level_.domain.upper[d]))
      return false;
  return filled(piece, number);
}

// Number n: the low corner of part n along active directions; along others the part itself.
Vec3 CornerLattice::corner(const GeometryPiece* piece, IntVec3 number, IntVec3 part) {
  LatticeCorner c;
  c.place = middle_of(part);
  c.step = step_;
  c.active = active_;
  c.count = count_;
  for (int a = 0; a < count_; ++a) {
    const int d = active_[a], res = object_.per_cell[d];
    c.place[d] = level_.anchor[d] + (number[d] * level_.spacing[d]) / res;
    c.fixed[d] = !object_.mapped && (number[d] == level_.domain.lower[d] * res ||
                                     number[d] == level_.domain.upper[d] * res);
  }
  const unsigned all = (1u << (1 << count_)) - 1;
  for (int k = 0; k < 1 << count_; ++k) {
    IntVec3 beside = number;
    for (int a = 0; a < count_; ++a) beside[active_[a]] -= k >> a & 1 ? 0 : 1;
    if (filled(piece, beside)) c.filled |= 1u << k;
  }
  if (c.filled == all) return c.place;
  const auto [at, fresh] = moved_.try_emplace({number.x, number.y, number.z});
  if (fresh) at->second = on_surface(piece != nullptr ? *piece : *object_.piece, c);
  return at->second;
}

ParticleCorners CornerLattice::corners_of(const GeometryPiece* piece, IntVec3 cell, IntVec3 part) {
  const IntVec3 number = cell * object_.per_cell + part;
  ParticleCorners to;
  for (int k = 0; k < 1 << count_; ++k) {
    IntVec3 n = number;
    for (int a = 0; a < count_; ++a) n[active_[a]] += k >> a & 1;
    Vec3 x = corner(piece, n, number);
    if (object_.mapped) x = applied(object_.map, x) + object_.shift;
    to.place[k] = rounded(x);
  }
  for (int a = 0; a < count_; ++a)
    for (int side = 0; side < 2; ++side) {
      IntVec3 n = number;
      n[active_[a]] += side == 0 ? -1 : 1;
      if (!seeded(piece, n)) to.outer |= 1 << (2 * a + side);
    }
  return to;
}

ParticleCorners CornerLattice::alone(Vec3 place, const Map& edges) const {
  ParticleCorners to;
  for (int k = 0; k < 1 << count_; ++k) {
    Vec3 x = place;
    for (int a = 0; a < count_; ++a) {
      const int e = active_[a];
      const double sign = k >> a & 1 ? 0.5 : -0.5;
      for (int b = 0; b < count_; ++b) {
        const int d = active_[b];
        x[d] += sign * edges[3 * d + e] * level_.spacing[d];
      }
    }
    to.place[k] = rounded(x);
  }
  to.outer = (1 << (2 * count_)) - 1;
  return to;
}

}  // namespace sluice::mpm
