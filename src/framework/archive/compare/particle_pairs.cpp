// Points in bins about as wide as their distance; a search looks at rings of bins.
#include "framework/archive/compare/particle_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sluice {
namespace {

double square_distance(Vec3 a, Vec3 b) {
  const Vec3 d = a - b;
  return dot(d, d);
}

class PointBins {
 public:
  explicit PointBins(const std::vector<Vec3>& points) : points_(points) {
    low_ = points.front();
    Vec3 high = low_;
    for (const Vec3& p : points)
      for (int d = 0; d < 3; ++d) {
        low_[d] = std::min(low_[d], p[d]);
        high[d] = std::max(high[d], p[d]);
      }
    choose_width(high - low_);
    begin_.assign(static_cast<std::size_t>(count_.x) * count_.y * count_.z + 1, 0);
    for (const Vec3& p : points) ++begin_[number(bin_of(p)) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    members_.resize(points.size());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t n = 0; n < points.size(); ++n) members_[next[number(bin_of(points[n]))]++] = n;
  }

  std::size_t nearest(Vec3 p) const {
    const IntVec3 centre = bin_of(p);
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    const int most = std::max({count_.x, count_.y, count_.z});
    // Whatever lies in ring r is at least r - 1 widths away, from outside the bins too.
    for (int r = 0; r <= most && (r < 2 || (r - 1) * width_ * ((r - 1) * width_) <= least); ++r)
      search_ring(centre, r, p, best, least);
    return best;
  }

 private:
  void choose_width(Vec3 size) {
    const double longest = std::max({size.x, size.y, size.z});
    double volume = 1;
    int directions = 0;
    for (int d = 0; d < 3; ++d)
      if (size[d] > 1e-6 * longest) {
        volume *= size[d];
        ++directions;
      }
    const auto n = static_cast<double>(points_.size());
    width_ = directions == 0 ? 1.0 : std::pow(volume / n, 1.0 / directions);
    for (int d = 0; d < 3; ++d)
      count_[d] = static_cast<int>(std::min(size[d] / width_, 4 * std::cbrt(n) + 1000)) + 1;
  }
  IntVec3 bin_of(Vec3 p) const {
    IntVec3 bin;
    for (int d = 0; d < 3; ++d) {
      const double place = std::floor((p[d] - low_[d]) / width_);
      bin[d] = static_cast<int>(std::clamp(place, 0.0, count_[d] - 1.0));
    }
    return bin;
  }
  std::size_t number(IntVec3 bin) const {
    return bin.x + count_.x * (bin.y + static_cast<std::size_t>(count_.y) * bin.z);
  }
  void search_ring(IntVec3 centre, int r, Vec3 p, std::size_t& best, double& least) const {
    const IndexBox all{{0, 0, 0}, count_};
    const IndexBox ring =
        intersection(IndexBox{centre, centre + IntVec3{1, 1, 1}}.grown({r, r, r}), all);
    for_each_cell(ring, [&](IntVec3 bin) {
      const IntVec3 off = bin - centre;
      if (std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}) != r) return;
      const std::size_t b = number(bin);
      for (std::size_t m = begin_[b]; m < begin_[b + 1]; ++m) {
        const double d = square_distance(points_[members_[m]], p);
        if (d < least) {
          least = d;
          best = members_[m];
        }
      }
    });
  }

  const std::vector<Vec3>& points_;
  Vec3 low_{};
  double width_ = 1;
  IntVec3 count_{1, 1, 1};
  std::vector<std::size_t> begin_, members_;
};

std::vector<Vec3> places_of(const ParticleTable& t) {
  std::vector<Vec3> points;
  for (std::size_t n = 0; n < t.size(); ++n) points.push_back(t.position(n));
  return points;
}

std::size_t place_of_number(const ParticleTable& t, std::int64_t id) {
  const auto found = std::lower_bound(t.ids.begin(), t.ids.end(), id);
  return found != t.ids.end() && *found == id ? static_cast<std::size_t>(found - t.ids.begin())
                                              : t.size();
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> mutual_nearest(const std::vector<Vec3>& a,
                                                                const std::vector<Vec3>& b) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  if (a.empty() || b.empty()) return pairs;
  const PointBins in_a(a), in_b(b);
  for (std::size_t n = 0; n < a.size(); ++n) {
    const std::size_t m = in_b.nearest(a[n]);
    if (in_a.nearest(b[m]) == n) pairs.emplace_back(n, m);
  }
  return pairs;
}

ParticlePairs ParticlePairing::pair(const ParticleTable& a, const ParticleTable& b) {
  ParticlePairs found;
  const bool numbered = a.numbered && b.numbered;
  found.by_number = numbered && (partners_ || a.ids == b.ids);
  if (found.by_number) {
    for (std::size_t n = 0; n < a.size(); ++n) {
      std::int64_t id = a.ids[n];
      if (partners_) {
        const auto partner = partners_->find(id);
        if (partner == partners_->end()) continue;
        id = partner->second;
      }
      const std::size_t m = place_of_number(b, id);
      if (m < b.size()) found.places.emplace_back(n, m);
    }
    return found;
  }
  found.places = mutual_nearest(places_of(a), places_of(b));
  if (numbered) partners_.emplace();
  for (const auto& [n, m] : found.places) {
    found.farthest =
        std::max(found.farthest, std::sqrt(square_distance(a.position(n), b.position(m))));
    if (numbered) partners_->emplace(a.ids[n], b.ids[m]);
  }
  return found;
}

}  // namespace sluice
