// Where faces exchange shear along strong shocks, and how much: step/shock_shear.hpp.
//
// Over each face across another axis t, of either of its two cells a and b, that jumps: |dp| > K/3
// with K = rho c^2 the smaller of the two cells there:
//   s_t = (|du_t| + |dc|) min(1, 3 (|dp|/K - 1/3))
//   k   = min(.1, l_d/2 max s_t max(0, 1 - 3 |p_b - p_a|/max |dp|)),   l_d = dt/dx_d
// so that k is zero to the bit where no face beside jumps by more than a third of rho c^2 (which is
// more than a third of the pressure), and where the shock is inclined to the grid by more than
// about one in three.
// A grid holds a shock along it by dissipation across it alone: what differs from row to row inside
// the captured shock is no sound, is damped by nothing, and grows (Quirk, Int. J. Numer. Methods
// Fluids 18, 1994; Sanders, Morano and Druguet, J. Comput. Phys. 145, 1998).
// None on walls, nor on faces of cells that solids meet, nor from jumps there.
#include "ice/step/shock_shear.hpp"

#include <algorithm>

#include "framework/base/infinity.hpp"
#include "ice/one_material/tasks.hpp"
#include "ice/step/wall_faces.hpp"

namespace sluice::ice {
namespace {

// threshold: jump of the pressure, relative to rho c^2, above which faces along a shock exchange
//   momentum; unit: 1; test: ShockShear.LeavesSlipLinesAlone
constexpr double min_jump = 1.0 / 3;
// threshold: jump above which they exchange it in full; unit: 1; test:
//   ShockShear.RowsBehindAShockStayAlike
constexpr double full_jump = 2.0 / 3;
// coefficient: share of l s_t that is exchanged (head of this file); unit: 1
constexpr double shear_share = 0.5;
// threshold: largest share of the momentum that faces exchange in a step; unit: 1; test: none
constexpr double max_shear = 0.1;
// threshold: inclination of a shock to the grid, one in so many, from which on its faces exchange
//   none; unit: 1; test: FullStrongShocks.SedovShockStandsWhereItShould
constexpr double askew = 3;
// coefficient: of the least jump, where jumps are marked with another modulus; unit: 1
constexpr double marked_share = 0.999;

// ---- Low faces of cells across each axis t: |dp| and s_t where it jumps -------------------------

struct JumpHandles {
  In pressure, rho, sound, velocity, fraction;
  Out jumps, marks;  // |dp| of each axis, then s_t of each; where something is
};

// Marks cells of which a low face may jump: never none where one does. Whether there are any.
template <int D>
bool mark_jumps(const Row& row, const JumpHandles& h, double gamma) {
  const int n = row.count();
  const auto below = [&](In in, int d) { return row(in, 0, d, -1); };
  const double *p = row(h.pressure), *pl = below(h.pressure, 0), *pb = below(h.pressure, 1);
  const double* pd = D == 3 ? below(h.pressure, 2) : p;
  double* __restrict marks = row(h.marks);
  std::int64_t jumps = 0;
  const auto mark = [&](auto modulus) {
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double high = larger(larger(p[i], pl[i]), larger(pb[i], pd[i]));
      const double low = smaller(smaller(p[i], pl[i]), smaller(pb[i], pd[i]));
      const bool jump = high - low > marked_share * min_jump * modulus(i, low);
      marks[i] = jump ? 1.0 : 0.0;
      jumps += jump ? 1 : 0;
    }
  };
  if (gamma > 0) {
    mark([=](int, double low) { return gamma * low; });
    return jumps != 0;
  }
  const double *r = row(h.rho), *rl = below(h.rho, 0), *rb = below(h.rho, 1);
  const double *c = row(h.sound), *cl = below(h.sound, 0), *cb = below(h.sound, 1);
  const double* rd = D == 3 ? below(h.rho, 2) : r;
  const double* cd = D == 3 ? below(h.sound, 2) : c;
  mark([=](int i, double) {
    return smaller(smaller(r[i] * (c[i] * c[i]), rl[i] * (cl[i] * cl[i])),
                   smaller(rb[i] * (cb[i] * cb[i]), rd[i] * (cd[i] * cd[i])));
  });
  return jumps != 0;
}

// Of a part of a row, across axis t.
template <bool Walled>
void find_jumps(const Row& row, const JumpHandles& h, int axes, int t) {
  const double *pa = row(h.pressure, 0, t, -1), *pb = row(h.pressure);
  const double *ra = row(h.rho, 0, t, -1), *rb = row(h.rho);
  const double *ca = row(h.sound, 0, t, -1), *cb = row(h.sound);
  const double *ua = row(h.velocity, t, t, -1), *ub = row(h.velocity, t);
  const double *fa = Walled ? row(h.fraction, 0, t, -1) : pa, *fb = Walled ? row(h.fraction) : pb;
  double* __restrict jump = row(h.jumps, t);
  double* __restrict speed = row(h.jumps, axes + t);
  const int n = row.count();
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double dp = std::fabs(pb[i] - pa[i]);
    const double K = smaller(ra[i] * (ca[i] * ca[i]), rb[i] * (cb[i] * cb[i]));
    const double solid = Walled ? fa[i] + fb[i] : 0.0;
    const double limit = solid > 0.0 ? infinity : min_jump * K;
    const double weight = smaller((dp / K - min_jump) / (full_jump - min_jump), 1.0);
    const double s = (std::fabs(ub[i] - ua[i]) + std::fabs(cb[i] - ca[i])) * weight;
    jump[i] = dp > limit ? dp : 0.0;
    speed[i] = dp > limit ? s : 0.0;
  }
}

// `gamma`: of the one ideal gas, else 0.
template <int D>
void jumps_row(const Row& row, const JumpHandles& h, double gamma) {
  if (!mark_jumps<D>(row, h, gamma)) return;
  const double* marks = row(h.marks);
  for_each_part(
      row, [&](int first, int count) { return any_flag_set(marks + first, 0, count - 1); },
      [&](const Row& part) {
        for (int t = 0; t < D; ++t)
          h.fraction.index < 0 ? find_jumps<false>(part, h, D, t) : find_jumps<true>(part, h, D, t);
      });
}

void add_jumps(TaskList& list, const ShockShearTaskInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("where pressure jumps", effect);
  Stencil below;
  for (int d = 0; d < o.grid.axes.count; ++d) below.low[o.grid.axes.direction[d]] = 1;
  JumpHandles h;
  h.pressure = task.read(v.pressure, below);
  h.rho = task.read(v.rho, below);
  h.sound = task.read(v.sound, below);
  h.velocity = task.read(v.velocity, below);
  if (o.grid.has_cut_cells) h.fraction = task.read(v.fraction, below);
  h.jumps = task.write(v.jumps);
  h.marks = task.write(v.jump_marks);
  const eos::IdealGas* gas =
      o.materials.mixture || o.materials.mixed != nullptr ? nullptr : o.materials.fluid.gamma_law();
  task.kernel(
      [=, gamma = gas != nullptr ? gas->gamma : 0, axes = o.grid.axes.count](const Row& row) {
        axes == 2 ? jumps_row<2>(row, h, gamma) : jumps_row<3>(row, h, gamma);
      });
}

// ---- k of the low faces of cells, from the faces across the other axes --------------------------

struct Handles {
  In pressure, fraction, jumps, jump_marks;
  Out strength, fastest, marks;
};

// Of the faces of a part of a row along axis d.
template <int D>
void find_strength(const Row& row, const Handles& h, int d, double l) {
  const int n = row.count();
  double* __restrict largest = row(h.strength, d);
  double* __restrict fastest = row(h.fastest);
  std::fill_n(largest, n, 0.0);
  std::fill_n(fastest, n, 0.0);
  for (int t = 0; t < D; ++t) {
    if (t == d) continue;
    for (const int side : {-1, 0})     // of the cells that the face lies between
      for (const int high : {0, 1}) {  // of the faces of such a cell
        std::array<int, 3> at{};
        at[d] = side;
        at[t] = high;
        const double* marks = row.at_offset(h.jump_marks, 0, at);
        const double* jump = row.at_offset(h.jumps, t, at);
        const double* speed = row.at_offset(h.jumps, D + t, at);
#pragma GCC ivdep
        for (int i = 0; i < n; ++i) {
          const double dp = jump[i], s = speed[i];
          largest[i] = larger(largest[i], marks[i] != 0.0 ? dp : 0.0);
          fastest[i] = larger(fastest[i], marks[i] != 0.0 ? s : 0.0);
        }
      }
  }
  const double *pa = row(h.pressure, 0, d, -1), *pb = row(h.pressure);
  double* __restrict k = largest;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double dp = largest[i], plane = larger(0.0, dp - askew * std::fabs(pb[i] - pa[i]));
    const double wanted = shear_share * l * fastest[i] * plane / dp;
    k[i] = dp > 0.0 ? smaller(wanted, max_shear) : 0.0;
  }
}

void clear_beside_solids(const Row& row, const Handles& h, int axis, double* k) {
  const double *fa = row(h.fraction, 0, axis, -1), *fb = row(h.fraction);
  for (int i = 0; i < row.count(); ++i) k[i] = fa[i] + fb[i] > 0.0 ? 0.0 : k[i];
}

// The rows of marks around a row, of all axes but the one along it.
template <int D>
auto marks_around(const Row& row, In marks) {
  constexpr std::size_t count = D == 2 ? 3 : 9;
  FlagRows<count> rows;
  for (std::size_t n = 0; n < count; ++n) {
    const int j = static_cast<int>(n % 3) - 1, k = static_cast<int>(n / 3) - 1;
    rows[n] = row.at_offset(marks, 0, {0, j, D == 2 ? 0 : k});
  }
  return rows;
}

template <int D>
void strength_row(const Row& whole, const Handles& h, const SchemeOptions& o) {
  std::fill_n(whole(h.marks), whole.count(), 0.0);
  for_each_marked_part(whole, marks_around<D>(whole, h.jump_marks), 1, [&](const Row& row) {
    const int n = row.count();
    bool any = false;
    for (int d = 0; d < D; ++d) {
      find_strength<D>(row, h, d, row.step().dt / row.step().spacing[o.grid.axes.direction[d]]);
      double* k = row(h.strength, d);
      if (h.fraction.index >= 0) clear_beside_solids(row, h, d, k);
      for_each_wall_face(row, o, d, [&](int i, bool) { k[i] = 0.0; });
      any = any || any_flag_set(k, 0, n - 1);
    }
    if (any) std::fill_n(row(h.marks), n, 1.0);
  });
}

}  // namespace

void add_shock_shear(TaskList& list, const ShockShearTaskInput& v, const SchemeOptions& o,
                     int effect) {
  if (!o.scheme.shears_shocks) return;
  add_jumps(list, v, o, effect);
  TaskBuilder task = list.task("shear along shocks", effect);
  const Stencil around = Stencil::box(1);
  Handles h;
  h.pressure = task.read(v.pressure, around);
  if (o.grid.has_cut_cells) h.fraction = task.read(v.fraction, around);
  h.jumps = task.read(v.jumps, around);
  h.jump_marks = task.read(v.jump_marks, around);
  h.strength = task.write(v.shear);
  h.fastest = task.write(list.temporary("speeds across shocks"));
  h.marks = task.write(v.shear_marks);
  task.kernel([=, axes = o.grid.axes.count](const Row& row) {
    axes == 2 ? strength_row<2>(row, h, o) : strength_row<3>(row, h, o);
  });
}

}  // namespace sluice::ice
