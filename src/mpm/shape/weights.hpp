// Weights of particles on nodes along one axis, and their derivatives:
// docs/theory/mpm_transfers.md, "Shape functions".
//
// S_ip is the product of the weights of the axes, G_ip = grad S_ip. Each basis works on columns of
// places, so that its loop becomes vectors. Sums over a stencil go outside in ((first + last) +
// middle): mirror images have mirrored bits. Weights have no unit, lengths are in m; half widths of
// particles are in cells.
#pragma once
#include <algorithm>
#include <cmath>

#include "mpm/shape/axis.hpp"

namespace sluice::mpm {

inline constexpr int chunk_size = 64;  // particles whose weights are made together

// N weights of each particle of a chunk along one axis.
template <int N>
struct AxisWeights {
  alignas(64) double w[N][chunk_size];    // S
  alignas(64) double d[N][chunk_size];    // dS/dx, 1/length
  alignas(64) double off[N][chunk_size];  // x_i - x_p, length
  alignas(64) int first[chunk_size];      // index of the lowest node
};

// The nearest node (or, for an even number of nodes, the middle of the nearest cell) of a place.
inline double nearest_node(const Axis& a, double u) {
  return a.odd ? std::floor(u) + 0.5 : std::nearbyint(u);
}
inline double nearest_middle(const Axis& a, double u) {
  return a.odd ? std::nearbyint(u) : std::floor(u) + 0.5;
}

// Hat functions (2 nodes).
struct Linear {
  static constexpr int nodes = 2;
  static constexpr int below = 0;  // nodes reached below the cell of the place
  template <bool Offsets>
  static void weights(const Axis& a, const double* x, double /*half*/, int n, AxisWeights<2>& to) {
    const double inverse = a.inverse;
    for (int p = 0; p < n; ++p) {
      const double u = a.place(x[p]), r = nearest_middle(a, u), s = u - r;
      to.first[p] = static_cast<int>(r - 0.5 + a.first);
      to.w[0][p] = 0.5 - s;
      to.w[1][p] = 0.5 + s;
      to.d[0][p] = -inverse;
      to.d[1][p] = inverse;
      if constexpr (Offsets) {
        to.off[0][p] = (-0.5 - s) * a.spacing;
        to.off[1][p] = (0.5 - s) * a.spacing;
      }
    }
  }
};

// Particles of half width l = half/h <= 1/2 cells (uGIMP); with l = 1/2 the quadratic B-spline.
// S. G. Bardenhagen, E. M. Kober, CMES 5 (2004) 477.
struct Gimp {
  static constexpr int nodes = 3;
  template <bool Offsets>
  static void weights(const Axis& a, const double* x, double half, int n, AxisWeights<3>& to) {
    const double quarter = 1 / (4 * half), slope = a.inverse / (2 * half);
    weights_of_widths<Offsets>(a, x, n, to, [&](int) { return Width{half, quarter, slope}; });
  }
  // Each particle has a half width of its own.
  template <bool Offsets>
  static void weights(const Axis& a, const double* x, const double* half, int n,
                      AxisWeights<3>& to) {
    weights_of_widths<Offsets>(a, x, n, to, [&](int p) {
      return Width{half[p], 1 / (4 * half[p]), a.inverse / (2 * half[p])};
    });
  }

 private:
  struct Width {
    double half, quarter, slope;
  };
  template <bool Offsets, class Widths>
  static void weights_of_widths(const Axis& a, const double* x, int n, AxisWeights<3>& to,
                                const Widths& widths) {
    for (int p = 0; p < n; ++p) {
      const auto [l, quarter, slope] = widths(p);
      const double u = a.place(x[p]), r = nearest_node(a, u), s = u - r;
      to.first[p] = static_cast<int>(r + a.first) - 1;
      const double c = std::min(l, std::max(-l, s));  // a in the reference
      const double up = l + c, down = l - c;
      const double high = up * up * quarter + std::max(0.0, s - l);
      const double low = down * down * quarter + std::max(0.0, -s - l);
      to.w[0][p] = low;
      to.w[2][p] = high;
      to.w[1][p] = 1 - (low + high);
      const double d_high = up * slope, d_low = -(down * slope);
      to.d[0][p] = d_low;
      to.d[2][p] = d_high;
      to.d[1][p] = -(d_low + d_high);
      if constexpr (Offsets) {
        to.off[0][p] = (-1 - s) * a.spacing;
        to.off[1][p] = -s * a.spacing;
        to.off[2][p] = (1 - s) * a.spacing;
      }
    }
  }
};

// The same, each particle with a half width of its own.
struct GimpOfOwnWidths : Gimp {};

// Cubic B-spline (4 nodes).
struct Cubic {
  static constexpr int nodes = 4;
  template <bool Offsets>
  static void weights(const Axis& a, const double* x, double /*half*/, int n, AxisWeights<4>& to) {
    const double inverse = a.inverse;
    for (int p = 0; p < n; ++p) {
      const double u = a.place(x[p]), r = nearest_middle(a, u), s = u - r;
      to.first[p] = static_cast<int>(r - 0.5 + a.first) - 1;
      const double m = 0.5 - s, q = 0.5 + s;  // a, b in the reference
      const double m2 = m * m, q2 = q * q, m3 = m2 * m, q3 = q2 * q;
      to.w[0][p] = m3 / 6;
      to.w[1][p] = (2.0 / 3 - q2) + 0.5 * q3;
      to.w[2][p] = (2.0 / 3 - m2) + 0.5 * m3;
      to.w[3][p] = q3 / 6;
      to.d[0][p] = -0.5 * m2 * inverse;
      to.d[1][p] = (1.5 * q2 - 2 * q) * inverse;
      to.d[2][p] = (2 * m - 1.5 * m2) * inverse;
      to.d[3][p] = 0.5 * q2 * inverse;
      if constexpr (Offsets)
        for (int i = 0; i < 4; ++i) to.off[i][p] = (i - 1.5 - s) * a.spacing;
    }
  }
};

}  // namespace sluice::mpm
