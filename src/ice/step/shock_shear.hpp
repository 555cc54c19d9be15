// Shear along strong shocks: what faces whose normals lie in the plane of a shock exchange of the
// momentum along them.
//
//   q_c = k min(rho_a, rho_b) (u_b - u_a)_c   through a face of axis d, for c != d
//   dp_c takes sum_d (q_c+ - q_c-),   E* gains sum_d [q+ . (u_f+ - ub) - q- . (u_f- - ub)]
// u_f: mean of the two cells. Per volume of a cell; k: one_material/shock_shear.cpp, zero to the
// bit away from shocks. What is lost of kinetic energy becomes heat, exactly.
//
// Marks are 1 in cells where something is, else 0. Where a cell is not marked its strength may be
// of an earlier row, and must not be read: a row may be of several rows of the task that wrote it.
#pragma once
#include <array>
#include <bit>
#include <cstdint>

#include "ice/fluid/limiters.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

// Rows are looked at so many cells at a time.
constexpr int marked_cells = 16;

// Whether one of the cells from `first` to `last` is marked.
inline bool any_flag_set(const double* marks, int first, int last) {
  std::uint64_t bits = 0;
  for (int i = first; i <= last; ++i) bits |= std::bit_cast<std::uint64_t>(marks[i]);
  return bits != 0;
}

template <std::size_t N>
using FlagRows = std::array<const double*, N>;

template <std::size_t N>
bool any_flag_set(const FlagRows<N>& rows, int first, int last) {
  std::uint64_t bits = 0;
  for (int i = first; i <= last; ++i)
    for (const double* marks : rows) bits |= std::bit_cast<std::uint64_t>(marks[i]);
  return bits != 0;
}

// f(part of the row) where is_wanted(first, count), in longest parts.
template <class Wanted, class F>
void for_each_part(const Row& row, Wanted&& is_wanted, F&& f) {
  const int n = row.count();
  int begin = 0;  // of the part that is open
  for (int first = 0; first < n; first += marked_cells) {
    const int count = n - first < marked_cells ? n - first : marked_cells;
    if (is_wanted(first, count)) continue;
    if (first > begin) f(row.part(begin, first - begin));
    begin = first + count;
  }
  if (n > begin) f(row.part(begin, n - begin));
}

// f(part of the row) where one of these rows of marks is set, from so many cells before it to one
// behind it.
template <std::size_t N, class F>
void for_each_marked_part(const Row& row, const FlagRows<N>& rows, int before, F&& f) {
  if (!any_flag_set(rows, -before, row.count())) return;
  for_each_part(
      row, [&](int first, int count) { return any_flag_set(rows, first - before, first + count); },
      f);
}

struct ShockShearReads {
  In strength, marks;  // k of the low faces by axis; where one is not zero
  In rho, velocity;    // of cells and those around
  Out impulse;
};

// What the Lagrangian phase takes of it.
struct ShockShearInput {
  VariableId shear, marks, rho, velocity;

  static ShockShearInput of(const SchemeVariables& v) {
    return {.shear = v.shear, .marks = v.shear_marks, .rho = v.rho, .velocity = v.velocity};
  }
};
inline ShockShearReads read_shock_shear(TaskBuilder& task, const ShockShearInput& v) {
  ShockShearReads h;
  const Stencil and_above{{}, IntVec3::all(1)};  // the high faces are the low ones of these
  h.strength = task.read(v.shear, and_above);
  h.marks = task.read(v.marks, and_above);
  h.rho = task.read(v.rho, Stencil::box(1));
  h.velocity = task.read(v.velocity, Stencil::box(1));
  return h;
}

template <int D>
FlagRows<D> sheared_rows(const Row& row, const ShockShearReads& h) {
  FlagRows<D> rows;
  for (int d = 0; d < D; ++d)
    rows[d] = row.at_offset(h.marks, 0, {0, d == 1 ? 1 : 0, d == 2 ? 1 : 0});
  return rows;
}

// Whether some faces of the cells of a row exchange shear.
template <int D>
bool is_sheared(const Row& row, const ShockShearReads& h) {
  return any_flag_set(sheared_rows<D>(row, h), 0, row.count());
}

// Calls f(part) for parts of a row of cells of whose faces some do.
template <int D, class F>
void for_each_sheared_part(const Row& row, const ShockShearReads& h, F&& f) {
  for_each_marked_part(row, sheared_rows<D>(row, h), 0, f);
}

// The faces of a part of a row of cells along one axis: marks (0 or 1) and strengths k (without
// unit) of low and high faces; densities of the cell, of the one below and of the one above,
// kg/m^3.
struct ShearedFaces {
  const double *mm, *mp, *km, *kp, *r, *rm, *rp;

  ShearedFaces() = default;
  ShearedFaces(const Row& row, const ShockShearReads& h, int axis)
      : mm(row(h.marks)),
        mp(row(h.marks, 0, axis, 1)),
        km(row(h.strength, axis)),
        kp(row(h.strength, axis, axis, 1)),
        r(row(h.rho)),
        rm(row(h.rho, 0, axis, -1)),
        rp(row(h.rho, 0, axis, 1)) {}
  // k min(rho_a, rho_b) of the low and of the high face, kg/m^3.
  double below(int i) const {
    const double k = km[i] * smaller(rm[i], r[i]);
    return mm[i] != 0.0 ? k : 0.0;
  }
  double above(int i) const {
    const double k = kp[i] * smaller(r[i], rp[i]);
    return mp[i] != 0.0 ? k : 0.0;
  }
};

// Takes from the impulse what the cells get of their neighbours' momentum.
template <int D, int C>
void take_shear(const Row& whole, const ShockShearReads& h) {
  for_each_sheared_part<D>(whole, h, [&](const Row& row) {
    const int n = row.count();
    std::array<ShearedFaces, D> faces;
    for (int d = 0; d < D; ++d) faces[d] = {row, h, d};
    for (int c = 0; c < C; ++c) {
      double* __restrict dp = row(h.impulse, c);
      const double *u = row(h.velocity, c), *um[D], *up[D];
      for (int d = 0; d < D; ++d) {
        um[d] = row(h.velocity, c, d, -1);
        up[d] = row(h.velocity, c, d, 1);
      }
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) {
        double pull = 0;  // of all axes first: the order of two does not show in the bits
#pragma GCC unroll 3
        for (int d = 0; d < D; ++d) {
          const ShearedFaces& f = faces[d];
          if (d != c) pull += f.above(i) * (up[d][i] - u[i]) - f.below(i) * (u[i] - um[d][i]);
        }
        dp[i] -= pull;
      }
    }
  });
}

// The heat of it, into E (J/m^3), in a part of a row; w: 1/mass, m^3/kg.
template <int D, int C>
void add_heat_of_shear(const Row& row, const ShockShearReads& h, const double* w,
                       double* __restrict energy) {
  const double *um[D][C], *up[D][C], *u[C], *dp[C];
  std::array<ShearedFaces, D> faces;
  for (int d = 0; d < D; ++d) faces[d] = {row, h, d};
  for (int c = 0; c < C; ++c) {
    u[c] = row(h.velocity, c);
    dp[c] = row(h.impulse, c);
    for (int d = 0; d < D; ++d) {
      um[d][c] = row(h.velocity, c, d, -1);
      up[d][c] = row(h.velocity, c, d, 1);
    }
  }
  const int n = row.count();
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    double work = 0;
#pragma GCC unroll 3
    for (int d = 0; d < D; ++d) {
      const ShearedFaces& f = faces[d];
      const double above = f.above(i), below = f.below(i);
      double along = 0, carried = 0;
#pragma GCC unroll 3
      for (int c = 0; c < C; ++c) {
        if (c == d) continue;
        const double ub = u[c][i] - 0.5 * dp[c][i] * w[i];
        const double high = above * (up[d][c][i] - u[c][i]);
        const double low = below * (u[c][i] - um[d][c][i]);
        (c < D ? along : carried) += high * (0.5 * (u[c][i] + up[d][c][i]) - ub) -
                                     low * (0.5 * (um[d][c][i] + u[c][i]) - ub);
      }
      work += along + carried;
    }
    energy[i] += work;
  }
}

}  // namespace sluice::ice
