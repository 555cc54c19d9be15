#include "mpm/step/carry_corners.hpp"

#include <cmath>

#include "solids/corner_volume.hpp"

namespace sluice::mpm {
namespace {

// act.template operator()<D>() for the directions of a level.
template <class Act>
auto for_directions(int count, Act&& act) {
  if (count == 3) return act.template operator()<3>();
  if (count == 2) return act.template operator()<2>();
  return act.template operator()<1>();
}

// s with s^D = x.
template <int D>
double root(double x) {
  if constexpr (D == 1) return x;
  if constexpr (D == 2) return std::sqrt(x);
  return std::cbrt(x);
}

double determinant(const Nine<double>& F, std::size_t p) {
  const auto f = [&](std::size_t e) { return F[e][p]; };
  return f(0) * (f(4) * f(8) - f(5) * f(7)) - f(1) * (f(3) * f(8) - f(5) * f(6)) +
         f(2) * (f(3) * f(7) - f(4) * f(6));
}

// How many numbers of a particle say how far a corner is from the middle, and are too large.
template <int D, class T>
T far_corners(const TransferGrid& grid, const solids::CornerVolume<D, T>& v) {
  T far{};
  for (int a = 0; a < D; ++a) {
    const auto d = static_cast<std::size_t>(grid.active[static_cast<std::size_t>(a)]);
    for (int k = 0; k < v.count; ++k)
      far +=
          magnitude(v.x[k][a]) * grid.axes[d].inverse <= solids::farthest_corner ? T{} : T{} + 1.0;
  }
  return far;
}

template <int D>
std::optional<BatchFault> deform_batch(const Body& body, const BlockWork& w, std::size_t at,
                                       const Batch& b, GridAtParticles& read) {
  const Columns& c = body.carried->columns;
  const TransferGrid& grid = body.grid;
  const CornerColumns corners = corners_of(*w.next, c);
  const Nine<const double> edges = read_columns<9>(*w.set, c.size);
  const Nine<double> F = write_columns<9>(*w.next, c.F);
  double* volume = w.next->column(static_cast<std::size_t>(c.volume));
  const int part = body.carried->filled;
  const double* filled = part >= 0 ? w.set->column(static_cast<std::size_t>(part)) : nullptr;
  alignas(64) double volumes[chunk_size], far[chunk_size], factors[chunk_size];
  for_eights(0, static_cast<std::size_t>(b.count), [&](auto q) {
    solids::CornerVolume<D, typename decltype(q)::Number> v;
    solids::read_carried<D>(corners, grid.active, q.behind(at), v.x);
    v.find();
    q.put(v.volume, volumes);
    q.put(far_corners(grid, v), far);
  });
  for (int q = 0; q < b.count; ++q) {
    const std::size_t p = at + static_cast<std::size_t>(q);
    volume[p] = volumes[q] * depth_of(grid, edges, p);
    if (filled != nullptr) volume[p] *= filled[p];
    const double J = volume[p] / b.volume_0[q];
    // Written so that what is no number is a fault.
    if (!(J > 0))
      return BatchFault{
          q,
          "its corners enclose nothing any more: it was pressed or sheared too far in "
          "this step; a smaller timestep_multiplier, artificial_viscosity or another "
          "interpolator may carry it; volume/volume_0",
          J};
    if (far[q] != 0)
      return BatchFault{
          q,
          "a corner lies over 1.5 cells from its middle: the body is stretched or torn "
          "there beyond what corners that particles share can follow; finer particles "
          "(res), erosion or another interpolator may; volume/volume_0",
          J};
    factors[q] = root<D>(J / determinant(F, p));
  }
  for (int a = 0; a < D; ++a) {
    const int d = grid.active[static_cast<std::size_t>(a)];
    for (int e = 0; e < 3; ++e) {
      double *f = F[static_cast<std::size_t>(3 * d + e)] + at, *l = read.L[3 * d + e];
      for (int q = 0; q < b.count; ++q) {
        f[q] *= factors[q];
        l[q] *= factors[q];
      }
    }
    for (int q = 0; q < b.count; ++q) read.L[4 * d][q] += (factors[q] - 1) / b.dt;
  }
  return std::nullopt;
}

template <int D>
void find_middles(const Body& body, ParticleSet& next, std::size_t at, int n) {
  const CornerColumns corners = corners_of(next, body.carried->columns);
  const std::array<int, 3>& active = body.grid.active;
  for_eights(at, at + static_cast<std::size_t>(n), [&](auto p) {
    solids::CornerVolume<D, typename decltype(p)::Number> v;
    solids::read_carried<D>(corners, active, p, v.x);
    v.find_middle();
    for (int a = 0; a < D; ++a)
      p.put(v.middle[a], next.coordinate(active[static_cast<std::size_t>(a)]));
  });
}

}  // namespace

Vec3 corner_at(const ParticleSet& set, const Columns& c, int corner, std::size_t p) {
  const auto first = static_cast<std::size_t>(c.corners + 3 * corner);
  return {set.column(first)[p], set.column(first + 1)[p], set.column(first + 2)[p]};
}

void move_corners(const Body& body, const BlockWork& w, std::size_t at, int n, Vec3 reference,
                  double dt, const VelocitiesAtCorners& v) {
  const Columns& c = body.carried->columns;
  const TransferGrid& grid = body.grid;
  for (int k = 0; k < c.corner_count; ++k)
    for (int d = 0; d < 3; ++d) {
      const auto column = static_cast<std::size_t>(c.corners + 3 * k + d);
      const double* x = w.set->column(column) + at;
      double* to = w.next->column(column) + at;
      const double* u = v[k][d];
      const Axis& axis = grid.axes[static_cast<std::size_t>(d)];
      const double of_all = reference[d];
      for (int q = 0; q < n; ++q) to[q] = x[q] + axis.rounded(dt * (of_all + u[q]));
    }
  for_directions(grid.count, [&]<int D>() { find_middles<D>(body, *w.next, at, n); });
}

std::optional<BatchFault> deform_to_corners(const Body& body, const BlockWork& w, std::size_t at,
                                            const Batch& b, GridAtParticles& read) {
  return for_directions(body.grid.count,
                        [&]<int D>() { return deform_batch<D>(body, w, at, b, read); });
}

void wrap_corners(const Level& level, const Columns& c, ParticleSet& set) {
  for (int d = 0; d < 3; ++d) {
    const auto a = static_cast<std::size_t>(d);
    if (!level.active[a] || !level.periodic[a]) continue;
    const double length = axis_of(level, d).rounded(level.domain.size()[d] * level.spacing[d]);
    const double* x = set.coordinate(d);
    const auto column = [&](int k) {
      return set.column(static_cast<std::size_t>(c.corners + 3 * k + d));
    };
    for (std::size_t p = 0; p < set.size(); ++p) {
      // Half way between opposite corners is near enough to the middle.
      const double middle = 0.5 * (column(0)[p] + column(c.corner_count - 1)[p]);
      const double turns = std::nearbyint((x[p] - middle) / length);
      if (turns == 0) continue;
      for (int k = 0; k < c.corner_count; ++k) column(k)[p] += turns * length;
    }
  }
}

double depth_of(const TransferGrid& grid, const Nine<const double>& edges, std::size_t p) {
  double depth = 1;
  for (int d = 0, a = 0; d < 3; ++d)
    if (a < grid.count && grid.active[static_cast<std::size_t>(a)] == d)
      ++a;
    else
      depth *= edges[static_cast<std::size_t>(4 * d)][p] *
               grid.axes[static_cast<std::size_t>(d)].spacing;
  return depth;
}

}  // namespace sluice::mpm
