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

#include "framework/base/eight.hpp"
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

// The nearest node (or, for an even number of nodes, the middle of the nearest cell) of a place;
// T: double, or Eight of eight places.
template <class T>
[[gnu::always_inline]] inline T nearest_node(const Axis& a, const T& u) {
  return a.odd ? rounded_down(u) + 0.5 : rounded_to_even(u);
}
template <class T>
[[gnu::always_inline]] inline T nearest_middle(const Axis& a, const T& u) {
  return a.odd ? rounded_to_even(u) : rounded_down(u) + 0.5;
}

// Hat functions (2 nodes).
struct Linear {
  static constexpr int nodes = 2;
  static constexpr int below = 0;  // nodes reached below the cell of the place
  template <bool Offsets>
  static void weights(const Axis& axis, const double* x, double /*half*/, int n,
                      AxisWeights<2>& to) {
    const Axis a = axis;
    for_eights(0, static_cast<std::size_t>(n), [&](auto p) {
      using T = typename decltype(p)::Number;
      const T u = a.place(p(x)), r = nearest_middle(a, u), s = u - r;
      p.put(r - 0.5 + a.first, to.first);
      p.put(0.5 - s, to.w[0]);
      p.put(0.5 + s, to.w[1]);
      p.put(T{} - a.inverse, to.d[0]);
      p.put(T{} + a.inverse, to.d[1]);
      if constexpr (Offsets) {
        p.put((-0.5 - s) * a.spacing, to.off[0]);
        p.put((0.5 - s) * a.spacing, to.off[1]);
      }
    });
  }
};

// Particles of half width l = half/h <= 1/2 cells (uGIMP); with l = 1/2 the quadratic B-spline.
// S. G. Bardenhagen, E. M. Kober, CMES 5 (2004) 477.
struct Gimp {
  static constexpr int nodes = 3;
  template <bool Offsets>
  static void weights(const Axis& a, const double* x, double half, int n, AxisWeights<3>& to) {
    const double quarter = 1 / (4 * half), slope = a.inverse / (2 * half);
    weights_of_widths<Offsets>(a, x, n, to, [=](auto p) {
      const typename decltype(p)::Number zero{};
      return Width{zero + half, zero + quarter, zero + slope};
    });
  }
  // Each particle has a half width of its own.
  template <bool Offsets>
  static void weights(const Axis& a, const double* x, const double* half, int n,
                      AxisWeights<3>& to) {
    const double inverse = a.inverse;
    weights_of_widths<Offsets>(a, x, n, to, [=](auto p) {
      const auto l = p(half);
      return Width{l, 1.0 / (4.0 * l), inverse / (2.0 * l)};
    });
  }

 private:
  template <class T>
  struct Width {
    T half, quarter, slope;
  };
  template <bool Offsets, class Widths>
  static void weights_of_widths(const Axis& axis, const double* x, int n, AxisWeights<3>& to,
                                const Widths& widths) {
    const Axis a = axis;
    for_eights(0, static_cast<std::size_t>(n), [&](auto p) {
      using T = typename decltype(p)::Number;
      const Width<T> width = widths(p);
      const T l = width.half, zero{};
      const T u = a.place(p(x)), r = nearest_node(a, u), s = u - r;
      p.put(r + a.first - 1.0, to.first);
      const T c = smaller(l, larger(T(-l), s));  // a in the reference
      const T up = l + c, down = l - c;
      const T high = up * up * width.quarter + larger(zero, T(s - l));
      const T low = down * down * width.quarter + larger(zero, T(-s - l));
      p.put(low, to.w[0]);
      p.put(high, to.w[2]);
      p.put(1.0 - (low + high), to.w[1]);
      const T d_high = up * width.slope, d_low = -(down * width.slope);
      p.put(d_low, to.d[0]);
      p.put(d_high, to.d[2]);
      p.put(-(d_low + d_high), to.d[1]);
      if constexpr (Offsets) {
        p.put((-1.0 - s) * a.spacing, to.off[0]);
        p.put(-s * a.spacing, to.off[1]);
        p.put((1.0 - s) * a.spacing, to.off[2]);
      }
    });
  }
};

// The same, each particle with a half width of its own.
struct GimpOfOwnWidths : Gimp {};

// Cubic B-spline (4 nodes).
struct Cubic {
  static constexpr int nodes = 4;
  template <bool Offsets>
  static void weights(const Axis& axis, const double* x, double /*half*/, int n,
                      AxisWeights<4>& to) {
    const Axis a = axis;
    for_eights(0, static_cast<std::size_t>(n), [&](auto p) {
      using T = typename decltype(p)::Number;
      const T u = a.place(p(x)), r = nearest_middle(a, u), s = u - r;
      p.put(r - 0.5 + a.first - 1.0, to.first);
      const T m = 0.5 - s, q = 0.5 + s;  // a, b in the reference
      const T m2 = m * m, q2 = q * q, m3 = m2 * m, q3 = q2 * q;
      p.put(m3 / 6.0, to.w[0]);
      p.put((2.0 / 3 - q2) + 0.5 * q3, to.w[1]);
      p.put((2.0 / 3 - m2) + 0.5 * m3, to.w[2]);
      p.put(q3 / 6.0, to.w[3]);
      p.put(-0.5 * m2 * a.inverse, to.d[0]);
      p.put((1.5 * q2 - 2.0 * q) * a.inverse, to.d[1]);
      p.put((2.0 * m - 1.5 * m2) * a.inverse, to.d[2]);
      p.put(0.5 * q2 * a.inverse, to.d[3]);
      if constexpr (Offsets)
        for (int i = 0; i < 4; ++i) p.put((i - 1.5 - s) * a.spacing, to.off[i]);
    });
  }
};

}  // namespace sluice::mpm
