// Shear along strong shocks: what faces whose normals lie in the plane of a shock exchange of the
// momentum along them.
//
//   q_c = k min(rho_a, rho_b) (u_b - u_a)_c   through a face of axis d, for c != d
//   dp_c takes sum_d (q_c+ - q_c-),   E* gains sum_d [q+ . (u_f+ - ub) - q- . (u_f- - ub)]
// u_f: mean of the two cells. Per volume of a cell; k: one_material/shock_shear.cpp, zero to the
// bit away from shocks. What is lost of kinetic energy becomes heat, exactly.
//
// Marks have two components: 1 in cells where something is, and 1 all along a row in which it is
// anywhere. Where that is 0 nothing else of the row is written or may be read.
#pragma once
#include <array>

#include "ice/fluid/limiters.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

// Rows are looked at so many cells at a time.
constexpr int marked_cells = 16;

// Whether one of the cells from `first` to `last` is marked: 1, else 0.
inline bool is_marked(const double* marks, int first, int last) {
  double highest = 0;
  for (int i = first; i <= last; ++i) highest = larger(highest, marks[i]);
  return highest != 0.0;
}

// A row of marks, and whether it has any.
struct MarkedRow {
  const double* marks = nullptr;  // null: none

  MarkedRow() = default;
  MarkedRow(const Row& row, In in, std::array<int, 3> offset)
      : marks(*row.at_offset(in, 1, offset) != 0.0 ? row.at_offset(in, 0, offset) : nullptr) {}
};

// f(part of the row) where one of these rows of marks is set, from so many cells before the part
// to one behind it.
template <std::size_t N, class F>
void for_each_marked_part(const Row& row, const std::array<MarkedRow, N>& rows, int before, F&& f) {
  bool none = true;
  for (const MarkedRow& m : rows) none = none && m.marks == nullptr;
  if (none) return;
  const int n = row.count();
  for (int first = 0; first < n; first += marked_cells) {
    const int count = n - first < marked_cells ? n - first : marked_cells;
    bool any = false;
    for (const MarkedRow& m : rows)
      any = any || (m.marks != nullptr && is_marked(m.marks, first - before, first + count));
    if (any) f(row.part(first, count));
  }
}

struct ShockShearReads {
  In strength, marks;  // k of the low faces by axis; where one is not zero
  In rho, velocity;    // of cells and those around
  Out impulse;
};

inline ShockShearReads read_shock_shear(TaskBuilder& task, const SchemeVariables& v) {
  ShockShearReads h;
  const Stencil and_above{{}, IntVec3::all(1)};  // the high faces are the low ones of these
  h.strength = task.read(v.shear, and_above);
  h.marks = task.read(v.shear_marks, and_above);
  h.rho = task.read(v.rho, Stencil::box(1));
  h.velocity = task.read(v.velocity, Stencil::box(1));
  return h;
}

// Calls f(part) for parts of a row of cells of whose faces some exchange shear.
template <int D, class F>
void for_each_sheared_part(const Row& row, const ShockShearReads& h, F&& f) {
  std::array<MarkedRow, D> rows;
  for (int d = 0; d < D; ++d)
    rows[static_cast<std::size_t>(d)] = {row, h.marks, {0, d == 1 ? 1 : 0, d == 2 ? 1 : 0}};
  for_each_marked_part(row, rows, 0, f);
}

inline constexpr double no_shear[marked_cells] = {};

// The faces of a part of a row of cells along one axis.
struct ShearedFaces {
  const double *km, *kp, *r, *rm, *rp;

  ShearedFaces() = default;
  ShearedFaces(const Row& row, const ShockShearReads& h, int axis)
      : km(row(h.marks, 1)[0] != 0.0 ? row(h.strength, axis) : no_shear),
        kp(row(h.marks, 1, axis, 1)[0] != 0.0 ? row(h.strength, axis, axis, 1) : no_shear),
        r(row(h.rho)),
        rm(row(h.rho, 0, axis, -1)),
        rp(row(h.rho, 0, axis, 1)) {}
  double below(int i) const { return km[i] * smaller(rm[i], r[i]); }
  double above(int i) const { return kp[i] * smaller(r[i], rp[i]); }
};

// Takes from the impulse what the cells get of their neighbours' momentum.
template <int D, int C>
void take_shear(const Row& whole, const ShockShearReads& h) {
  for_each_sheared_part<D>(whole, h, [&](const Row& row) {
    std::array<ShearedFaces, D> faces;
    for (int d = 0; d < D; ++d) faces[static_cast<std::size_t>(d)] = {row, h, d};
    for (int c = 0; c < C; ++c) {
      double* __restrict dp = row(h.impulse, c);
      const double *u = row(h.velocity, c), *um[D], *up[D];
      for (int d = 0; d < D; ++d) {
        um[d] = row(h.velocity, c, d, -1);
        up[d] = row(h.velocity, c, d, 1);
      }
      for (int i = 0; i < row.count(); ++i) {
        double pull = 0;  // of all axes first: the order of two does not show in the bits
        for (int d = 0; d < D; ++d) {
          const ShearedFaces& f = faces[static_cast<std::size_t>(d)];
          if (d != c) pull += f.above(i) * (up[d][i] - u[i]) - f.below(i) * (u[i] - um[d][i]);
        }
        dp[i] -= pull;
      }
    }
  });
}

// The heat of it, into E, in a part of a row; w: 1/mass.
template <int D, int C>
void add_heat_of_shear(const Row& row, const ShockShearReads& h, const double* w,
                       double* __restrict energy) {
  const double *um[D][C], *up[D][C], *u[C], *dp[C];
  std::array<ShearedFaces, D> faces;
  for (int d = 0; d < D; ++d) faces[static_cast<std::size_t>(d)] = {row, h, d};
  for (int c = 0; c < C; ++c) {
    u[c] = row(h.velocity, c);
    dp[c] = row(h.impulse, c);
    for (int d = 0; d < D; ++d) {
      um[d][c] = row(h.velocity, c, d, -1);
      up[d][c] = row(h.velocity, c, d, 1);
    }
  }
  for (int i = 0; i < row.count(); ++i) {
    double work = 0;
    for (int d = 0; d < D; ++d) {
      const ShearedFaces& f = faces[static_cast<std::size_t>(d)];
      const double above = f.above(i), below = f.below(i);
      double along = 0, carried = 0;
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
