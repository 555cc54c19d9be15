// Grid to particles with corners.
#include "mpm/nodes/node_sums.hpp"
#include "mpm/transfer/corner_transfer.hpp"
#include "mpm/transfer/corners.hpp"
#include "mpm/transfer/window_axes.hpp"

namespace sluice::mpm {
namespace {

// v*, and its change where that is asked for.
struct Values {
  Four velocity, change;
};

// Values at a corner: hats, axis after axis.
template <int D, bool Changes>
inline Values at_corner(const std::int64_t* node, const std::ptrdiff_t (&stride)[D],
                        const double (&s)[D]) {
  Values v[1 << D];
  for (int i = 0; i < 1 << D; ++i) {
    const std::int64_t* from = node;
    for (int a = 0; a < D; ++a) from += (i >> a & 1) * stride[a];
    v[i].velocity = *reinterpret_cast<const FourAtNode*>(from);
    if constexpr (Changes) v[i].change = *reinterpret_cast<const FourAtNode*>(from + 4);
  }
  for (int a = 0; a < D; ++a) {
    const double low = 0.5 - s[a], up = 0.5 + s[a];
    for (int i = 0; i < 1 << (D - 1 - a); ++i) {
      v[i].velocity = low * v[2 * i].velocity + up * v[2 * i + 1].velocity;
      if constexpr (Changes) v[i].change = low * v[2 * i].change + up * v[2 * i + 1].change;
    }
  }
  return v[0];
}

template <int D, bool Tetrahedron, Reading reading>
void read_block(const TransferGrid& grid, const std::array<const double*, 3>& x,
                const ParticleShape& shape, int at, int n, const Window& window,
                GridAtParticles& to) {
  constexpr bool Changes = reading != Reading::velocities;
  constexpr bool gradients = reading != Reading::motion;
  using Corner = Corners<D, Tetrahedron>;
  static thread_local Corner corners;
  find_corners(grid, x, shape, at, n, gradients ? Slopes::wanted : Slopes::unused, corners);
  const WindowAxes<D> axes(grid, window);
  const std::int64_t* nodes = window.at(0, 0, 0);
  const bool carried = shape.corners[0] != nullptr;
  for (int q = 0; q < n; ++q) {
    Four velocity[Corner::count], change[Corner::count];
    for (int c = 0; c < Corner::count; ++c) {
      const std::int64_t* node = nodes;
      double s[D];
      for (int a = 0; a < D; ++a) {
        s[a] = corners.s[c][a][q];
        node += (corners.first[c][a][q] - axes.low[a]) * axes.stride[a];
      }
      const Values v = at_corner<D, Changes>(node, axes.stride, s);
      velocity[c] = v.velocity;
      for (int e = 0; e < 3 && carried; ++e) to.corner[c][e][q] = v.velocity[e];
      if constexpr (Changes) change[c] = v.change;
    }
    const Four u = corner_sum(velocity) * Corner::share;
    for (int e = 0; e < 3; ++e) to.u[e][q] = u[e];
    if constexpr (!Changes) to.fourth[q] = u[3];
    if constexpr (Changes) {
      const Four dv = corner_sum(change) * Corner::share;
      for (int e = 0; e < 3; ++e) to.dv[e][q] = dv[e];
    }
    for (int a = 0; a < D && gradients; ++a) {
      Four part[Corner::count];
      for (int c = 0; c < Corner::count; ++c) part[c] = corners.slope[c][a][q] * velocity[c];
      const Four slope = corner_sum(part);
      const int d = grid.active[a];
      for (int e = 0; e < 3; ++e) to.L[3 * e + d][q] = slope[e];
    }
  }
  if constexpr (gradients) clear_inactive(grid, n, false, to);
}

}  // namespace

void read_corners(Basis basis, const TransferGrid& grid, const std::array<const double*, 3>& x,
                  const ParticleShape& shape, int at, int n, Reading reading, const Window& window,
                  GridAtParticles& to) {
  const auto go = [&]<int D, bool Tetrahedron>() {
    if (reading == Reading::all)
      read_block<D, Tetrahedron, Reading::all>(grid, x, shape, at, n, window, to);
    else if (reading == Reading::motion)
      read_block<D, Tetrahedron, Reading::motion>(grid, x, shape, at, n, window, to);
    else
      read_block<D, Tetrahedron, Reading::velocities>(grid, x, shape, at, n, window, to);
  };
  if (basis == Basis::cpti) return go.template operator()<3, true>();
  if (grid.count == 3) return go.template operator()<3, false>();
  if (grid.count == 2) return go.template operator()<2, false>();
  go.template operator()<1, false>();
}

}  // namespace sluice::mpm
