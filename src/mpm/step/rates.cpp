#include "mpm/step/rates.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::mpm {
namespace {

// The largest of f(i); a NaN wins.
template <class F>
double largest(std::size_t begin, std::size_t end, double from, F&& f) {
  bool sound = true;
  for (std::size_t i = begin; i < end; ++i) {
    const double x = f(i);
    sound &= x == x;
    from = x > from ? x : from;
  }
  return sound ? from : std::nan("");
}

}  // namespace

double KindRates::spread() const {
  double s = 0;
  for (int d = 0; d < 3; ++d) s = std::max(s, 0.5 * (up[d] + down[d]));
  // The middle is rounded.
  double size = 0;
  for (int d = 0; d < 3; ++d) size = std::max({size, std::fabs(up[d]), std::fabs(down[d])});
  return s + 1e-15 * size;
}

void KindRates::add(const KindRates& o) {
  mass = std::max(mass, o.mass);
  up = {std::max(up.x, o.up.x), std::max(up.y, o.up.y), std::max(up.z, o.up.z)};
  down = {std::max(down.x, o.down.x), std::max(down.y, o.down.y), std::max(down.z, o.down.z)};
  // NaN must survive: the step is then rejected.
  tension = o.tension > tension || o.tension != o.tension ? o.tension : tension;
  affine = std::max(affine, o.affine);
}

void KindRates::to(std::span<double> kept) const {
  const double all[count] = {mass, up.x, up.y, up.z, down.x, down.y, down.z, tension, affine};
  std::copy_n(all, count, kept.begin());
}

KindRates KindRates::from(std::span<const double> k) {
  KindRates r;
  r.mass = k[0];
  r.up = {k[1], k[2], k[3]};
  r.down = {k[4], k[5], k[6]};
  r.tension = k[7];
  r.affine = k[8];
  return r;
}

KindRates rates_of(const ParticleSet& set, const ParticleSet& now, const Columns& c,
                   std::size_t begin, std::size_t end) {
  KindRates r;
  const auto column = [&](int first, int n) {
    return now.column(static_cast<std::size_t>(first + n));
  };
  const double* mass = set.column(static_cast<std::size_t>(c.mass));
  r.mass = largest(begin, end, 0, [&](std::size_t i) { return mass[i]; });
  for (int d = 0; d < 3; ++d) {
    const double* v = column(c.velocity, d);
    r.up[d] = largest(begin, end, r.up[d], [&](std::size_t i) { return v[i]; });
    r.down[d] = largest(begin, end, r.down[d], [&](std::size_t i) { return -v[i]; });
  }
  const double* volume = column(c.volume, 0);
  for (int n = 0; n < 6; ++n) {
    const double* s = column(c.stress, n);
    r.tension = largest(begin, end, r.tension,
                        [&](std::size_t i) { return std::fabs(volume[i] * s[i]); });
  }
  if (c.viscous >= 0) {
    const double* q = column(c.viscous, 0);
    r.tension += largest(begin, end, 0, [&](std::size_t i) { return volume[i] * q[i]; });
  }
  for (int n = 0; n < 9 && c.affine >= 0; ++n) {
    const double* a = column(c.affine, n);
    r.affine = largest(begin, end, r.affine, [&](std::size_t i) { return std::fabs(a[i]); });
  }
  return r;
}

}  // namespace sluice::mpm
