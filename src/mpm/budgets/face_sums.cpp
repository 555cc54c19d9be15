#include "mpm/budgets/face_sums.hpp"

#include <cmath>

#include "solids/corner_volume.hpp"

namespace sluice::mpm {
namespace {

// Weight of one node and its derivative at a distance of r >= 0 cells (h = 1).
struct Weight {
  double w = 0, d = 0;
};

Weight hat(double r) {
  return r < 1 ? Weight{1 - r, -1} : Weight{};
}

Weight gimp(double r, double l) {
  if (r < l) return {1 - (r * r + l * l) / (2 * l), -r / l};
  if (r < 1 - l) return {1 - r, -1};
  if (r < 1 + l) return {(1 + l - r) * (1 + l - r) / (4 * l), -(1 + l - r) / (2 * l)};
  return {};
}

Weight cubic(double r) {
  if (r < 1) return {2.0 / 3 - r * r + 0.5 * r * r * r, -2 * r + 1.5 * r * r};
  if (r < 2) return {(2 - r) * (2 - r) * (2 - r) / 6, -0.5 * (2 - r) * (2 - r)};
  return {};
}

// What a particle gives to the nodes of a side and to those beyond it; gradients in 1/m.
struct Share {
  double on = 0;
  Vec3 slope_on{}, slope_beyond{};
};

class Face {
 public:
  Face(const MpmScene& solids, const Level& level, Side side, const ParticleSet& set,
       const Carried& carried)
      : basis_(solids.basis),
        d_(direction_of(side)),
        inward_(is_plus(side) ? -1.0 : 1.0),
        spacing_(level.spacing),
        half_(carried.half[d_]) {
    const int edge = is_plus(side) ? level.domain.upper[d_] : level.domain.lower[d_];
    place_ = level.anchor[d_] + edge * level.spacing[d_];
    const Columns& c = carried.columns;
    if (c.half >= 0) halves_ = set.column(c.half + d_);
    F_ = read_columns<9>(set, c.F);
    size_ = read_columns<9>(set, c.size);
    corners_ = corners_of(set, c);
    for (int d = 0; d < 3; ++d)
      if (level.active[d]) active_.list[active_.count++] = d;
  }

  // Of a particle at x: cells into the domain.
  double depth(double x) const { return inward_ * (x - place_) / spacing_[d_]; }

  Share share_of(std::size_t p, double s) const {
    if ((basis_ == Basis::cpdi || basis_ == Basis::fast_cpdi) && size_[0] != nullptr)
      return corner_share(p, s);
    if (corners_[0] != nullptr) {
      if (active_.count == 3) return carried_share<3>(p);
      return active_.count == 2 ? carried_share<2>(p) : carried_share<1>(p);
    }
    Weight on, beyond;
    if (basis_ == Basis::cubic) {
      on = cubic(std::fabs(s));
      beyond = cubic(s + 1);
    } else if (basis_ == Basis::linear || basis_ == Basis::cpti) {
      on = hat(std::fabs(s));
    } else {
      const double l = halves_ != nullptr ? halves_[p] : half_;
      on = gimp(std::fabs(s), l);
      beyond = gimp(s + 1, l);
    }
    Share share;
    share.on = on.w;
    share.slope_on[d_] = (s < 0 ? -on.d : on.d) * inward_ / spacing_[d_];
    share.slope_beyond[d_] = beyond.d * inward_ / spacing_[d_];
    return share;
  }

 private:
  // The full edge vectors of a particle: F diag(h) R_0, columns.
  std::array<Vec3, 3> edges(std::size_t p) const {
    std::array<Vec3, 3> edge{};
    for (std::size_t c = 0; c < 3; ++c)
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
          edge[c][i] += F_[3 * i + k][p] * spacing_[k] * size_[3 * k + c][p];
    return edge;
  }

  // sum over corners of N/8, and of alpha_c N, alpha_c = E^-T s_c/4.
  Share corner_share(std::size_t p, double s) const {
    const std::array<Vec3, 3> e = edges(p);
    // Rows of E^-1: cross products over the determinant.
    const std::array<Vec3, 3> cross_of = {cross(e[1], e[2]), cross(e[2], e[0]), cross(e[0], e[1])};
    const double det = dot(e[0], cross_of[0]);
    Share share;
    for (int corner = 0; corner < 8; ++corner) {
      double at = s;
      Vec3 alpha{};
      for (int k = 0; k < 3; ++k) {
        const double sign = (corner >> k) % 2 == 0 ? -1.0 : 1.0;
        at += 0.5 * sign * inward_ * e[k][d_] / spacing_[d_];
        alpha = alpha + (0.25 * sign / det) * cross_of[k];
      }
      const double on = hat(std::fabs(at)).w, beyond = at < 0 ? -at : 0.0;
      share.on += on / 8;
      share.slope_on = share.slope_on + on * alpha;
      share.slope_beyond = share.slope_beyond + beyond * alpha;
    }
    return share;
  }

  // sum over corners of 2^-D N, and of b_k/V N.
  template <int D>
  Share carried_share(std::size_t p) const {
    solids::CornerVolume<D> v;
    solids::read_carried<D>(corners_, active_.list, OneOf{p}, v.x);
    double at[1 << D];
    for (int c = 0; c < v.count; ++c) at[c] = depth(corners_[3 * c + d_][p]);
    v.find();
    Share share;
    for (int c = 0; c < v.count; ++c) {
      const double on = hat(std::fabs(at[c])).w, beyond = at[c] < 0 ? -at[c] : 0.0;
      share.on += on / v.count;
      for (int a = 0; a < D; ++a) {
        const int e = active_.list[a];
        share.slope_on[e] += on * v.b[c][a] / v.volume;
        share.slope_beyond[e] += beyond * v.b[c][a] / v.volume;
      }
    }
    return share;
  }

  Basis basis_;
  int d_;
  double inward_;
  Vec3 spacing_;
  double half_, place_ = 0;
  const double* halves_ = nullptr;
  std::array<const double*, 9> F_, size_;
  CornerColumns corners_{};
  struct {
    std::array<int, 3> list{};
    int count = 0;
  } active_;
};

Vec3 traction(const std::array<const double*, 6>& s, std::size_t p, Vec3 n) {
  return {s[0][p] * n.x + s[5][p] * n.y + s[4][p] * n.z,
          s[5][p] * n.x + s[1][p] * n.y + s[3][p] * n.z,
          s[4][p] * n.x + s[3][p] * n.y + s[2][p] * n.z};
}

}  // namespace

bool is_mirror(const MpmScene& solids, Side side, int material) {
  for (const SolidBoundary& b : solids.boundaries)
    if (b.kind == SolidBoundary::Kind::symmetric && b.side == side &&
        (b.material < 0 || b.material == material))
      return true;
  return false;
}

void add_face(const MpmScene& solids, const Level& level, Side side, bool mirror,
              const ParticleSet& set, const Carried& carried, ConservedTotal* force,
              ConservedTotal* area) {
  const Face face(solids, level, side, set, carried);
  const int d = direction_of(side);
  const double* x = set.coordinate(d);
  const double* volume = set.column(carried.columns.volume);
  const auto stress = read_columns<6>(set, carried.columns.stress);
  for (std::size_t p = 0; p < set.size(); ++p) {
    const double s = face.depth(x[p]);
    if (!(s < 2.5)) continue;
    const Share share = face.share_of(p, s);
    if (area != nullptr && share.on != 0) area->add(2 * volume[p] * share.on / level.spacing[d]);
    if (force == nullptr) continue;
    const Vec3 on = volume[p] * traction(stress, p, share.slope_on);
    const Vec3 beyond = volume[p] * traction(stress, p, share.slope_beyond);
    for (int k = 0; k < 3; ++k) {
      const double times = !mirror ? 1.0 : k == d ? 2.0 : 0.0;
      force[k].add(on[k] + times * beyond[k]);
    }
  }
}

}  // namespace sluice::mpm
