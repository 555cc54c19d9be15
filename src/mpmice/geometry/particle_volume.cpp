#include "mpmice/geometry/particle_volume.hpp"

#include <algorithm>

namespace sluice::mpmice {
namespace {

using Place = std::array<const double*, 3>;

// What one face of hexahedra gives to b of its corners; x, b: in the order of the face.
void add_face(const std::array<Place, 4>& x, int n,
              const std::array<std::array<double*, 3>, 4>& b) {
  for (std::size_t d = 0; d < 3; ++d) {
    const std::size_t u = (d + 1) % 3, v = (d + 2) % 3;
    const double *au = x[0][u], *bu = x[1][u], *cu = x[2][u], *du = x[3][u];
    const double *av = x[0][v], *bv = x[1][v], *cv = x[2][v], *dv = x[3][v];
    double *at_a = b[0][d], *at_b = b[1][d], *at_c = b[2][d], *at_d = b[3][d];
#pragma GCC ivdep
    for (int q = 0; q < n; ++q) {
      // Diagonals e = c - a, f = d - b; from the centre: x_a - m = -(e + g)/2, x_c - m = (e - g)/2,
      // x_b - m = (g - f)/2, x_d - m = (g + f)/2 with g = ((b + d) - (a + c))/2.
      const double eu = cu[q] - au[q], fu = du[q] - bu[q];
      const double ev = cv[q] - av[q], fv = dv[q] - bv[q];
      const double gu = 0.5 * ((bu[q] - au[q]) + (du[q] - cu[q]));
      const double gv = 0.5 * ((bv[q] - av[q]) + (dv[q] - cv[q]));
      const double whole = (eu * fv - ev * fu) * (1.0 / 24);
      // f x (x_a - m), -e x (x_b - m), -f x (x_c - m), e x (x_d - m), by their halves.
      const double fe = fu * ev - fv * eu, fg = fu * gv - fv * gu, eg = eu * gv - ev * gu;
      at_a[q] += whole - (fe + fg) * (1.0 / 12);
      at_b[q] += whole - (eg + fe) * (1.0 / 12);
      at_c[q] += whole - (fe - fg) * (1.0 / 12);
      at_d[q] += whole + (eg - fe) * (1.0 / 12);
    }
  }
}

template <int D>
void find_gradients(const CornerColumns<D>& x, std::size_t at, int n, VolumeGradients<D>& to) {
  constexpr std::size_t corners = corners_of_particle<D>;
  for (std::size_t c = 0; c < corners; ++c)
    for (std::size_t d = 0; d < D; ++d)
      std::fill_n(to.b[c][d], n, D > 1 ? 0.0 : c == 0 ? -1.0 : 1.0);
  if constexpr (D == 2) {
    constexpr std::array<std::size_t, 4> around{0, 1, 3, 2};  // counterclockwise
    for (std::size_t k = 0; k < 4; ++k) {
      const auto &next = x[around[(k + 1) % 4]], &previous = x[around[(k + 3) % 4]];
      const double *xn = next[0] + at, *yn = next[1] + at;
      const double *xp = previous[0] + at, *yp = previous[1] + at;
      auto& b = to.b[around[k]];
#pragma GCC ivdep
      for (int q = 0; q < n; ++q) {
        b[0][q] = 0.5 * (yn[q] - yp[q]);
        b[1][q] = -0.5 * (xn[q] - xp[q]);
      }
    }
  } else if constexpr (D == 3) {
    for (const auto& face : face_corners<3>) {
      std::array<Place, 4> places;
      std::array<std::array<double*, 3>, 4> b;
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t d = 0; d < 3; ++d) {
          places[k][d] = x[face[k]][d] + at;
          b[k][d] = to.b[face[k]][d];
        }
      add_face(places, n, b);
    }
  }
}

}  // namespace

template <int D>
void volume_gradients(const CornerColumns<D>& x, std::size_t at, int n, VolumeGradients<D>& to) {
  find_gradients<D>(x, at, n, to);
  std::fill_n(to.volume, n, 0.0);
  for (std::size_t c = 1; c < corners_of_particle<D>; ++c)
    for (std::size_t d = 0; d < D; ++d) {
      const double *here = x[c][d] + at, *first = x[0][d] + at, *b = to.b[c][d];
#pragma GCC ivdep
      for (int q = 0; q < n; ++q) to.volume[q] += b[q] * (here[q] - first[q]);
    }
  for (int q = 0; q < n; ++q) to.volume[q] *= 1.0 / D;
}

template void volume_gradients<1>(const CornerColumns<1>&, std::size_t, int, VolumeGradients<1>&);
template void volume_gradients<2>(const CornerColumns<2>&, std::size_t, int, VolumeGradients<2>&);
template void volume_gradients<3>(const CornerColumns<3>&, std::size_t, int, VolumeGradients<3>&);

}  // namespace sluice::mpmice
