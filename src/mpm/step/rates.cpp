#include "mpm/step/rates.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/largest.hpp"
#include "mpm/material/base/batch_math.hpp"
#include "mpm/material/base/material.hpp"
#include "mpm/shape/weights.hpp"
#include "mpm/transfer/corners.hpp"

namespace sluice::mpm {
namespace {

// Of one particle or of eight: a row of a tensor.
template <class T>
struct Row {
  T x, y, z;
};

// Row d of F^-1; `at`: a reader of columns.
template <class At>
[[gnu::always_inline]] inline auto inverse_row(const Nine<const double>& F, int d, const At& at) {
  const auto f = [&](int r, int c) { return at(F[static_cast<std::size_t>(3 * (r % 3) + c % 3)]); };
  using T = decltype(f(0, 0));
  T J{}, row[3];
  for (int k = 0; k < 3; ++k) {
    row[k] = f(k + 1, d + 1) * f(k + 2, d + 2) - f(k + 1, d + 2) * f(k + 2, d + 1);
    J += f(k, d) * row[k];
  }
  const T inverse = 1.0 / J;
  return Row<T>{inverse * row[0], inverse * row[1], inverse * row[2]};
}

// c_ref of a particle.
double wave_of_reference(const Nine<const double>& F_columns, std::size_t p, double c, double mu) {
  const std::array<double, 6> b = left_cauchy_green(at(F_columns, static_cast<int>(p)));
  std::array<double, 6> inverse{};  // of b: F^-T F^-1
  for (int d = 0; d < 3; ++d) {
    const Row<double> row = inverse_row(F_columns, d, OneOf{p});
    const double products[6] = {row.x * row.x, row.y * row.y, row.z * row.z,
                                row.y * row.z, row.x * row.z, row.x * row.y};
    for (std::size_t n = 0; n < 6; ++n) inverse[n] += products[n];
  }
  const auto largest_of = [](const std::array<double, 6>& s) {
    const double mean = (s[0] + s[1] + s[2]) * (1.0 / 3);
    return mean + eigenvalue_reach(s, mean);
  };
  return std::sqrt(std::max(c * c - mu * largest_of(b), 0.0) * largest_of(inverse) + mu);
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
  // What is no number must survive: the step is then rejected.
  keep_larger(tension, o.tension);
  affine = std::max(affine, o.affine);
  keep_larger(extent, o.extent);
  slope = std::max(slope, o.slope);
  wave = std::max(wave, o.wave);
  energy = std::max(energy, o.energy);
}

double KindRates::most_kinetic() const {
  double square = 0;
  for (int d = 0; d < 3 && any(); ++d) {
    const double most = std::max(std::fabs(up[d]), std::fabs(down[d]));
    square += most * most;
  }
  return 0.5 * mass * square;
}

void KindRates::to(std::span<double> kept) const {
  const double all[count] = {mass,    up.x,   up.y,   up.z,  down.x, down.y, down.z,
                             tension, affine, extent, slope, wave,   energy};
  std::copy_n(all, count, kept.begin());
}

KindRates KindRates::from(std::span<const double> k) {
  KindRates r;
  r.mass = k[0];
  r.up = {k[1], k[2], k[3]};
  r.down = {k[4], k[5], k[6]};
  r.tension = k[7];
  r.affine = k[8];
  r.extent = k[9];
  r.slope = k[10];
  r.wave = k[11];
  r.energy = k[12];
  return r;
}

KindRates rates_of(Basis basis, const TransferGrid& grid, const ParticleSet& set,
                   const ParticleSet& now, const Columns& c, std::size_t begin, std::size_t end) {
  KindRates r;
  const auto column = [&](int first, int n) {
    return now.column(static_cast<std::size_t>(first + n));
  };
  const double* mass = set.column(static_cast<std::size_t>(c.mass));
  r.mass = largest(begin, end, 0, [&](auto at) { return at(mass); });
  for (int d = 0; d < 3; ++d) {
    const double* v = column(c.velocity, d);
    r.up[d] = largest(begin, end, r.up[d], [&](auto at) { return at(v); });
    r.down[d] = largest(begin, end, r.down[d], [&](auto at) { return -at(v); });
  }
  const double* volume = column(c.volume, 0);
  const double* q = c.viscous >= 0 ? column(c.viscous, 0) : nullptr;
  for (int n = 0; n < 6; ++n) {
    const double* s = column(c.stress, n);
    // Of each particle: sums of maxima would depend on which particles go together.
    r.tension =
        q == nullptr
            ? largest(begin, end, r.tension, [&](auto at) { return magnitude(at(volume) * at(s)); })
            : largest(begin, end, r.tension,
                      [&](auto at) { return magnitude(at(volume) * at(s)) + at(volume) * at(q); });
  }
  const double* energy = column(c.energy, 0);
  r.energy = largest(begin, end, 0, [&](auto at) { return magnitude(at(energy)); });
  for (int n = 0; n < 9 && c.affine >= 0; ++n) {
    const double* a = column(c.affine, n);
    r.affine = largest(begin, end, r.affine, [&](auto at) { return magnitude(at(a)); });
  }
  for (int n = 0; n < 3 && c.spin >= 0; ++n) {
    const double* w = column(c.spin, n);
    r.affine = largest(begin, end, r.affine, [&](auto at) { return magnitude(at(w)); });
  }
  if (by_corners(basis)) {
    ParticleShape shape = shape_of(set, c);
    shape.F = read_columns<9>(now, c.F);
    shape.corners = corners_of(now, c);
    const CornerReach reach =
        corner_reach(basis, grid, shape, static_cast<int>(begin), static_cast<int>(end));
    r.extent = reach.extent;
    r.slope = reach.slope;
  }
  if (c.reference >= 0) {
    const Nine<const double> F = read_columns<9>(now, c.F);
    r.slope = largest(begin, end, 0, [&](auto at) {
      decltype(at(volume)) sum{};
      for (int a = 0; a < grid.count; ++a) {
        const int d = grid.active[static_cast<std::size_t>(a)];
        const auto row = inverse_row(F, d, at);
        sum += (magnitude(row.x) + magnitude(row.y) + magnitude(row.z)) *
               grid.axes[static_cast<std::size_t>(d)].inverse;
      }
      return sum;
    });
  }
  return r;
}

double step_rate(const Level& level, const ParticleSet& set, const Columns& columns,
                 const Material& law, std::size_t at, int n, const double* c) {
  Nine<const double> F = read_columns<9>(set, columns.F);
  for (const double*& column : F) column += at;
  const double mu = law.wave_stiffening();
  if (columns.reference >= 0 && mu > 0) {
    double waves[chunk_size];
    for (int q = 0; q < n; ++q)
      waves[q] = wave_of_reference(F, static_cast<std::size_t>(q), c[q], mu);
    return wave_rate(level, n, waves);
  }
  double rate = 0;
  for (int d = 0; d < 3; ++d) {
    if (!level.active[static_cast<std::size_t>(d)]) continue;
    const double* v = set.column(static_cast<std::size_t>(columns.velocity + d)) + at;
    const auto count = static_cast<std::size_t>(n);
    const double most =
        columns.reference >= 0
            ? largest(0, count, 0,
                      [&](auto of) {
                        const auto row = inverse_row(F, d, of);
                        return of(c) * square_root(row.x * row.x + row.y * row.y + row.z * row.z);
                      })
            : largest(0, count, 0, [&](auto of) { return of(c) + magnitude(of(v)); });
    keep_larger(rate, most / level.spacing[d]);
  }
  return rate;
}

double wave_rate(const Level& level, int n, const double* c) {
  double inverse = 0;
  const double most = largest(0, static_cast<std::size_t>(n), 0, [&](auto at) { return at(c); });
  for (int d = 0; d < 3; ++d)
    if (level.active[static_cast<std::size_t>(d)])
      inverse = std::max(inverse, 1 / level.spacing[d]);
  return most * inverse;
}

}  // namespace sluice::mpm
